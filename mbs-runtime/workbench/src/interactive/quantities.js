// Sliders and fields of parameters and inputs, in the units of the declaration.
const quantities = (() => {
  // From 0 to twice the declared value; about 0 where that is declared.
  function range(value) {
    if (value > 0) return [0, 2 * value];
    return value < 0 ? [2 * value, 0] : [-10, 10];
  }

  const plain = (value) => String(Number(value.toPrecision(10)));

  // A form of quantities, which begin with some values. `take` is given all values in SI units and throws what
  // is wrong with them.
  function form(id, declared, shown, begin, take, tell) {
    const element = document.getElementById(id);
    element.hidden = declared.length === 0;
    element.addEventListener("submit", (event) => event.preventDefault());
    let values = [...begin];
    function attempt(wanted) {
      try {
        take(wanted);
      } catch (failure) {
        if (!(failure instanceof mbs.Failure)) throw failure;
        tell(failure.message);
        return false;
      }
      values = wanted;
      tell("");
      return true;
    }
    const rows = declared.map((it, at) => {
      const { unit, scale } = shown[at], [from, to] = range(begin[at] / scale);
      const row = document.createElement("div"), label = document.createElement("label");
      const slider = document.createElement("input"), field = document.createElement("input");
      const unitOf = document.createElement("span");
      row.className = "quantity";
      label.textContent = it.name.replaceAll("_", " ");
      label.htmlFor = field.id = `${id}-${it.name}`;
      if (it.doc) {
        const doc = document.createElement("small");
        doc.textContent = " " + it.doc.trim();
        label.append(doc);
      }
      Object.assign(slider, { type: "range", min: from, max: to, step: (to - from) / 400 || 0.01 });
      slider.setAttribute("aria-label", `${it.name}${unit ? " in " + unit : ""}`);
      Object.assign(field, { type: "number", step: "any", inputMode: "decimal" });
      unitOf.className = "unit";
      unitOf.textContent = unit;
      row.append(label, slider, field, unitOf);
      const show = () => { slider.value = field.value = plain(values[at] / scale); };
      const change = (text) => {
        const wanted = [...values];
        const number = text.trim() === "" ? NaN : Number(text) * scale;
        // a text that was not changed stands for all digits of the number
        wanted[at] = text === plain(values[at] / scale) ? values[at] : number;
        const isTaken = attempt(wanted);
        field.setAttribute("aria-invalid", String(!isTaken));
        return isTaken;
      };
      slider.addEventListener("input", () => { field.value = slider.value; change(slider.value); });
      slider.addEventListener("change", show);
      field.addEventListener("change", () => { if (change(field.value)) show(); });
      show();
      return { row, show, field };
    });
    element.querySelector("div").replaceChildren(...rows.map(({ row }) => row));
    element.querySelector("button").addEventListener("click", () => {
      if (!attempt(declared.map((it) => it.value))) return;
      rows.forEach(({ show, field }) => { field.removeAttribute("aria-invalid"); show(); });
    });
  }

  return { form };
})();
