// node run.mjs FILE.wasm: the hashes of the WebAssembly build in Node.js, a line each.
import { readFile } from "node:fs/promises";
import { hashes } from "./hashes.mjs";

console.log((await hashes(await readFile(process.argv[2]))).join("\n"));
