"use strict";
// Shapes of a mechanism on a canvas, in the sizes in which figures draw them.
const drawShape = (() => {
  const FONT = "14px system-ui, sans-serif";
  // On white paper; a page may have others.
  const LIGHT = { grey: "#788088", ink: "#1e1e1e", paper: "#fff", soil: "#c2c5c9", halo: "rgba(255, 255, 255, 0.85)" };

  function line(c, points, colour, width) {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.beginPath();
    points.forEach((p) => c.lineTo(...p));
    c.stroke();
  }

  function fill(c, points, colour) {
    c.fillStyle = colour;
    c.beginPath();
    points.forEach((p) => c.lineTo(...p));
    c.fill();
  }

  function disc(c, [x, y], radius, colour) {
    c.fillStyle = colour;
    c.beginPath();
    c.arc(x, y, radius, 0, 7);
    c.fill();
  }

  function ring(c, at, v) {
    disc(c, at, 4.5 * v.size, v.ink);
    disc(c, at, 3 * v.size, v.paper);
  }

  function text(c, words, [x, y], colour, halo) {
    c.font = FONT;
    c.textAlign = "left";
    c.textBaseline = "middle";
    c.lineWidth = 4;
    c.strokeStyle = halo;
    c.strokeText(words, x, y);
    c.fillStyle = colour;
    c.fillText(words, x, y);
  }

  const SHAPES = {
    rail(c, s, v) {
      const [x, y] = v.at(s.from), [dx, dy] = v.direction(s.from, s.ahead);
      line(c, s.reach.map((r) => [x + r * v.zoom * dx, y + r * v.zoom * dy]), v.grey, 1.5);
    },
    ground(c, s, v) {
      const [x, y] = v.at(s.at), d = (pixels) => pixels * v.size, foot = y + d(18);
      const corners = [[x - d(11), foot], [x, y], [x + d(11), foot]];
      fill(c, corners, v.soil);
      line(c, corners, v.grey, d(1.5));
      line(c, [[x - d(16), foot], [x + d(16), foot]], v.grey, d(1.5));
      for (let k = 1; k <= 5; k++) {
        const right = x - d(16) + k * d(6.4);
        line(c, [[right, foot], [right - d(6), foot + d(6)]], v.grey, d(1.2));
      }
    },
    link: (c, s, v) => line(c, s.points.map(v.at), v.grey, 3 * v.size),
    circle(c, s, v) {
      const [x, y] = v.at(s.at), [rx, ry] = v.at(s.rim);
      c.strokeStyle = s.colour === null ? v.grey : v.colour(s.colour);
      c.lineWidth = 3 * v.size;
      c.beginPath();
      c.arc(x, y, Math.hypot(rx - x, ry - y), 0, 7);
      c.stroke();
    },
    spring(c, s, v) {
      const [[ax, ay], [bx, by]] = s.points.map(v.at), dx = bx - ax, dy = by - ay;
      const half = 10 * v.size / (Math.hypot(dx, dy) || 1), turns = 12;
      const at = (along, aside) => [ax + along * dx - aside * half * dy, ay + along * dy + aside * half * dx];
      const zigzag = [...Array(turns).keys()].map((k) => at(0.14 + 0.72 * (k + 0.5) / turns, k % 2 ? -1 : 1));
      line(c, [at(0, 0), at(0.14, 0), ...zigzag, at(0.86, 0), at(1, 0)], v.ink, 1.8 * v.size);
    },
    bar: (c, s, v) => line(c, s.points.map(v.at), v.colour(s.colour), 8 * v.size),
    plate(c, s, v) {
      const corners = s.points.map(v.at);
      c.globalAlpha = 0.28;
      fill(c, corners, v.colour(s.colour));
      c.globalAlpha = 1;
      line(c, [...corners, corners[0], corners[1]], v.colour(s.colour), 4 * v.size);
    },
    dot: (c, s, v) => disc(c, v.at(s.at), 9 * v.size, v.colour(s.colour)),
    block(c, s, v) {
      const [x, y] = v.at(s.at), [dx, dy] = v.direction(s.from, s.ahead);
      const corner = ([a, b]) => [x + v.size * (18 * a * dx - 11 * b * dy), y + v.size * (18 * a * dy + 11 * b * dx)];
      fill(c, [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(corner), v.colour(s.colour));
    },
    coil(c, s, v) {
      const [x, y] = v.at(s.at);
      const spiral = [...Array(61).keys()].map((k) => {
        const turn = (k / 60) * 5 * Math.PI, radius = v.size * (6 + (8 * k) / 60);
        return [x + radius * Math.cos(turn), y - radius * Math.sin(turn)];
      });
      line(c, spiral, v.ink, 1.5 * v.size);
    },
    pin: (c, s, v) => ring(c, v.at(s.at), v),
    weld(c, s, v) {
      const [x, y] = v.at(s.at), half = 4.5 * v.size;
      fill(c, [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => [x + a * half, y + b * half]), v.ink);
    },
    centre(c, s, v) {
      const [x, y] = v.at(s.at);
      ring(c, [x, y], v);
      c.fillStyle = v.ink;
      for (const quarter of [0, Math.PI]) {
        c.beginPath();
        c.moveTo(x, y);
        c.arc(x, y, 4 * v.size, quarter - Math.PI / 2, quarter);
        c.fill();
      }
    },
    mark(c, s, v) {
      const [a, b] = s.points.map(v.at);
      c.setLineDash([8, 5]);
      line(c, [a, b], v.grey, 1.5);
      c.setLineDash([]);
      text(c, s.text, [(a[0] + b[0]) / 2 + 8, (a[1] + b[1]) / 2 + 8], v.ink, v.halo);
    },
    label(c, s, v) {
      const points = s.points.map(v.at);
      const middle = [0, 1].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
      // Beside a bar, across it, on its upper side; above anything else.
      const [dx, dy] = points.length === 2 ? [points[1][0] - points[0][0], points[1][1] - points[0][1]] : [1, 0];
      const length = Math.hypot(dx, dy) || 1, up = dx < 0 ? -1 : 1;
      c.font = FONT;
      const [across, over] = [(up * dy) / length, (-up * dx) / length];
      const width = c.measureText(s.text).width;
      // On the other side, or not at all, where another name is.
      for (const side of [1, -1]) {
        const reach = side * across;
        const left = reach < -0.3 ? -width : reach > 0.3 ? 0 : -width / 2;
        const [x, y] = [middle[0] + 14 * reach + left, middle[1] + 18 * side * over];
        if (!v.isFree([x, y - 8, x + width, y + 8])) continue;
        text(c, s.text, [x, y], v.colour(s.colour), v.halo);
        return;
      }
    },
  };

  // `view` says where points are and how large things become; what it does not know is left out.
  return (c, shape, view) => SHAPES[shape.kind]?.(c, shape, { ...LIGHT, ...view });
})();
