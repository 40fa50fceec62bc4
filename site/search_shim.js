// Lets the search work in pages that are opened from a file. Such pages can start a worker only from a blob, so
// the worker of the search is replaced by that of the npm package iframe-worker. The worker of the playground
// is already a blob and is not replaced. scripts/site/__main__.py inserts the code of the package below.
(() => { const Own = window.Worker;
/* SHIM */
if (window.Worker !== Own) window.Worker = function (url, options) {
  return new (/^blob:/.test(url) ? Own : window.IFrameWorker)(url, options);
};
})();
