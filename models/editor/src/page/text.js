// The declaration: a text field over its coloured copy, with line numbers and underlined problems.
const declaration = (() => {
  const keywords = JSON.parse(document.getElementById("keywords").textContent);
  const meaning = new Map(keywords.map((keyword) => [keyword.word, keyword]));
  const find = (selector) => document.querySelector(selector);
  const [field, shown, numbers, hint] = ["#text", ".shown", ".numbers", "#keyword"].map(find);
  const TOKEN = /(?<comment>\/\/[^\n]*|\/\*[^]*?\*\/)|(?<unit>\[[^\[\]\n]*\])|(?<number>\b\d[\d_]*(?:\.\d+)?(?:e[+-]?\d+)?)|(?<word>[A-Za-z_]\w*)/g;
  let marks = [];

  // Coloured pieces of the text: from, to, and the class.
  function pieces(text) {
    const found = [];
    for (const match of text.matchAll(TOKEN)) {
      const { comment, unit, number, word } = match.groups;
      const kind = comment ? "comment" : unit ? "unit" : number ? "number" : meaning.has(word) ? "keyword" : null;
      if (kind) found.push([match.index, match.index + match[0].length, kind]);
    }
    return found;
  }

  function draw() {
    const text = field.value, coloured = pieces(text), bounds = new Set([0, text.length]);
    for (const [from, to] of [...coloured, ...marks]) bounds.add(from).add(to);
    const sorted = [...bounds].sort((a, b) => a - b), parts = [];
    let piece = 0;
    for (let at = 0; at + 1 < sorted.length; at++) {
      const [from, to] = [sorted[at], sorted[at + 1]];
      while (piece < coloured.length && coloured[piece][1] <= from) piece++;
      const colour = coloured[piece]?.[0] <= from ? coloured[piece][2] : "";
      const isBad = marks.some((mark) => mark[0] <= from && to <= mark[1]);
      const part = document.createElement("span");
      part.className = isBad ? `${colour} bad` : colour;
      part.textContent = text.slice(from, to);
      parts.push(part);
    }
    // a last empty line has a height of its own
    shown.replaceChildren(...parts, "\n ");
    const bad = new Set(marks.map(([from]) => lineOf(from)));
    const lines = Array.from({ length: lineOf(text.length) }, (_, line) => {
      const number = document.createElement("span");
      number.className = bad.has(line + 1) ? "bad" : "";
      number.textContent = `${line + 1}\n`;
      return number;
    });
    numbers.replaceChildren(...lines);
  }

  const lineOf = (offset) => field.value.slice(0, offset).split("\n").length;

  // The place of a location, whose columns count characters and not units of a string.
  function range({ line, column, length }) {
    const lines = field.value.split("\n"), before = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    const rest = Array.from(field.value.slice(before)), units = (count) => rest.slice(0, count).join("").length;
    const from = before + units(column - 1), to = before + units(column - 1 + length);
    // what has no length is seen too
    return [from, Math.max(to, Math.min(from + 1, field.value.length))];
  }

  // What the keyword at the caret means, or the first one of its line.
  function explain() {
    const text = field.value, at = field.selectionStart;
    const from = at - text.slice(0, at).match(/\w*$/)[0].length, word = text.slice(from).match(/^\w*/)[0];
    const first = text.slice(text.lastIndexOf("\n", at - 1) + 1).match(/^ *(\w*)/)[1];
    const keyword = meaning.get(word) ?? meaning.get(first), form = document.createElement("code");
    hint.replaceChildren();
    if (!keyword) return;
    form.textContent = keyword.form;
    hint.append(form, ` ${keyword.meaning}`);
  }

  const insert = (text) => document.execCommand("insertText", false, text);

  field.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const line = field.value.slice(0, field.selectionStart).split("\n").at(-1);
    if (event.key === "Tab" && !event.shiftKey && field.dataset.leave !== "yes") {
      event.preventDefault();
      insert(" ".repeat(4 - (line.length % 4)));
    } else if (event.key === "Enter") {
      event.preventDefault();
      insert("\n" + line.match(/^ */)[0] + (/[{(]\s*$/.test(line) ? "    " : ""));
    } else if (event.key === "}" && /^ +$/.test(line) && field.selectionStart === field.selectionEnd) {
      event.preventDefault();
      field.setSelectionRange(field.selectionStart - Math.min(4, line.length), field.selectionEnd);
      insert("}");
    }
    // after Escape the Tab key goes on to what is next
    field.dataset.leave = event.key === "Escape" ? "yes" : "";
  });
  document.addEventListener("selectionchange", () => { if (document.activeElement === field) explain(); });

  return {
    field,
    get value() { return field.value; },
    // A whole new text.
    replace(text) {
      field.value = text;
      marks = [];
      draw();
      find(".editor").scrollTo(0, 0);
      field.setSelectionRange(0, 0);
      explain();
    },
    mark(locations) {
      marks = locations.map(range);
      draw();
    },
    select(location) {
      field.focus();
      field.setSelectionRange(...range(location));
    },
    // Calls `changed` when something was typed, under which underlines move away.
    follow(changed) {
      field.addEventListener("input", () => {
        marks = [];
        draw();
        changed();
      });
    },
  };
})();
