// Friction that sticks: which of it does, with which forces, and at the ends of steps; see `sticking.c`.
class Sticking extends AtContacts {
  // The direction in which friction slides; 0 while it sticks.
  direction(row) {
    return this.inputs[this.tables.stops[row]];
  }

  // Sets the memories of friction: its direction and the force with which it sticks.
  setFriction(row, direction, held) {
    this.inputs[this.tables.stops[row]] = direction;
    this.inputs[this.tables.stops[row] + 1] = held;
  }

  // The rows of frictions.
  frictions() {
    return this.each((row) => row).filter((row) => !this.isStop(row) && !this.isLock(row));
  }

  // Those of frictions that have no stop.
  freeFrictions() {
    return this.frictions().filter((row) => this.stopOf(row) < 0);
  }

  // The size of every friction while it slides, and the largest one with which it sticks.
  limits(reactions) {
    const m = this.mechanism, stops = this.tables.stops.length - this.tables.ofRates.length - this.tables.frictions;
    m.call("limits", this.t, this.q, this.v, this.inputs, reactions, m.limits);
    return this.each((row) => (row < stops || this.isLock(row) ? {} : { sliding: m.limits[2 * (row - stops)], most: m.limits[2 * (row - stops) + 1] }));
  }

  // The friction of a set whose force is most beyond its limit; -1 where none is.
  loose(set, forces, limits) {
    let worst = 0;
    return this.frictions().reduce((loose, row) => {
      const force = Math.abs(forces[row]), most = limits[row];
      // what has no largest force does not stick
      const beyond = !(most > 0) ? Infinity : force > (1 + 1e-12) * most ? force / most : 0;
      if (!set[row] || beyond <= worst) return loose;
      worst = beyond;
      return row;
    }, -1);
  }

  // The forces of which of the frictions stick that do not move, and of stops that are rested on.
  decide(resting, still) {
    const m = this.mechanism, n = this.q.length, rows = this.freeFrictions(), rubbed = this.frictions().length - rows.length;
    const sticking = still.map((it, row) => it && rows.includes(row)), free = sticking.slice();
    const locked = this.locked(), bounds = this.bounds();
    // what is off its stop does not rub; what is on it is decided with the stop
    const rubbing = still.map((it, row) => it && this.stopOf(row) >= 0 && this.isBorne(resting, row));
    const directions = this.each((row) => (this.stopOf(row) < 0 || rubbing[row] ? 0 : this.direction(row)));
    for (let tries = 0; tries <= 8 * (rows.length + rubbed); tries++) {
      rows.filter((row) => sticking[row]).forEach((row) => this.setFriction(row, 0, 0));
      m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, m.reactions.subarray(n));
      const b = this.gapsAt(this.t, this.q, this.v, m.reactions).map(({ second }) => second);
      m.call("contacts", this.t, this.q, m.contacts);
      const bound = sticking.map((it, row) => it || locked[row]);
      const rest = { closed: resting, bound, directions, bounds, rates: b };
      const struck = this.meet(rest, b) ?? this.failAtStop("IMPACT", resting.map((it, row) => it || bound[row]).indexOf(true));
      const forces = struck.impulses;
      this.addResponses(forces, 0, m.reactions.subarray(0, n));
      this.addResponses(forces, n, m.reactions.subarray(n));
      if (!rows.length) {
        this.noteHeld(rubbing, struck, resting.map((it, row) => it || bound[row]));
        return forces;
      }
      const most = this.limits(m.reactions).map((limit) => limit.most);
      const loose = this.loose(sticking, forces, most);
      if (loose >= 0) {
        this.setFriction(loose, forces[loose] > 0 ? -1 : 1, 0);
        sticking[loose] = false;
        continue;
      }
      const changes = this.changed(this.each(() => 0), forces);
      const slipping = this.withoutHold(sticking, b, changes, m.reactions.subarray(0, n));
      if (slipping !== undefined) {
        this.setFriction(slipping, b[slipping] + changes[slipping] > 0 ? 1 : -1, 0);
        sticking[slipping] = false;
        continue;
      }
      const turned = rows.find((row) => {
        const least = 2 * 1e-6 * this.mobility(row, row) * most[row];
        return free[row] && !sticking[row] && least > 0 && this.direction(row) * (b[row] + changes[row]) < -least;
      });
      if (turned === undefined) {
        rows.filter((row) => sticking[row]).forEach((row) => this.setFriction(row, 0, forces[row]));
        this.noteHeld(rubbing, struck, resting.map((it, row) => it || bound[row]));
        return forces;
      }
      sticking[turned] = true;
    }
    return this.failAtStop("JAMMED", free.indexOf(true));
  }

  // Sets the memories of what rubs on stops, and of the forces of stops and modes.
  noteHeld(rubbing, { impulses, held, directions }, set) {
    rubbing.forEach((it, row) => { if (it) this.setFriction(row, directions[row], held[row] ? impulses[row] : 0); });
    this.noteForces(set, impulses);
  }

  // The first friction of a set that holds nothing, whatever its force: on what a drive moves, and at dead centres.
  withoutHold(set, b, changes, accelerations) {
    const largest = accelerations.reduce((most, a) => Math.max(most, Math.abs(a)), 0);
    return this.frictions().find((row) => {
      const left = Math.abs(b[row] + changes[row]);
      return set[row] && left > 1e-6 * Math.abs(b[row]) && left > 1e-9 * largest;
    });
  }

  // Sets the memories of the forces of stops, frictions that stick and modes.
  hold() {
    const held = this.held(), isNoted = this.tables.noted.some(([row]) => held[row]);
    if (isNoted || this.frictions().some((row) => held[row])) this.measure();
    else this.letGo();
  }

  // Sets the memories of all forces that hold to 0.
  letGo() {
    this.frictions().forEach((row) => this.setFriction(row, this.direction(row), 0));
    this.noteForces(this.each(() => false), []);
  }

  // The same as `hold`, with the accelerations and multipliers there.
  measure() {
    const m = this.mechanism, n = this.q.length, held = this.held();
    this.letGo();
    m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, m.reactions.subarray(n));
    if (!held.includes(true)) return;
    const { forces } = this.pressWith(held, m.reactions);
    this.frictions().filter((row) => held[row]).forEach((row) => this.setFriction(row, 0, forces[row]));
    this.noteForces(held, forces);
  }

  // Sets the directions of the frictions that move at a start; those that do not.
  slide() {
    const m = this.mechanism, energy = m.call("kinetic_energy", this.t, this.q, this.v);
    const gaps = this.gapsAt(this.t, this.q, this.v, m.unmoved);
    m.call("contacts", this.t, this.q, m.contacts);
    return gaps.map(({ rate }, row) => {
      if (this.isStop(row) || this.isLock(row)) return false;
      const own = this.mobility(row, row), fastest = Math.sqrt(2 * (energy > 0 ? energy : 0) * (own > 0 ? own : 0));
      const isStill = Math.abs(rate) <= 1e-9 * fastest;
      if (!isStill) this.setFriction(row, rate > 0 ? 1 : -1, 0);
      return isStill;
    });
  }

  // True of a friction that slid and has come to a halt, or goes against the direction in which it slid.
  hasCrossed(row, was, rate) {
    const from = this.direction(row) * was, to = this.direction(row) * rate;
    return to < 0 || (from > 0 && to <= 1e-12 * from);
  }

  // Half a step of those that stuck, and the rest of the step of those that have come to a halt in it.
  halting(stuck, crossed, was, ends, limits) {
    const { h } = this, none = { given: 0, most: 0, loose: 0, shift: 0 };
    return limits.map(({ sliding, most }, row) => {
      if (crossed[row]) {
        const direction = this.direction(row), from = was[row], to = ends[row];
        // what is halted by others may have been still all the time
        const hasTurned = direction * from > 0 && direction * to < 0, rest = (hasTurned ? 1 - from / (from - to) : 1) * h;
        return { given: 0, most: rest * (sliding + most), loose: rest * (sliding + sliding), shift: 0.5 * rest };
      }
      if (!stuck[row]) return none;
      const held = this.inputs[this.tables.stops[row] + 1];
      return { given: 0.5 * h * held, most: h * most, loose: h * sliding, shift: 0 };
    });
  }

  // The impulses; the worst of those that need more than they can have slides on.
  findHalts(resting, rates, halted, halting, slides) {
    const fixed = this.each(() => 0), directions = this.each(() => 0);
    for (;;) {
      const b = this.changed(rates, fixed);
      const x = this.solveAtStops(halted.map((it, row) => it || resting[row]), b, slides);
      const total = x.map((it, row) => it + halting[row].given);
      const loose = this.loose(halted, total, halting.map(({ most }) => most));
      if (loose < 0) return { impulses: x.map((it, row) => it + fixed[row]), directions };
      fixed[loose] = (total[loose] > 0 ? halting[loose].loose : -halting[loose].loose) - halting[loose].given;
      directions[loose] = total[loose] > 0 ? -1 : 1;
      halted[loose] = false;
    }
  }

  // What leads back to where they were what stuck in the whole step and has slipped, and to the constraints of modes; stops
  // that are rested on stay where they are.
  wayBack(slipped, resting, moved, slides) {
    if (!slipped.some((it) => it !== undefined) && !this.locked().includes(true)) return this.each(() => 0);
    const b = this.changed(slipped.map((it) => it ?? 0), moved);
    return this.solveAtStops(slipped.map((it, row) => it !== undefined || resting[row]), b, slides);
  }

  // Answers friction at the end of a step, behind what stops did.
  halt(pushed, before) {
    const m = this.mechanism, n = this.q.length, rows = this.freeFrictions(), locked = this.locked();
    if (!rows.length && !locked.includes(true)) {
      if (this.frictions().length || this.tables.noted.length) this.hold();
      return;
    }
    const gaps = this.gapsAt(this.t, this.q, this.v, m.unmoved), now = gaps.map(({ rate }) => rate), ends = now.slice();
    m.trialQ.set(before.q);
    m.trialV.set(before.v);
    const gapsBefore = this.gapsAt(before.t, m.trialQ, m.trialV, m.unmoved), was = gapsBefore.map(({ rate }) => rate);
    const stuck = pushed.map((it, row) => it && rows.includes(row));
    const crossed = now.map((rate, row) => rows.includes(row) && this.hasCrossed(row, was[row], rate));
    if (!stuck.includes(true) && !crossed.includes(true) && !locked.includes(true)) {
      this.hold();
      return;
    }
    const held = this.held();
    m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, m.reactions.subarray(n));
    if (held.includes(true)) this.pressWith(held, m.reactions);
    const limits = this.limits(m.reactions);
    m.call("contacts", this.t, this.q, m.contacts);
    const acts = stuck.map((it, row) => it || crossed[row] || locked[row]);
    if (!(m.contacts[m.contacts.length - 1] < this.tables.growthLimit)) this.failAtStop("JAMMED", acts.indexOf(true));
    const resting = held.map((it, row) => it && !rows.includes(row));
    const slides = this.sliding();
    // sliding may come to a halt by the impulses of those that stick
    crossed.fill(false);
    for (;;) {
      const halting = this.halting(stuck, crossed, was, ends, limits);
      const halted = stuck.map((it, row) => it || crossed[row]);
      const { impulses, directions } = this.findHalts(resting, now, halted, halting, slides);
      const rates = this.changed(now, impulses);
      const late = rows.filter((row) => !stuck[row] && !crossed[row] && this.hasCrossed(row, was[row], rates[row]));
      if (!late.length) {
        const ofQ = new Float64Array(n), ofV = new Float64Array(n);
        const moved = impulses.map((impulse, row) => impulse * halting[row].shift);
        const slipped = gaps.map(({ gap }, row) => {
          if (locked[row] && !this.isOfRates(row)) return gap;
          return halted[row] && stuck[row] ? gap - gapsBefore[row].gap : undefined;
        });
        const back = this.wayBack(slipped, resting.map((it, row) => it && !this.isOfRates(row)), moved, slides);
        this.addResponses(moved, 0, ofQ);
        this.addResponses(back, 0, ofQ);
        this.addResponses(impulses, 0, ofV);
        add(this.q, 1, ofQ);
        add(this.v, 1, ofV);
        rows.filter((row) => stuck[row] || crossed[row]).forEach((row) => this.setFriction(row, directions[row], 0));
        break;
      }
      late.forEach((row) => {
        ends[row] = rates[row];
        crossed[row] = true;
      });
    }
    this.hold();
  }
}
