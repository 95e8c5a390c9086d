"use strict";
// What all plots share: colours, numbers as text, and axes.
const drawing = (() => {
  const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#3c3c3c"];

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

  // What a vertical axis shows: a curve that only rounding moves is a straight line, and below 1e-12 it is 0.
  function range(u, low, high) {
    if (low == null) return [low, high];
    const size = Math.max(Math.abs(low), Math.abs(high));
    if (size < 1e-12) return [-1, 1];
    if (high - low > 1e-9 * size) return uPlot.rangeNum(low, high, 0.1, true);
    const middle = (low + high) / 2;
    return [middle - 0.1 * size, middle + 0.1 * size];
  }

  // Numbers at the marks of an axis; what is 0 but for rounding reads as 0.
  function marks(splits) {
    const shown = splits.filter((v) => v != null);
    const step = shown.length > 1 ? Math.abs(shown[1] - shown[0]) : 0;
    return splits.map((v) => format(v != null && Math.abs(v) < 1e-6 * step ? 0 : v, 6));
  }

  // On a logarithmic axis: a line per decade, or at 1, 2 and 5 where there are few decades.
  function decades(u, splits) {
    const shown = splits.filter((v) => v != null);
    const few = shown.length && shown[shown.length - 1] / shown[0] < 150;
    const keep = few ? ["1", "2", "5"] : ["1"];
    return splits.map((v) => (v != null && keep.includes(v.toExponential(6)[0]) &&
      Math.abs(Number(v.toExponential(6).split("e")[0]) % 1) < 1e-5 ? v : null));
  }

  // How wide a vertical axis is: as its longest number is, so that its label stands beside them.
  function width(least) {
    return (u, values) => Math.max(least, ...(values || []).map((text) => 22 + 7.5 * (text || "").length));
  }

  // Colours of text and grid may be those of a dark page.
  function axis(description, size, { ink = "#1e1e1e", grid = "#e4e4e4", tick = "#999" } = {}) {
    return {
      ...(description.log ? { filter: decades } : {}),
      ...(description.tick ? { incrs: [1 / 6, 1 / 3, 1 / 2, 1, 2, 3, 4].map((part) => part * description.tick) } : {}),
      label: description.label, size, labelSize: 24, stroke: ink,
      font: "12px system-ui, sans-serif", labelFont: "13px system-ui, sans-serif",
      grid: { stroke: grid, width: 1 }, ticks: { stroke: tick, width: 1 },
      values: (u, splits) => marks(splits),
    };
  }

  // Draws ticks at the upper edge of a plot, where something happens.
  function marker(times, ink = "#1e1e1e") {
    return ({ ctx, bbox, valToPos }) => {
      const all = times().map((time) => Math.round(valToPos(time, "x", true)));
      ctx.save();
      ctx.fillStyle = ink;
      const shown = new Set(all.filter((x) => x >= bbox.left && x <= bbox.left + bbox.width));
      shown.forEach((x) => ctx.fillRect(x - 0.75 * devicePixelRatio, bbox.top, 1.5 * devicePixelRatio, 9 * devicePixelRatio));
      ctx.restore();
    };
  }

  return { COLOURS, format, scale, range, axis, width, marker };
})();
