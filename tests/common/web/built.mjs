// node built.mjs HTML SHOTS PACKAGES [CHECK]: the MkDocs site in a real Chromium. A line of JSON for each check.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [, , html, shots, packages, only = ""] = process.argv;
const { launch } = await import(pathToFileURL(path.join(packages, "launch.mjs")));
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
let delays = {}; // ms by the end of an address
const server = http
  .createServer(async (request, answer) => {
    const { pathname } = new URL(request.url, "http://here");
    const file = path.join(html, decodeURIComponent(pathname));
    const late = Object.entries(delays).find(([end]) => pathname.endsWith(end));
    if (late) await new Promise((resolve) => setTimeout(resolve, late[1]));
    const found = fs.existsSync(file) && fs.statSync(file).isFile();
    const whole = found ? file : path.join(html, "404.html");
    answer.writeHead(found ? 200 : 404, { "content-type": types[path.extname(whole)] ?? "application/octet-stream" });
    answer.end(fs.readFileSync(whole));
  })
  .listen(0);
const view = await launch();
const base = `http://127.0.0.1:${server.address().port}/`;
const fromFile = pathToFileURL(`${html}/`).href;
fs.mkdirSync(shots, { recursive: true });
const PATIENCE = 30_000;
const MOST_FRAME = 120; // ms, middle one; 33 are required of a machine that does nothing else
const MOST_PAUSE = 600; // ms; 200 are required there
const equal = (got, wanted, what) => {
  if (got !== wanted) throw new Error(`${what}: ${JSON.stringify(got)} instead of ${JSON.stringify(wanted)}`);
};
async function open(address, more = {}) {
  const context = await view.newContext({ viewport: { width: 1400, height: 1000 }, ...more });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  page.wrong = [];
  page.on("pageerror", (error) => page.wrong.push(error.message));
  page.on("console", (message) => message.type() === "error" && page.wrong.push(message.text()));
  await page.goto(address);
  return page;
}
const rest = (page) => page.waitForFunction(() => /at rest/.test(document.querySelector(".pg-clock")?.textContent));
const position = (page) => page.textContent(".pg-position").then(Number);
const part = (page) => page.inputValue(".pg-part");
const link = (page, words) => page.evaluate((hash) => (location.hash = hash), new URLSearchParams(words).toString());
const RUN = { v: "1", go: "1", speed: "0" };

const checks = {
  async "the playground runs over http and from a file"() {
    let page;
    for (const from of [base, fromFile]) {
      page = await open(`${from}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}`);
      await rest(page);
      equal(await position(page), 1000, from);
    }
    return [page];
  },
  async "the page for lost addresses from a file"() {
    const page = await open(`${fromFile}404.html`);
    const [wide, href] = await page.evaluate(() => [document.styleSheets.length, document.links[0].href]);
    if (!wide || !href.startsWith("file:")) throw new Error(`404.html: ${wide} style sheets, first link ${href}`);
    return [page];
  },
  async "a part chosen last wins"() {
    delays = { "parts/ppmc104.js": 1500, "parts/stmc.js": 300, "stmc.wasm": 800 };
    const page = await open(`${base}playground.html`);
    await link(page, { ...RUN, part: "ppmc104", run: "2" });
    await link(page, { ...RUN, part: "stmc", run: "2" });
    await rest(page);
    equal(await part(page), "stmc", "part");
    equal(await position(page), 800, "position");
    await page.waitForTimeout(1500);
    equal(await part(page), "stmc", "part after the older one has come");
    await page.goBack();
    await page.waitForFunction(() => document.querySelector(".pg-part").value === "ppmc104");
    await rest(page);
    equal(await position(page), 1000, "position after back");
    delays = {};
    return [page];
  },
  async "Run, then Pause while the part is loading"() {
    delays = { ".wasm": 1500 };
    const page = await open(`${base}playground.html`);
    await page.waitForSelector(".pg-names li");
    equal(await position(page), 0, "position before the first Run");
    await page.click(".pg-run");
    await page.click("text=Pause");
    await page.waitForFunction(() => /paused/.test(document.querySelector(".pg-clock").textContent));
    equal(await position(page), 0, "position");
    delays = {};
    return [page];
  },
  async "what is wrong with a link stays while it runs"() {
    let page;
    for (const [words, wrong] of [
      [{ part: "z80" }, /no part z80/],
      [{ part: "ppmc104", run: "99" }, /no session 99/],
      [{ part: "ppmc104", speed: "7" }, /speed=7/],
      [{ run: "2" }, /names no part/],
    ]) {
      page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, ...words })}`);
      await page.selectOption(".pg-pace", "0");
      await rest(page);
      const got = await page.textContent(".pg-trouble span", { timeout: 2000 });
      if (!wrong.test(got)) throw new Error(`${JSON.stringify(words)}: ${got}`);
    }
    return [page];
  },
  async "typed text is there after a reload"() {
    const page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "stmc", run: "2" })}`);
    await rest(page);
    await page.fill("#pg-text", "wait 123 # mine");
    await page.fill("#pg-now", "st");
    await page.reload();
    await page.waitForSelector(".pg-names li");
    equal(await page.inputValue("#pg-text"), "wait 123 # mine", "text");
    equal(await page.inputValue("#pg-now"), "st", "line");
    equal(await part(page), "stmc", "part");
    return [page];
  },
  async "the bank at full speed"() {
    const axes = Array.from({ length: 8 }, (_, n) => `axis ${n} c 0A d 01 d 01 d 04 d 00 c 45 d 00`).join("\n");
    const page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "bank", text: axes })}`);
    await page.waitForFunction(() => /million/.test(document.querySelector(".pg-clock")?.textContent));
    await page.waitForTimeout(4000);
    const gaps = await page.evaluate(
      () =>
        new Promise((resolve) => {
          const times = [];
          const tick = (t) =>
            times.push(t) > 60 ? resolve(times.slice(1).map((one, n) => one - times[n])) : requestAnimationFrame(tick);
          requestAnimationFrame(tick);
        }),
    );
    const pause = await page.evaluate(
      () =>
        new Promise((resolve) => {
          const begin = performance.now();
          [...document.querySelectorAll(".pg-bar button")].find((one) => /Pause/.test(one.textContent)).click();
          const look = () =>
            /paused/.test(document.querySelector(".pg-clock").textContent)
              ? resolve(performance.now() - begin)
              : setTimeout(look, 1);
          look();
        }),
    );
    const middle = gaps.sort((a, b) => a - b)[gaps.length >> 1];
    if (middle > MOST_FRAME || pause > MOST_PAUSE) throw new Error(`frame ${middle} ms, Pause ${pause} ms`);
    await page.screenshot({ path: path.join(shots, "bank.png") });
    return [page, `bank at full speed: ${middle.toFixed(0)} ms a frame (middle of 60), Pause after ${pause.toFixed(0)} ms`];
  },
  async "contrast in both schemes, and a header that stays"() {
    let page;
    for (const colorScheme of ["light", "dark"]) {
      page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}`, {
        colorScheme,
      });
      await rest(page);
      const low = await page.evaluate(() => {
        const parse = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
        const light = (rgb) =>
          [0.2126, 0.7152, 0.0722].reduce((sum, share, n) => {
            const c = rgb[n] / 255;
            return sum + share * (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
          }, 0);
        const behind = (one) => {
          for (; one; one = one.parentElement) {
            const rgb = parse(getComputedStyle(one).backgroundColor);
            if (rgb.length === 3 || rgb[3] > 0.99) return rgb;
          }
          return [255, 255, 255];
        };
        const found = [];
        for (const one of document.querySelectorAll(".pg *")) {
          const words = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim()) || one.value;
          if (!words || one.closest("svg") || !one.getClientRects().length) continue;
          const [a, b] = [light(parse(getComputedStyle(one).color)), light(behind(one))];
          const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
          if (ratio < 4.5) found.push(`${one.className || one.tagName} ${ratio.toFixed(2)}`);
        }
        return [...new Set(found)].join();
      });
      equal(low, "", `contrast, ${colorScheme}`);
      const gap = await page.evaluate(() => {
        const box = document.querySelector(".pg-log");
        box.scrollTop = box.scrollHeight;
        return box.querySelector("th").getBoundingClientRect().top - box.getBoundingClientRect().top;
      });
      if (Math.abs(gap) > 2) throw new Error(`the header of the log is at ${gap}`);
      await page.screenshot({ path: path.join(shots, `built-${colorScheme}.png`) });
    }
    return [page];
  },
};

for (const [name, check] of Object.entries(checks).filter(([name]) => name.includes(only))) {
  const line = { name };
  try {
    const [page, told] = await check();
    if (page.wrong.length) throw new Error(`console: ${page.wrong.join("; ")}`);
    line.told = told;
  } catch (error) {
    line.error = String(error.message).split("\n").slice(0, 4).join(" ");
  }
  for (const context of view.contexts()) await context.close();
  console.log(JSON.stringify(line));
}
await view.close();
server.close();
