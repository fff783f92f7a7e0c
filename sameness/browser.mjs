// node browser.mjs FILE.wasm: the same in a page of Chromium, after a line with its version.
// Without a file: whether there is a browser, and the Playwright of web/ to drive it.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { hashes } from "./hashes.mjs";

const { chromium } = createRequire(new URL("../web/", import.meta.url))("@playwright/test");
// The distribution's browser, or else Playwright's own.
const distribution = "/usr/bin/chromium";
const browser = await chromium.launch({
    ...(existsSync(distribution) ? { executablePath: distribution } : {}),
    args: [
        "--no-sandbox",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
    ],
});
try {
    console.log(`# Chromium ${browser.version()}`);
    const file = process.argv[2];
    if (file !== undefined) {
        const page = await browser.newPage();
        const lines = await page.evaluate(hashes, new Uint8Array(await readFile(file)));
        console.log(lines.join("\n"));
    }
} finally {
    await browser.close();
}
