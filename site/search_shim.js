// Shim of the search worker in pages that are opened from a file. Such pages can start a worker only from a
// blob. The worker of the playground is already a blob, so the shim does not replace it.
// scripts/site/__main__.py puts in the shim of the npm package iframe-worker.
(() => { const Own = window.Worker;
/* SHIM */
if (window.Worker !== Own) window.Worker = function (url, options) {
  return new (/^blob:/.test(url) ? Own : window.IFrameWorker)(url, options);
};
})();
