"use strict";
(() => {
  const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#3c3c3c"];
  const plots = JSON.parse(document.getElementById("data").textContent);

  const superscript = (n) => String(n).replace(/-/, "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);

  // Plain between 1e-3 and 1e5, else as a power of ten: 1e-8 must not read as 0.
  function format(value, digits) {
    if (value == null) return "";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits))).replace("-", "−");
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    const factor = Number(mantissa);
    const power = "10" + superscript(Number(exponent));
    return (factor === 1 ? power : factor + "·" + power).replace("-", "−");
  }

  function scale(axis) {
    const scale = { time: false, distr: axis.log ? 3 : 1 };
    if (axis.range) scale.range = axis.range;
    return scale;
  }

  // On a logarithmic axis: a line per decade, or at 1, 2 and 5 where there are few decades.
  function decades(u, splits) {
    const shown = splits.filter((v) => v != null);
    const few = shown.length && shown[shown.length - 1] / shown[0] < 150;
    const keep = few ? ["1", "2", "5"] : ["1"];
    return splits.map((v) => (v != null && keep.includes(v.toExponential(6)[0]) &&
      Math.abs(Number(v.toExponential(6).split("e")[0]) % 1) < 1e-5 ? v : null));
  }

  function axis(description, size) {
    return {
      ...(description.log ? { filter: decades } : {}),
      label: description.label, size, labelSize: 24, stroke: "#1e1e1e",
      font: "12px system-ui, sans-serif", labelFont: "13px system-ui, sans-serif",
      grid: { stroke: "#e4e4e4", width: 1 }, ticks: { stroke: "#999", width: 1 },
      values: (u, splits) => splits.map((v) => format(v, 6)),
    };
  }

  function lines(element, panel) {
    const name = (s) => s.name || panel.y.label;
    const series = panel.series.map((s, at) => ({
      label: name(s), stroke: COLOURS[at % COLOURS.length], width: 1.8,
      dash: s.stroke === "dashed" ? [8, 5] : undefined,
      points: { show: s.stroke === "dotted", size: 6 },
      spanGaps: false,
      value: (u, v) => format(v, 6),
    }));
    const width = () => Math.max(320, element.clientWidth);
    const options = {
      width: width(), height: 320,
      scales: { x: scale(panel.x), y: scale(panel.y) },
      axes: [axis(panel.x, 46), axis(panel.y, 88)],
      series: [{ label: panel.x.label, value: (u, v) => format(v, 6) }, ...series],
      cursor: { drag: { x: true, y: false } },
    };
    const plot = new uPlot(options, uPlot.join(panel.series.map((s) => [s.x, s.y])), element);
    addEventListener("resize", () => plot.setSize({ width: width(), height: 320 }));
  }

  function animation(element, picture) {
    element.innerHTML = `<h3></h3><canvas></canvas>
      <div class="controls"><button type="button"></button>
      <input type="range" min="0" max="1000" value="0" aria-label="time">
      <label>speed <select><option>1</option><option>0.5</option><option>0.2</option>
      <option selected>0.1</option><option>0.05</option></select></label></div>
      <div class="readouts"></div>`;
    const find = (selector) => element.querySelector(selector);
    const [canvas, button, slider, speed] = ["canvas", "button", "input", "select"].map(find);
    find("h3").textContent = picture.title;
    const times = picture.times, start = times[0], span = times[times.length - 1] - start;

    const all = picture.frames.flat();
    const bound = (at, f) => f(...all.map((p) => p[at]));
    const margin = 0.12 * (bound(0, Math.max) - bound(0, Math.min) || 1);
    const box = { left: bound(0, Math.min) - margin, right: bound(0, Math.max) + margin,
                  low: bound(1, Math.min) - margin, high: bound(1, Math.max) + margin };

    function draw(now) {
      const at = Math.min(times.length - 1, Math.round((now - start) / span * (times.length - 1)));
      const ratio = devicePixelRatio || 1;
      const width = element.clientWidth, unit = width / (box.right - box.left);
      const height = Math.min(420, (box.high - box.low) * unit);
      canvas.width = width * ratio;
      canvas.height = height * ratio;
      canvas.style.height = height + "px";
      const c = canvas.getContext("2d");
      c.scale(ratio, ratio);
      const zoom = Math.min(unit, height / (box.high - box.low));
      const place = ([x, y]) => [width / 2 + (x - (box.left + box.right) / 2) * zoom,
                                 height / 2 - (y - (box.low + box.high) / 2) * zoom];
      const points = picture.frames[at].map(place);
      c.lineCap = c.lineJoin = "round";

      c.strokeStyle = "#b8c0c8";
      c.lineWidth = 1.2;
      for (const traced of picture.traced) {
        c.beginPath();
        picture.frames.forEach((frame) => c.lineTo(...place(frame[traced])));
        c.stroke();
      }
      for (const ground of picture.fixed) {
        const [x, y] = points[ground];
        c.fillStyle = "#8a929a";
        c.beginPath();
        c.moveTo(x, y);
        c.lineTo(x - 13, y + 22);
        c.lineTo(x + 13, y + 22);
        c.fill();
      }
      for (const block of picture.blocks) {
        const [x, y] = points[block];
        c.fillStyle = "#009e73";
        c.fillRect(x - 24, y - 15, 48, 30);
        c.strokeStyle = "#8a929a";
        c.lineWidth = 1.5;
        c.beginPath();
        c.moveTo(0, y + 16);
        c.lineTo(width, y + 16);
        c.stroke();
      }
      picture.bars.forEach(([from, to], number) => {
        c.strokeStyle = COLOURS[number % COLOURS.length];
        c.lineWidth = 9;
        c.beginPath();
        c.moveTo(...points[from]);
        c.lineTo(...points[to]);
        c.stroke();
      });
      for (const joint of new Set(picture.bars.flat())) {
        c.fillStyle = "#fff";
        c.strokeStyle = "#1e1e1e";
        c.lineWidth = 1.5;
        c.beginPath();
        c.arc(...points[joint], 5, 0, 7);
        c.fill();
        c.stroke();
      }
      const values = [`t = ${times[at].toFixed(4)} s`, ...picture.readouts.map(
        (r) => `${r.name} = ${format(r.values[at], 4)} ${r.unit}`)];
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
})();
