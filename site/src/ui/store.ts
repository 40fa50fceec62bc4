// All changes of all pins since power-up, for waves, speed and VCD.

import type { LogEntry, PartData, Port } from "../types";
import { ROW } from "../engine/core";
import { Speed } from "../engine/speeds";

const INPUT = 1 << 16;
const STEP = 1 << 17;
const MOST = 524_288; // changes of a pin, a power of two; with more changes, the older half is discarded
const MOST_OF_ALL = 2_000_000; // changes of all pins together; a change needs 12 bytes
/** Log entries that only read; they cannot start or end a move. */
export const READS = new Set(["st", "r", "<", "get", "axis", "count", "?", "!"]);

export class Track {
  times = new Float64Array(256);
  values = new Uint32Array(256);
  count = 0;
  /** Whether the oldest changes of the track have been discarded. */
  cut = false;

  add(t: number, value: number): void {
    if (this.count && this.times[this.count - 1] === t) {
      this.values[this.count - 1] = value;
      return;
    }
    if (this.count === this.times.length) this.grow();
    this.times[this.count] = t;
    this.values[this.count++] = value;
  }

  private grow(): void {
    if (this.count >= MOST) {
      this.halve();
      return;
    }
    const times = new Float64Array(2 * this.times.length);
    const values = new Uint32Array(2 * this.values.length);
    times.set(this.times);
    values.set(this.values);
    this.times = times;
    this.values = values;
  }

  /** Discard the older half of the changes. */
  halve(): void {
    const half = this.count >> 1;
    this.times.copyWithin(0, half);
    this.values.copyWithin(0, half);
    this.count -= half;
    this.cut = true;
  }

  /** Return the index of the last change at or before t; -1 before the first change. */
  at(t: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= t) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }
}

/** Row of the waves: one bit, or all bits of a bus. */
export interface Row {
  name: string;
  track: Track;
  /** Position of the row's bits in the words of a frame. */
  word: number;
  shift: number;
  mask: number;
  width: number;
  input: boolean;
}

/** Word of the module, with the rows of its bits. */
interface Word {
  value: number;
  whole: Row | undefined;
  bits: Row[];
}

export class Store {
  readonly rows: Row[] = [];
  readonly speeds: Speed[] = [];
  private readonly words: { inputs: Word[]; outputs: Word[] } = { inputs: [], outputs: [] };
  private readonly names = new Map<string, Row>();
  end = 0;

  constructor(readonly part: PartData) {
    this.clear();
  }

  clear(): void {
    this.rows.length = this.speeds.length = this.words.inputs.length = this.words.outputs.length = 0;
    this.names.clear();
    this.end = 0;
    for (const port of this.part.inputs) this.lay(port, true);
    for (const port of this.part.outputs) this.lay(port, false);
    for (const _ of this.part.motors) this.speeds.push(new Speed(this.part.clkHz));
  }

  private lay(port: Port, input: boolean): void {
    const words = port.idle.map((value): Word => ({ value: value >>> 0, whole: undefined, bits: [] }));
    this.words[input ? "inputs" : "outputs"].push(...words);
    const bus = /^(d_[io]|sd_[io]|a|sa|rs|phase_._ref|adc_data|bemf_level)$/.test(port.name);
    if (bus || port.width === 1) {
      const mask = port.width >= 32 ? 0xffffffff : 2 ** port.width - 1;
      words[0]!.whole = this.row(port, port.name, 0, mask, port.width, input);
      return;
    }
    for (let bit = 0; bit < port.width; bit++)
      words[bit >> 5]!.bits.push(this.row(port, `${port.name}[${bit + port.lowest}]`, bit, 1, 1, input));
  }

  private row(port: Port, name: string, bit: number, mask: number, width: number, input: boolean): Row {
    const shift = bit & 31;
    const track = new Track();
    track.add(-1, ((port.idle[bit >> 5]! >>> shift) & mask) >>> 0);
    const row = { name, track, word: port.word + (bit >> 5), shift, mask, width, input };
    this.rows.push(row);
    this.names.set(`${input ? "i" : "o"} ${name}`, row);
    return row;
  }

  /** Add the rows of a frame (core.cpp) and the log entries of the same time. */
  take(block: ArrayBuffer, end: number, log: readonly LogEntry[]): void {
    const view = new DataView(block);
    const writes = log.filter((one) => !READS.has(one.kind) && !(one.kind === "f" && one.text[0] === "j"));
    let written = 0;
    for (let at = 0; at + ROW <= block.byteLength; at += ROW) {
      const t = view.getFloat64(at, true);
      const pin = view.getUint32(at + 8, true);
      const value = view.getUint32(at + 12, true);
      if (pin < STEP) {
        change(pin < INPUT ? this.words.outputs[pin] : this.words.inputs[pin - INPUT], t, value);
        continue;
      }
      while (written < writes.length && writes[written]!.t <= t) {
        written++;
        for (const speed of this.speeds) speed.write();
      }
      this.speeds[pin - STEP]?.step(t, value);
    }
    if (written < writes.length) for (const speed of this.speeds) speed.write();
    this.end = end;
    this.bound();
  }

  private bound(): void {
    const all = this.rows.reduce((sum, row) => sum + row.track.count, 0);
    if (all < MOST_OF_ALL) return;
    const tracks = this.rows.map((row) => row.track);
    tracks.reduce((most, one) => (one.count > most.count ? one : most)).halve();
  }

  find(name: string, input: boolean): Row | undefined {
    return this.names.get(`${input ? "i" : "o"} ${name}`);
  }
}

function change(word: Word | undefined, t: number, value: number): void {
  if (!word) return;
  if (word.whole) word.whole.track.add(t, (value & word.whole.mask) >>> 0);
  for (let left = word.bits.length ? word.value ^ value : 0; left; left &= left - 1) {
    const bit = 31 - Math.clz32(left & -left);
    word.bits[bit]?.track.add(t, (value >>> bit) & 1);
  }
  word.value = value;
}

/** Return the level of a row in the words of a frame. */
export function level(row: Row, words: readonly number[]): number {
  return (((words[row.word] ?? 0) >>> row.shift) & row.mask) >>> 0;
}
