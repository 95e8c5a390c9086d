// A mechanism: the functions of its module, and vectors in the memory of it.
const EPSILON = 2 ** -52;

// What is wrong, in the words of the declaration or of the run.
class Failure extends Error {}

// Where the largest magnitude stands, or the first that is not finite; -1 where there is none.
function place(x) {
  let found = -1;
  for (let at = 0; at < x.length; at++) {
    if (!Number.isFinite(x[at])) return at;
    if (found < 0 || Math.abs(x[at]) > Math.abs(x[found])) found = at;
  }
  return found;
}

function largest(x) {
  const found = place(x);
  return found < 0 ? 0 : Math.abs(x[found]);
}

function firstNonFinite(x) {
  const found = place(x);
  return found < 0 || Number.isFinite(x[found]) ? -1 : found;
}

// x + scale y, in the place of x.
function add(x, scale, y) {
  for (let at = 0; at < x.length; at++) x[at] = x[at] + scale * y[at];
}

function norm(x) {
  let sum = 0;
  for (let at = 0; at < x.length; at++) sum = sum + x[at] * x[at];
  return Math.sqrt(sum);
}

// The size of coordinates that rounding is compared with.
const extent = (q, lines) => 1 + largest(q.subarray(0, lines));

// Whether a step of h with these gains makes no violation grow; see `NAME_set_feedback` in C.
function isStable({ share, weight }, h, { alpha, beta, held }) {
  const stages = share.length, a = 2 * alpha * h, b = beta * h * (beta * h);
  const e = [[1], [0]], v = [[0], [1]];
  for (let start = 0; start < 2; start++) {
    for (let last = 0; last < stages; last++) {
      let eSum = 0, vSum = 0;
      for (let stage = 0; stage <= last; stage++) {
        const from = held ? 0 : stage, w = share[last] * weight[last][stage];
        eSum += w * v[start][stage];
        vSum -= w * (a * v[start][from] + b * e[start][from]);
      }
      e[start][last + 1] = e[start][0] + eSum;
      v[start][last + 1] = v[start][0] + vSum;
    }
  }
  const trace = e[0][stages] + v[1][stages];
  const determinant = e[0][stages] * v[1][stages] - e[1][stages] * v[0][stages];
  const slack = 16 * EPSILON * (1 + a + b) * (1 + a + b);
  const isBounded = Math.abs(trace) <= 1 + determinant + slack && determinant <= 1 + slack;
  return alpha >= 0 && beta >= 0 && isBounded;
}

// The functions of a module with vectors in its memory; a vector knows its address.
class Mechanism {
  constructor(module, tables) {
    this.tables = tables;
    this.functions = new WebAssembly.Instance(module, { math: Math }).exports;
    const t = tables, n = t.coordinates.length, m = t.constraints.length, s = t.states.length;
    const lengths = {
      mechanism: t.parameters.length + t.hoisted, conditionValues: t.conditionValues, inputs: t.inputs.length,
      q: n, v: n, delta: n, reactions: n + m, phi: m, phiDot: m, phiT: m, residual: m, none: m, unread: m,
      entries: t.jacobian.length, mass: n, points: 2 * t.points, outputs: t.outputs.length,
      pivots: t.pivots.length, startPivots: t.startPivots.length, gains: 2, moved: n + m, still: n,
      clockTimes: 2 * t.clocks, gaps: 3 * t.stops.length, stopLaws: 2 * (t.stops.length - t.ofRates.length - t.frictions) + t.rubbing.length, limits: 2 * t.frictions, contacts: t.contacts,
      unmoved: n + m, sampled: t.samples.length, transitions: t.transitions.length, feedback: m, nextQ: s, nextV: s, trialQ: n, trialV: n, solution: n,
    };
    for (let at = 0; at <= t.scheme.share.length; at++) {
      Object.assign(lengths, { ["stageQ" + at]: s, ["stageV" + at]: s, ["solved" + at]: s });
    }
    const { memory, heap } = this.functions;
    const begin = heap.value, end = Object.values(lengths).reduce((sum, length) => sum + 8 * length, begin);
    memory.grow(Math.ceil(end / 65536));
    let at = begin;
    for (const [name, length] of Object.entries(lengths)) {
      this[name] = new Float64Array(memory.buffer, at, length);
      at += 8 * length;
    }
    this.inputs.set(t.inputs.map((input) => input.value));
    this.setParameters(t.parameters.map((parameter) => parameter.value));
  }

  // Takes parameters over if they satisfy all conditions; else those from before stay.
  setParameters(values) {
    const t = this.tables, f = this.functions, count = t.parameters.length;
    const before = this.mechanism.slice();
    this.mechanism.set(values);
    try {
      values.forEach((value, at) => {
        if (!Number.isFinite(value)) throw new Failure(`${t.parameters[at].name}: it has to be finite`);
      });
      f.conditions(this.mechanism.byteOffset, this.conditionValues.byteOffset);
      for (const { name, words, value, difference, sign, strict } of t.conditions) {
        const judged = sign * this.conditionValues[difference];
        if (!(strict ? judged > 0 : judged >= 0)) {
          throw new Failure(`${name} = ${this.conditionValues[value]}: ${words}`);
        }
      }
      f.new(this.mechanism.byteOffset, this.mechanism.byteOffset + 8 * count);
    } catch (failure) {
      this.mechanism.set(before);
      throw failure;
    }
  }

  parameters() {
    return Array.from(this.mechanism.subarray(0, this.tables.parameters.length));
  }

  // A function of the module: vectors are given by their addresses.
  call(name, ...given) {
    const f = this.functions[name];
    return f(this.mechanism.byteOffset, ...given.map((it) => (typeof it === "number" ? it : it.byteOffset)));
  }
}
