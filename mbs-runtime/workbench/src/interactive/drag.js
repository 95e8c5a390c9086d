// A body that is dragged: which point of it is held, and what a pull on this point does.
const drag = (() => {
  const { run, mechanism: m, tables, data } = session;
  const n = tables.coordinates.length, [low, high] = [data.picture.low, data.picture.high];
  const span = Math.hypot(high[0] - low[0], high[1] - low[1]);

  const pointAt = (points, at) => [points[2 * at], points[2 * at + 1]];

  // A held place moves with two points of its body, or with its only one.
  function hold(body, place) {
    const points = run.points(), a = pointAt(points, body.points[0]);
    const far = body.points.reduce((best, at) => {
      const reach = (at) => { const p = pointAt(points, at); return Math.hypot(p[0] - a[0], p[1] - a[1]); };
      return reach(at) > reach(best) ? at : best;
    }, body.points[0]);
    const b = pointAt(points, far), [x, y] = [b[0] - a[0], b[1] - a[1]], square = x * x + y * y;
    const [dx, dy] = [place[0] - a[0], place[1] - a[1]];
    const isRigid = square > 1e-12 * span * span;
    const local = isRigid ? [(dx * x + dy * y) / square, (dy * x - dx * y) / square] : [dx, dy];
    return { first: body.points[0], second: far, isRigid, local };
  }

  function placeOf({ first, second, isRigid, local: [s, w] }, q) {
    const points = run.points(q), a = pointAt(points, first);
    if (!isRigid) return [a[0] + s, a[1] + w];
    const b = pointAt(points, second), [x, y] = [b[0] - a[0], b[1] - a[1]];
    return [a[0] + s * x - w * y, a[1] + s * y + w * x];
  }

  // How the held place moves with each coordinate, by central differences.
  function slopes(held) {
    const q = m.trialQ, jx = new Float64Array(n), jy = new Float64Array(n);
    q.set(run.q);
    for (let j = 0; j < n; j++) {
      const h = 1e-6 * Math.max(tables.coordinates[j].length ? span : 1, 1e-9), before = q[j];
      q[j] = before + h;
      const ahead = placeOf(held, q);
      q[j] = before - h;
      const behind = placeOf(held, q);
      q[j] = before;
      [jx[j], jy[j]] = [0, 1].map((axis) => (ahead[axis] - behind[axis]) / (2 * h));
    }
    return [jx, jy];
  }

  const along = ([jx, jy], u) => [0, 1].map((axis) => u.reduce((sum, x, j) => sum + (axis ? jy : jx)[j] * x, 0));

  // What the constraints leave of M⁻¹Jᵀf, the accelerations by a force f on the held place: the nearest
  // motion, measured by masses, that keeps them. Nothing where it is singular.
  function response(j, force) {
    m.call("mass", run.t, run.q, m.mass);
    const u = Float64Array.from(m.mass, (mass, at) => (mass > 0 ? (j[0][at] * force[0] + j[1][at] * force[1]) / mass : 0));
    m.call("phi_q", run.t, run.q, m.entries);
    m.residual.fill(0);
    tables.jacobian.forEach(([row, column], at) => { m.residual[row] -= m.entries[at] * u[column]; });
    const growth = m.call("projection", run.t, run.q, m.residual, m.delta);
    if (!(growth < tables.growthLimit) || !Number.isFinite(mbs.largest(m.delta))) return null;
    mbs.add(u, 1, m.delta);
    return u;
  }

  // While it plays: a damped spring accelerates the held place towards the pointer for dt.
  function pull(held, target, dt) {
    const place = placeOf(held, run.q), j = slopes(held), velocity = along(j, run.v);
    // stiff enough that gravity pulls it aside by a fraction of the picture
    const omega = Math.sqrt((60 * 9.81) / span), wanted = [0, 1].map(
      (axis) => omega * omega * (target[axis] - place[axis]) - 1.4 * omega * velocity[axis]);
    const u = response(j, wanted);
    if (!u) return;
    const [x, y] = along(j, u), gain = wanted[0] * x + wanted[1] * y;
    const total = m.mass.reduce((sum, mass) => sum + mass, 0);
    // the mass that is felt, which is without bound where the freedom is across the pull
    const felt = gain > 0 ? (wanted[0] ** 2 + wanted[1] ** 2) / gain : 0;
    mbs.add(run.v, Math.min(felt, 20 * total) * dt, u);
  }

  // At rest: the held place goes along the freedom as near to the pointer as it can. False where there
  // is no freedom.
  function move(held, target) {
    for (let iteration = 0; iteration < 12; iteration++) {
      const place = placeOf(held, run.q), off = [target[0] - place[0], target[1] - place[1]];
      if (Math.hypot(...off) < 1e-4 * span) return true;
      const j = slopes(held), u = response(j, off);
      if (!u) return iteration > 0;
      const [x, y] = along(j, u), speed = Math.hypot(x, y);
      const turn = mbs.largest(u.filter((_, at) => !tables.coordinates[at].length));
      if (!(speed > 1e-9 * mbs.largest(u) * span) || tables.freedom < 1) return tables.freedom > 0;
      // the nearest along this line, in steps that Newton's iteration follows
      let length = Math.min((off[0] * x + off[1] * y) / speed ** 2, (0.1 * span) / speed, 0.3 / (turn || 1e-300));
      const before = run.q.slice(), distance = Math.hypot(...off);
      let isNearer = false;
      for (let halvings = 0; halvings < 6 && !isNearer; halvings++, length /= 2) {
        try {
          session.place(before.map((x, at) => x + length * u[at]));
          const now = placeOf(held, run.q);
          isNearer = Math.hypot(target[0] - now[0], target[1] - now[1]) < distance;
        } catch (failure) {
          if (!(failure instanceof mbs.Failure)) throw failure;
        }
      }
      if (!isNearer) {
        session.place(before);
        return true;
      }
    }
    return true;
  }

  return { hold, placeOf, pull, move };
})();
