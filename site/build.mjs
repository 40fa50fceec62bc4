// Build scripts and styles of the playground and of the landing page: node build.mjs [FOLDER].
// Each script contains the worker as text, so that the pages also work if they are opened from a file.
import { build } from "esbuild";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import path from "node:path";

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.resolve(process.argv[2] ?? path.join(here, "../build/site/playground"));
const common = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  target: "es2020",
  logLevel: "warning",
  legalComments: "none",
  write: false,
};
// uPlot formats numbers for the browser's language. Without a system language, Chromium names one that is invalid.
const validLanguage = `try { new Intl.NumberFormat(navigator.language) }
catch { Object.defineProperty(navigator, "language", { value: "en" }) }`;
const worker = await build({ ...common, entryPoints: ["src/worker.ts"], format: "iife" });
const pages = await build({
  ...common,
  entryPoints: { playground: "src/main.tsx", landing: "src/landing.tsx" },
  outdir: out,
  format: "iife",
  jsx: "automatic",
  jsxImportSource: "preact",
  banner: { js: validLanguage },
  define: { WORKER: JSON.stringify(worker.outputFiles[0].text) },
});
// The tests use the engine without the page.
const engine = await build({
  ...common,
  minify: false,
  entryPoints: { engine: "src/engine/alone.ts" },
  outdir: path.join(out, "../engine"),
  format: "esm",
});
// An unchanged file is not written again, because another process may be reading it.
for (const { path: file, contents } of [...pages.outputFiles, ...engine.outputFiles]) {
  if (existsSync(file) && readFileSync(file).equals(contents)) continue;
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, contents);
}
