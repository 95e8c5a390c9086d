// What is typed is compiled, and shown beside it.
(() => {
  const library = JSON.parse(document.getElementById("library").textContent);
  const find = (id) => document.getElementById(id);
  const [examples, problems, state, frames, step, end] = ["examples", "problems", "state", "frames", "step", "end"].map(find);
  // A pause in typing, in ms; what is shown of a mechanism lives on from one text to the next.
  const PAUSE = 250;
  let timer = 0, shown = null, lived = null;

  function save(name, text, type) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  // A storage may be refused to a page from a file.
  function stored(what) {
    try {
      return what(localStorage);
    } catch {
      return null;
    }
  }

  function line(text, of = "p") {
    const element = document.createElement(of);
    element.textContent = text;
    return element;
  }

  function problem({ message, location, help, notes }) {
    const item = document.createElement("div");
    item.className = "problem";
    const place = ({ line, column }) => `${line}:${column}`;
    const said = (message, location) => {
      if (!location) return line(message);
      const button = line(`${place(location)}  ${message}`, "button");
      button.type = "button";
      button.addEventListener("click", () => declaration.select(location));
      return button;
    };
    item.append(said(message, location));
    for (const note of notes) item.append(said(note.message, note.location));
    if (help) item.append(line(help));
    return item;
  }

  // The next page takes the place of the last one once it is drawn, and goes on where that was.
  function show(page) {
    const frame = document.createElement("iframe");
    frame.title = "The mechanism";
    frame.sandbox = "allow-scripts allow-downloads";
    frame.className = "coming";
    // one that cannot run says so itself
    frame.addEventListener("load", () => setTimeout(() => reveal(frame), 3000));
    frame.srcdoc = page;
    frames.append(frame);
  }

  function reveal(frame) {
    frame.className = "";
    if (!frame.isConnected) return;
    while (frames.firstElementChild !== frame) frames.firstElementChild.remove();
  }

  addEventListener("message", ({ source, data }) => {
    const frame = [...frames.children].find((frame) => frame.contentWindow === source);
    if (frame && data === "drawn") {
      source.postMessage(lived, "*");
      reveal(frame);
    } else if (frame === frames.lastElementChild && frame) {
      lived = data;
    }
  });

  async function compile() {
    const text = declaration.value, asked = { text, step: step.value, end: end.value };
    state.textContent = "compiling…";
    const answer = await compiler.ask(asked);
    if (!answer || text !== declaration.value) return;
    const wrong = answer.problems ?? (answer.error ? [{ message: answer.error, notes: [] }] : []);
    const warnings = (answer.warnings ?? []).map((message) => ({ message: `Warning: ${message}.`, notes: [] }));
    problems.replaceChildren(...[...wrong, ...warnings].map(problem));
    problems.className = wrong.length ? "wrong" : "";
    declaration.mark((answer.problems ?? []).map(({ location }) => location).filter(Boolean));
    frames.className = wrong.length ? "old" : "";
    state.textContent = wrong.length ? (shown ? "as it was last understood" : "not understood yet") : "";
    if (!answer.page) return;
    shown = answer;
    find("export").disabled = false;
    show(answer.page);
  }

  function later() {
    stored((storage) => storage.setItem("declaration", declaration.value));
    clearTimeout(timer);
    timer = setTimeout(compile, PAUSE);
  }

  function open(text, times = { step: "", end: "" }) {
    lived = null;
    declaration.replace(text);
    [step.value, end.value] = [times.step, times.end];
    stored((storage) => storage.setItem("declaration", text));
    compile();
  }

  examples.replaceChildren(new Option("choose…", ""), ...library.map(({ name }, at) => new Option(name, at)));
  examples.addEventListener("change", () => {
    const example = library[examples.value];
    if (example) open(example.text, example);
  });
  declaration.follow(later);
  for (const field of [step, end]) field.addEventListener("change", compile);
  find("open").addEventListener("click", () => find("file").click());
  find("file").addEventListener("change", async (event) => {
    const [file] = event.target.files;
    event.target.value = "";
    if (file) open(await file.text());
  });
  const name = () => (shown ? shown.name.toLowerCase() : "mechanism");
  find("save").addEventListener("click", () => save(`${name()}.mbs`, declaration.value, "text/plain"));
  find("export").addEventListener("click", () => save(`${name()}.html`, shown.page, "text/html"));
  open(stored((storage) => storage.getItem("declaration")) || library[0].text);
})();
