// The start of a run, whose state is `t`, `q` and `v`, and what is wrong with one.
class Start {
  constructor(mechanism, step, feedback) {
    this.mechanism = mechanism;
    this.tables = mechanism.tables;
    this.q = mechanism.q;
    this.v = mechanism.v;
    this.inputs = mechanism.inputs;
    const [alpha, beta] = this.tables.scheme.deadbeat.map((gain) => gain / step);
    this.feedback = feedback ?? { held: true, alpha, beta };
    this.h = step;
    if (!isStable(this.tables.scheme, step, this.feedback)) this.fail("BAD_GAINS");
    mechanism.gains.set([-2 * this.feedback.alpha, -this.feedback.beta * this.feedback.beta]);
    mechanism.none.fill(0);
    mechanism.still.fill(0);
  }

  fail(code, where) {
    const words = this.tables.errors[code];
    throw new Failure(where ? `${where}: ${words}` : words);
  }

  // The declared start, made consistent with the constraints.
  start() {
    const m = this.mechanism;
    this.t = m.call("declared_start", this.q, this.v);
    if (!(this.h > 0 && Number.isFinite(this.h) && 4 * EPSILON * Math.abs(this.t) <= this.h)) this.fail("BAD_STEP");
    this.assemble("position_correction");
    this.projectVelocities("velocity_correction");
    this.check(this.q, this.v);
    this.begin();
    const free = this.inputs.length - this.tables.memories;
    this.tables.inputs.slice(free).forEach((memory, at) => { this.inputs[free + at] = memory.value; });
    this.touch();
    this.sample();
  }

  // What is near the present state and consistent becomes the start of a run: after parameters have
  // changed, or a body has been moved.
  goOnFrom(q, v) {
    const before = [this.q.slice(), this.v.slice()];
    try {
      this.q.set(q);
      this.v.set(v);
      this.assemble("projection");
      this.projectVelocities("projection");
      this.check(this.q, this.v);
      this.begin();
      this.touch();
    } catch (failure) {
      this.q.set(before[0]);
      this.v.set(before[1]);
      throw failure;
    }
  }

  // The watch over a run that begins.
  begin() {
    this.startTime = this.t;
    this.steps = 0;
    this.worstGrowth = 0;
    this.alarm = this.rememberedFrom = 64;
    const stage = this.stage(0);
    this.select(stage);
    this.complete(this.t, stage, this.q, this.v);
    this.size = this.measure();
    this.clocks().forEach(([period, offset]) => {
      const slack = 8 * EPSILON, count = this.stepsOf(period), first = (this.startTime - offset) / this.h;
      const rounding = slack * (1 + (Math.abs(this.startTime) + Math.abs(offset)) / this.h);
      const isWhole = count >= 1 && Math.abs(period / this.h - count) <= slack * count;
      if (!(isWhole && Math.abs(first - Math.floor(first + 0.5)) <= rounding)) this.fail("BAD_PERIOD");
    });
  }

  // Period and offset of every clock.
  clocks() {
    const { clockTimes: times } = this.mechanism, count = this.tables.clocks;
    if (count) this.mechanism.call("clocks", times);
    return Array.from({ length: count }, (_, clock) => times.slice(2 * clock, 2 * clock + 2));
  }

  // The nearest whole number of steps to some seconds.
  stepsOf(seconds) {
    return Math.floor(seconds / this.h + 0.5);
  }

  // Takes the samples that are due, in the order of the clocks.
  sample() {
    this.clocks().forEach(([period, offset], clock) => {
      const count = this.stepsOf(period), steps = this.stepsOf(this.startTime - offset) + this.steps;
      if (steps - Math.floor(steps / count) * count !== 0) return;
      this.takeSample(clock);
    });
  }

  // Sets the memories of a clock, or of a transition, which count behind the clocks.
  takeSample(clock) {
    const m = this.mechanism;
    m.call("samples", this.t, this.q, this.v, this.inputs, m.sampled);
    this.tables.samples.forEach(([of, memory], at) => {
      if (of === clock) this.inputs[memory] = m.sampled[at];
    });
  }

  // Positions on phi = 0 by Newton's iteration.
  assemble(correction) {
    const m = this.mechanism, { q, tables: { lines } } = this, { phi, residual, delta } = m;
    let isAtRest = false;
    m.call("phi", this.t, q, phi);
    for (let iteration = 0; iteration < 50 && !isAtRest; iteration++) {
      residual.fill(0);
      add(residual, -1, phi);
      this.checkCorrection(m.call(correction, this.t, q, residual, delta));
      isAtRest = largest(delta) <= 4 * EPSILON * extent(q, lines);
      if (isAtRest) add(q, 1, delta);
      else this.damped();
    }
    const worst = place(phi);
    if (isAtRest || largest(phi) <= 64 * EPSILON * extent(q, lines)) {
      isAtRest = this.meetsRedundant(q, Math.sqrt(EPSILON) * extent(q, lines), 1);
    }
    if (!isAtRest) this.fail("NOT_ASSEMBLED", this.tables.constraints[this.where ?? worst]?.name);
  }

  // q + delta, or what the longest halved step that does not enlarge the violation leads to.
  damped() {
    const m = this.mechanism, { q } = this, before = q.slice(), violation = norm(m.phi);
    for (let halvings = 0, length = 1; halvings <= 10; halvings++, length /= 2) {
      q.set(before);
      add(q, length, m.delta);
      m.call("phi", this.t, q, m.phi);
      if (norm(m.phi) < violation) return;
    }
  }

  // Velocities whose constraints hold: one solution and one refinement of it.
  projectVelocities(correction) {
    const m = this.mechanism, { phiDot, residual, delta } = m;
    for (let pass = 0; pass < 2; pass++) {
      residual.fill(0);
      m.call("phi_dot", this.t, this.q, this.v, phiDot);
      add(residual, -1, phiDot);
      this.checkCorrection(m.call(correction, this.t, this.q, residual, delta));
      add(this.v, 1, delta);
    }
  }

  // Refuses a correction of the start in a singular position.
  checkCorrection(growth) {
    const m = this.mechanism, { delta } = m;
    if (firstNonFinite(delta) < 0 && growth < this.tables.growthLimit) return;
    m.call("start_pivots", this.t, this.q, m.startPivots);
    this.cause(this.q, delta, growth, this.tables.growthLimit, m.startPivots, "SINGULAR_START", this.tables.startPivots);
  }

  // Refuses what is not finite: an input, a position or a velocity.
  check(q, v) {
    const t = this.tables, input = firstNonFinite(this.inputs);
    if (input >= 0) this.fail("BAD_INPUT", t.inputs[input].name);
    for (const vector of [q, v]) {
      const at = firstNonFinite(vector);
      if (at >= 0) this.fail("NOT_FINITE", t.coordinates[at].name);
    }
  }

  // Why a solution with pivots of these growths is no good.
  cause(q, solution, growth, limit, growths, code, names) {
    const pivot = place(growths);
    let at = firstNonFinite(q);
    if (at < 0 && growth < limit && (pivot < 0 || growths[pivot] < limit)) at = firstNonFinite(solution);
    if (at >= 0) this.fail("NOT_FINITE", this.tables.coordinates[at].name);
    this.fail(code, pivot >= 0 && !(growths[pivot] < limit / 64) ? names[pivot] : "");
  }

  // Redundant constraints take no part in steps: with parameters for which they do not fit they
  // would be violated.
  meetsRedundant(q, share, size) {
    const t = this.tables, m = this.mechanism;
    this.where = undefined;
    if (!t.redundant.length) return true;
    m.call("phi", this.t, q, m.phi);
    for (const row of t.redundant) {
      let allowed = share;
      for (let power = 0; power < t.constraints[row].length; power++) allowed = allowed * size;
      if (!(Math.abs(m.phi[row]) <= allowed)) {
        this.where = row;
        return false;
      }
    }
    return true;
  }

  // The size of the mechanism: the largest coordinate that is a length, or lever arm.
  measure() {
    const t = this.tables, m = this.mechanism;
    let size = 0;
    t.coordinates.slice(0, t.lines).forEach((it, j) => {
      const length = it.length !== 0 ? Math.abs(this.q[j]) : 0;
      size = length > size ? length : size;
    });
    m.call("phi_q", this.t, this.q, m.entries);
    t.jacobian.forEach(([row, j], k) => {
      const isArm = t.constraints[row].length === 1 && t.coordinates[j].length === 0;
      size = isArm && Math.abs(m.entries[k]) > size ? Math.abs(m.entries[k]) : size;
    });
    return size;
  }

  // What of the state is integrated, in a stage of a step.
  stage(at) {
    const m = this.mechanism;
    return { t: this.t, q: m["stageQ" + at], v: m["stageV" + at] };
  }

  select(stage) {
    this.tables.states.forEach((coordinate, j) => {
      stage.q[j] = this.q[coordinate];
      stage.v[j] = this.v[coordinate];
    });
  }

  // All coordinates from those that are integrated.
  complete(t, { q, v }, allQ, allV) {
    if (this.tables.states.length < this.tables.coordinates.length) {
      this.mechanism.call("complete", t, q, v, allQ, allV);
    } else {
      allQ.set(q);
      allV.set(v);
    }
  }
}
