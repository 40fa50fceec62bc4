// node built.mjs HTML SHOTS PACKAGES [CHECK]: check the MkDocs site in a real Chromium.
// Output: a line of JSON for each check.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [, , html, shots, packages, only = ""] = process.argv;
const { launch } = await import(pathToFileURL(path.join(packages, "launch.mjs")));
const axe = fs.readFileSync(createRequire(path.resolve(packages, "package.json")).resolve("axe-core/axe.min.js"), "utf8");
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
let delays = {}; // end of a path -> delay of its response in ms
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
const MOST_FRAME = 33; // maximum CPU time of the page in ms; other processes do not count
const MOST_SHIFT = 0.05; // cumulative layout shift, a number without a unit; Lighthouse calls up to 0.1 good
const MOST_PAUSE = 200; // maximum CPU time of the page in ms
const MOST_WAITING = 2; // frames in transit to the page: the one that it draws, and that of Pause
const equal = (got, wanted, what) => {
  if (got !== wanted) throw new Error(`${what}: ${JSON.stringify(got)} instead of ${JSON.stringify(wanted)}`);
};
async function open(address, more = {}, prepare = () => {}) {
  const context = await view.newContext({ viewport: { width: 1400, height: 1000 }, ...more });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  page.wrong = [];
  page.on("pageerror", (error) => page.wrong.push(error.message));
  page.on("console", (message) => message.type() === "error" && page.wrong.push(message.text()));
  await page.addInitScript(prepare);
  await page.goto(address);
  return page;
}
const rest = (page) => page.waitForFunction(() => /at rest/.test(document.querySelector(".pg-clock")?.textContent));
const position = (page) => page.textContent(".pg-position").then(Number);
const part = (page) => page.inputValue(".pg-part");
const link = (page, words) => page.evaluate((hash) => (location.hash = hash), new URLSearchParams(words).toString());
const CONTRAST = ["index.html", "playground.html", "404.html", "docs/ppmc104/index.html", "docs/ppmc104/examples.html"];
CONTRAST.push("overview.html", "docs/host.html", "docs/benchmarks.html", "api/ppmc2104.html", "CHANGELOG.html");
const FIRST_MOVE = 2000; // maximum time from opening the landing page to its first move in ms
const LANDING_BUTTON = "#openppmc-landing button"; // Pause or Play
const LANDING_BOXES = [
  ".landing h1, .landing-hero > div:first-child > p, .landing .md-button, .pg-motor, .landing-bytes, .landing-plot span",
  ".landing-plot canvas, .landing-caption > *, .landing-doors > div, .landing > h2",
].join();
const PLAYGROUND_BOXES = [
  ".pg-bar > *, .pg-note, .pg-box, .pg-box h2, .pg-motor, .pg-rail, .pg-pins > *, .pg-more, .pg-editor, .pg-send > *",
  ".pg-stations > *, .pg-log, .pg-registers, .pg-bits, .pg-plot, .pg-waves, .pg-measured, .pg-caret",
].join();
/** Throw an error for two boxes that overlap although no one contains the other. */
const apart = (boxes, where) =>
  boxes.forEach(({ name, box: a, around }, n) =>
    boxes.forEach(({ name: other, box: b, around: more }, m) => {
      const over = Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1;
      const under = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
      if (over && under && !around.includes(m) && !more.includes(n))
        throw new Error(`${where}: ${name} overlaps ${other}`);
    }),
  );
const turned = (page) => page.getAttribute(".pg-shaft", "transform").then((text) => parseFloat(text.slice(7)));
const turns = (page, from) =>
  page
    .waitForFunction((old) => {
      const text = document.querySelector(".pg-shaft")?.getAttribute("transform");
      return text && parseFloat(text.slice(7)) !== old && performance.now();
    }, from)
    .then((found) => found.jsonValue());
const RUN = { v: "1", go: "1", speed: "0" };

const checks = {
  async "the landing page moves and leads to the playground"() {
    let page;
    const times = [];
    for (const from of [base, fromFile]) {
      page = await open(`${from}index.html`);
      times.push(await turns(page, 0));
      equal(await page.title(), "OpenPPMC", "title");
      await page.click("text=Run it");
      await rest(page);
      equal(await position(page), 1000, from);
      equal(page.wrong.join(), "", from);
    }
    // The better of two times, because other processes may delay one of them.
    if (Math.min(...times) > FIRST_MOVE) throw new Error(`the motor moves after ${times} ms`);
    return [page, `landing page: the motor moves after ${times.map(Math.round).join(" and ")} ms (http, file)`];
  },
  async "the picture of the landing page pauses"() {
    const page = await open(`${base}index.html`, { reducedMotion: "reduce", viewport: { width: 390, height: 844 } });
    const still = async (what) => {
      await page.waitForTimeout(300); // the last frames arrive
      const before = await turned(page);
      await page.waitForTimeout(700);
      equal(await turned(page), before, what);
      return before;
    };
    equal(await still("reduced motion"), 0, "reduced motion");
    await page.click(LANDING_BUTTON);
    await turns(page, 0);
    await page.click(LANDING_BUTTON);
    const paused = await still("after Pause");
    await page.click(LANDING_BUTTON);
    await turns(page, paused);
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    const away = await still("out of view");
    await page.evaluate(() => scrollTo(0, 0));
    await turns(page, away);
    return [page];
  },
  async "the doors and the layout of the landing page"() {
    let page;
    for (const [width, height] of [
      [1440, 900],
      [768, 1024],
      [390, 844],
    ]) {
      page = await open(`${base}index.html`, { viewport: { width, height } });
      await turns(page, 0);
      const [boxes, wide, small, links] = await page.evaluate((selector) => {
        const all = [...document.querySelectorAll(selector)];
        const texts = [...document.querySelectorAll(".landing :is(h1, h2, p, li, a, span, button, b, code)")];
        return [
          all.map((one) => ({
            name: one.getAttribute("class") ?? one.tagName,
            box: one.getBoundingClientRect().toJSON(),
            around: all.flatMap((other, n) => (one.contains(other) ? [n] : [])),
          })),
          document.documentElement.scrollWidth,
          texts.filter((one) => parseFloat(getComputedStyle(one).fontSize) < 16).map((one) => one.textContent),
          [...document.querySelectorAll(".landing-doors a")].map((one) => one.href),
        ];
      }, LANDING_BOXES);
      equal(wide, width, "width of the page");
      equal(small.join(), "", `texts below 16 pixels, ${width} pixels`);
      apart(boxes, `${width} pixels`);
      if (boxes.length < 18) throw new Error(`only ${boxes.length} boxes`);
      for (const end of ["docs/ppmc104/replace.html", "docs/integration.html", "docs/host.html"])
        equal(links.includes(base + end), true, end);
      for (const href of links) equal((await page.request.get(href)).status(), 200, href);
      if (!boxes.some(({ name, box }) => name === "pg-motor" && box.bottom <= height))
        throw new Error(`${width} pixels: the motor is below the window`);
      await page.screenshot({ path: path.join(shots, `landing-${width}.png`) });
    }
    return [page];
  },
  async "the playground runs over http and from a file"() {
    let page;
    for (const from of [base, fromFile]) {
      page = await open(`${from}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}`);
      await rest(page);
      equal(await position(page), 1000, from);
    }
    return [page];
  },
  async "nothing moves while the playground loads"() {
    delays = { "playground.css": 500 };
    const page = await open(`${base}playground.html`);
    delays = {};
    await page.waitForFunction(() => Number(document.querySelector(".pg-position")?.textContent) > 0);
    const shift = await page.evaluate(
      () =>
        new Promise((done) => {
          const sum = (list) => list.getEntries().reduce((all, { value }) => all + value, 0);
          new PerformanceObserver((list) => done(sum(list))).observe({ type: "layout-shift", buffered: true });
          setTimeout(() => done(0), 1000); // there was no shift
        }),
    );
    if (shift > MOST_SHIFT) throw new Error(`cumulative layout shift: ${shift}`);
    return [page, `cumulative layout shift of the playground while it loads: ${shift.toFixed(3)}`];
  },
  async "a browser without a valid language"() {
    const page = await open(`${base}playground.html`, {}, () =>
      Object.defineProperty(navigator, "language", { value: "en-US@posix", configurable: true }),
    );
    await page.waitForFunction(() => Number(document.querySelector(".pg-position")?.textContent) > 0);
    return [page];
  },
  async "the layout of the playground at three sizes"() {
    let page;
    let count = 0;
    for (const [width, height, words] of [
      [1440, 900, { ...RUN, part: "ppmc104", run: "2" }],
      [1440, 900, { ...RUN, part: "ppmc2104", run: "2" }],
      [1440, 900, { ...RUN, part: "bank", run: "2" }],
      [1440, 900, { ...RUN, part: "ppmc312-serial", run: "2" }],
      [1440, 900, {}],
      [768, 1024, { ...RUN, part: "ppmc104", run: "2" }],
      [390, 844, { ...RUN, part: "ppmc104", run: "2" }],
      [390, 844, { ...RUN, part: "bank", run: "2" }],
      [390, 844, { ...RUN, part: "ppmc312-serial", run: "2" }],
    ]) {
      const size = `${words.part ?? "first visit"}, ${width} × ${height}`;
      page = await open(`${base}playground.html#${new URLSearchParams(words)}`, { viewport: { width, height } });
      if (words.part) await rest(page);
      else await page.waitForSelector(".pg-note");
      await page.waitForSelector(".pg-registers p");
      const [boxes, wide, tall] = await page.evaluate((selector) => {
        const all = [...document.querySelectorAll(selector)].filter((one) => one.getBoundingClientRect().width > 1);
        return [
          all.map((one) => ({
            name: one.getAttribute("class") ?? one.id ?? one.tagName,
            box: one.getBoundingClientRect().toJSON(),
            around: all.flatMap((other, n) => (one.contains(other) ? [n] : [])),
          })),
          document.documentElement.scrollWidth,
          document.documentElement.scrollHeight,
        ];
      }, PLAYGROUND_BOXES);
      equal(wide, width, `${size}: width of the page`);
      apart(boxes, size);
      count += boxes.length;
      const top = (name) => boxes.find((one) => one.name.split(" ").includes(name)).box.top;
      if (width > 500) equal(top("pg-rate"), top("pg-machine"), `${size}: speed next to the motor`);
      if (width === 1440) equal(tall, height, `${size}: height of the page`);
      if (width < 500) {
        const [tops, small, gone] = await page.evaluate(() => {
          const [run, motor, text, log] = [".pg-run", ".pg-motor", ".pg-host", ".pg-log"].map((one) =>
            document.querySelector(one).getBoundingClientRect(),
          );
          const own = (one) => [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
          const size = (one) => parseFloat(getComputedStyle(one).fontSize) * (one.getScreenCTM?.().a ?? 1);
          const texts = [...document.querySelectorAll(".pg *")].filter(
            (one) => (own(one) || /^(INPUT|SELECT|TEXTAREA|CANVAS)$/.test(one.tagName)) && one.checkVisibility(),
          );
          scrollTo(0, document.body.scrollHeight);
          const bar = [...document.querySelectorAll(".pg-bar > *, .pg-bar select")];
          return [
            [run.bottom <= motor.top, motor.bottom <= text.top, text.bottom <= log.top].join(),
            texts.filter((one) => size(one) < 15.99).map((one) => `${one.tagName} ${one.textContent} ${size(one)}`),
            bar.filter((one) => {
              const box = one.getBoundingClientRect();
              return box.top < 0 || box.bottom > innerHeight || box.left < 0 || box.right > innerWidth;
            }).length,
          ];
        });
        equal(tops, "true,true,true", `${size}: order of Run, motor, text, log`);
        equal(small.slice(0, 4).join(), "", `${size}: texts below 16 pixels`);
        equal(gone, 0, `${size}: controls out of sight after scrolling`);
      }
      await page.screenshot({ path: path.join(shots, `playground-${words.part ?? "first"}-${width}.png`) });
    }
    if (count < 150) throw new Error(`only ${count} boxes`);
    return [page, `${count} boxes of the playground at three sizes do not overlap`];
  },
  async "log, text, waves and rules select each other"() {
    const page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}`);
    await rest(page);
    const row = (code) => page.locator(`.pg-log tr:has(td:nth-child(2):text-is("command")):has(code:text-is("${code}"))`);
    const current = () => page.textContent(".pg-log [aria-current] code", { timeout: 2000 });
    const line = () => page.evaluate(() => document.querySelector(".pg-marked").style.top);
    const touched = () => page.$$eval(".pg-touched", (names) => names.map((one) => one.textContent).join());
    await row("43").click();
    equal(await line(), "calc(13 * var(--pg-row))", "line of the command 43");
    equal((await touched()).includes("wr_n,d_i"), true, "pins with edges of the access");
    equal(await page.textContent(".pg-rule a"), "P104-OPR-07", "rule");
    const rule = await open(new URL(await page.getAttribute(".pg-rule a", "href"), page.url()).href);
    equal(await rule.textContent("td:target"), "P104-OPR-07", "row of the manual");
    // A click on an edge selects its row; the waves still show the access.
    await page.press(".pg-log", "Escape");
    equal(await page.$(".pg-log [aria-current]"), null, "row after Escape");
    const at = await page.evaluate(() => {
      const names = [...document.querySelectorAll(".pg-names li")];
      const { top } = names.find((one) => one.textContent === "wr_n").getBoundingClientRect();
      const canvas = document.querySelector(".pg-waves canvas").getBoundingClientRect();
      const scrolled = document.querySelector(".pg-waves");
      scrolled.scrollTop += top - canvas.top - 60;
      const moved = names.find((one) => one.textContent === "wr_n").getBoundingClientRect();
      return { x: canvas.width / 3 + 2, y: moved.top + 10 - canvas.top };
    });
    await page.click(".pg-waves canvas", { position: at });
    equal(await current(), "43", "row of an edge");
    // A click on a line selects its row.
    await page.evaluate(() => (document.querySelector(".pg-editor").scrollTop = 0));
    const height = await page.evaluate(() => document.querySelector(".pg-decoded li").getBoundingClientRect().height);
    await page.click("#pg-text", { position: { x: 20, y: 7.5 * height } });
    equal(await current(), "20", "row of line 8");
    equal(await page.textContent(".pg-bits .pg-on"), "N1 1", "bit of the status 20");
    page.wrong.push(...rule.wrong);
    return [page];
  },
  async "blocks of the PPMC-312 by fields"() {
    const text = "> 03 09 00 01 03E8 00C8 0007D0\n< 03 01 00\n> 03 08 82 40 0000 0000012C\n< 03 02 82 10";
    const page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc312", text })}`);
    await rest(page);
    const fields = async (n) => {
      await page.locator(".pg-log tr:has(td:nth-child(2):text-matches('^(block|answer)$'))").nth(n).click();
      return page.$$eval(".pg-fields tr", (rows) => rows.map((one) => [...one.cells].map((cell) => cell.textContent).join(" ")).join("; "));
    };
    equal(
      await fields(2),
      "header 03 instruction; length 08 8 bytes follow; code 82 move with ramps; move flags 40 CCW; rate 00 00 0; pulses 00 00 01 2C 300",
      "block",
    );
    equal(await fields(3), "header 03 answer; length 02 2 bytes follow; code 82 move with ramps; profile 10 triangle", "answer");
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
    await page.waitForFunction(() => /paused/.test(document.querySelector(".pg-clock")?.textContent));
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
    const page = await open(
      `${base}playground.html#${new URLSearchParams({ ...RUN, part: "bank", text: axes })}`,
      {},
      () => {
        // Count the frames that the worker has sent but the page has not drawn yet.
        globalThis.waiting = globalThis.mostWaiting = 0;
        globalThis.Worker = class extends Worker {
          constructor(...words) {
            super(...words);
            this.addEventListener("message", ({ data }) => {
              if (data.kind === "frame") globalThis.mostWaiting = Math.max(globalThis.mostWaiting, ++globalThis.waiting);
            });
          }
          postMessage(data, ...more) {
            if (data.kind === "shown") globalThis.waiting = 0;
            super.postMessage(data, ...more);
          }
        };
      },
    );
    await page.waitForFunction(() => /million/.test(document.querySelector(".pg-clock")?.textContent));
    await page.waitForTimeout(4000);
    const browser = await view.newBrowserCDPSession();
    const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
    // Linux counts the ns of each thread. The first thread of a renderer is that of the page, not the worker.
    const spent = () =>
      processInfo
        .filter(({ type, id }) => type === "renderer" && fs.existsSync(`/proc/${id}/task/${id}/schedstat`))
        .reduce((sum, { id }) => sum + Number(fs.readFileSync(`/proc/${id}/task/${id}/schedstat`, "utf8").split(" ")[0]) / 1e6, 0);
    const clock = () => page.textContent(".pg-clock").then(parseFloat);
    const [clk, before] = [await clock(), spent()];
    await page.evaluate(
      (frames) =>
        new Promise((resolve) => {
          const tick = () => (frames-- ? requestAnimationFrame(tick) : resolve());
          tick();
        }),
      60,
    );
    const frame = (spent() - before) / 60;
    equal((await clock()) === clk, false, "the time stands still");
    const pressed = spent();
    await page.evaluate(
      () =>
        new Promise((resolve) => {
          [...document.querySelectorAll(".pg-bar button")].find((one) => /Pause/.test(one.textContent)).click();
          const look = () =>
            /paused/.test(document.querySelector(".pg-clock")?.textContent) ? resolve() : setTimeout(look, 1);
          look();
        }),
    );
    const pause = spent() - pressed;
    const waiting = await page.evaluate(() => globalThis.mostWaiting);
    if (!waiting || waiting > MOST_WAITING) throw new Error(`${waiting} frames wait for the page`);
    if (!(before > 0) || frame > MOST_FRAME || pause > MOST_PAUSE)
      throw new Error(`processor time of the page: ${frame} ms a frame, Pause ${pause} ms`);
    await page.screenshot({ path: path.join(shots, "bank.png") });
    return [
      page,
      `bank at full speed: ${frame.toFixed(1)} ms of the page's processor a frame (60 frames), Pause after ${pause.toFixed(0)} ms`,
    ];
  },
  async "search over http and from a file"() {
    let page;
    for (const from of [base, fromFile])
      for (const name of ["index.html", "docs/ppmc104/index.html", "playground.html", "404.html"]) {
        page = await open(from + name);
        await page.fill(".md-search__input", "excitation");
        await page.waitForSelector(".md-search-result__item a");
        const found = await page.$$eval(".md-search-result__item > a", (links) => links.map((one) => one.href));
        if (!found.every((href) => href.startsWith(from))) throw new Error(`${from}${name}: ${found}`);
        if (name !== "404.html" || from === fromFile) equal(page.wrong.join(), "", name);
        await page.click(".md-search-result__item > a");
        await page.waitForFunction(() => /excitation/i.test(document.querySelector("article")?.textContent));
      }
    page.wrong = [];
    return [page];
  },
  async "no page loads anything from another host"() {
    const page = await open(`${base}index.html`);
    const others = [];
    page.on("request", (request) => {
      if (![base, fromFile, "data:", "blob:"].some((own) => request.url().startsWith(own))) others.push(request.url());
    });
    const pages = fs.readdirSync(html, { recursive: true }).filter((name) => name.endsWith(".html"));
    for (const [from, names] of [
      [base, pages],
      [fromFile, ["index.html", "404.html", "playground.html", path.join("docs", "host.html")]],
    ])
      for (const name of names) await page.goto(from + name.split(path.sep).map(encodeURIComponent).join("/"));
    equal([...new Set(others)].join(), "", "addresses of other hosts");
    if (pages.length < 50) throw new Error(`only ${pages.length} pages`);
    return [page, `${pages.length} pages load nothing from another host, over http and from a file`];
  },
  async "the speed plot leaves zero by a vertical line"() {
    let page;
    for (const [width, part] of [1400, 390].flatMap((width) => ["ppmc2104", "bank", "stmc"].map((one) => [width, one]))) {
      page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part, run: "2" })}`, {
        viewport: { width, height: 1000 },
      });
      await rest(page);
      await page.waitForTimeout(500);
      const [jump, lifted] = await page.evaluate(() => {
        const canvas = document.querySelector(".pg-plot canvas");
        const { width, height } = canvas;
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        // Lines of motors have a colour; all other lines are grey.
        const coloured = (x, y) => {
          const rgb = data.slice(4 * (x + width * y), 4 * (x + width * y) + 4);
          return rgb[3] > 100 && Math.max(rgb[0], rgb[1], rgb[2]) - Math.min(rgb[0], rgb[1], rgb[2]) > 60;
        };
        let zero = 0;
        for (let x = 0; x < width; x++) {
          const inked = Array.from({ length: height }, (_, y) => y).filter((y) => coloured(x, y));
          if (!inked.length) continue;
          zero ||= inked.at(-1);
          if (inked.at(-1) - inked[0] > height / 10) return [x, false];
          if (inked[0] < zero - 4) return [x, true];
        }
        return [0, false];
      });
      if (lifted || !jump) throw new Error(`${part}, ${width} pixels: a slope at x = ${jump}`);
      const plot = await page.$("section[aria-labelledby=pg-speed]");
      await plot.screenshot({ path: path.join(shots, `speed-${part}-${width}.png`) });
    }
    return [page];
  },
  async "contrast of text in both schemes"() {
    let page;
    let count = 0;
    for (const colorScheme of ["light", "dark"])
      for (const [name, width] of [...CONTRAST.map((name) => [name, 1400]), ["index.html", 390], ["playground.html", 390]]) {
        const run = name === "playground.html" ? `#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}` : "";
        page = await open(`${base}${name}${run}`, { colorScheme, viewport: { width, height: 1000 } });
        if (run) await rest(page);
        await page.evaluate(axe);
        const { violations, passes } = await page.evaluate(() => axe.run({ runOnly: ["color-contrast"] }));
        const low = violations.flatMap(({ nodes }) =>
          nodes.map(({ target, any }) => `${target.join(" ")} ${any[0].data.contrastRatio}`),
        );
        count += passes.reduce((sum, { nodes }) => sum + nodes.length, 0);
        equal([...new Set(low)].slice(0, 8).join(", "), "", `contrast, ${colorScheme}, ${name}, ${width} pixels`);
      }
    if (count < 1000) throw new Error(`only ${count} texts`);
    return [page, `contrast of ${count} texts is at least 4.5 : 1`];
  },
  async "the header of the log stays"() {
    let page;
    for (const width of [1400, 390]) {
      page = await open(`${base}playground.html#${new URLSearchParams({ ...RUN, part: "ppmc104", run: "2" })}`, {
        viewport: { width, height: 1000 },
      });
      await rest(page);
      const [scrolled, gap, over] = await page.evaluate(() => {
        const box = document.querySelector(".pg-log");
        box.scrollTop = box.scrollHeight;
        box.scrollIntoView({ block: "center" });
        const head = box.querySelector("th").getBoundingClientRect();
        const seen = document.elementFromPoint(head.left + 4, head.top + head.height / 2);
        return [box.scrollTop, head.top - box.getBoundingClientRect().top, seen?.closest("th") ? "" : seen?.outerHTML];
      });
      if (!scrolled) throw new Error("the log does not scroll");
      if (Math.abs(gap) > 2 || over) throw new Error(`the header of the log is at ${gap}, under ${over}`);
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
