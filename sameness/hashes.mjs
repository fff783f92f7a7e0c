// The hashes of the WebAssembly build, run where this is called: in Node.js or in a page, which is given its text alone.
export async function hashes(bytes) {
    const module = await WebAssembly.compile(bytes);
    // What a library may ask of a browser, no case calls.
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
        imports[from] ??= {};
        imports[from][name] = () => {
            throw new Error(`a case called ${name} of ${from}`);
        };
    }
    const { exports } = await WebAssembly.instantiate(module, imports);
    const count = exports.count();
    if (count === 0) throw new Error("a case failed: run the native program to see which");
    const hash = (line) => BigInt.asUintN(64, exports.hash(line)).toString(16).padStart(16, "0");
    return Array.from({ length: count }, (_, line) => hash(line));
}
