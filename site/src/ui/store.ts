// All changes of all pins since power-up, by word of 32 bits: what waves, speed and VCD are made of.

import type { PartData, Port } from "../types";
import { ROW } from "../engine/core";

const INPUT = 1 << 16;
const MOST = 2_000_000; // changes that a word keeps; the older half goes then

export class Track {
  times = new Float64Array(256);
  values = new Uint32Array(256);
  count = 0;
  /** Its oldest changes have gone. */
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
      const half = this.count >> 1;
      this.times.copyWithin(0, half);
      this.values.copyWithin(0, half);
      this.count -= half;
      this.cut = true;
      return;
    }
    const times = new Float64Array(2 * this.times.length);
    const values = new Uint32Array(2 * this.values.length);
    times.set(this.times);
    values.set(this.values);
    this.times = times;
    this.values = values;
  }

  /** Number of the last change at or before t; -1 before the first one. */
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

/** Rows of the waves: some bits of a word. */
export interface Row {
  name: string;
  track: Track;
  shift: number;
  mask: number;
  width: number;
  input: boolean;
}

export interface Speeds {
  t: number[];
  v: number[];
}

const MOST_SPEEDS = 20_000;

export class Store {
  readonly tracks: Track[] = [];
  readonly inputs: Track[] = [];
  readonly rows: Row[] = [];
  readonly speeds: Speeds[] = [];
  end = 0;

  constructor(readonly part: PartData) {
    this.clear();
  }

  clear(): void {
    this.tracks.length = this.inputs.length = this.rows.length = this.speeds.length = 0;
    this.end = 0;
    this.lay(this.part.inputs, this.inputs);
    this.lay(this.part.outputs, this.tracks);
    for (const port of this.part.inputs) this.row(port, true);
    for (const port of this.part.outputs) this.row(port, false);
    for (const _ of this.part.motors) this.speeds.push({ t: [], v: [] });
  }

  private lay(ports: readonly Port[], tracks: Track[]): void {
    for (const port of ports)
      for (const level of port.idle) {
        const track = new Track();
        track.add(-1, level >>> 0);
        tracks.push(track);
      }
  }

  private row(port: Port, input: boolean): void {
    const tracks = input ? this.inputs : this.tracks;
    const bus = /^(d_[io]|sd_[io]|a|sa|rs|phase_._ref|adc_data|bemf_level)$/.test(port.name);
    if (bus || port.width === 1) {
      const mask = port.width >= 32 ? 0xffffffff : 2 ** port.width - 1;
      this.rows.push({
        name: port.name,
        track: tracks[port.word]!,
        shift: 0,
        mask,
        width: port.width,
        input,
      });
      return;
    }
    for (let bit = 0; bit < port.width; bit++)
      this.rows.push({
        name: `${port.name}[${bit + port.lowest}]`,
        track: tracks[port.word + (bit >> 5)]!,
        shift: bit & 31,
        mask: 1,
        width: 1,
        input,
      });
  }

  /** Rows of a frame; see core.cpp. */
  take(block: ArrayBuffer, end: number): void {
    const view = new DataView(block);
    for (let at = 0; at + ROW <= block.byteLength; at += ROW) {
      const t = view.getFloat64(at, true);
      const pin = view.getUint32(at + 8, true);
      const value = view.getUint32(at + 12, true);
      const track = pin >= INPUT ? this.inputs[pin - INPUT] : this.tracks[pin];
      track?.add(t, value);
    }
    this.end = end;
    this.part.motors.forEach((motor, axis) => this.measure(motor.step, axis));
  }

  private readonly seen: { at: number; level: number; pulse: number; gap: number; dir: number }[] = [];

  /** Speed over time from the pulses (or steps of phases) that have come. */
  private measure(pin: string, axis: number): void {
    const row = this.find(pin);
    const speed = this.speeds[axis]!;
    if (!row) return;
    if (!speed.t.length) {
      this.seen[axis] = {
        at: 0,
        level: (row.track.values[0]! >>> row.shift) & row.mask,
        pulse: -1,
        gap: 0,
        dir: -1,
      };
      speed.t.push(0);
      speed.v.push(0);
    }
    const seen = this.seen[axis]!;
    const turn = this.find(this.part.motors[axis]!.dir);
    const { edge } = this.part.motors[axis]!;
    for (; seen.at < row.track.count; seen.at++) {
      const level = (row.track.values[seen.at]! >>> row.shift) & row.mask;
      if (level === seen.level) continue;
      const stepped = row.mask > 1 ? level !== 0 && level !== row.mask : level === edge;
      seen.level = level;
      if (!stepped) continue;
      const t = row.track.times[seen.at]!;
      const gap = t - seen.pulse;
      const way = turn ? this.level(turn, t) : -1;
      // Between two ways there is no interval.
      if (seen.pulse >= 0) {
        if (gap < 0.1 * this.part.clkHz && way === seen.dir) {
          speed.t.push(seen.pulse / this.part.clkHz, t / this.part.clkHz);
          speed.v.push(this.part.clkHz / gap, this.part.clkHz / gap);
        } else this.stand(speed, seen.pulse, t);
      } else this.stand(speed, t, t);
      seen.pulse = t;
      seen.gap = gap;
      seen.dir = way;
    }
    if (speed.t.length > MOST_SPEEDS) {
      // Every second interval goes; the shape stays.
      const keep = (_: number, n: number): boolean => n % 4 < 2;
      speed.t = speed.t.filter(keep);
      speed.v = speed.v.filter(keep);
    }
  }

  private stand(speed: Speeds, from: number, to: number): void {
    speed.t.push(from / this.part.clkHz, to / this.part.clkHz);
    speed.v.push(0, 0);
  }

  /** Speed of an axis up to now: at rest behind its last pulse. */
  speed(axis: number): Speeds {
    const { t, v } = this.speeds[axis]!;
    const seen = this.seen[axis];
    if (!seen || seen.pulse < 0 || this.end - seen.pulse < 3 * Math.max(seen.gap, 1)) return { t, v };
    const rest = seen.pulse / this.part.clkHz;
    return { t: [...t, rest, this.end / this.part.clkHz], v: [...v, 0, 0] };
  }

  find(name: string): Row | undefined {
    const exact = this.rows.find((row) => row.name === name);
    if (exact) return exact;
    const port = this.part.outputs.find((one) => one.name === name);
    if (!port || port.width === 1) return undefined;
    return {
      name,
      track: this.tracks[port.word]!,
      shift: 0,
      mask: 2 ** Math.min(port.width, 31) - 1,
      width: port.width,
      input: false,
    };
  }

  level(row: Row, t: number): number {
    const index = row.track.at(t);
    return index < 0 ? 0 : ((row.track.values[index]! >>> row.shift) & row.mask) >>> 0;
  }
}
