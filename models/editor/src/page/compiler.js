// The compiler, asked one thing at a time: of several texts the last one.
const compiler = await (async () => {
  // Nobody waits longer for what is typed.
  const PATIENCE = 20000;
  const read = (id) => document.getElementById(id).textContent;
  const packed = new Blob([Uint8Array.from(atob(JSON.parse(read("packed"))), (letter) => letter.charCodeAt(0))]);
  const module = await new Response(packed.stream().pipeThrough(new DecompressionStream("deflate-raw"))).arrayBuffer();
  const script = URL.createObjectURL(new Blob([read("worker")], { type: "text/javascript" }));
  let worker = null, waiting = null, next = null, timer = 0;

  function start() {
    worker = new Worker(script);
    worker.onmessage = ({ data }) => settle(data);
    worker.onerror = (event) => settle({ failure: event.message });
    worker.postMessage({ module });
  }

  function settle(outcome) {
    clearTimeout(timer);
    const { resolve } = waiting;
    waiting = null;
    resolve(outcome.failure ? { error: `The compiler gave up: ${outcome.failure}.` } : outcome.answer);
    if (next) begin();
  }

  function begin() {
    [waiting, next] = [next, null];
    worker.postMessage({ request: waiting.request });
    timer = setTimeout(() => {
      worker.terminate();
      start();
      settle({ failure: `it was at work for ${PATIENCE / 1000} s` });
    }, PATIENCE);
  }

  start();
  return {
    // The answer to a request; null if another one came before it was looked at.
    ask(request) {
      next?.resolve(null);
      return new Promise((resolve) => {
        next = { request: JSON.stringify(request), resolve };
        if (!waiting) begin();
      });
    },
  };
})();
