// The recorder of a bitstream (UB-REC): reads its records, and replays them on the RTL with the parameters of the board.

import type { PartData } from "../types";
import { Core, ROW } from "./core";
import { BoardError, type Link, word } from "./serial_link";
import { words } from "./side";

const RECORD = 0x0d;
const RECORDED = 0x0e;
const FETCH = 0x90;
const INPUT = 1 << 16;
const SETTLE = 2; // cycles of reset after which the outputs have their reset levels
const MOST_RUN = 1_000_000;
const SLICE_MS = 20;
const LONGEST_MS = 120_000; // longest comparison of edges

export interface Recorder {
  bytes: number;
  timeBits: number;
  most: number;
  full: boolean;
  count: number;
}
export interface Sample {
  t: number;
  levels: bigint;
}
export interface Edges {
  records: number;
  edges: number;
  cycles: number;
  /** Reason why later edges were not compared, "" if all edges were compared. */
  end: string;
  /** The first difference, "" if there is none. */
  difference: string;
}

/** Return the state of the recorder; undefined if the bitstream has none. */
export async function recorder(link: Link): Promise<Recorder | undefined> {
  const { result, data } = await link.request([RECORD, 0, RECORDED]);
  if (result) return undefined;
  return { bytes: data[0]!, timeBits: data[1]!, most: 2 ** data[2]!, full: (data[3]! & 2) !== 0, count: word(data, 4) };
}

/** End the recording, and read all records. */
export async function fetchRecords(link: Link): Promise<{ info: Recorder; samples: Sample[] }> {
  const info = await recorder(link);
  if (!info) throw new BoardError("the bitstream has no recorder");
  await link.request([RECORD, 2]);
  const most = Math.floor(255 / info.bytes);
  const samples: Sample[] = [];
  let t = 0;
  for (let left = info.count; left > 0; ) {
    const count = Math.min(left, most);
    const { data } = await link.request([FETCH, count * info.bytes]);
    for (let at = 0; at < data.length; at += info.bytes) {
      let value = 0n;
      for (let n = info.bytes - 1; n >= 0; n--) value = (value << 8n) | BigInt(data[at + n]!);
      t += Number(value & ((1n << BigInt(info.timeBits)) - 1n));
      samples.push({ t, levels: value >> BigInt(info.timeBits) });
    }
    left -= count;
  }
  return { info, samples };
}

interface Pin {
  name: string;
  shift: bigint;
  mask: bigint;
  word: number;
  count: number;
  input: boolean;
}

/** Apply the recorded levels of the inputs to the RTL, and compare each edge of its outputs.
 *
 * part: the part in the build of the board. wanted: called with the part of the recorded time that was compared, from 0
 * to 1; if it returns false, the comparison ends. */
export async function replay(
  part: PartData,
  wasm: BufferSource,
  samples: readonly Sample[],
  full: boolean,
  wanted: (done: number) => boolean = () => true,
): Promise<Edges> {
  const core = new Core(wasm);
  const pins = layout(part);
  const reset = pins.find((pin) => pin.name === "rst_n")!;
  const level = (pin: Pin, levels: bigint): bigint => (levels >> pin.shift) & pin.mask;
  const found: Edges = { records: samples.length, edges: 0, cycles: 0, end: full ? "recorder full" : "", difference: "" };
  const from = samples.findIndex(({ levels }) => level(reset, levels) === 0n);
  if (from < 0) return { ...found, difference: "no reset was recorded" };
  const base = samples[from]!.t - core.now;
  const outputs = pins.filter((pin) => !pin.input);
  const is = (pin: Pin): bigint => {
    let value = 0n;
    for (let n = pin.count - 1; n >= 0; n--) value = (value << 32n) | BigInt(core.output(pin.word + n));
    return value & pin.mask;
  };
  checkIdle(part, pins, samples.slice(from));
  const last = samples.at(-1)!.t - base;
  let before = 0n;
  const begin = performance.now();
  let slice = begin;
  for (const { t, levels } of samples.slice(from)) {
    // An output that changes at edge t is recorded at t + 1, so outputs may change only at the last edge before a
    // record.
    for (let left = t - base - core.now; left > 0; ) {
      left -= core.run(Math.min(left, MOST_RUN), 0);
      const early = firstOutput(core.rows());
      if (early >= 0 && early + 1 + base < t && early + base > samples[from]!.t + SETTLE) {
        const name = outputs.find((pin) => is(pin) !== level(pin, before))?.name ?? "an output";
        return { ...found, difference: `${name} changes in the RTL ${early} cycles after the reset begins, but not on the board` };
      }
      if (performance.now() - slice > SLICE_MS) {
        const go = wanted(core.now / last);
        if (!go || performance.now() - begin > LONGEST_MS) {
          const ms = Math.floor((core.now * 1e3) / part.clkHz);
          return { ...found, end: `${go ? "after two minutes" : "with Stop"}, the comparison ended at ${ms} ms of the run` };
        }
        await new Promise((done) => setTimeout(done, 0));
        slice = performance.now();
      }
    }
    found.cycles = t - base;
    if (t >= samples[from]!.t + SETTLE)
      for (const pin of outputs) {
        const board = level(pin, levels);
        if (board !== level(pin, before)) found.edges++;
        if (board === is(pin)) continue;
        const text = (value: bigint): string =>
          pin.mask > 1n ? value.toString(16).toUpperCase().padStart(2, "0") : String(value);
        const values = `${text(board)} on the board, ${text(is(pin))} in the RTL`;
        return { ...found, difference: `${pin.name} is ${values}, ${t - base} cycles after the reset begins` };
      }
    for (const pin of pins)
      if (pin.input && (t === samples[from]!.t || level(pin, levels) !== level(pin, before)))
        put(core, part, pin, level(pin, levels));
    before = levels;
  }
  return found;
}

/** Throw an error if the phases have the levels of the other PHASE_IDLE, which IDENT does not report. */
function checkIdle(part: PartData, pins: readonly Pin[], samples: readonly Sample[]): void {
  const phases = pins.find(({ name }) => name === "s");
  const value = part.params.PHASE_IDLE;
  const first = samples.find(({ t }) => t >= samples[0]!.t + SETTLE);
  if (!phases || !first || value === undefined) return;
  if (((first.levels >> phases.shift) & phases.mask) === (value ? 0n : phases.mask))
    throw new BoardError(`the board has PHASE_IDLE = ${value ? 0 : 1}, the RTL of this page ${value}; use openppmc selftest`);
}

function put(core: Core, part: PartData, pin: Pin, value: bigint): void {
  if (pin.name === "rst_n") {
    core.put(words(part.inputs), Number(value));
    return;
  }
  for (let n = 0; n < pin.count; n++) core.put(pin.word + n, Number((value >> BigInt(32 * n)) & 0xffffffffn));
}

function layout(part: PartData): Pin[] {
  let shift = 0;
  return part.recorder.map(([name, width]) => {
    const input = part.inputs.find((port) => port.name === name);
    const port = input ?? part.outputs.find((one) => one.name === name);
    const count = Math.ceil(width / 32);
    const mask = (1n << BigInt(width)) - 1n;
    const pin = { name, shift: BigInt(shift), mask, word: port?.word ?? 0, count, input: !!input || name === "rst_n" };
    shift += width;
    return pin;
  });
}

/** Return the cycle of the first change of an output in these rows, -1 if there is none. */
function firstOutput(rows: Uint8Array): number {
  const view = new DataView(rows.buffer, rows.byteOffset, rows.byteLength);
  for (let at = 0; at < rows.length; at += ROW) if (view.getUint32(at + 8, true) < INPUT) return view.getFloat64(at, true);
  return -1;
}
