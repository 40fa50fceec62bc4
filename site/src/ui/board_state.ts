// State of the panel "Real board": connection, runs with their confirmation, comparison.

import { batch, signal } from "@preact/signals";
import { compare, motionLines, type Simulated, slowed } from "../engine/serial_compare";
import { buildOf, simulatedBuild } from "../engine/serial_build";
import { Link, Lost, message } from "../engine/serial_link";
import { fetchRecords, type Recorder, recorder, replay } from "../engine/serial_record";
import type { Result } from "../engine/serial_report";
import { Run, stopMotors, Stopped } from "../engine/serial_run";
import { type BoardRow, stopScripts } from "../engine/serial_steps";
import { TextError } from "../engine/text";
import type { PartData } from "../types";
import { choosePort, onReturn, WebLine } from "./board_port";
import { Simulation } from "./board_sim";
import { loadWasm, parts } from "./load";
import { chapter, part, startText, text } from "./state";

export type Phase = "off" | "opening" | "ready" | "simulating" | "confirm" | "running" | "comparing";
interface Job {
  title: string;
  text: string;
  golden: Simulated;
  motions: string[];
}

export const phase = signal<Phase>("off");
export const trouble = signal("");
/** A message that is not an error. */
export const told = signal("");
export const both = signal(true);
export const board = signal<Link | undefined>(undefined);
export const records = signal<Recorder | undefined>(undefined);
export const jobs = signal<Job[]>([]);
export const results = signal<Result[]>([]);
export const rows = signal<BoardRow[]>([]);
export const golden = signal<Simulated | undefined>(undefined);
export const positions = signal<number[]>([]);
export const line = signal(0);
/** Compared part of the recorded time in percent, -1 before the comparison of edges. */
export const replayed = signal(-1);

let link: Link | undefined;
let port: Awaited<ReturnType<typeof choosePort>>;
let simulation: Simulation | undefined;
let run: Run | undefined;
/** The present run, until its motors have stopped. */
let active: Promise<unknown> = Promise.resolve();
let endWatch: () => void = () => undefined;
/** Number of the last request to simulate; an earlier one has been cancelled. */
let asked = 0;

/** Return the title of the part on the board. */
export function boardPart(): string {
  const number = board.value?.identity.part;
  return parts().find((one) => one.number === number)?.title ?? `part ${number}`;
}

/** Return the reason why a text of the chosen part cannot run on the board, "" if it can. */
export function mismatch(): string {
  const data = part.value;
  if (!board.value || !data) return "";
  if (!data.board.number) return `the ${data.title} has no UART bridge, so the page cannot run it on a board`;
  if (data.board.number !== board.value.identity.part)
    return `this session is for the ${data.title}, but the board has a ${boardPart()}; choose the ${boardPart()} as part`;
  return data.bus === "byte" && board.value.identity.axes !== data.motors.length
    ? `the board has ${board.value.identity.axes} axes, the ${data.title} of this page ${data.motors.length}`
    : "";
}

export async function connect(): Promise<void> {
  trouble.value = told.value = "";
  try {
    const chosen = await choosePort();
    if (chosen) await attach(chosen);
  } catch (error) {
    trouble.value = message(error);
    phase.value = "off";
  }
}

async function attach(chosen: NonNullable<typeof port>): Promise<void> {
  phase.value = "opening";
  endWatch();
  const wire = new WebLine(chosen);
  await wire.open();
  const made = new Link(wire);
  try {
    await made.open();
    const info = await recorder(made);
    batch(() => {
      link = board.value = made;
      port = chosen;
      records.value = info;
      results.value = rows.value = [];
      phase.value = "ready";
    });
    made.onLost = lost;
    if (part.value && !mismatch()) prepare(part.value, made).load().catch(() => undefined);
  } catch (error) {
    await wire.close().catch(() => undefined);
    throw error;
  }
}

/** The port has disappeared: report what still moves, and stop it when the port returns. */
function lost(): void {
  const moving = phase.value === "running";
  const gone = port;
  const moved = run?.part;
  reset();
  trouble.value = moving
    ? "The port was lost during a run. The page cannot stop the motor now: it ends its move, or runs until a limit. " +
      "Switch the driver off or press the reset button of the board. When the port returns, the page stops the motor."
    : "the port was lost; connect the board again";
  if (!moving || !gone) return;
  endWatch = onReturn((found) => {
    if (found !== gone) return;
    void attach(found)
      .then(async () => {
        if (moved?.board.number !== link!.identity.part) return;
        await stopMotors(link!, moved);
        told.value = "the port has returned, and the motor was stopped";
        trouble.value = "";
      })
      .catch((error: unknown) => {
        trouble.value = message(error);
        phase.value = "off";
      });
  });
}

function reset(): void {
  batch(() => {
    link = board.value = undefined;
    run = undefined;
    phase.value = "off";
    jobs.value = [];
  });
}

export async function disconnect(): Promise<void> {
  const old = link;
  await stop("the board was disconnected");
  await active.catch(() => undefined);
  reset();
  await old?.close();
}

/** Return the simulation of a part with the parameters of the board. */
function prepare(data: PartData, used: Link): Simulation {
  const build = simulatedBuild(data, used.identity, records.value);
  if (simulation?.part.wasm === build.wasm) return simulation;
  simulation?.close();
  simulation = new Simulation(build);
  return simulation;
}

/** Simulate texts, and show the request for confirmation. Sends nothing to the board. */
export async function ask(texts: { title: string; text: string }[]): Promise<void> {
  const data = part.value;
  trouble.value = told.value = "";
  const mine = ++asked;
  const wrong = mismatch();
  if (wrong || !data || !link) {
    trouble.value = wrong;
    return;
  }
  try {
    for (const one of texts) new Run(link, data, one.text);
    const simulator = prepare(data, link);
    phase.value = "simulating";
    const made: Job[] = [];
    for (const [n, one] of texts.entries()) {
      told.value = texts.length > 1 ? `simulating session ${n + 1} of ${texts.length}` : "";
      const found = await simulator.run(one.text);
      if (mine !== asked) return;
      const scale = link.identity.xtalHz / Number(simulator.part.params.XTAL_HZ);
      const motions = motionLines(found.motions, data.motors.length, Number(data.style.first), scale);
      if (found.open) motions.push(`${found.open}: it may output more pulses than listed`);
      made.push({ ...one, golden: found, motions });
    }
    batch(() => {
      told.value = "";
      jobs.value = made;
      phase.value = "confirm";
    });
  } catch (error) {
    if (mine !== asked) return;
    trouble.value = message(error);
    phase.value = link ? "ready" : "off";
  }
}

/** Run the text of the editor. */
export function askText(): Promise<void> {
  return ask([{ title: sessionTitle(), text: text.value }]);
}

function sessionTitle(): string {
  return part.value?.sessions.find((one) => one.name === chapter.value)?.title ?? "own text";
}

/** Run all sessions of the manual that a board can execute. */
export function askSelfTest(): Promise<void> {
  const data = part.value;
  const suitable = (data?.sessions ?? []).filter((one) => {
    try {
      return link && data && new Run(link, data, one.text);
    } catch (error) {
      if (error instanceof TextError) return false;
      throw error;
    }
  });
  return ask(suitable);
}

export function cancel(): void {
  asked++;
  jobs.value = [];
  told.value = "";
  phase.value = link ? "ready" : "off";
}

/** The reader has confirmed the motions: run all jobs on the board, and compare them. */
export async function confirm(): Promise<void> {
  const data = part.value;
  const all = jobs.value;
  const used = link;
  if (!data || !used || phase.value !== "confirm" || mismatch()) return;
  results.value = [];
  if (both.value && all.length === 1) startText(all[0]!.text);
  for (const job of all) {
    if (!jobs.value.length) break;
    const played = play(job, data, used);
    active = played;
    const result = await played;
    if (used !== link && !result.error) return;
    results.value = [...results.value, result];
    if (result.error) break;
  }
  if (link) phase.value = "ready";
  jobs.value = [];
}

async function play(job: Job, data: PartData, used: Link): Promise<Result> {
  const info = records.value;
  const build = info ? buildOf(data, used.identity, info) : "the bitstream has no recorder (make bitstream … RECORD=13)";
  const why = typeof build === "string" ? build : "";
  const made = new Run(used, data, job.text, !why, () =>
    batch(() => {
      rows.value = [...made.rows];
      positions.value = made.positions;
      line.value = made.line;
      if (made.over && !result.compared.answers) show();
    }),
  );
  const first = Number(data.style.first);
  const result: Result = {
    title: job.title,
    motions: job.motions,
    compared: { answers: 0, positions: 0, differences: [] },
    edges: why,
    error: "",
    answeredMs: 0,
  };
  const show = (): void => {
    result.answeredMs = made.answered;
    result.compared = compare(made.rows, [], job.golden, first);
    results.value = [...results.value.filter((one) => one !== result), result];
  };
  batch(() => {
    golden.value = job.golden;
    replayed.value = -1;
    rows.value = [];
    positions.value = made.positions;
    phase.value = "running";
  });
  run = made;
  try {
    await made.play();
  } catch (error) {
    result.error = message(error);
    if (!(error instanceof Lost)) trouble.value = result.error;
    if (error instanceof Stopped) told.value = `stopped at position ${made.positions.join(", ")}`;
  } finally {
    run = undefined;
    results.value = results.value.filter((one) => one !== result);
  }
  if (used.lost) return result;
  phase.value = "comparing";
  const counted = made.counted ? made.positions : [];
  if (!result.error) {
    result.compared = compare(made.rows, counted, job.golden, first);
    if (result.compared.differences.length) {
      const slower = await prepare(data, used).run(slowed(job.text)).catch(() => undefined);
      result.compared = compare(made.rows, counted, job.golden, first, slower);
    }
  }
  try {
    if (typeof build !== "string") {
      const { info: state, samples } = await fetchRecords(used);
      result.edges = await replay(build, await loadWasm(build), samples, state.full, (done) => {
        replayed.value = Math.floor(100 * done);
        return jobs.value.length > 0;
      });
    }
  } catch (error) {
    result.edges = message(error);
  }
  return result;
}

/** End the session, and start no further one. */
function end(why: string): void {
  if (phase.value === "running" || phase.value === "comparing") jobs.value = [];
  run?.stop(why);
}

/** Stop the session and all motors immediately. */
export async function stop(why: string): Promise<void> {
  const used = link;
  const data = part.value;
  if (phase.value === "simulating" || phase.value === "confirm") cancel();
  end(why);
  if (run || !used || !data || mismatch()) return;
  try {
    await stopMotors(used, data);
    told.value = "all motors were stopped";
  } catch (error) {
    trouble.value = message(error);
  }
}

/** Stop all motors while the page is being closed or frozen. */
function leave(): void {
  if (run && link) link.shout(stopScripts(run.part));
  end("the page was closed");
}

addEventListener("pagehide", leave);
document.addEventListener("freeze", leave);
document.addEventListener("visibilitychange", () => {
  if (document.hidden) end("the tab was hidden");
});
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && (run || phase.value === "comparing")) void stop("stopped with Escape");
});
