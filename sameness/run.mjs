// node run.mjs FILE.wasm: the hashes of the WebAssembly build, a line each.
import { readFile } from "node:fs/promises";

const module = await WebAssembly.compile(await readFile(process.argv[2]));
const { exports } = await WebAssembly.instantiate(module, {});
const count = exports.count();
if (count === 0) throw new Error("a case failed: run the native program to see which");
for (let line = 0; line < count; line++) {
    console.log(BigInt.asUintN(64, exports.hash(line)).toString(16).padStart(16, "0"));
}
