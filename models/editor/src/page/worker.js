// The compiler in a thread of its own: a program for WASI, started anew for each request, so that nothing of an
// earlier one is left. Of WASI it needs standard input and output, and chance for its hash maps. There are no files.
let compiler = null;

// WASI's answer for a file that is not open.
const NOT_OPEN = 8;

class Ended extends Error {}

async function answer(request) {
  const input = new TextEncoder().encode(request), output = [];
  let read = 0, memory = null;
  // The buffers of a call, as pairs of 32 bits: where, how many bytes.
  const buffers = (at, count) => Array.from({ length: count }, (_, k) => {
    const view = new DataView(memory.buffer);
    return new Uint8Array(memory.buffer, view.getUint32(at + 8 * k, true), view.getUint32(at + 8 * k + 4, true));
  });
  const tell = (at, value) => { new DataView(memory.buffer).setUint32(at, value, true); return 0; };
  const wasi = {
    fd_read(_, at, count, done) {
      const before = read;
      for (const buffer of buffers(at, count)) {
        const part = input.subarray(read, read + buffer.length);
        buffer.set(part);
        read += part.length;
      }
      return tell(done, read - before);
    },
    fd_write(descriptor, at, count, done) {
      let written = 0;
      for (const buffer of buffers(at, count)) {
        if (descriptor === 1) output.push(buffer.slice());
        written += buffer.length;
      }
      return tell(done, written);
    },
    environ_sizes_get: (count, size) => tell(count, 0) || tell(size, 0),
    environ_get: () => 0,
    random_get(at, length) { crypto.getRandomValues(new Uint8Array(memory.buffer, at, length)); return 0; },
    sched_yield: () => 0,
    proc_exit(code) { throw new Ended(`the compiler ended with ${code}`); },
  };
  const module = await compiler;
  WebAssembly.Module.imports(module).forEach(({ name }) => { wasi[name] ??= () => NOT_OPEN; });
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi });
  memory = instance.exports.memory;
  instance.exports._start();
  return new Blob(output).text();
}

onmessage = async ({ data }) => {
  try {
    if (data.module) compiler = WebAssembly.compile(data.module);
    else postMessage({ answer: JSON.parse(await answer(data.request)) });
  } catch (failure) {
    // browsers bound how deep calls nest; everything else is a mistake of the compiler
    const isDeep = failure instanceof RangeError;
    postMessage({ failure: isDeep ? "formulas or brackets are nested too deeply for this browser" : failure.message });
  }
};
