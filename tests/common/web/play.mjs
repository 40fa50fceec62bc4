// node play.mjs ENGINE.js PLAYGROUND < JSON: play sessions on the engine of the page and print each result.
// JSON: [{part, text, clk}, …]. With clk, the session is played on the build for boards with this clock in Hz.
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [, , engine, folder] = process.argv;
const { play } = await import(pathToFileURL(path.resolve(engine)));
const jobs = JSON.parse(fs.readFileSync(0, "utf8"));
for (const { part, text, clk } of jobs) {
  if (!globalThis.openppmc?.data?.[part])
    (0, eval)(fs.readFileSync(path.join(folder, `parts/${part}.js`), "utf8"));
  const page = globalThis.openppmc.data[part];
  const data = { ...page, ...(clk && page.board.builds.find((one) => one.clkHz === clk)) };
  let played;
  try {
    played = play(data, fs.readFileSync(path.join(folder, data.wasm)), text);
  } catch (error) {
    played = { error: error.message };
  }
  console.log(JSON.stringify(played));
}
