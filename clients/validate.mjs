// Issues of GLB files under the Khronos validator, as JSON.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(`${process.env.CLIENTS_NODE_MODULES}/`);
const validator = require("gltf-validator");
const reports = [];
for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
    reports.push({ ...report.issues, info: report.info });
}
console.log(JSON.stringify(reports));
