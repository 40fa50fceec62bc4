// node browser.mjs SITE SHOTS PACKAGES TRIPPED [CHECK]: check the playground in a real Chromium.
// TRIPPED: module of a PPMC-104 (trip.sv) whose simulation stops with an error when l1_n is low.
// Output: a line of JSON for each check, {name, error?, told?}.
// If no browser is available, the program prints one line and ends with exit code 3.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [, , site, shots, packages, tripped, only = ""] = process.argv;
const { launch } = await import(pathToFileURL(path.join(packages, "launch.mjs")));

const types = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
};
const server = http
  .createServer((request, answer) => {
    const file = path.join(site, decodeURIComponent(new URL(request.url, "http://here").pathname));
    try {
      const whole = fs.statSync(file).isDirectory() ? path.join(file, "index.html") : file;
      answer.writeHead(200, { "content-type": types[path.extname(whole)] ?? "application/octet-stream" });
      answer.end(fs.readFileSync(whole));
    } catch {
      answer.writeHead(404).end();
    }
  })
  .listen(0);

const view = await launch();
const base = `http://127.0.0.1:${server.address().port}/`;
fs.mkdirSync(shots, { recursive: true });
const RUN = ".pg-run";
const FIRST_PAINT = 1000; // ms
const FIRST_MOVE = 2000; // ms
const PATIENCE = 120_000; // in ms; long, because the computer may be busy
const MOST = 3; // number of short sessions of each device except the first one; test_engine.py plays more
const equal = (got, wanted, what) => {
  if (got !== wanted) throw new Error(`${what}: ${JSON.stringify(got)} instead of ${JSON.stringify(wanted)}`);
};
const truth = (got, what) => {
  if (!got) throw new Error(what);
};

/** A page; errors on its console make the check fail at its end. */
async function open(address = base, more = {}, prepare) {
  const context = await view.newContext({
    viewport: { width: 1400, height: 1000 },
    locale: "en-US",
    acceptDownloads: true,
    ...more,
  });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  page.wrong = [];
  page.on("pageerror", (error) => page.wrong.push(error.message));
  page.on("console", (message) => message.type() === "error" && page.wrong.push(message.text()));
  if (prepare) await prepare(page);
  await page.goto(address);
  return page;
}
const rest = (page) =>
  page.waitForFunction(() => /at rest/.test(document.querySelector(".pg-clock")?.textContent), null, {
    timeout: PATIENCE,
  });
const position = (page) => page.textContent(".pg-position").then(Number);
const message = (page) => page.textContent(".pg-trouble span", { timeout: PATIENCE });
const fast = (page) => page.selectOption(".pg-pace", "0");
async function type(page, text) {
  await page.fill("#pg-text", text);
  await fast(page);
  await page.click(RUN);
}
async function saved(page, file) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=VCD")]);
  await download.saveAs(path.join(shots, file));
  return fs.readFileSync(path.join(shots, file), "utf8");
}

const checks = {
  async "the first visit moves without a click"() {
    const still = await open(base, { reducedMotion: "reduce" });
    await still.waitForFunction(() => document.querySelector(".pg-names li"));
    truth(/press/.test(await still.textContent(".pg-note")), "no invitation");
    // The best of up to three visits, because other processes may delay one of them.
    let page;
    let [painted, moved] = [Infinity, Infinity];
    for (let visit = 0; visit < 3 && (painted > FIRST_PAINT || moved > FIRST_MOVE); visit++) {
      page = await open();
      const [first, step] = await page
        .waitForFunction(
          () =>
            Number(document.querySelector(".pg-position")?.textContent) > 0 && [
              performance.getEntriesByName("first-contentful-paint")[0].startTime,
              performance.now(),
            ],
        )
        .then((found) => found.jsonValue());
      painted = Math.min(painted, first);
      moved = Math.min(moved, step);
    }
    truth(/press/.test(await page.textContent(".pg-note")), "no invitation");
    await page.screenshot({ path: path.join(shots, "running.png") });
    equal(await position(still), 0, "position with reduced motion");
    truth((await still.textContent(".pg-clock")).startsWith("0.0"), "the part runs with reduced motion");
    await fast(page);
    await page.click(RUN);
    await rest(page);
    equal(await page.$(".pg-note"), null, "invitation after Run");
    equal(await position(page), 1000, "position");
    await page.screenshot({ path: path.join(shots, "desktop.png"), fullPage: true });
    await saved(page, "ppmc104-2.vcd");
    truth(painted <= FIRST_PAINT, `first paint after ${painted} ms`);
    truth(moved <= FIRST_MOVE, `the motor moves after ${moved} ms`);
    return [
      page,
      `first paint after ${Math.round(painted)} ms, the motor moves after ${Math.round(moved)} ms`,
    ];
  },
  async "phone and dark"() {
    const phone = await open(base, { viewport: { width: 390, height: 844 }, hasTouch: true });
    await fast(phone);
    await phone.click(RUN);
    await rest(phone);
    const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
    truth(wide <= 390, `${wide} pixels wide on a phone`);
    await phone.screenshot({ path: path.join(shots, "phone.png"), fullPage: true });
    const dark = await open(base, { colorScheme: "dark" });
    await fast(dark);
    await dark.click(RUN);
    await rest(dark);
    await dark.screenshot({ path: path.join(shots, "dark.png"), fullPage: true });
    return [dark];
  },
  async "sessions of every part run"() {
    const page = await open();
    await page.waitForSelector(RUN);
    await fast(page);
    const parts = await page.$$eval(".pg-part option", (found) => found.map((one) => one.value));
    let count = 0;
    for (const part of parts) {
      await page.selectOption(".pg-part", part);
      await page.waitForFunction((name) => globalThis.openppmc.data?.[name], part);
      const sessions = await page.evaluate(
        (name) => globalThis.openppmc.data[name].sessions.map((one) => one.name),
        part,
      );
      for (const session of sessions.slice(part === "ppmc104" ? 0 : -MOST)) {
        await page.selectOption(".pg-session", session);
        await page.waitForFunction(
          (name) => document.querySelector(".pg-log").dataset.run === name,
          `${part} ${session}`,
        );
        await page.waitForFunction(
          () =>
            document.querySelector(".pg-trouble") ||
            /over|at rest/.test(document.querySelector(".pg-clock").dataset.state),
          null,
          { timeout: PATIENCE },
        );
        const trouble = await page.$(".pg-trouble span");
        truth(!trouble, `${part} ${session}: ${trouble && (await trouble.textContent())}`);
        equal(
          await page.$$eval(".pg-log tr.pg-bad", (rows) => rows.length),
          0,
          `${part} ${session}: wrong bytes`,
        );
        count++;
      }
    }
    return [page, `${count} sessions of ${parts.length} parts run in the page`];
  },
  async "a switch stops the motor"() {
    const page = await open();
    await page.waitForSelector(RUN);
    await type(page, "c 0A d C7 d 31 d 64 d 00\nc 45 d 63");
    await page.waitForFunction(() => Number(document.querySelector(".pg-position")?.textContent) > 100);
    await page.click(".pg-pins >> text=l1_n");
    await rest(page);
    const stopped = await position(page);
    await page.fill("#pg-now", "c 80 r");
    await page.press("#pg-now", "Enter");
    await page.waitForFunction(() =>
      /ended by the limit/.test(document.querySelector(".pg-registers")?.textContent),
    );
    equal(await position(page), stopped, "position");
    // A link contains the whole session: the page that it opens shows the same waves.
    const first = await saved(page, "pressed.vcd");
    await page.click("text=Link");
    await page.waitForFunction(() => location.hash.includes("text="));
    const again = await open(page.url());
    await rest(again);
    equal(await position(again), stopped, "position from the link");
    const second = await saved(again, "linked.vcd");
    const pulses = (text) => {
      const id = / (\S+) pout_n \$end/.exec(text)[1];
      return text
        .split("#")
        .filter((one) => one.split("\n").includes(`0${id}`))
        .map((one) => one.split("\n")[0])
        .join();
    };
    truth(pulses(first).length > 500, "too few pulses");
    equal(pulses(second), pulses(first), "pulses from the link");
    page.wrong.push(...again.wrong);
    return [page];
  },
  async "the stations of a line"() {
    const page = await open(`${base}#v=1&part=ppmc312-serial&run=2&speed=0&go=1`);
    await rest(page);
    const places = () => page.$$eval(".pg-stations small", (all) => all.map((one) => one.textContent).join());
    const moved = await places();
    equal(moved, "0,0,0,1500,0,-1000,0,0,0,0,0,0,0,0,0,0", "positions");
    const names = () => page.$$eval(".pg-names li", (all) => all.map((one) => one.textContent));
    for (const [station, place] of [["3", 1500], ["5", -1000]]) {
      await page.click(`.pg-stations button:has(b:text-is("${station}"))`);
      await page.waitForFunction((end) => document.querySelector(".pg-names li")?.textContent.endsWith(end), `[${station}]`);
      truth((await names()).every((one) => one.endsWith(`[${station}]`)), `pins of another station: ${await names()}`);
      equal(await position(page), place, `position of station ${station}`);
      truth((await page.textContent(".pg-rate h2")).includes(`station ${station}`), "speed of another station");
    }
    // A frame and an answer are explained field by field.
    const fields = async (bytes) => {
      await page.click(`.pg-log tr:has(code:text-is("${bytes}"))`);
      await page.waitForFunction(() => /Selected/.test(document.querySelector(".pg-registers")?.textContent));
      return page.$$eval(".pg-fields tr", (rows) => rows.map((row) => row.textContent).join("; "));
    };
    equal(
      await fields("95 A3 00 00 00 00 03 E8"),
      "control code95instruction; address5station 5; codeA3move with ramps, CCW; rate00 000; " +
        "pulses00 00 03 E81000; checksum5Cright; characters95 61 33 30 30 30 30 30 30 30 30 30 33 65 38 5C",
      "frame",
    );
    truth(/P312-CMD-82/.test(await page.textContent(".pg-rule a")), "rule of the frame");
    equal(
      await fields("A0 FF FF FC 18"),
      "control codeA5data; address5station 5; positionFF FF FC 18-1000; checksum48right; characters" +
        "A5 66 66 66 66 66 63 31 38 48",
      "answer",
    );
    // An answer that the reader selects shows its station.
    await fields("A0 00 00 05 DC");
    equal(await position(page), 1500, "position of the station of the answer");
    // A link contains what was sent after the session.
    await page.fill("#pg-now", "axis 3; > A4 0140 00000064; < 90");
    await page.press("#pg-now", "Enter");
    await page.waitForFunction(() => document.querySelector(".pg-stations button:nth-child(4) small").textContent === "1400");
    await rest(page);
    await page.click("text=Link");
    await page.waitForFunction(() => location.hash.includes("text="));
    const again = await open(page.url());
    await again.waitForFunction(() => document.querySelector(".pg-stations button:nth-child(4) small")?.textContent === "1400");
    page.wrong.push(...again.wrong);
    return [page];
  },
  async "the machine stops the motor"() {
    const page = await open();
    await page.waitForSelector(RUN);
    await type(page, "machine on\nc 0A d C7 d 31 d 64 d 00\nc 45 d 63");
    await rest(page);
    equal(await position(page), 2000, "position");
    return [page];
  },
  async "pause, next pulse, slow"() {
    const page = await open();
    await page.waitForSelector(RUN);
    await type(page, "c 0A d C7 d 31 d 64 d 00\nc 45 d 63");
    await page.selectOption(".pg-pace", "0.001");
    await page.waitForFunction(() => /million/.test(document.querySelector(".pg-clock")?.textContent));
    await page.click("text=Pause");
    await page.waitForFunction(() => /paused/.test(document.querySelector(".pg-clock")?.textContent));
    const before = await position(page);
    await fast(page);
    for (let n = 1; n <= 3; n++) {
      await page.click("text=Next pulse");
      await page.waitForFunction(
        (wanted) => Number(document.querySelector(".pg-position")?.textContent) === wanted,
        before + n,
      );
    }
    // Keys control the zoom and the cursors, and the times of the cursors are shown.
    await page.focus(".pg-waves canvas");
    for (const key of ["+", "+", "a", "ArrowRight", "ArrowRight", "b"]) await page.keyboard.press(key);
    await page.waitForFunction(() =>
      /B − A = .* cycles/.test(document.querySelector(".pg-measured")?.textContent),
    );
    return [page];
  },
  async "frames while it runs"() {
    const page = await open();
    await page.waitForSelector(RUN);
    await type(page, "c 0A d 09 d 04 d 04 d 00\nc 45 d 00");
    await page.waitForTimeout(500);
    const browser = await view.newBrowserCDPSession();
    // CPU time in s of the page's process with its worker; Linux counts in hundredths of a second.
    const spent = async () => {
      const { processInfo } = await browser.send("SystemInfo.getProcessInfo");
      const stats = processInfo
        .filter((one) => one.type === "renderer" && fs.existsSync(`/proc/${one.id}/stat`))
        .map((one) => fs.readFileSync(`/proc/${one.id}/stat`, "utf8").replace(/.*\)/s, "").split(" "));
      return stats.reduce((sum, words) => sum + (Number(words[12]) + Number(words[13])) / 100, 0);
    };
    const passed = async () => {
      const [, number, unit] = /^([\d.]+) (m?s)/.exec(await page.textContent(".pg-clock"));
      return Number(number) * (unit === "s" ? 16 : 0.016); // million cycles
    };
    const [cycles, cpu] = [await passed(), await spent()];
    const gaps = await page.evaluate(
      () =>
        new Promise((resolve) => {
          const times = [];
          const tick = (t) =>
            times.push(t) > 90
              ? resolve(times.slice(1).map((one, n) => one - times[n]))
              : requestAnimationFrame(tick);
          requestAnimationFrame(tick);
        }),
    );
    gaps.sort((a, b) => a - b);
    const middle = gaps[gaps.length >> 1];
    const each = ((await passed()) - cycles) / ((await spent()) - cpu);
    // A low speed is not an error here; the figures are for docs/benchmarks.md.
    truth(each > 0, "the part runs");
    const speed = (await page.textContent(".pg-clock")).match(/([\d.]+) million/)?.[1];
    return [
      page,
      `${(1000 / middle).toFixed(0)} frames/s (90 frames, middle one) while ppmc104 runs at ${speed} million cycles/s in the page, ` +
        `${each.toFixed(1)} a second of processor time of worker and page`,
    ];
  },
  async "bad input is told"() {
    const page = await open(`${base}#v=0&part=ppmc104`);
    truth(/version 0/.test(await message(page)), "an old link");
    await page.waitForSelector(".pg-names li");
    for (const [text, wrong] of [
      ["c 4G", "4G: not a byte"],
      ["c 43 d E7\nhello", "no such statement: hello"],
      ["set l1_n=7", "l1_n has 1 bit"],
    ]) {
      await type(page, text);
      await page.waitForFunction(
        (part) => document.querySelector(".pg-trouble span")?.textContent.includes(part),
        wrong,
      );
    }
    await type(page, "c 82 r FC");
    await rest(page);
    truth(!(await page.$(".pg-trouble")), "the message stays");
    await page.fill("#pg-now", "c ZZ");
    truth(
      /two hexadecimal digits/.test(await page.textContent("form .pg-meaning")),
      "a byte while it is typed",
    );
    const other = await open(`${base}#v=1&part=z80`);
    truth(/no part z80/.test(await message(other)), "an unknown part");
    page.wrong.push(...other.wrong);
    return [page];
  },
  async "without WebAssembly, or with half a module"() {
    const page = await open(base, {}, (one) => one.addInitScript(() => delete globalThis.WebAssembly));
    truth(/no WebAssembly/.test(await message(page)), "no message without WebAssembly");
    await page.click("#pg-text");
    const half = await open(base, {}, (one) =>
      one.route("**/*.wasm", (route) =>
        route.fulfill({ body: "not a module", contentType: "application/wasm" }),
      ),
    );
    truth((await message(half)).length > 10, "no message with half a module");
    const none = await open(base, {}, (one) =>
      one.route("**/*.wasm", (route) => route.fulfill({ status: 404 })),
    );
    truth(/404/.test(await message(none)), "no message without a module");
    return [page];
  },
  async "a part that runs into an assertion"() {
    const page = await open(base, {}, (one) =>
      one.route("**/wasm/ppmc104.wasm", (route) =>
        route.fulfill({ body: fs.readFileSync(tripped), contentType: "application/wasm" }),
      ),
    );
    await page.waitForSelector(".pg-names li");
    for (const text of ["wait 100\nset l1_n=0\nwait 100", "set l1_n=0"]) {
      await type(page, text);
      const told = await message(page);
      truth(/the part has stopped: .*l1_n is low.*power it up again/s.test(told), `it says: ${told}`);
      // After the simulation has stopped, a new session runs on a new core and removes the message.
      await type(page, "c 0A d C7 d 31 d 64 d 00\nc 43 d 03 d 00 d 00");
      await rest(page);
      equal(await position(page), 4, "position afterwards");
      truth(!(await page.$(".pg-trouble")), "the message stays");
    }
    // Here a click on the pin stops the simulation; after that, the core can be neither paused nor stepped.
    await page.click(".pg-pins >> text=l1_n");
    await page.click("text=Next pulse");
    truth(/power it up again/.test(await message(page)), "no message for a pin");
    return [page];
  },
  async "a click before the part is there"() {
    const page = await open(base, {}, (one) =>
      one.route("**/*.wasm", async (route) => {
        await new Promise((resolve) => setTimeout(resolve, 1500));
        await route.continue();
      }),
    );
    await page.waitForSelector(".pg-pins button");
    await fast(page);
    await page.click(RUN);
    equal(await page.$$eval(".pg-pins .pg-low", (found) => found.length), 0, "switches that are closed");
    await rest(page);
    equal(await position(page), 1000, "position");
    return [page];
  },
  async "names for everything"() {
    const page = await open();
    await page.waitForSelector(".pg-names li");
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll(".pg button, .pg input, .pg select, .pg textarea, .pg svg")]
        .filter((one) => !(one.textContent.trim() || one.getAttribute("aria-label") || one.labels?.length))
        .map((one) => one.outerHTML.slice(0, 80)),
    );
    equal(nameless.join(), "", "without a name");
    return [page];
  },
  async "from a file"() {
    const page = await open(pathToFileURL(path.join(site, "index.html")).href);
    await page.waitForSelector(".pg-names li");
    await fast(page);
    await page.click(RUN);
    await rest(page);
    equal(await position(page), 1000, "position");
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
