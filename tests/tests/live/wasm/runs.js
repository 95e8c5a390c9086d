// Runs a mechanism in its module: the script of runs stands before this. A line has t, q, v and the inputs, by their bits.
const { readFileSync } = require("fs");
const [, , folder, step, steps] = process.argv;
const tables = JSON.parse(readFileSync(`${folder}/tables.json`, "utf8"));
const mechanism = new mbs.Mechanism(new WebAssembly.Module(readFileSync(`${folder}/module.wasm`)), tables);
const run = new mbs.Run(mechanism, Number(step));
const bits = (number) => new BigUint64Array(Float64Array.of(number + 0).buffer)[0].toString(16);
const print = () => console.log([run.t, ...run.q, ...run.v, ...run.inputs].map(bits).join(" "));
run.start();
print();
for (let taken = 0; taken < Number(steps); taken++) {
  run.step();
  print();
}
