// Runs the calls of a job in Node: node engine_in_node.mjs ENGINE JOB RESULT. NaN is written as null.
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [engine, job, result] = process.argv.slice(2);
const { Kernel, moduleCode } = await import(pathToFileURL(engine).href);
const { works } = JSON.parse(readFileSync(job, "utf8"));
const number = (row) => Float64Array.from(row, (x) => (x === null ? NaN : x));
const arrays = (given) => Object.fromEntries(Object.entries(given).map(([name, row]) => [name, number(row)]));

function run(work) {
  const code = moduleCode(new WebAssembly.Module(Buffer.from(work.module, "base64")));
  const call = new Kernel(work.program, code, work.tables).call(work.n);
  call.set(work.values);
  call.give(arrays({ ...work.positions, ...work.fields }));
  call.run();
  return Object.fromEntries(call.program.outputs.map((name) => [name, [...call.row(name)]]));
}

writeFileSync(result, JSON.stringify(works.map(run)));
