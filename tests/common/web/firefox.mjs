// node firefox.mjs HTML SHOTS PACKAGES: open the playground in the Firefox on PATH, from a file.
// Output: a line with the version of Firefox. Without Firefox, the program prints one line, and its exit code is 3.
import { execFileSync } from "node:child_process";
import path from "node:path";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [, , html, shots, packages] = process.argv;
const puppeteer = createRequire(path.resolve(packages, "package.json"))("puppeteer-core");
const PATIENCE = 120_000;

function found() {
  for (const name of ["firefox-esr", "firefox"])
    try {
      return execFileSync("which", [name], { encoding: "utf8" }).trim();
    } catch {
      // This name is not a program on PATH.
    }
  console.error("no Firefox is installed");
  process.exit(3);
}

const view = await puppeteer.launch({
  browser: "firefox",
  executablePath: found(),
  timeout: PATIENCE,
  protocolTimeout: PATIENCE,
});
const page = await view.newPage();
const wrong = [];
page.on("pageerror", (error) => wrong.push(error.message));
page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
page.setDefaultTimeout(PATIENCE);
await page.setViewport({ width: 1440, height: 900 });
const address = pathToFileURL(path.join(html, "playground.html")).href;
await page.goto(address);
// The first visit starts a session.
await page.waitForFunction(() => Number(document.querySelector(".pg-position")?.textContent) > 0);
const size = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
if (size.join() !== "1440,900") throw new Error(`the page has ${size.join(" × ")} pixels`);
await page.goto(`${address}#v=1&part=ppmc104&run=2&go=1&speed=0`);
await page.waitForFunction(() => /at rest/.test(document.querySelector(".pg-clock")?.textContent));
const position = await page.$eval(".pg-position", (one) => one.textContent);
if (position !== "1000") throw new Error(`position ${position}`);
await page.evaluate(() => document.querySelector(".pg-log tbody tr:last-child").click());
await page.waitForSelector(".pg-registers .pg-rule a");
if (!(await page.$$(".pg-touched")).length) throw new Error("the waves mark no edge");
await page.screenshot({ path: path.join(shots, "firefox.png") });
if (wrong.length) throw new Error(`console: ${wrong.join("; ")}`);
console.log(await view.version());
await view.close();
