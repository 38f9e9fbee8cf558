"use strict";
// The worker: questions with answers. A question of the kind "run" that waits is replaced by a newer one.
function startWorker(pack) {
  const code = document.getElementById("worker-code").textContent;
  const url = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  const waiting = new Map();
  let worker = null;
  let number = 0;
  let asked = null;
  let next = null;

  function send(q, news) {
    number += 1;
    const id = number;
    return new Promise((resolve, reject) => {
      waiting.set(id, { resolve, reject, news });
      worker.postMessage({ ...q, id });
    });
  }

  function begin() {
    worker = new Worker(url);
    worker.onmessage = ({ data }) => {
      const entry = waiting.get(data.id);
      if (!entry) return;
      if (data.news) {
        if (entry.news) entry.news(data.news);
        return;
      }
      waiting.delete(data.id);
      if (data.failure) entry.reject(new Error(data.failure));
      else entry.resolve(data.answer);
    };
    const wasm = Uint8Array.from(atob(pack.wasm), (c) => c.charCodeAt(0));
    return send({
      kind: "setup",
      wasm,
      layout: pack.layout,
      golden: pack.golden,
      golden_models: pack.golden_models,
      ...pack.for_worker,
    });
  }

  // The latest run wins: one is computed, one waits.
  function run(q, show) {
    next = { q, show };
    if (asked) return asked;
    asked = (async () => {
      while (next) {
        const { q: now, show: tell } = next;
        next = null;
        tell(await send({ kind: "run", ...now }), now);
      }
      asked = null;
    })();
    return asked;
  }

  // Ends whatever is being computed and begins anew.
  function stop() {
    worker.terminate();
    for (const entry of waiting.values()) entry.reject(new Error("stopped"));
    waiting.clear();
    asked = null;
    next = null;
    return begin();
  }

  return { begin, send, run, stop };
}
