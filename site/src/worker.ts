// Worker with the part and its host: runs them at the requested speed. While they run, it sends the next
// frame when the page has drawn the last frame.

import type { Frame, FromWorker, PartData, ToWorker } from "./types";
import { Core, ROW } from "./engine/core";
import { Player } from "./engine/player";
import { words } from "./engine/side";
import { TextError } from "./engine/text";

const SLICE = 14; // ms of work before messages of the page are handled
const CHUNK_MS = 3; // ms of work between two reads of the time
const MOST_CHUNK = 200_000; // cycles
const MOST_ROWS = 16_384; // rows that may wait for the page; if there are more, the part waits, too

let part: PartData;
let core: Core;
let bytes: ArrayBuffer;
let player: Player | undefined;
let running = false;
let stepping = false;
let speed = 0.1; // multiple of real time; 0: as fast as possible
let credit = 0; // cycles that may be simulated
let last = 0;
let timer = 0;
let why = "";
let chunk = 2_000; // cycles that need about CHUNK_MS
let shown = true; // the page has drawn the last frame
let waiting: Uint8Array[] = []; // rows for the next frame
let bytesWaiting = 0;
let done = 0; // cycles executed in `spent` ms of work, for the displayed speed
let spent = 0;

const post = (message: FromWorker, transfer: Transferable[] = []): void =>
  (self as unknown as Worker).postMessage(message, transfer);

function keep(rows: Uint8Array): void {
  if (rows.length) waiting.push(rows);
  bytesWaiting += rows.length;
}

function drop(): void {
  waiting = [];
  bytesWaiting = 0;
}

function frame(): void {
  if (!player) return;
  keep(core.rows());
  const rows = new Uint8Array(bytesWaiting);
  let at = 0;
  for (const block of waiting) {
    rows.set(block, at);
    at += block.length;
  }
  drop();
  shown = false;
  const { side } = player;
  const message: Frame = {
    kind: "frame",
    t: core.now,
    rows: rows.buffer,
    positions: part.motors.map((_, axis) => core.position(axis)),
    log: side.log.splice(0),
    status: side.status,
    line: player.line,
    running,
    over: player.over,
    machine: side.machine,
    places: side.places,
    why,
    mclk: spent > 0 ? done / spent / 1e3 : 0,
    levels: {
      inputs: Array.from({ length: words(part.inputs) }, (_, n) => core.input(n)),
      outputs: Array.from({ length: words(part.outputs) }, (_, n) => core.output(n)),
    },
  };
  post(message, [rows.buffer]);
}

function tell(error: unknown): void {
  running = false;
  const said = core?.message();
  if (error instanceof TextError) post({ kind: "error", text: error.message });
  else if (error instanceof WebAssembly.RuntimeError) {
    post({
      kind: "error",
      text: `the part has stopped: ${said || "an assertion failed"}. Run a session to power it up again.`,
    });
    player = undefined;
  } else post({ kind: "error", text: String(error instanceof Error ? error.message : error) });
}

function slice(): void {
  timer = 0;
  if (!running || !player) return;
  const begin = performance.now();
  credit = speed
    ? Math.min(credit + ((begin - last) / 1e3) * speed * part.clkHz, 0.1 * speed * part.clkHz + 1)
    : Infinity;
  last = begin;
  try {
    let time = begin;
    while (credit >= 1 && time - begin < SLICE && bytesWaiting < MOST_ROWS * ROW) {
      const before = core.now;
      const ran = player.advance(Math.min(Math.floor(credit), chunk), stepping);
      const took = performance.now() - time;
      time += took;
      if (took > CHUNK_MS) chunk = Math.max(500, chunk >> 1);
      else if (ran === chunk && 2 * took < CHUNK_MS) chunk = Math.min(MOST_CHUNK, 2 * chunk);
      done += ran;
      if (speed) credit -= ran;
      const rows = core.rows();
      keep(rows);
      if (stepping && moved(rows)) {
        pause("a motor has stepped");
        break;
      }
      if (player.resting) {
        pause("at rest");
        break;
      }
      if (ran === 0 && core.now === before && player.over) break;
    }
  } catch (error) {
    frame();
    tell(error);
    return;
  }
  spent += performance.now() - begin;
  if (shown || !running) frame();
  if (spent > 500) {
    done *= 0.5;
    spent *= 0.5;
  }
  // If the buffer of rows is full, the message "shown" continues the run.
  if (running && bytesWaiting < MOST_ROWS * ROW)
    timer = setTimeout(slice, speed ? Math.max(0, 16 - (performance.now() - begin)) : 0) as unknown as number;
}

let stepsBefore = 0;
function steps(): number {
  return part.motors.reduce((sum, _, axis) => sum + core.steps(axis), 0);
}
function moved(rows: Uint8Array): boolean {
  return rows.length > 0 && steps() !== stepsBefore;
}

function pause(reason: string): void {
  running = false;
  stepping = false;
  why = reason;
}

function go(step: boolean): void {
  if (!player) return;
  stepsBefore = steps();
  stepping = step;
  why = "";
  player.stir();
  last = performance.now();
  credit = 0;
  if (!running) {
    running = true;
    if (!timer) slice();
  }
}

function pressed(text: string): void {
  if (player) post({ kind: "journal", line: `@${core.now} ${text}` });
}

self.onmessage = ({ data }: MessageEvent<ToWorker>): void => {
  try {
    switch (data.kind) {
      case "load":
        running = false;
        part = data.part;
        bytes = data.wasm;
        core = new Core(bytes);
        player = new Player(core, part);
        post({ kind: "ready" });
        frame();
        break;
      case "start":
        if (!player) {
          // The module has stopped after a failed assertion: create a new one.
          core = new Core(bytes);
          player = new Player(core, part);
        }
        speed = data.speed;
        running = false;
        done = spent = 0;
        player.start(data.text);
        core.rows();
        drop();
        post({ kind: "began", label: data.label });
        go(false);
        break;
      case "send":
        player?.send(data.text);
        pressed(data.text);
        go(false);
        break;
      case "press":
        player?.press(`set ${data.pin}=${data.level}`);
        pressed(`set ${data.pin}=${data.level}`);
        if (!running) frame();
        break;
      case "machine":
        player?.press(data.words.join(" "));
        pressed(data.words.join(" "));
        if (!running) frame();
        break;
      case "speed":
        speed = data.speed;
        break;
      case "pause":
        pause("paused");
        frame();
        break;
      case "go":
        go(false);
        break;
      case "step":
        go(true);
        break;
      case "shown":
        shown = true;
        if (running && !timer) slice();
        break;
    }
  } catch (error) {
    tell(error);
  }
};
