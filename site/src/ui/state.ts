// What the page knows, as signals; and what it asks the worker for.

import { computed, signal } from "@preact/signals";
import type { Frame, FromWorker, LogEntry, PartData, ToWorker } from "../types";
import { loadPart, loadWasm, makeWorker, parts } from "./load";
import { read, write } from "./link";
import { Store } from "./store";

export const SPEEDS: readonly (readonly [number, string])[] = [
  [0.001, "1/1000"],
  [0.01, "1/100"],
  [0.1, "1/10"],
  [1, "real time"],
  [10, "10 ×"],
  [0, "as fast as it goes"],
];
const MOST_LOG = 2_000;

export const part = signal<PartData | undefined>(undefined);
export const chapter = signal("");
export const text = signal("");
export const speed = signal(0.1);
export const running = signal(false);
/** Part and chapter that log and waves are of. */
export const shows = signal("");
export const over = signal(false);
export const why = signal("");
export const mclk = signal(0);
export const line = signal(0);
export const status = signal(-1);
export const positions = signal<number[]>([]);
export const inputs = signal<number[]>([]);
export const outputs = signal<number[]>([]);
export const log = signal<LogEntry[]>([]);
export const trouble = signal("");
export const said = signal("");
export const now = signal(0);
export const frames = signal(0); // redraw
export const journal = signal<string[]>([]);
export const machineOn = signal(false);
export const places = signal<number[]>([500, -300, -150, 0, 1850, 2000]);
export const seconds = computed(() => (part.value ? now.value / part.value.clkHz : 0));

export let store: Store | undefined;
let worker: Worker | undefined;
/** Whether the part can run; what shall be done as soon as it can. */
let loaded = false;
let wanted: (() => void) | undefined;

export function ask(message: ToWorker, transfer: Transferable[] = []): void {
  worker?.postMessage(message, transfer);
}

function onFrame(frame: Frame): void {
  store?.take(frame.rows, frame.t);
  now.value = frame.t;
  running.value = frame.running;
  over.value = frame.over;
  why.value = frame.why;
  mclk.value = frame.mclk;
  line.value = frame.line;
  status.value = frame.status;
  machineOn.value = frame.machine;
  if (frame.machine) places.value = frame.places;
  positions.value = frame.positions;
  inputs.value = frame.levels.inputs;
  outputs.value = frame.levels.outputs;
  if (frame.log.length) log.value = [...log.value, ...frame.log].slice(-MOST_LOG);
  frames.value++;
}

function onMessage({ data }: MessageEvent<FromWorker>): void {
  switch (data.kind) {
    case "frame":
      onFrame(data);
      break;
    case "began":
      store?.clear();
      log.value = [];
      shows.value = `${part.value?.name} ${chapter.value}`;
      over.value = false;
      why.value = "";
      break;
    case "journal":
      journal.value = [...journal.value, data.line];
      break;
    case "error":
      running.value = false;
      trouble.value = data.text;
      break;
    case "ready":
      loaded = true;
      wanted?.();
      wanted = undefined;
      break;
  }
}

/** Another part: its tables, its module, a session of it. */
export async function choose(name: string, run?: string, own?: string, go = false): Promise<void> {
  trouble.value = "";
  if (!parts().some((one) => one.name === name)) {
    trouble.value = `there is no part ${name}: the page shows ${parts()[0]!.title} instead`;
    name = parts()[0]!.name;
    run = own = undefined;
  }
  if (typeof WebAssembly !== "object") {
    trouble.value = "this browser has no WebAssembly: the text can be read and typed, the part cannot run";
  }
  loaded = false;
  wanted = go ? start : undefined;
  const data = await loadPart(name);
  part.value = data;
  store = new Store(data);
  log.value = [];
  journal.value = [];
  now.value = 0;
  status.value = -1;
  machineOn.value = false;
  take(run ?? data.sessions.find((one) => one.name === "2")?.name ?? data.sessions[0]?.name ?? "", own);
  frames.value++;
  if (typeof WebAssembly !== "object") return;
  worker?.terminate();
  worker = undefined;
  const wasm = await loadWasm(data);
  if (part.value !== data) return;
  worker = makeWorker();
  worker.onmessage = onMessage;
  worker.onerror = (event) => (trouble.value = `the part does not start: ${event.message}`);
  ask({ kind: "load", part: data, wasm }, [wasm]);
}

/** A session of the manual into the text, or an own text. */
export function take(name: string, own?: string): void {
  const session = part.value?.sessions.find((one) => one.name === name);
  if (own === undefined && name && !session) trouble.value = `the manual has no session ${name}`;
  chapter.value = own === undefined && session ? name : "";
  text.value = own ?? session?.text ?? part.value?.sessions[0]?.text ?? "";
  journal.value = [];
}

export function start(): void {
  if (!loaded && typeof WebAssembly === "object") {
    wanted = start;
    if (!trouble.value) why.value = "the part is being loaded";
    return;
  }
  trouble.value = "";
  why.value = "";
  over.value = false;
  journal.value = [];
  machineOn.value = false;
  ask({ kind: "start", text: text.value, speed: speed.value });
}

export function setSpeed(value: number): void {
  speed.value = value;
  ask({ kind: "speed", speed: value });
}

/** The link that makes this session again: what was typed and pressed, with the clk of each. */
export function link(): string {
  const own = journal.value.length > 0 || !chapter.value || text.value !== session()?.text;
  const whole = [text.value, ...journal.value].join("\n");
  const state = { part: part.value?.name ?? "", speed: speed.value, go: true };
  return write(own ? { ...state, text: whole } : { ...state, run: chapter.value });
}

function session(): { text: string } | undefined {
  return part.value?.sessions.find((one) => one.name === chapter.value);
}

/** What the address says, or the first part. */
export async function open(hash: string): Promise<void> {
  let linked;
  let wrong = "";
  try {
    linked = read(hash);
  } catch (error) {
    wrong = error instanceof Error ? error.message : String(error);
  }
  if (linked?.speed !== undefined) speed.value = linked.speed;
  try {
    await choose(linked?.part ?? parts()[0]!.name, linked?.run, linked?.text, linked?.go);
  } catch (error) {
    trouble.value = `cannot load the part: ${error instanceof Error ? error.message : error}`;
  }
  if (wrong) trouble.value = wrong;
}
