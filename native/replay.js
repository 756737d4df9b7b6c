// Recorded calls, made again in WebAssembly: node replay.js REPLAY.wasm CALLS
const [wasm, calls] = process.argv.slice(2).map((file) => require("fs").readFileSync(file));
WebAssembly.instantiate(wasm).then(({ instance: { exports: kernel } }) => {
  const begin = kernel.room(BigInt(calls.length));
  new Uint8Array(kernel.memory.buffer, begin, calls.length).set(calls);
  for (let at = begin; at < begin + calls.length; ) {
    at = kernel.call(at);
    console.log(BigInt.asUintN(64, kernel.told()).toString(16).padStart(16, "0"));
  }
});
