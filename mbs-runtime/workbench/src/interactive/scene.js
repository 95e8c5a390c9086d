// The picture of the mechanism, and the pointer on it.
const scene = (() => {
  const { data, run } = session, { picture, bodies } = data;
  const canvas = document.getElementById("scene"), MOST_TRACE = 900;
  const traces = picture.traced.map(() => []);
  let low, high, held = null, target = null;

  function reset() {
    [low, high] = [[...picture.low], [...picture.high]];
    traces.forEach((trace) => { trace.length = 0; });
  }

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  const pairs = (points) => Array.from({ length: points.length / 2 }, (_, at) => [points[2 * at], points[2 * at + 1]]);

  function trace() {
    const points = run.points();
    picture.traced.forEach(([point], at) => {
      traces[at].push([points[2 * point], points[2 * point + 1]]);
      if (traces[at].length > MOST_TRACE) traces[at].shift();
    });
  }

  // What maps metres to pixels and back.
  function mapping() {
    const width = canvas.clientWidth, tall = Math.max(240, Math.min(0.62 * innerHeight, width));
    const margin = 44, zoom = Math.min(
      (width - 2 * margin) / Math.max(high[0] - low[0], 1e-9), (tall - 2 * margin) / Math.max(high[1] - low[1], 1e-9));
    const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    const height = Math.max(240, Math.min(tall, (high[1] - low[1]) * zoom + 2 * margin));
    return {
      width, height, zoom,
      pixels: ([x, y]) => [width / 2 + (x - middle[0]) * zoom, height / 2 - (y - middle[1]) * zoom],
      metres: ([x, y]) => [(x - width / 2) / zoom + middle[0], (height / 2 - y) / zoom + middle[1]],
    };
  }

  function draw() {
    const places = pairs(run.points());
    for (const place of bodies.flatMap((body) => body.points.map((point) => places[point]))) {
      if (!place.every(Number.isFinite)) continue;
      for (const axis of [0, 1]) {
        low[axis] = Math.min(low[axis], place[axis]);
        high[axis] = Math.max(high[axis], place[axis]);
      }
    }
    const view = mapping(), ratio = devicePixelRatio || 1, points = places.map(view.pixels);
    canvas.style.height = view.height + "px";
    const size = [view.width, view.height].map((pixels) => Math.round(pixels * ratio));
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    const c = canvas.getContext("2d"), ink = style("ink"), paper = style("paper");
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = paper;
    c.fillRect(0, 0, view.width, view.height);
    c.lineCap = c.lineJoin = "round";
    const colour = (at) => (at % 7 === 6 ? style("grey") : drawing.COLOURS[at % 7]);
    picture.traced.forEach(([, of], at) => {
      c.strokeStyle = colour(of) + "70";
      c.lineWidth = 1.2;
      c.beginPath();
      traces[at].forEach((place) => c.lineTo(...view.pixels(place)));
      c.stroke();
    });
    const names = [];
    const shown = {
      grey: style("grey"), ink, paper, soil: style("soil"), halo: style("halo"), colour,
      zoom: view.zoom, size: picture.weight, at: (point) => points[point],
      isFree: (box) => {
        const isApart = (other) => box[0] >= other[2] || other[0] >= box[2] || box[1] >= other[3] || other[1] >= box[3];
        return names.every(isApart) && names.push(box) > 0;
      },
      direction: (from, to) => {
        const [a, b] = [points[from], points[to]], length = Math.hypot(b[0] - a[0], b[1] - a[1]);
        return length ? [(b[0] - a[0]) / length, (b[1] - a[1]) / length] : [1, 0];
      },
    };
    picture.shapes.forEach((shape) => drawShape(c, shape, shown));
    if (held && target) {
      const [from, to] = [drag.placeOf(held, run.q), target].map(view.pixels);
      c.strokeStyle = style("accent");
      c.lineWidth = 2;
      c.setLineDash([5, 4]);
      c.beginPath();
      c.moveTo(...from);
      c.lineTo(...to);
      c.stroke();
      c.setLineDash([]);
    }
  }

  // How far a place is from a line between two others, in pixels.
  function distance([x, y], [ax, ay], [bx, by]) {
    const square = (bx - ax) ** 2 + (by - ay) ** 2;
    const s = square ? Math.max(0, Math.min(1, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square)) : 0;
    return Math.hypot(x - ax - s * (bx - ax), y - ay - s * (by - ay));
  }

  // The body next to the pointer, if one is near enough for a finger.
  function bodyAt(pixel, view) {
    const points = pairs(run.points()).map(view.pixels);
    const off = (body) => Math.min(...body.points.flatMap(
      (a) => body.points.map((b) => distance(pixel, points[a], points[b]))));
    const near = bodies.map((body) => [off(body), body]).sort((a, b) => a[0] - b[0])[0];
    return near && near[0] < 32 ? near[1] : null;
  }

  // `moved` is called when the pointer has moved a held body, and when it lets go.
  function follow(moved) {
    const pixel = (event) => [event.offsetX, event.offsetY];
    canvas.addEventListener("pointerdown", (event) => {
      const view = mapping(), body = bodyAt(pixel(event), view);
      if (!body) return;
      target = view.metres(pixel(event));
      held = drag.hold(body, target);
      canvas.setPointerCapture(event.pointerId);
      canvas.classList.add("dragging");
      event.preventDefault();
      canvas.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!held) return;
      target = mapping().metres(pixel(event));
      moved(held, target);
    });
    const release = () => {
      if (!held) return;
      held = target = null;
      canvas.classList.remove("dragging");
      moved(null, null);
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
  }

  reset();
  return { canvas, draw, trace, reset, follow, mapping, get held() { return held && { held, target }; } };
})();
