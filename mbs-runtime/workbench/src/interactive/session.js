// The mechanism of this page, its run, and the rows that were recorded of it.
const session = await (async () => {
  // Module, data of the page and tables of the mechanism, each compressed.
  const packed = JSON.parse(document.getElementById("packed").textContent);
  const unpacked = (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")));
  };
  const module = await WebAssembly.compile(await unpacked(packed[0]).arrayBuffer());
  const [data, tables] = await Promise.all([unpacked(packed[1]).json(), unpacked(packed[2]).json()]);
  const mechanism = new mbs.Mechanism(module, tables);
  mechanism.setParameters(Float64Array.from(data.start.parameters));
  const run = new mbs.Run(mechanism, data.step, data.feedback);
  run.inputs.set(data.start.inputs);
  // About a thousand rows in the time that a run usually takes; the oldest make room.
  const STRIDE = Math.max(1, Math.round(data.end / data.step / 1000)), MOST_ROWS = 20000;
  const rows = [], changes = [];
  let taken = 0, isAsDeclared = true, before = [];

  // The columns of a recording: time, coordinates, rates, multipliers, outputs, memories, violation.
  function record() {
    const { multipliers, outputs } = run.results();
    const shown = (values, of) => Array.from(values, (value, at) => value / (of[at]?.scale ?? 1));
    const memories = data.memories.map(([at, scale]) => run.inputs[at] / scale);
    rows.push([run.t, ...shown(run.q, data.places), ...shown(run.v, data.rates), ...multipliers, ...shown(outputs, data.outputs), ...memories, run.violation()]);
    if (rows.length > MOST_ROWS) rows.splice(0, MOST_ROWS / 10);
  }

  // The names of the stops that are rested on and of the modes that hold.
  function holding() {
    return data.holding.filter((at) => run.inputs[at] > 0.5).map((at) => tables.inputs[at].name);
  }

  // Notes the time where a stop is hit or left, or a mode is entered or left; of many the last ones.
  function note() {
    const now = [...data.holding, ...data.impulses].map((at) => run.inputs[at]);
    if (before.length && now.some((value, at) => value !== before[at])) changes.push(run.t);
    if (changes.length > MOST_ROWS) changes.shift();
    before = now;
  }

  function forget() {
    rows.length = changes.length = before.length = taken = 0;
  }

  function restart() {
    forget();
    isAsDeclared = true;
    run.start();
    record();
  }

  function step() {
    run.step();
    taken++;
    note();
    if (taken % STRIDE === 0) record();
  }

  // Parameters in SI units, or inputs; a run that has begun goes on from where it is.
  function setParameters(values) {
    const before = mechanism.parameters();
    mechanism.setParameters(values);
    try {
      if (isAsDeclared && taken === 0) restart();
      else run.goOnFrom(run.q.slice(), run.v.slice());
    } catch (failure) {
      mechanism.setParameters(before);
      throw failure;
    }
  }

  // Inputs in SI units, from now on.
  function setInputs(values) {
    const wrong = values.findIndex((value) => !Number.isFinite(value));
    if (wrong >= 0) throw new mbs.Failure(`${tables.inputs[wrong].name}: ${tables.errors.BAD_INPUT}`);
    run.inputs.set(values);
    if (taken > 0) return;
    rows.length = 0;
    record();
  }

  // At rest at some positions, or the nearest that keep the constraints.
  function place(q) {
    run.goOnFrom(q, new Float64Array(q.length));
    forget();
    isAsDeclared = false;
    record();
  }

  return { data, tables, mechanism, run, rows, changes, holding, restart, step, setParameters, setInputs, place };
})();
