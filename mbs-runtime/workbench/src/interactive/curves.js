// Curves that follow the run: two plots, each of a column that can be chosen.
const curves = (() => {
  const { data, tables, rows, changes } = session, MOST_POINTS = 1200;
  const n = tables.coordinates.length, outputs = tables.outputs.length, all = data.columns.length;
  const begin = tables.lines ? 1 : 1 + n;
  const behind = data.memories.length + 1, output = all - behind - outputs;
  const first = outputs ? [output, outputs > 1 ? output + 1 : begin] : [begin, n > 1 ? begin + 1 : 1 + n];
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

  function plot(parent, at, column) {
    const box = document.createElement("div"), choice = document.createElement("select"), place = document.createElement("div");
    choice.setAttribute("aria-label", `curve ${at + 1}`);
    const order = [...data.columns.keys()].slice(1);
    const outer = order.slice(output - 1), inner = order.slice(0, output - 1);
    choice.replaceChildren(...[...outer, ...inner].map((k) => new Option(data.columns[k], k, k === column, k === column)));
    box.append(choice, place);
    parent.append(box);
    let drawn = null, width = 0;
    const make = () => {
      drawn?.destroy();
      width = Math.max(240, place.clientWidth);
      const colours = { ink: style("ink"), grid: style("grid"), tick: style("grey") };
      drawn = new uPlot({
        width, height: 230, legend: { show: false }, cursor: { drag: { x: false, y: false } },
        scales: { x: { time: false }, y: { range: drawing.range } },
        axes: [drawing.axis({ label: "t [s]" }, 40, colours), drawing.axis({ label: data.columns[choice.value] }, drawing.width(60), colours)],
        series: [{}, { stroke: drawing.COLOURS[at], width: 1.8 }],
        hooks: { draw: [drawing.marker(() => changes, style("ink"))] },
      }, points(), place);
    };
    const points = () => {
      const stride = Math.ceil(rows.length / MOST_POINTS) || 1;
      const kept = rows.filter((_, at) => (rows.length - 1 - at) % stride === 0);
      return [kept.map((row) => row[0]), kept.map((row) => row[choice.value])];
    };
    choice.addEventListener("change", make);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", make);
    // at first too, once all boxes are there and have their widths
    new ResizeObserver(() => { if (Math.max(240, place.clientWidth) !== width) make(); }).observe(place);
    return () => drawn?.setData(points());
  }

  const parent = document.querySelector(".plots");
  const plots = first.map((column, at) => plot(parent, at, column));
  const count = document.getElementById("rows");
  return {
    draw() {
      plots.forEach((draw) => draw());
      count.textContent = `${rows.length} rows`;
    },
  };
})();
