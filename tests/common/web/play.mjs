// node play.mjs ENGINE.js PLAYGROUND < JSON: play sessions on the engine of the page and print each result.
// JSON: [{part, text}, …].
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [, , engine, folder] = process.argv;
const { play } = await import(pathToFileURL(path.resolve(engine)));
const jobs = JSON.parse(fs.readFileSync(0, "utf8"));
for (const { part, text } of jobs) {
  if (!globalThis.openppmc?.data?.[part])
    (0, eval)(fs.readFileSync(path.join(folder, `parts/${part}.js`), "utf8"));
  const data = globalThis.openppmc.data[part];
  let played;
  try {
    played = play(data, fs.readFileSync(path.join(folder, data.wasm)), text);
  } catch (error) {
    played = { error: error.message };
  }
  console.log(JSON.stringify(played));
}
