// Stops at the ends of steps: time stepping by Moreau and Jean; see `stops.c`.
class AtStops extends Modes {
  // A set of contacts, or a number per contact: stops, behind them frictions that stick, and constraints of modes.
  each(what) {
    return Array.from({ length: this.tables.stops.length }, (_, stop) => what(stop));
  }

  // True of stops.
  isStop(row) {
    return row < this.tables.stops.length - this.tables.ofRates.length - this.tables.frictions;
  }

  // Gap, rate and second derivative of every stop.
  gapsAt(t, q, v, reactions) {
    const { gaps } = this.mechanism;
    this.mechanism.call("gaps", t, q, v, reactions, gaps);
    return this.each((stop) => ({ gap: gaps[3 * stop], rate: gaps[3 * stop + 1], second: gaps[3 * stop + 2] }));
  }

  // Where the responses to a unit impulse at a stop begin.
  responses(stop) {
    return stop * (2 * this.q.length + this.tables.constraints.length);
  }

  // The change of the rate of one gap by a unit impulse at a stop.
  mobility(of, by) {
    return this.mechanism.contacts[this.responses(this.tables.stops.length) + by * this.tables.stops.length + of];
  }

  // What that of its own rate would be without joints; where no mass tells, as it is.
  freeMobility(row) {
    const count = this.tables.stops.length, free = this.mechanism.contacts[this.responses(count) + count * count + row];
    return free > 0 && Number.isFinite(free) ? free : this.mobility(row, row);
  }

  // The same and that of what slides on it.
  slidMobility(of, by, slides) {
    const own = this.mobility(of, by);
    return slides?.[by] ? own + slides[by] * this.mobility(of, this.frictionOn(by)) : own;
  }

  // x of a set of stops with W x + b = 0 there, by elimination; 0 of one that depends on others of the set. Constraints of modes
  // are the first, in the order of their pivots. A pivot is rounding beside what it was before the others; of modes, which hold
  // where joints may hold, too, also beside what W would be without joints.
  // What slides on stops has so many times their x.
  solveAtStops(set, b, slides) {
    const all = this.each((row) => row).filter((row) => set[row] && this.isBorne(set, row)), x = this.each(() => 0);
    const locks = all.filter((row) => this.isLock(row)), members = [...locks, ...all.filter((row) => !this.isLock(row))];
    const rows = members.map((of) => [...members.map((by) => this.slidMobility(of, by, slides)), -b[of]]);
    const before = rows.map((row, at) => row[at]), free = members.map((row) => this.freeMobility(row));
    const isPivot = [], isDone = [];
    for (let turn = 0; turn < rows.length; turn++) {
      const ratio = (at) => rows[at][at] / free[at];
      const left = locks.map((_, at) => at).filter((at) => !isDone[at]);
      const at = left.length ? left.reduce((most, at) => (ratio(at) > ratio(most) ? at : most)) : turn;
      const pivot = rows[at][at];
      isPivot[at] = pivot > Math.max(1e-10 * before[at], at < locks.length ? 64 * EPSILON * free[at] : 0);
      isDone[at] = true;
      if (!isPivot[at]) continue;
      rows.forEach((row, other) => {
        if (other === at) return;
        const factor = row[at] / pivot;
        row.forEach((entry, column) => { row[column] = entry - factor * rows[at][column]; });
      });
    }
    members.forEach((row, at) => {
      x[row] = isPivot[at] ? rows[at][members.length] / rows[at][at] : 0;
      if (slides?.[row]) x[this.frictionOn(row)] = slides[row] * x[row];
    });
    return x;
  }

  // The first stop of a set that is pulled, or that is left free and closes.
  leastWrong(set, active, b, x) {
    const largest = x.reduce((largest, it) => (Math.abs(it) > largest ? Math.abs(it) : largest), 0);
    return b.findIndex((own, stop) => {
      if (!set[stop]) return false;
      if (active[stop] && x[stop] < -1e-12 * largest) return true;
      let rate = own, size = Math.abs(own);
      x.forEach((force, by) => {
        const term = this.mobility(stop, by) * force;
        rate = rate + term;
        size = size + Math.abs(term);
      });
      return rate < -1e-12 * size;
    });
  }

  // The impulses at active stops that do what a unit impulse at another one does, as far as they can.
  shares(active, by) {
    return this.solveAtStops(active.map((it, stop) => it && stop !== by), this.each((of) => -this.mobility(of, by)));
  }

  // True if an impulse at a stop does what impulses at the active ones can do.
  depends(stop, active) {
    const shares = this.shares(active, stop), own = this.mobility(stop, stop);
    const rest = active.reduce((rest, it, by) => (it ? rest - this.mobility(stop, by) * shares[by] : rest), own);
    return rest <= 1e-10 * own;
  }

  // The first active stop whose impulse becomes 0 where that of one grows that depends on them; -1 where there is none.
  exchanged(active, by, bound, x) {
    const shares = this.shares(active, by);
    return shares.reduce((first, share, stop) => {
      const isFirst = !bound[stop] && share > 1e-10 && (first < 0 || x[stop] / share < x[first] / shares[first]);
      return isFirst ? stop : first;
    }, -1);
  }

  // x >= 0 with W x + b >= 0 at the stops of a set, one or the other 0 at each, by pivots of the least index; W x + b = 0 at
  // those that are bound; nothing where there is none.
  answerIfAny(set, b, bound) {
    // stops press before friction holds, where they depend on each other
    const isBound = set.some((it, stop) => it && bound[stop]), active = set.map((it) => it && isBound);
    const open = set.map((it, stop) => it && !bound[stop]);
    for (let pivots = 0; pivots < 512; pivots++) {
      const x = this.solveAtStops(active, b);
      let wrong = this.leastWrong(open, active, b, x);
      if (wrong < 0) return x;
      // one that closes with others, or although it is active, depends on them: it takes the place of one of them
      if (active[wrong] ? x[wrong] === 0 : this.depends(wrong, active)) {
        const left = this.exchanged(active, wrong, bound, x);
        if (left < 0) break;
        active[wrong] = true;
        wrong = left;
      }
      active[wrong] = !active[wrong];
    }
    return null;
  }

  complementary(set, b, bound = this.each(() => false)) {
    return this.answerIfAny(set, b, bound) ?? this.failAtStop("IMPACT", set.indexOf(true));
  }

  // The stops of a set that others of it and what is bound keep closed: no impulses open them.
  keptClosed(set, bound) {
    return set.map((it, stop) =>
      it && !bound[stop] && !this.answerIfAny(set, this.each((row) => (row === stop ? -1 : 0)), bound));
  }

  failAtStop(code, stop) {
    return this.fail(code, this.tables.inputs[this.tables.stops[stop]].name);
  }

  // Adds what impulses or forces at stops do to velocities, accelerations or multipliers.
  addResponses(x, from, to) {
    const { contacts } = this.mechanism;
    x.forEach((force, stop) => {
      const begin = this.responses(stop) + from;
      if (force !== 0) add(to, force, contacts.subarray(begin, begin + to.length));
    });
  }

  // Sets the memories of stops: which are rested on, and what impulses add up to.
  noteStops(held, impulses) {
    this.tables.stops.filter((_, stop) => this.isStop(stop)).forEach((memory, stop) => {
      this.inputs[memory] = held[stop] ? 1 : 0;
      this.inputs[memory + 1] = this.inputs[memory + 1] + impulses[stop];
    });
  }

  // The rates with which gaps open that close with others.
  rebounds(rates) {
    const { stopLaws } = this.mechanism;
    this.mechanism.call("stop_laws", stopLaws);
    return rates.map((rate, stop) => (this.isStop(stop) && rate < 0 ? -(stopLaws[2 * stop] * rate) : 0));
  }

  // Rates of gaps, changed by impulses.
  changed(rates, impulses) {
    return rates.map((rate, stop) =>
      rate + impulses.reduce((change, impulse, by) => change + this.mobility(stop, by) * impulse, 0));
  }

  // The rates that forces at the stops of a set take from gaps in a step.
  taken(closed, change, locked) {
    const set = closed.map((it, row) => it || locked[row]);
    return this.complementary(set, change, locked).map((force, stop) => this.mobility(stop, stop) * force);
  }

  // The same of the first change that has an answer, or nothing where modes lead to what is closed.
  takenIfAny(closed, changes, locked) {
    const set = closed.map((it, row) => it || locked[row]);
    for (const change of changes) {
      const forces = this.answerIfAny(set, change, locked);
      if (forces) return forces.map((force, stop) => this.mobility(stop, stop) * force);
    }
    return locked.includes(true) ? this.each(() => 0) : this.failAtStop("IMPACT", set.indexOf(true));
  }

  // Adds what the stops do that are rested on; the growth of the responses.
  press(reactions) {
    const held = this.held();
    return held.includes(true) ? this.pressWith(held, reactions).growth : 0;
  }

  // The stops that are rested on, the frictions that stick, and the constraints of the modes that hold.
  held() {
    const held = this.tables.stops.map((memory, row) =>
      this.isStop(row) || this.isLock(row) ? this.inputs[memory] > 0.5 : Math.abs(this.inputs[memory]) < 0.5);
    return held.map((it, row) => it && this.isBorne(held, row));
  }

  // Adds what some stops and frictions do that hold; their forces, and the growth.
  pressWith(held, reactions) {
    const m = this.mechanism, n = this.q.length;
    const gaps = this.gapsAt(this.t, this.q, this.v, reactions);
    m.call("contacts", this.t, this.q, m.contacts);
    const forces = this.solveAtStops(held, gaps.map(({ second }) => second), this.sliding());
    this.addResponses(forces, 0, reactions.subarray(0, n));
    this.addResponses(forces, n, reactions.subarray(n));
    return { forces, growth: m.contacts[m.contacts.length - 1] };
  }

  // Rests on the stops that a start touches; one behind a stop is refused.
  touch() {
    const m = this.mechanism, n = this.q.length, { lines, stops } = this.tables;
    this.look();
    if (!stops.length) return;
    const locked = this.locked(), still = this.slide();
    m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, m.reactions.subarray(n));
    const gaps = this.gapsAt(this.t, this.q, this.v, m.reactions), thrown = this.rebounds(gaps.map(({ rate }) => rate));
    m.call("contacts", this.t, this.q, m.contacts);
    const size = 1e-9 * (1e-3 + largest(this.q.subarray(0, lines)));
    const closed = gaps.map(({ gap }, stop) => {
      if (!this.isStop(stop)) return false;
      const slope = this.slope(stop);
      if (gap < -(size * slope)) this.failAtStop("BEHIND", stop);
      return gap <= size * slope;
    });
    const off = gaps.findIndex(({ gap }, row) =>
      locked[row] && !(Math.abs(gap) <= this.allowed(size / 1e-9, this.slope(row))));
    if (off >= 0) this.failAtStop("APART", off);
    const taken = this.taken(closed, gaps.map(({ second }) => this.h * second), locked);
    const settled = closed.map((it, stop) => it && gaps[stop].rate <= taken[stop] && thrown[stop] <= taken[stop]);
    const forces = this.decide(settled, still);
    this.noteStops(forces.map((force) => force > 0), this.each(() => 0));
  }

  // Half of what the forces of rest do in a step, before it; what pushes, with these halves.
  push() {
    const m = this.mechanism, held = this.held(), half = 0.5 * this.h;
    if (!held.includes(true)) return { pushed: held, halves: held.map(() => 0) };
    this.engage();
    const rows = this.frictions();
    const forces = this.decide(held.map((it, row) => it && this.isStop(row)), held.map((it, row) => it && rows.includes(row)));
    const holds = this.held();
    m.call("contacts", this.t, this.q, m.contacts);
    const halves = forces.map((force) => half * force);
    this.addResponses(halves, 0, this.v);
    return { pushed: forces.map((force, row) => force > 0 || (!this.isStop(row) && holds[row])), halves };
  }

  // The impulses of an impact; what others keep closed throws nothing back.
  answered(hit, wanted, isDeep) {
    const { bound: locked, rates } = hit, set = hit.closed.map((it, row) => it || locked[row]);
    const answer = this.answerHit(hit, wanted);
    if (answer) return answer;
    const kept = this.keptClosed(set, locked);
    const next = this.answerHit(hit, wanted.map((it, row) => (kept[row] ? rates[row] : it)));
    if (next) return next;
    // where modes and drives lead to what is closed, it gives no impulse while it is closed within what modes may be off
    const isLed = locked.includes(true) && !set.some((it, row) => it && isDeep(row));
    return isLed ? { impulses: this.solveAtStops(locked, rates) } : this.failAtStop("IMPACT", set.indexOf(true));
  }

  // The impulses at the stops that are closed at the end of a step, or that impulses close, one impact after the other.
  answer(closed, { before, now, gap, rest, shift, pushed, halves, slid, pressing, speed, rested }) {
    const none = this.each(() => 0), bounds = this.bounds(), directions = this.each(() => 0);
    const change = now.map((rate, stop) => rate - before[stop]), locked = this.locked();
    const size = largest(this.q.subarray(0, this.tables.lines)), slopes = this.each((row) => this.slope(row));
    const nearest = slopes.map((slope) => 1e-14 * size * slope), slowest = slopes.map((slope) => 1e-14 * speed * slope);
    let impulses = this.each(() => 0), held = this.each(() => false), isImpact = false;
    for (let turn = 0; ; turn++) {
      const moved = impulses.map((impulse, stop) => impulse * shift[stop]);
      const gaps = this.changed(gap, moved), rates = this.changed(now, impulses);
      gaps.forEach((it, stop) => { closed[stop] = closed[stop] || (this.isStop(stop) && it <= nearest[stop]); });
      const still = rates.map((_, stop) => slowest[stop] + 1e-12 * impulses.reduce(
        (size, impulse, by) => size + Math.abs(this.mobility(stop, by) * impulse),
        Math.abs(before[stop]) + Math.abs(now[stop])));
      // what was rested on has a part in the first one, whatever its rate is without the second half of the rest
      const takesPart = (stop) => turn === 15 || (turn === 0 && (pushed[stop] || rested[stop]));
      const closing = closed.map((it, stop) => it && (takesPart(stop) || rates[stop] <= still[stop]));
      const hit = closing.map((it, stop) => it && rates[stop] < -still[stop]);
      if (turn === 16 || !hit.includes(true)) {
        held = held.map((it, stop) => closing[stop] && it && impulses[stop] > 0);
        return { impulses, moved, gaps, isImpact, held, directions: this.moving(directions, rates, impulses) };
      }
      // one stop may bear what several could: by what presses without any, too
      const taken = this.takenIfAny(closed, [pressing, change], locked).map((it, stop) => (-pressing[stop] > it ? -pressing[stop] : it));
      // of a rest what its second half leaves
      const second = this.changed(this.each(() => 0), halves);
      const first = now.map((rate, stop) => rate + (pushed[stop] ? second[stop] : -(rest[stop] * change[stop])));
      const approach = turn === 0 ? first : rates;
      const thrown = this.rebounds(approach);
      const least = taken.map((taken, stop) => taken + still[stop]);
      // what is closed in the last of all impacts is rested on
      held = closed.map((it, stop) => it && (turn === 15 || thrown[stop] <= least[stop]));
      // a force that presses for a step is no impact
      isImpact = isImpact || hit.some((it, stop) => it && -approach[stop] > least[stop]);
      const wanted = rates.map((rate, stop) => {
        const later = turn === 0 ? rest[stop] * change[stop] : 0, isStill = held[stop] || locked[stop] || this.stopOf(stop) >= 0;
        const target = isStill ? 0 : thrown[stop] + later;
        return rate - (target > 0 ? target : 0);
      });
      const isDeep = (row) => this.isStop(row) && gap[row] < -this.allowed(size, this.slope(row));
      const impact = { closed: closing, bound: locked, directions: none, bounds, rates };
      // an impact takes no time: friction that it turns around has no part of the step
      const more = this.answered(turn === 0 && !isImpact ? this.turned(impact, wanted, { pushed, slid, before }) : impact, wanted, isDeep);
      more.rubbed?.forEach((it, row) => { if (it) directions[row] = more.directions[row]; });
      impulses = impulses.map((impulse, stop) => impulse + more.impulses[stop]);
    }
  }

  // Leads the end of a step back from the stops that are closed there; true if that was an impact.
  strike({ pushed, halves }, before) {
    const m = this.mechanism, n = this.q.length;
    const now = this.gapsAt(this.t, this.q, this.v, m.unmoved);
    // a gap that is no number, too, for which there is no answer
    const closed = now.map(({ gap }, stop) => this.isStop(stop) && (pushed[stop] || !(gap > 0)));
    if (!closed.includes(true)) {
      this.noteStops(closed, this.each(() => 0));
      return false;
    }
    m.trialQ.set(before.q);
    m.trialV.set(before.v);
    const was = this.gapsAt(before.t, m.trialQ, m.trialV, m.unmoved);
    m.call("reactions", this.t, this.q, this.v, this.inputs, m.none, m.reactions, m.reactions.subarray(n));
    const pressing = this.gapsAt(this.t, this.q, this.v, m.reactions).map(({ second }) => this.h * second);
    // velocities as joints at the end have them: those of the start change by forces alone, and stops that depend on each
    // other do not contradict each other by what joints are off
    const [rateBefore, rateNow] = [before.v, this.v].map((velocities) => {
      m.trialV.set(velocities);
      m.call("phi_dot", this.t, this.q, m.trialV, m.phiDot);
      m.call("projection", this.t, this.q, m.phiDot, m.delta);
      m.delta.forEach((change, j) => { m.trialV[j] = m.trialV[j] - change; });
      return this.gapsAt(this.t, this.q, m.trialV, m.unmoved).map(({ rate }) => rate);
    });
    m.call("contacts", this.t, this.q, m.contacts);
    if (!(m.contacts[m.contacts.length - 1] < this.tables.growthLimit)) this.failAtStop("IMPACT", closed.indexOf(true));
    const rest = now.map(({ gap }, stop) => {
      const from = was[stop].gap, part = from > 0 && gap < from ? from / (from - gap) : 0;
      return part < 1 ? 1 - part : 0;
    });
    const shift = rest.map((part, row) => (pushed[row] || this.isLock(row) ? 0 : part * this.h)), isClosed = closed.slice();
    const ofStop = (row) => (this.stopOf(row) < 0 ? row : this.stopOf(row));
    const { impulses, moved, gaps, held, isImpact, directions } = this.answer(closed, {
      before: rateBefore,
      now: rateNow,
      gap: now.map(({ gap }) => gap),
      rest,
      shift: shift.map((_, row) => shift[ofStop(row)]),
      pushed,
      halves,
      pressing,
      rested: this.held(),
      speed: Math.max(...[before.v, this.v].map((v) => largest(v.subarray(0, this.tables.lines)))),
      slid: this.each((row) => (this.stopOf(row) < 0 ? 0 : this.direction(row))),
    });
    // what has stuck in the whole step is where it was
    const stuck = this.held().map((it, row) => it && this.stopOf(row) >= 0 && directions[row] === 0);
    const locked = this.locked(), set = held.map((it, row) => it || stuck[row] || (locked[row] && !this.isOfRates(row)));
    const off = gaps.map((gap, row) => (stuck[row] ? gap - was[row].gap : gap));
    const shifts = this.solveAtStops(set, off).map((shift, stop) => moved[stop] + shift);
    const ofQ = new Float64Array(n), ofV = new Float64Array(n);
    this.addResponses(shifts, 0, ofQ);
    this.addResponses(impulses, 0, ofV);
    add(this.q, 1, ofQ);
    add(this.v, 1, ofV);
    // the second half of a rest has no part in an impact
    const more = impulses.map((impulse, stop) => impulse - (pushed[stop] ? halves[stop] : 0));
    this.noteStops(held, more.map((impulse) => (isImpact && impulse > 0 ? impulse : 0)));
    this.noteDirections(this.each((row) => isClosed[this.stopOf(row)] || held[this.stopOf(row)]), directions);
    return isImpact;
  }

  // Leaves the stops that would have to pull at what rests on them with the velocities behind an impact.
  keepPushing() {
    const held = this.held(), resting = held.map((it, row) => it && this.isStop(row)), rows = this.frictions();
    if (!resting.includes(true)) return;
    const forces = this.decide(resting, held.map((it, row) => it && rows.includes(row)));
    this.noteStops(resting.map((it, stop) => it && forces[stop] > 0), this.each(() => 0));
  }

  // A step, and what stops make of its end.
  toStops(step) {
    const { t, steps, alarm, worstGrowth } = this, q = this.q.slice(), v = this.v.slice();
    try {
      const hasContacts = this.tables.stops.length > 0, push = hasContacts ? this.push() : undefined;
      step();
      const { due } = this.seen(false);
      let isImpact = false;
      if (hasContacts) {
        isImpact = this.strike(push, { t, q, v });
        this.halt(push.pushed, { t, q, v });
        if (isImpact) this.keepPushing();
      }
      // an impact throws back what a condition has let pass; what modes, rests and frictions lead back has not passed it
      this.passAndEngage(isImpact ? due : []);
    } catch (failure) {
      Object.assign(this, { t, steps, alarm, worstGrowth });
      this.q.set(q);
      this.v.set(v);
      throw failure;
    }
  }
}
