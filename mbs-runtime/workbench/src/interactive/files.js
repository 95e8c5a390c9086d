// What can be kept: the recorded rows as CSV, and the picture.
(() => {
  const { data, rows } = session;

  function save(name, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  // Shortest forms that read back as the same numbers; what is not finite as in other files of `mbs`.
  const number = (x) => (Number.isNaN(x) ? "NaN" : Number.isFinite(x) ? (Object.is(x, -0) ? "-0" : String(x)) : x > 0 ? "inf" : "-inf");

  document.getElementById("csv").addEventListener("click", () => {
    const lines = [data.columns.map(cell), ...rows.map((row) => row.map(number))].map((line) => line.join(","));
    save(`${data.file}.csv`, new Blob([lines.join("\n") + "\n"], { type: "text/csv" }));
  });
  document.getElementById("png").addEventListener("click", () => {
    scene.draw();
    scene.canvas.toBlob((blob) => save(`${data.file}.png`, blob), "image/png");
  });
})();
