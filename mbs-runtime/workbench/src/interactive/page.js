// Playing: buttons, keys, and what happens from frame to frame.
(() => {
  const { data, run } = session;
  const find = (id) => document.getElementById(id), [button, speed, time, message] = ["play", "speed", "time", "message"].map(find);
  // Work of a frame, in ms; a mechanism that takes more is shown slower.
  const MOST_WORK = 20;
  let playing = false, failed = false, last = 0, due = 0;

  const tell = (text) => { message.textContent = text; };

  // Whatever lasts, is shown in about eight seconds.
  const SPEEDS = [10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];
  const off = (rate) => Math.abs(Math.log(data.end / rate / 8));
  const usual = SPEEDS.reduce((best, rate) => (off(rate) < off(best) ? rate : best));
  speed.replaceChildren(...SPEEDS.map((rate) => new Option(rate + "×", rate, rate === usual, rate === usual)));

  function show() {
    scene.draw();
    curves.draw();
    time.textContent = [`t = ${run.t.toFixed(4)} s`, ...session.holding()].join(" · ");
  }

  // What a run says of itself is shown in its words; a mistake of the page stays one.
  function attempt(what) {
    try {
      what();
      return true;
    } catch (failure) {
      if (!(failure instanceof mbs.Failure)) throw failure;
      tell(failure.message);
      return false;
    }
  }

  // Steps up to a time, as far as the work of a frame goes.
  function advance(until) {
    const begun = performance.now(), pulled = scene.held, kick = Math.max(1, Math.round(2e-3 / run.h));
    for (let count = 0; run.t + run.h / 2 < until; count++) {
      if (pulled && count % kick === 0) drag.pull(pulled.held, pulled.target, kick * run.h);
      session.step();
      if (count % 16 === 0 && performance.now() - begun > MOST_WORK) return false;
    }
    return true;
  }

  function frame(clock) {
    if (!playing) return;
    if (last) {
      due += (Math.min(50, clock - last) / 1000) * Number(speed.value);
      const isDone = attempt(() => { if (!advance(due)) due = run.t; });
      scene.trace();
      if (!isDone) {
        failed = true;
        play(false);
      }
    }
    last = clock;
    show();
    requestAnimationFrame(frame);
  }

  function play(on) {
    if (on) tell("");
    if (on && failed) restart();
    playing = on;
    last = 0;
    due = run.t;
    button.textContent = on ? "❚❚ Pause" : "▶ Play";
    player.changed();
    if (on) requestAnimationFrame(frame);
  }

  function restart() {
    failed = !attempt(() => session.restart());
    if (!failed) tell("");
    due = run.t;
    scene.reset();
    show();
  }

  // What one frame of playing would do, one step of the run at least.
  function step() {
    play(false);
    if (failed) return;
    failed = !attempt(() => advance(run.t + Math.max(run.h, Number(speed.value) / 30)));
    scene.trace();
    show();
  }

  function faster(by) {
    const at = SPEEDS.indexOf(Number(speed.value)) - by;
    if (SPEEDS[at]) speed.value = SPEEDS[at];
    player.changed();
  }

  const player = {
    get state() { return { isPlaying: playing, speed: Number(speed.value) }; },
    set speed(rate) { if (SPEEDS.includes(rate)) speed.value = rate; },
    play: () => play(true),
    changed() {},
  };

  speed.addEventListener("change", () => player.changed());
  button.addEventListener("click", () => play(!playing));
  find("step").addEventListener("click", step);
  find("restart").addEventListener("click", restart);
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, summary")) return;
    const keys = { " ": () => play(!playing), ArrowRight: step, ArrowUp: () => faster(1), ArrowDown: () => faster(-1), r: restart, R: restart };
    if (!keys[event.key] || (event.key === " " && event.target.closest("button"))) return;
    event.preventDefault();
    keys[event.key]();
  });
  addEventListener("resize", () => scene.draw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);

  scene.follow((held, target) => {
    if (held && !playing) {
      const isFree = drag.move(held, target);
      tell(isFree ? "" : "Its drives leave this mechanism no freedom: play it, or change a parameter.");
      failed = false;
    }
    if (!playing) show();
  });
  quantities.form("parameters", session.tables.parameters, data.parameters, data.start.parameters, (values) => {
    session.setParameters(values);
    failed = false;
    due = run.t;
    if (!playing) show();
  }, tell);
  const free = session.tables.inputs.length - session.tables.memories;
  quantities.form("inputs", session.tables.inputs.slice(0, free), data.inputs, data.start.inputs.slice(0, free), (values) => {
    session.setInputs(values);
    if (!playing) show();
  }, tell);

  restart();
  // for the console of the browser, and for tests: the session, and where points of bodies are on the canvas
  globalThis.mechanism = Object.assign(session, {
    player,
    pixels: (body, point) => {
      const at = data.bodies[body].points[point], points = run.points();
      return scene.mapping().pixels([points[2 * at], points[2 * at + 1]]);
    },
  });
})();
