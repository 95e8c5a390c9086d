// Friction at stops: Coulomb's law, of forces while a stop is rested on, and of impulses where it is hit; see `rubbing.c`.
class AtContacts extends Start {
  // The stop that a friction rubs on; -1 of any other row.
  stopOf(row) {
    return this.tables.rubbing.find(([friction]) => friction === row)?.[1] ?? -1;
  }

  // The friction on a stop.
  frictionOn(stop) {
    return this.tables.rubbing.find(([, of]) => of === stop)?.[0];
  }

  // True of the friction of a stop that is in a set, and of any other row.
  isBorne(set, row) {
    const stop = this.stopOf(row);
    return stop < 0 || Boolean(set[stop]);
  }

  // The most that friction has beside x of its stop, by its row, where it slides forwards and backwards.
  bounds() {
    const { stopLaws } = this.mechanism, first = stopLaws.length - this.tables.rubbing.length;
    this.mechanism.call("stop_laws", stopLaws);
    const sizes = this.each(() => 0);
    this.tables.rubbing.forEach(([row], at) => { sizes[row] = stopLaws[first + at]; });
    return { forwards: sizes, backwards: sizes };
  }

  // The middle of the bounds and half of what is between them.
  middle({ forwards, backwards }, row) {
    return [0.5 * (forwards[row] - backwards[row]), 0.5 * (forwards[row] + backwards[row])];
  }

  // The x of frictions that slide in some directions as multiples of those of their stops.
  slides({ forwards, backwards }, directions) {
    return this.each((stop) => {
      const row = this.isStop(stop) ? this.frictionOn(stop) : undefined;
      if (row === undefined) return 0;
      return directions[row] > 0 ? -forwards[row] : directions[row] < 0 ? backwards[row] : 0;
    });
  }

  // The same in the directions that a run remembers.
  sliding() {
    return this.slides(this.bounds(), this.each((row) => (this.stopOf(row) < 0 ? 0 : this.direction(row))));
  }

  // W x + b of a row.
  rateOf(row, b, x) {
    return x.reduce((rate, force, by) => rate + this.mobility(row, by) * force, b[row]);
  }

  // W x, by which impulses change the rates of gaps.
  changes(x) {
    return this.each((row) => x.reduce((change, force, by) => change + this.mobility(row, by) * force, 0));
  }

  // True of the friction of a closed stop that sticks, or slides in either direction.
  isOpen({ closed, directions }, row) {
    return this.stopOf(row) >= 0 && this.isBorne(closed, row) && directions[row] === 0;
  }

  // Stops with friction as complementary pairs: x of every stop beside its rate, and for every friction that may stick two
  // parts of its x beside its rate and that of the other direction, and its speed beside what its bound leaves of its x. Rows
  // are scaled by the root of their own W; what is bound is eliminated.
  pairs(hit, b) {
    const those = (holds) => this.each((row) => row).filter((row) => holds(row));
    const free = those((row) => this.isOpen(hit, row) && this.middle(hit.bounds, row)[1] > 0);
    const bound = those((row) => hit.bound[row]), stops = those((row) => hit.closed[row]);
    // the middle of the bounds goes with the stop
    const slides = this.slides(hit.bounds, hit.directions);
    free.forEach((row) => { slides[this.stopOf(row)] = -this.middle(hit.bounds, row)[0]; });
    const rows = [...bound, ...stops, ...free];
    const w = rows.map((of) => [...rows.map((by) => this.slidMobility(of, by, slides)), b[of]]);
    const before = w.map((row, at) => row[at]);
    bound.forEach((_, at) => {
      if (!(w[at][at] > 1e-10 * before[at])) return;
      for (let row = at + 1; row < rows.length; row++) {
        const factor = w[row][at] / w[at][at];
        w[row].forEach((entry, column) => { w[row][column] = entry - factor * w[at][column]; });
      }
    });
    const left = w.slice(bound.length).map((row) => row.slice(bound.length));
    const scales = left.map((row, at) => (row[at] > 0 ? 1 / Math.sqrt(row[at]) : 1));
    return { stops, free, w: left, scales };
  }

  table({ bounds }, { stops, free, w, scales }) {
    const count = stops.length + free.length, last = stops.length + 3 * free.length + 1;
    const table = new Table(stops.length + 3 * free.length);
    const first = (row) => (row < stops.length ? row : stops.length + 3 * (row - stops.length));
    const sides = (row) => (row < stops.length ? [[first(row), 1]] : [[first(row), 1], [first(row) + 1, -1]]);
    w.forEach((entries, of) => sides(of).forEach(([row, sign]) => {
      table.rows[row][last] = sign * (entries[count] * scales[of]);
      w.forEach((_, by) => sides(by).forEach(([column, bySign]) => {
        table.add(row, column, sign * bySign * (entries[by] * scales[of] * scales[by]));
      }));
    }));
    free.forEach((row, friction) => {
      const at = stops.length + friction, speed = first(at) + 2, stop = stops.indexOf(this.stopOf(row));
      for (let pair = first(at); pair < speed; pair++) {
        table.add(pair, speed, 1);
        table.add(speed, pair, -1);
      }
      table.add(speed, stop, this.middle(bounds, row)[1] * scales[stop] / scales[at]);
    });
    return table;
  }

  // The stops that push, and the directions of frictions; nothing where there is no answer.
  states(hit, b) {
    const pairs = this.pairs(hit, b), { stops, free } = pairs, table = this.table(hit, pairs);
    if (!table.solve()) return null;
    const active = this.each(() => false), directions = Array.from(hit.directions);
    stops.forEach((row, at) => { active[row] = table.isActive(at); });
    free.forEach((row, friction) => {
      const first = stops.length + 3 * friction, forwards = table.isActive(first), backwards = table.isActive(first + 1);
      // at its bound the force has the sign that a slide gives it, also where others hold what it does not
      const isForwards = forwards === backwards ? table.rest(first) > table.rest(first + 1) : backwards;
      directions[row] = !table.isActive(first + 2) || (forwards && backwards) ? 0 : isForwards ? 1 : -1;
    });
    return { active, directions };
  }

  // The impulses by Newton's and Coulomb's laws, with which rates become W x + b >= 0; nothing where there are none.
  meet(hit, b) {
    const { closed, bound } = hit, rubbed = this.each((row) => this.stopOf(row) >= 0 && this.isBorne(closed, row));
    if (!rubbed.includes(true)) {
      const impulses = this.answerIfAny(closed.map((it, row) => it || bound[row]), b, bound);
      return impulses && { impulses, held: closed, rubbed, directions: hit.directions };
    }
    const states = this.states(hit, b);
    if (!states) return null;
    const { active } = states;
    // what has no friction does not stick
    const isSmooth = rubbed.map((_, row) => this.isOpen(hit, row) && this.middle(hit.bounds, row)[1] <= 0);
    const directions = states.directions.map((it, row) => (isSmooth[row] ? 1 : it));
    const held = active.map((it, row) =>
      it || Boolean(bound[row]) || (this.stopOf(row) >= 0 && this.isBorne(active, row) && directions[row] === 0));
    const impulses = this.solveAtStops(held, b, this.slides(hit.bounds, directions));
    isSmooth.forEach((it, row) => { if (it) directions[row] = this.rateOf(row, b, impulses) > 0 ? 1 : -1; });
    return { impulses, held, rubbed, directions };
  }

  // The energy that impulses give, and the sum of the sizes of its terms.
  gain({ rates }, impulses) {
    const changes = this.changes(impulses);
    let gain = 0, size = 0;
    impulses.forEach((x, row) => {
      const before = x * rates[row], half = 0.5 * x * changes[row];
      gain = gain + before + half;
      size = size + Math.abs(before) + Math.abs(half);
    });
    return [gain, size];
  }

  // The impulses between two that keep the energy: those of the first one do not give any, those of the second one do.
  between(hit, from, to) {
    const way = to.impulses.map((x, row) => x - from.impulses[row]);
    const change = this.changes(from.impulses), ofWay = this.changes(way);
    let linear = 0, square = 0, part = 0;
    way.forEach((x, row) => {
      linear = linear + x * (hit.rates[row] + change[row]);
      square = square + 0.5 * x * ofWay[row];
    });
    // c + b s + a s^2 = 0 with c <= 0
    const [gain] = this.gain(hit, from.impulses), atFirst = gain < 0 ? gain : 0;
    const root = Math.sqrt(linear * linear - 4 * square * atFirst);
    if (!(linear >= 0)) part = (root - linear) / (2 * square);
    else if (linear + root > 0) part = -2 * atFirst / (linear + root);
    const impulses = way.map((x, row) => from.impulses[row] + part * x);
    const directions = way.map((_, row) => {
      const rate = this.rateOf(row, hit.rates, impulses);
      const sticks = from.directions[row] === 0 && to.directions[row] === 0;
      return sticks || rate === 0 ? 0 : rate > 0 ? 1 : -1;
    });
    return { impulses, held: to.held, rubbed: to.rubbed, directions };
  }

  // The impulses with which rates become W x + b >= 0, b beside the rates what is thrown back; nothing where there are none.
  answerHit(hit, b) {
    // what friction jams throws nothing back
    const thrown = this.meet(hit, b) ?? this.meet(hit, hit.rates);
    if (!thrown || !thrown.rubbed.includes(true)) return thrown;
    if (!hit.closed.some((it, row) => it && b[row] !== hit.rates[row])) return thrown;
    const [gain, size] = this.gain(hit, thrown.impulses);
    if (gain <= 1e-12 * size) return thrown;
    const stopped = this.meet(hit, hit.rates);
    return stopped && this.between(hit, stopped, thrown);
  }

  // An impact with the bounds of the frictions that turn around within the step: half of the impulse of the direction in which
  // they slid acted before it.
  turned(hit, wanted, { pushed, slid, before }) {
    const moves = this.each((row) => {
      const stop = this.stopOf(row);
      return stop >= 0 && pushed[stop] && hit.closed[stop] && slid[row] !== 0;
    });
    const struck = moves.includes(true) ? this.meet({ ...hit, directions: slid }, wanted) : null;
    if (!struck) return hit;
    const changes = this.changes(struck.impulses), forwards = hit.bounds.forwards.slice(), backwards = hit.bounds.backwards.slice();
    moves.forEach((it, row) => {
      const from = before[row], to = hit.rates[row] + changes[row];
      if (!(it && slid[row] * from > 0 && slid[row] * to < 0)) return;
      const sizes = slid[row] > 0 ? backwards : forwards;
      sizes[row] = sizes[row] * (3 - 4 * (from / (from - to)));
    });
    return { ...hit, bounds: { forwards, backwards } };
  }

  // The directions of what moves by more than the rounding of impulses: what does not is open to stick.
  moving(directions, rates, impulses) {
    const roots = this.each((row) => {
      const own = this.mobility(row, row);
      return Math.sqrt(own > 0 ? own : 0);
    });
    const size = roots.reduce((sum, root, row) => sum + root * Math.abs(impulses[row]), 0);
    return directions.map((it, row) => (Math.abs(rates[row]) > 1e-12 * roots[row] * size ? it : 0));
  }

  // Sets the memories of the frictions of some rows to directions in which they slide.
  noteDirections(rubbed, directions) {
    rubbed.forEach((it, row) => { if (it) this.setFriction(row, directions[row], 0); });
  }
}
