// Modes, whose constraints hold with any force, and transitions; see `modes.c` and `transitions.c`.
class Modes extends Sticking {
  // True of constraints of modes, which stand behind stops and frictions.
  isLock(row) {
    return row >= this.tables.stops.length - this.tables.ofRates.length;
  }

  // True of constraints of modes that restrict no position.
  isOfRates(row) {
    const { stops, ofRates } = this.tables;
    return this.isLock(row) && ofRates[row - (stops.length - ofRates.length)];
  }

  // The constraints of the modes that hold.
  locked() {
    return this.held().map((it, row) => it && this.isLock(row));
  }

  // Sets the memories of the forces of stops and of the multipliers of modes, those of what holds to theirs and the others to 0.
  noteForces(held, forces) {
    this.tables.noted.forEach(([row, memory]) => {
      const force = this.isStop(row) ? forces[row] : -forces[row];
      this.inputs[memory] = held[row] ? force : 0;
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
    // the entry of a mode hits what is rested on; a smaller impulse is the rounding of a mode that holds
    this.tables.stops.forEach((memory, stop) => {
      const isHit = this.isStop(stop) && this.mobility(stop, stop) * impulses[stop] > 1e-6 * (this.slope(stop) * fastest);
      if (isHit) this.inputs[memory + 1] = this.inputs[memory + 1] + impulses[stop];
    });
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

  // True if conditions depend on forces or accelerations.
  seesForces() {
    return this.tables.transitions.some(([, , , , sees]) => sees);
  }

  // The value of every transition. Where forces are known, those that see them see those of this state; memories stay as they are.
  transitionValues(areForcesKnown) {
    const m = this.mechanism, inputs = this.inputs.slice();
    if (!this.tables.transitions.length) return [];
    if (areForcesKnown && this.seesForces()) this.measure();
    m.call("transitions", this.t, this.q, this.v, this.inputs, m.reactions, m.transitions);
    this.inputs.set(inputs);
    return Array.from(m.transitions);
  }

  // Notes on which side of its condition every transition is at a start. Those that see forces do not hold yet.
  look() {
    this.transitionValues(false).forEach((value, of) => {
      const [memory, side, sign, , sees] = this.tables.transitions[of];
      // one that is 0 is on the side that its comparison says
      if (sees) this.inputs[memory] = -side * 1e-30;
      else this.inputs[memory] = value === 0 ? sign * 1e-30 : value;
    });
  }

  // The transitions whose conditions have begun to hold, and what their memories are from then on. Those that see forces are
  // judged where these are known.
  seen(areForcesKnown) {
    const due = [], seen = [];
    this.transitionValues(areForcesKnown).forEach((now, of) => {
      const [memory, side, sign, holdsNear, sees] = this.tables.transitions[of], before = this.inputs[memory];
      const largest = Math.abs(before), beyond = side * now, rounding = 1e-12 * largest;
      if (sees && !areForcesKnown) {
        due[of] = false;
        seen[of] = before;
        return;
      }
      const isAtLimit = holdsNear && Math.abs(beyond) <= rounding && largest > 2e-30;
      // where no mode holds that it asks for, there is no force
      const isNone = sees && side !== sign && beyond === 0;
      // what a mode keeps at its limit is off by the error of a step
      const stays = beyond >= -(1e-6 * largest) && !isNone;
      // forces are solved for, and are none within rounding
      const begins = sees ? beyond > rounding : beyond > 0 || isAtLimit;
      const holds = side * before > 0 ? stays : begins, size = Math.max(largest, Math.abs(now));
      due[of] = side * before < 0 && holds;
      seen[of] = holds ? side * size : -side * size;
    });
    return { due, seen };
  }

  // Takes the samples of the transitions whose conditions have begun to hold, those of some that are known among them, and of
  // those whose conditions do by that; true if there was one.
  pass(known) {
    for (let turn = 0; turn <= 16; turn++) {
      // behind what the first ones set, forces are known where velocities have followed
      const { due, seen } = this.seen(turn === 0);
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
    for (let turn = 0; turn <= 16; turn++) {
      if (!this.pass(turn === 0 ? known : []) || !this.tables.stops.length) return;
      this.engage();
      this.close();
      this.engage();
      // what modes have let go may slide, and what they hold does not
      const resting = this.held().map((it, row) => it && this.isStop(row));
      // velocities and forces change, and other conditions may begin
      this.decide(resting, this.slide());
    }
    this.fail("ENDLESS");
  }
}
