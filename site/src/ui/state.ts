// State of the page as signals, and requests to the worker.

import { batch, computed, signal } from "@preact/signals";
import type { Frame, FromWorker, LogEntry, PartData, ToWorker } from "../types";
import { loadPart, loadWasm, makeWorker, parts } from "./load";
import { isLink, read, write } from "./link";
import { READS, Store } from "./store";

export const SPEEDS: readonly (readonly [number, string])[] = [
  [0.001, "1/1000"],
  [0.01, "1/100"],
  [0.1, "1/10"],
  [1, "real time"],
  [10, "10 ×"],
  [0, "as fast as possible"],
];
const FIRST_SPEED = 0.01;
const MOST_LOG = 2_000;
const LOG_MS = 250; // minimum time between two updates of the log while the part runs
const SHOWN_MS = 100; // a frame is drawn after this time even if the page is in the background
const NEAR = 4; // largest number of cycles from the end of an access to its last edge
const KEPT_MS = 150; // delay between an input of the reader and its storage

export const part = signal<PartData | undefined>(undefined);
/** The part that was chosen last; `part` is undefined until its tables are loaded. */
export const chosen = signal("");
export const chapter = signal("");
export const text = signal("");
/** The line "Send now". */
export const now = signal("");
export const speed = signal(0.1);
export const running = signal(false);
/** Part and chapter to which log and waves belong. */
export const shows = signal("");
export const over = signal(false);
export const why = signal("");
export const mclk = signal(0);
export const line = signal(0);
export const status = signal(-1);
/** Axis, or station of a line, that the reader has selected. */
export const axis = signal(0);
export const positions = signal<number[]>([]);
export const inputs = signal<number[]>([]);
export const outputs = signal<number[]>([]);
export const log = signal<LogEntry[]>([]);
export const trouble = signal("");
export const clk = signal(0);
export const frames = signal(0); // number of frames drawn; a change redraws the components
export const journal = signal<string[]>([]);
export const machineOn = signal(false);
export const places = signal<number[]>([500, -300, -150, 0, 1850, 2000]);
/** The access that log, waves and text mark, and the view in which the reader has selected it. */
export const selected = signal<LogEntry | undefined>(undefined);
export const selectedIn = signal<"log" | "waves" | "text">("log");
/** True on the first visit, in which the page has started a session without a request of the reader. */
export const welcome = signal(false);
export const seconds = computed(() => (part.value ? clk.value / part.value.clkHz : 0));

export let store: Store | undefined;
let worker: Worker | undefined;
/** Number of the newest choice of a part. An older choice that is still loading must not change anything. */
let turn = 0;
/** Whether the module of the part is loaded. Requests wait in `early` for its tables, in `later` for it. */
let loaded = false;
let early: (() => void)[] = [];
let later: ToWorker[] = [];
/** Loading has failed: Run loads again. */
let failed = false;
/** Errors in the link; the message stays until the reader starts a session or chooses a part. */
let remark = "";
/** The displayed address. */
let opened = "";
/** True if the next start of a session is the automatic start of the first visit. */
let first = false;
/** A frame that is not drawn yet, and log entries that are not shown yet. */
let frame: Frame | undefined;
let entries: LogEntry[] = [];
let logged = 0;

export function select(entry: LogEntry | undefined, view: "log" | "waves" | "text"): void {
  batch(() => {
    selectedIn.value = view;
    selected.value = entry;
    if (entry?.station !== undefined) axis.value = entry.station;
  });
}

/** Select the last access of a line of the text. */
export function selectLine(number: number): void {
  select(log.value.filter((one) => one.line === number).at(-1), "text");
}

/** Select the access with an edge in this cycle, or else the last write before it, which is the edge's cause. */
export function selectEdge(t: number): void {
  const away = (one: LogEntry): number => Math.max(one.from - t, t - one.t, 0);
  const near = log.value.filter((one) => away(one) <= NEAR);
  const inside = near.filter((one) => away(one) === Math.min(...near.map(away))).at(-1);
  select(inside ?? log.value.filter((one) => one.t <= t && !READS.has(one.kind)).at(-1), "waves");
}

const able = (): boolean => typeof WebAssembly === "object";

export function ask(message: ToWorker): void {
  if (!part.value) early.push(() => ask(message));
  else if (!loaded) later.push(message);
  else worker?.postMessage(message);
}

/** Pause, continue, or run to the next pulse. */
export function clock(kind: "pause" | "go" | "step"): void {
  ask({ kind });
  if (!loaded && able()) running.value = kind !== "pause";
}

function draw(): void {
  if (!frame) return;
  const data = frame;
  frame = undefined;
  batch(() => {
    clk.value = data.t;
    running.value = data.running;
    over.value = data.over;
    why.value = data.why;
    mclk.value = data.mclk;
    line.value = data.line;
    status.value = data.status;
    machineOn.value = data.machine;
    if (data.machine) places.value = data.places;
    positions.value = data.positions;
    inputs.value = data.levels.inputs;
    outputs.value = data.levels.outputs;
    if (entries.length && (!data.running || performance.now() - logged > LOG_MS)) {
      log.value = [...log.value, ...entries].slice(-MOST_LOG);
      entries = [];
      logged = performance.now();
    }
    frames.value++;
  });
}

/** Store a frame, draw it with the next repaint of the browser, and then request another one. */
function onFrame(data: Frame, from: Worker): void {
  store?.take(data.rows, data.t, data.log);
  entries = [...entries, ...data.log].slice(-MOST_LOG);
  frame = data;
  let done = false;
  const shown = (): void => {
    if (done) return;
    done = true;
    if (from === worker) draw();
    // With a timeout of 0, the browser paints before the worker gets this message.
    setTimeout(() => from.postMessage({ kind: "shown" } satisfies ToWorker), 0);
  };
  requestAnimationFrame(shown);
  setTimeout(shown, SHOWN_MS);
}

function onMessage(data: FromWorker, from: Worker): void {
  switch (data.kind) {
    case "frame":
      onFrame(data, from);
      break;
    case "began":
      store?.clear();
      frame = undefined;
      entries = [];
      log.value = [];
      selected.value = undefined;
      shows.value = data.label;
      over.value = false;
      why.value = "";
      break;
    case "journal":
      journal.value = [...journal.value, data.line];
      break;
    case "error":
      draw();
      running.value = false;
      trouble.value = remark ? `${remark}; ${data.text}` : data.text;
      if (!loaded) fail(data.text);
      break;
    case "ready":
      loaded = true;
      for (const message of later.splice(0)) from.postMessage(message);
      break;
  }
}

function fail(told: string): void {
  failed = true;
  running.value = false;
  later = [];
  early = [];
  why.value = "";
  trouble.value = remark ? `${remark}; ${told}` : told;
}

/** Discard the present part and its state. */
function unload(): void {
  worker?.terminate();
  worker = undefined;
  loaded = failed = false;
  early = [];
  later = [];
  frame = undefined;
  entries = [];
  store = undefined;
  part.value = undefined;
  log.value = [];
  selected.value = undefined;
  journal.value = [];
  positions.value = inputs.value = outputs.value = [];
  axis.value = 0;
  clk.value = mclk.value = line.value = 0;
  status.value = -1;
  machineOn.value = running.value = over.value = welcome.value = false;
}

/** Load another part: its tables, its module, one of its sessions or another text. go: start the session. */
export async function choose(
  name: string,
  { run, own, go = false, wrong = [] }: { run?: string | undefined; own?: string | undefined; go?: boolean | undefined; wrong?: string[] } = {},
): Promise<void> {
  const mine = ++turn;
  const told = [...wrong];
  const show = (): string => (trouble.value = remark = told.join("; "));
  if (!parts().some((one) => one.name === name)) {
    if (name) told.push(`there is no part ${name}; the page shows ${parts()[0]!.title} instead`);
    name = parts()[0]!.name;
    run = own = undefined;
  }
  batch(() => {
    unload();
    show();
    chosen.value = name;
    why.value = "the part is being loaded";
  });
  try {
    const data = await loadPart(name);
    if (mine !== turn) return;
    const asked = early;
    batch(() => {
      part.value = data;
      store = new Store(data);
      if (own === undefined && run !== undefined && !data.sessions.some((one) => one.name === run))
        told.push(`the manual has no session ${run}`);
      take(run ?? data.sessions.find((one) => one.name === "2")?.name ?? data.sessions[0]?.name ?? "", own);
      frames.value++;
    });
    if (!able()) {
      told.push("this browser has no WebAssembly; you can read and edit the text, but the part cannot run");
      show();
      why.value = "";
      return;
    }
    show();
    if (go) launch(text.value);
    early = [];
    for (const action of asked) action();
    const wasm = await loadWasm(data);
    if (mine !== turn) return;
    const made = makeWorker();
    made.onmessage = (event: MessageEvent<FromWorker>) => mine === turn && onMessage(event.data, made);
    made.onerror = (event) => mine === turn && fail(`the part does not start: ${event.message}`);
    worker = made;
    made.postMessage({ kind: "load", part: data, wasm } satisfies ToWorker, [wasm]);
  } catch (error) {
    if (mine === turn) fail(`cannot load the part: ${error instanceof Error ? error.message : error}`);
  }
}

/** Set the text: a session of the manual, or another text. */
function take(name: string, own?: string): void {
  const session = part.value?.sessions.find((one) => one.name === name);
  chapter.value = own === undefined && session ? name : "";
  text.value = own ?? session?.text ?? part.value?.sessions[0]?.text ?? "";
  journal.value = [];
  // Show the first station that the text selects.
  if (isLine()) axis.value = Number(/^\s*axis (\d{1,2})\b/m.exec(text.value)?.[1] ?? 1) % part.value!.motors.length;
}

/** Whether the part is a line of stations, of which the page shows one. */
export function isLine(): boolean {
  return part.value?.bus === "line";
}

/** Start the session of the manual that the reader has selected. */
export function pick(name: string): void {
  take(name);
  remember();
  start();
}

/** Start the session for the reader, and remove messages about the link. */
export function start(): void {
  remark = "";
  if (able()) trouble.value = "";
  if (!part.value) {
    early.push(start);
    if (able() && !failed) running.value = true;
    return;
  }
  if (failed) {
    const own = chapter.value ? {} : { own: text.value };
    void choose(part.value.name, { ...own, run: chapter.value || undefined, go: true });
    return;
  }
  launch(text.value);
}

/** Start a text that is not necessarily that of the editor. The part must be loaded. */
export function startText(whole: string): void {
  remark = trouble.value = "";
  launch(whole);
}

function launch(whole: string): void {
  if (!able()) return;
  welcome.value = first;
  first = false;
  over.value = false;
  journal.value = [];
  machineOn.value = false;
  if (loaded) why.value = "";
  else running.value = true;
  const label = `${part.value?.name} ${chapter.value}`;
  ask({ kind: "start", text: whole, speed: speed.value, label });
}

export function setSpeed(value: number): void {
  speed.value = value;
  ask({ kind: "speed", speed: value });
}

/** Return the link that repeats this session: the text, and each input and press with its cycle. */
function link(): string {
  const own = journal.value.length > 0 || !chapter.value || text.value !== session()?.text;
  const whole = [text.value, ...journal.value].join("\n");
  const state = { part: chosen.value, speed: speed.value, go: true };
  return write(own ? { ...state, text: whole } : { ...state, run: chapter.value });
}

function session(): { text: string } | undefined {
  return part.value?.sessions.find((one) => one.name === chapter.value);
}

/** Make the link the address of the page, and return it. */
export function share(): string {
  const address = new URL(link(), location.href);
  history.replaceState(null, "", address);
  opened = address.hash;
  return address.href;
}

/** Inputs of the reader, stored with the entry in the browser's history; a reload restores them. */
interface Kept {
  part: string;
  chapter: string;
  text: string;
  now: string;
  speed: number;
  places: number[];
}
let due = 0;

function keep(): void {
  clearTimeout(due);
  due = 0;
  // A part without its tables has no text.
  const whole = part.value ? { chapter: chapter.value, text: text.value } : { chapter: "", text: "" };
  const kept: Kept = { part: chosen.value, ...whole, now: now.value, speed: speed.value, places: places.value };
  try {
    history.replaceState({ openppmc: kept }, "");
  } catch {
    // The browser does not store this amount of data.
  }
}

/** Store the inputs of the reader after KEPT_MS. */
export function remember(): void {
  if (!due) due = window.setTimeout(keep, KEPT_MS);
}

addEventListener("beforeunload", () => due && keep());

/** The page is new or has another address: show the state that is stored for it, else the session in the address. */
export function arrive(load = false): void {
  const kept = (history.state as { openppmc?: Kept } | null)?.openppmc;
  clearTimeout(due);
  due = 0;
  const { hash } = location;
  if (kept && typeof kept.text === "string" && Array.isArray(kept.places)) {
    opened = hash;
    speed.value = kept.speed;
    now.value = kept.now;
    places.value = kept.places;
    const own = kept.chapter || !kept.text ? undefined : kept.text;
    void choose(kept.part, { run: kept.chapter || undefined, own });
    return;
  }
  if (!load && !isLink(hash) && (hash !== "" || opened === "")) {
    keep(); // a position on this page: the text stays
    return;
  }
  opened = hash;
  const { linked, wrong } = read(hash, SPEEDS.map(([value]) => value));
  if (linked?.speed !== undefined) speed.value = linked.speed;
  let go = linked?.go;
  if (load && !linked && !wrong.length) {
    // The first visit begins with a motor that turns slowly enough to see its phases.
    speed.value = FIRST_SPEED;
    first = go = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  }
  void choose(linked?.part || parts()[0]!.name, { run: linked?.run, own: linked?.text, go, wrong });
  welcome.value = load && !linked && !wrong.length;
}
