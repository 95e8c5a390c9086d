// Modes, whose constraints hold with any force, and transitions; see `modes.c` and `transitions.c`.
class Modes extends Sticking {
  // True of constraints of modes, which stand behind stops and frictions.
  isLock(row) {
    return row >= this.tables.stops.length - this.tables.multipliers.length;
  }

  // True of constraints of modes that restrict no position.
  isOfRates(row) {
    const { stops, multipliers, ofRates } = this.tables;
    return this.isLock(row) && ofRates[row - (stops.length - multipliers.length)];
  }

  // The constraints of the modes that hold.
  locked() {
    return this.held().map((it, row) => it && this.isLock(row));
  }

  // Sets the memories of the multipliers of the constraints that hold.
  noteMultipliers(held, forces) {
    const { multipliers, stops } = this.tables;
    multipliers.forEach((memory, at) => {
      const row = stops.length - multipliers.length + at;
      this.inputs[memory] = held[row] ? -forces[row] : 0;
    });
  }

  // The sum of |dg/dq| of a contact.
  slope(row) {
    const n = this.q.length, begin = this.responses(row) + n + this.tables.constraints.length;
    return this.mechanism.contacts.subarray(begin, begin + n).reduce((sum, it) => sum + Math.abs(it), 0);
  }

  // How far a constraint may be off where its mode is entered.
  allowed(size, slope) {
    return 1e-6 * (1e-3 + size) * slope;
  }

  // How much of a constraint, or its rate, is that of joints which are off.
  ofJoints(row, off) {
    const begin = this.responses(row) + this.q.length;
    return 2 * off.reduce((sum, it, k) => sum + Math.abs(this.mechanism.contacts[begin + k] * it), 0);
  }

  // Leads velocities to the constraints of the modes that hold.
  engage() {
    const m = this.mechanism, { lines } = this.tables, locked = this.locked();
    if (!locked.includes(true)) return;
    const size = largest(this.q.subarray(0, lines)), fastest = largest(this.v.subarray(0, lines));
    const gaps = this.gapsAt(this.t, this.q, this.v, m.unmoved), rates = gaps.map(({ rate }) => rate);
    m.call("contacts", this.t, this.q, m.contacts);
    m.call("phi", this.t, this.q, m.phi);
    const off = gaps.findIndex(({ gap, rate }, row) => {
      const way = 4 * this.h * Math.abs(rate), allowed = this.allowed(size, this.slope(row));
      return locked[row] && !(Math.abs(gap) <= allowed + way + this.ofJoints(row, m.phi));
    });
    if (off >= 0) this.failAtStop("APART", off);
    if (!(m.contacts[m.contacts.length - 1] < this.tables.growthLimit)) this.failAtStop("CONTRADICTION", locked.indexOf(true));
    const closed = this.held().map((it, row) => it && this.isStop(row)), directions = this.each(() => 0);
    const struck = this.answerHit({ closed, bound: locked, directions, bounds: this.bounds(), rates }, rates);
    if (!struck) this.failAtStop("IMPACT", closed.map((it, row) => it || locked[row]).indexOf(true));
    const { impulses } = struck, after = this.changed(rates, impulses);
    // and what moves no position by more than rounding
    const slowest = 1e-9 * (1e-3 + size) / this.h;
    m.call("phi_dot", this.t, this.q, this.v, m.phiDot);
    const left = after.findIndex((rate, row) => {
      const slope = this.slope(row), least = 1e-6 * (Math.abs(rates[row]) + slope * fastest) + slope * slowest;
      return locked[row] && !(Math.abs(rate) <= least + this.ofJoints(row, m.phiDot));
    });
    if (left >= 0) this.failAtStop("CONTRADICTION", left);
    const ofV = new Float64Array(this.q.length);
    this.addResponses(impulses, 0, ofV);
    add(this.v, 1, ofV);
    this.noteDirections(struck.rubbed, struck.directions);
  }

  // Leads positions to the constraints of the modes that hold; stops that are rested on stay closed.
  close() {
    const m = this.mechanism, set = this.held().map((it, row) => it && (this.isStop(row) || (this.isLock(row) && !this.isOfRates(row))));
    if (!this.locked().includes(true)) return;
    for (let step = 0; step < 4; step++) {
      const gaps = this.gapsAt(this.t, this.q, this.v, m.unmoved), ofQ = new Float64Array(this.q.length);
      m.call("contacts", this.t, this.q, m.contacts);
      this.addResponses(this.solveAtStops(set, gaps.map(({ gap }) => gap)), 0, ofQ);
      add(this.q, 1, ofQ);
    }
  }

  transitionValues() {
    const m = this.mechanism;
    if (this.tables.transitions.length) m.call("transitions", this.t, this.q, this.v, this.inputs, m.transitions);
    return Array.from(m.transitions);
  }

  // Notes on which side of its condition every transition is at a start. One that is 0 is on that of its comparison.
  look() {
    this.transitionValues().forEach((value, of) => {
      const [memory, , sign] = this.tables.transitions[of];
      this.inputs[memory] = value === 0 ? sign * 1e-30 : value;
    });
  }

  // The transitions whose conditions have begun to hold, and what their memories are from then on.
  seen() {
    const due = [], seen = [];
    this.transitionValues().forEach((now, of) => {
      const [memory, side, , holdsNear] = this.tables.transitions[of], before = this.inputs[memory];
      const isAtLimit = holdsNear && Math.abs(now) <= 1e-12 * Math.abs(before) && Math.abs(before) > 2e-30;
      // what a mode keeps at its limit is off by the error of a step
      const hasHeld = side * before > 0;
      const holds = hasHeld ? side * now >= -(1e-6 * Math.abs(before)) : side * now > 0 || isAtLimit;
      const size = Math.max(Math.abs(before), Math.abs(now));
      due[of] = side * before < 0 && holds;
      seen[of] = holds ? side * size : -side * size;
    });
    return { due, seen };
  }

  // Takes the samples of the transitions whose conditions have begun to hold, those of some that are known among them, and of
  // those whose conditions do by that; true if there was one.
  pass(known) {
    for (let turn = 0; turn <= 16; turn++) {
      const { due, seen } = this.seen();
      seen.forEach((it, of) => {
        this.inputs[this.tables.transitions[of][0]] = it;
        due[of] = due[of] || (turn === 0 && known[of]);
      });
      if (!due.includes(true)) return turn > 0;
      due.forEach((it, of) => { if (it) this.takeSample(this.tables.clocks + of); });
    }
    return this.fail("ENDLESS");
  }

  // What conditions change that have begun to hold at the end of a step.
  passAndEngage(known) {
    if (!this.pass(known) || !this.tables.stops.length) return;
    this.engage();
    this.close();
    this.engage();
    this.hold();
  }
}
