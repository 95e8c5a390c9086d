// The steps of a run, and what it gives.
class Run extends AtStops {
  // One step.
  step() {
    if (this.tables.stops.length || this.tables.transitions.length) this.toStops(() => this.stepBetween());
    else this.stepBetween();
    this.sample();
  }

  // A step of which clocks and stops know nothing.
  stepBetween() {
    const tNext = this.startTime + (this.steps + 1) * this.h;
    if (!(this.tables.fused && this.stepAtOnce(tNext))) this.stepByStages(tNext);
  }

  // All stages in one function; false if the step was not calm.
  stepAtOnce(tNext) {
    const m = this.mechanism, now = this.stage(0), next = { q: m.nextQ, v: m.nextV };
    this.select(now);
    const name = this.feedback.held ? "step_held" : "step_per_stage";
    const growth = m.call(
      name, this.t, now.q, now.v, this.inputs, m.gains, this.h, 0.5 * this.h, tNext, next.q, next.v);
    const isFinite = firstNonFinite(next.q) < 0 && firstNonFinite(next.v) < 0;
    return isFinite && this.take(tNext, next, growth);
  }

  // Takes a step that is calm: its growth has not risen, and redundant constraints are met.
  take(tNext, next, growth) {
    const { trialQ, trialV } = this.mechanism;
    if (!(growth <= this.alarm)) return false;
    this.complete(tNext, next, trialQ, trialV);
    if (!this.meetsRedundantAt(tNext, trialQ)) return false;
    this.accept(tNext, growth);
    return true;
  }

  meetsRedundantAt(t, q) {
    const now = this.t;
    this.t = t;
    const isMet = this.meetsRedundant(q, 1e-3, this.size);
    this.t = now;
    return isMet;
  }

  accept(tNext, growth) {
    this.q.set(this.mechanism.trialQ);
    this.v.set(this.mechanism.trialV);
    this.t = tNext;
    const rise = 1.25 * growth;
    this.worstGrowth = growth > this.worstGrowth ? growth : this.worstGrowth;
    this.alarm = rise < this.rememberedFrom ? rise : this.rememberedFrom;
    this.steps++;
  }

  // The step of mechanisms that have no other, and of those whose step was not calm.
  stepByStages(tNext) {
    const m = this.mechanism, t = this.tables, { share, node, weight } = t.scheme, last = share.length;
    const stages = [this.stage(0)], growths = [];
    this.select(stages[0]);
    let growth = 0;
    for (let at = 0; at < last; at++) {
      const { t: time, q, v } = stages[at], solved = m["solved" + at];
      growths[at] = at > 0 && this.feedback.held
        ? m.call("constrained", time, q, v, this.inputs, m.feedback, solved)
        : m.call("stabilized", time, q, v, this.inputs, m.gains, solved, at > 0 ? m.unread : m.feedback);
      growth = growth + growths[at];
      const next = this.stage(at + 1), factor = share[at] * this.h;
      next.t = node[at] < 1 ? this.t + node[at] * this.h : tNext;
      for (let j = 0; j < t.states.length; j++) {
        let dv = 0, da = 0;
        for (let stage = 0; stage <= at; stage++) {
          dv = dv + weight[at][stage] * stages[stage].v[j];
          da = da + weight[at][stage] * m["solved" + stage][j];
        }
        next.q[j] = stages[0].q[j] + factor * dv;
        next.v[j] = stages[0].v[j] + factor * da;
      }
      stages.push(next);
    }
    const next = stages[last];
    if (!(growth < t.growthLimit) || firstNonFinite(next.q) >= 0 || firstNonFinite(next.v) >= 0) {
      this.diagnose(stages, growths);
    }
    if (!this.take(tNext, next, growth)) this.examine(tNext, next, growth);
  }

  // A step whose growth has risen: whether its constraints can still be met.
  examine(tNext, next, growth) {
    const { trialQ, trialV } = this.mechanism, isFirst = this.worstGrowth <= 0, before = 1.125 * this.alarm;
    this.complete(tNext, next, trialQ, trialV);
    const unreached = this.unreachedNear(tNext, trialQ);
    if (unreached >= 0) this.fail("OUT_OF_REACH", this.tables.constraints[unreached]?.name);
    if (!this.meetsRedundantAt(tNext, trialQ)) this.fail("OUT_OF_REACH", this.tables.constraints[this.where].name);
    if (growth > this.rememberedFrom) {
      const limit = this.tables.growthLimit;
      this.rememberedFrom = 2 * growth < limit ? 2 * growth : limit;
    }
    this.accept(tNext, growth);
    this.alarm = isFirst || this.alarm < before ? this.alarm : before;
  }

  // The constraint that cannot be met near q, or -1: Newton's iteration comes to rest at rounding,
  // which beyond a dead end it cannot.
  unreachedNear(t, start) {
    const m = this.mechanism, n = this.q.length, h = this.h, q = m.delta, { lines } = this.tables;
    const { phi, still, none, unread, feedback: kept } = m, saved = kept.slice();
    const solve = (feedback) => m.call("reactions", t, q, still, this.inputs, feedback, m.moved, unread);
    q.set(start);
    m.call("phi", t, q, phi);
    let best = phi.slice();
    try {
      for (let iteration = 0; iteration < 30; iteration++) {
        m.call("phi", t, q, phi);
        if (norm(phi) < norm(best)) best = phi.slice();
        kept.fill(0);
        add(kept, -1 / (h * h), phi);
        const growth = solve(kept), moved = m.moved.slice(0, n);
        solve(none);
        add(moved, -1, m.moved.subarray(0, n));
        const length = h * h * largest(moved.subarray(0, lines)), roundings = (64 + growth) * EPSILON;
        // without a first correction it is a drive that ends, and not a position
        if (length <= roundings * extent(q, lines) || (iteration === 0 && !Number.isFinite(length))) return -1;
        if (!Number.isFinite(length)) break;
        add(q, h * h, moved);
      }
    } finally {
      kept.set(saved);
    }
    return place(best);
  }

  // Why a step failed: a position that cannot be reached from one that was good, or what its stages say.
  diagnose(stages, growths) {
    const m = this.mechanism, end = stages[stages.length - 1].t, limit = this.tables.growthLimit;
    this.check([], []);
    if (growths[0] < limit && this.unreachedNear(this.t, this.q) < 0) {
      const unreached = this.unreachedNear(end, this.q);
      if (unreached >= 0) this.fail("OUT_OF_REACH", this.tables.constraints[unreached]?.name);
    }
    const { trialQ, trialV, solution } = m, share = limit / growths.length;
    for (let at = 0; at < growths.length; at++) {
      this.complete(stages[at].t, stages[at], trialQ, trialV);
      this.check(trialQ, trialV);
      solution.fill(0);
      this.tables.states.forEach((coordinate, j) => { solution[coordinate] = m["solved" + at][j]; });
      if (!(growths[at] < share) || firstNonFinite(solution) >= 0) {
        m.call("pivots", stages[at].t, trialQ, m.pivots);
        this.cause(trialQ, solution, growths[at], share, m.pivots, "SINGULAR", this.tables.pivots);
      }
    }
    this.fail("NOT_FINITE");
  }

  // Multipliers and outputs of the present state; not numbers where they are not defined.
  results() {
    const m = this.mechanism, n = this.q.length, multipliers = m.reactions.subarray(n);
    // outputs have the forces with which frictions stick here
    const inputs = this.inputs.slice();
    this.hold();
    const held = this.inputs.slice();
    this.inputs.set(inputs);
    let growth = m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, multipliers);
    growth = growth + this.press(m.reactions);
    if (!(growth < this.tables.growthLimit)) m.reactions.fill(NaN);
    this.inputs.set(held);
    m.call("outputs", this.t, this.q, this.v, this.inputs, m.reactions, m.outputs);
    this.inputs.set(inputs);
    return { multipliers, outputs: m.outputs };
  }

  energy() {
    const m = this.mechanism;
    return m.call("kinetic_energy", this.t, this.q, this.v) + m.call("potential_energy", this.t, this.q, this.v);
  }

  violation() {
    const m = this.mechanism;
    m.call("phi", this.t, this.q, m.phi);
    return norm(m.phi);
  }

  // x and y of every point at some positions.
  points(q = this.q) {
    this.mechanism.call("points", this.t, q, this.mechanism.points);
    return this.mechanism.points;
  }
}
