"use strict";
(() => {
  const { COLOURS, format, scale, axis } = drawing;
  const plots = JSON.parse(document.getElementById("data").textContent);

  function lines(element, panel) {
    const name = (s) => s.name || panel.y.label;
    const series = panel.series.map((s, at) => ({
      label: name(s), stroke: COLOURS[at % COLOURS.length], width: 1.8,
      dash: s.stroke === "dashed" ? [8, 5] : undefined,
      paths: s.stroke === "points" ? () => null : undefined,
      points: { show: s.stroke === "dotted" || s.stroke === "points", size: s.stroke === "points" ? 4 : 6 },
      spanGaps: false,
      value: (u, v) => format(v, 6),
    }));
    const width = () => Math.max(320, element.clientWidth);
    const options = {
      width: width(), height: 320,
      scales: { x: scale(panel.x), y: panel.y.log ? scale(panel.y) : { range: drawing.range, ...scale(panel.y) } },
      axes: [axis(panel.x, 46), axis(panel.y, drawing.width(88))],
      series: [{ label: panel.x.label, value: (u, v) => format(v, 6) }, ...series],
      cursor: { drag: { x: true, y: false } },
      hooks: { draw: [drawing.marker(() => panel.marks)] },
    };
    // One curve is named by its axis.
    element.classList.toggle("alone", panel.series.length === 1);
    const plot = new uPlot(options, uPlot.join(panel.series.map((s) => [s.x, s.y])), element);
    new ResizeObserver(() => plot.setSize({ width: width(), height: 320 })).observe(element);
  }

  function animation(element, picture) {
    element.innerHTML = `<h3></h3><canvas></canvas>
      <div class="controls"><button type="button"></button>
      <input type="range" min="0" max="1000" value="0" aria-label="time">
      <label>speed <select></select></label></div>
      <div class="readouts"></div>`;
    const find = (selector) => element.querySelector(selector);
    const [canvas, button, slider, speed] = ["canvas", "button", "input", "select"].map(find);
    find("h3").textContent = picture.title;
    if (!picture.times.length) return;
    const times = picture.times, start = times[0], span = times[times.length - 1] - start || 1;
    // Whatever lasts, is shown in about eight seconds.
    const speeds = [10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01];
    const off = (rate) => Math.abs(Math.log(span / rate / 8));
    const usual = speeds.reduce((best, rate) => (off(rate) < off(best) ? rate : best));
    speed.replaceChildren(...speeds.map((rate) => new Option(rate, rate, rate === usual, rate === usual)));

    const frames = picture.frames.map((places) => places.map((p) => p.map((x) => x * picture.unit)));
    const [left, low] = picture.low, [right, high] = picture.high;

    function draw(now) {
      const at = Math.min(times.length - 1, Math.round((now - start) / span * (times.length - 1)));
      const ratio = devicePixelRatio || 1;
      const width = element.clientWidth;
      const zoom = Math.min(width / (right - left), 460 / (high - low));
      const height = (high - low) * zoom;
      canvas.width = width * ratio;
      canvas.height = height * ratio;
      canvas.style.height = height + "px";
      const c = canvas.getContext("2d");
      c.scale(ratio, ratio);
      const place = ([x, y]) => [width / 2 + (x - (left + right) / 2) * zoom, height / 2 - (y - (low + high) / 2) * zoom];
      const points = frames[at].map(place);
      c.lineCap = c.lineJoin = "round";

      for (const [traced, colour] of picture.traced) {
        c.strokeStyle = COLOURS[colour % COLOURS.length] + "70";
        c.lineWidth = 1.2;
        c.beginPath();
        frames.forEach((frame) => c.lineTo(...place(frame[traced])));
        c.stroke();
      }
      const names = [];
      const view = {
        // Whether no name stands there yet; then one does.
        isFree: (box) => {
          const isApart = (other) => box[0] >= other[2] || other[0] >= box[2] || box[1] >= other[3] || other[1] >= box[3];
          return names.every(isApart) && names.push(box) > 0;
        },
        zoom, size: picture.weight,
        at: (point) => points[point],
        colour: (at) => COLOURS[at % COLOURS.length],
        direction: (from, to) => {
          const [a, b] = [points[from], points[to]], length = Math.hypot(b[0] - a[0], b[1] - a[1]);
          return length ? [(b[0] - a[0]) / length, (b[1] - a[1]) / length] : [1, 0];
        },
      };
      picture.shapes.forEach((shape) => drawShape(c, shape, view));
      const values = [`t = ${times[at].toFixed(4)} s`, ...picture.readouts.map(
        (r) => `${r.name} = ${format(r.values[at], 4)} ${r.unit}`.trim())];
      find(".readouts").replaceChildren(...values.map((text) => {
        const span = document.createElement("span");
        span.textContent = text;
        return span;
      }));
    }

    let playing = false, now = start, last = 0;
    const moveTo = (time) => {
      now = time;
      slider.value = (1000 * (now - start)) / span;
      draw(now);
    };
    const frame = (clock) => {
      if (!playing) return;
      if (last) moveTo(start + ((now - start + ((clock - last) / 1000) * speed.value) % span));
      last = clock;
      requestAnimationFrame(frame);
    };
    const play = (on) => {
      playing = on;
      last = 0;
      button.textContent = on ? "❚❚ pause" : "▶ play";
      if (on) requestAnimationFrame(frame);
    };
    button.onclick = () => play(!playing);
    slider.oninput = () => {
      play(false);
      moveTo(start + (slider.value / 1000) * span);
    };
    addEventListener("resize", () => draw(now));
    play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    draw(now);
  }

  for (const element of document.querySelectorAll("[data-plot]")) {
    const plot = plots[Number(element.dataset.plot)];
    (plot.kind === "animation" ? animation : lines)(element, plot);
  }

  // In a page that follows a file, the next report begins where this one was left.
  if (parent !== window) {
    addEventListener("message", (event) => Number.isFinite(event.data) && scrollTo(0, event.data));
    addEventListener("scroll", () => parent.postMessage(scrollY, "*"), { passive: true });
  }
})();
