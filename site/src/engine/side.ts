// Access to the pins of a part by name. Actions of a host are generators that yield the waiting times.

import type { LogEntry, PartData, Port } from "../types";
import type { Core } from "./core";
import { TextError } from "./text";

/** Wait for `clk` cycles, or at most until an event whose bit is set in `until` (STEP, CHANGE in core.ts). */
export interface Wait {
  clk: number;
  until: number;
}
export type Doing<T = void> = Generator<Wait, T, void>;

interface Place {
  port: Port;
  bit: number; // -1: the whole port
}

/** Positions: start of the carriage, CCW limit, slow CCW, origin, slow CW, CW limit. */
export const MACHINE: readonly number[] = [500, -300, -150, 0, 1850, 2000];
const PIN = /^(\w+)(?:\[(\d+)\])?$/;

export class Side {
  private readonly inputs = new Map<string, Port>();
  private readonly outputs = new Map<string, Port>();
  /** Levels that the host sets; in addition, the machine may close switches. */
  readonly levels = new Map<string, bigint>();
  log: LogEntry[] = [];
  /** First cycle of the current access, and the line of its statement. */
  from = 0;
  line = 0;
  status = -1;
  mark: number[] = [];
  machine = false;
  places: number[] = [...MACHINE];

  constructor(
    readonly core: Core,
    readonly part: PartData,
  ) {
    for (const port of part.inputs) this.inputs.set(port.name, port);
    for (const port of part.outputs) this.outputs.set(port.name, port);
  }

  powerUp(): void {
    this.core.powerUp();
    this.levels.clear();
    for (const port of this.part.inputs) this.levels.set(port.name, joined(port.idle));
    this.log = [];
    this.status = -1;
    this.markPulses();
  }

  /** Convert cycles of the text to cycles of the build. */
  cycles(n: number): number {
    return Math.round((n * this.part.clkHz) / this.part.textHz);
  }

  private find(pin: string, ports: Map<string, Port>, what: string): Place {
    const found = PIN.exec(pin);
    const port = found ? ports.get(found[1]!) : undefined;
    if (!found || !port) throw new TextError(`${this.part.title} has no ${what} ${pin}`);
    if (found[2] === undefined) return { port, bit: -1 };
    const bit = Number(found[2]) - port.lowest;
    if (bit < 0 || bit >= port.width) throw new TextError(`${this.part.title} has no ${what} ${pin}`);
    return { port, bit };
  }

  set(pin: string, level: number | bigint): void {
    if (pin === "rst_n") {
      this.core.put(words(this.part.inputs), Number(level));
      return;
    }
    const { port, bit } = this.find(pin, this.inputs, "input");
    const width = bit < 0 ? port.width : 1;
    if (level < 0 || BigInt(level) >> BigInt(width))
      throw new TextError(`${pin} has ${width} bit(s): ${level} is out of range`);
    const old = this.levels.get(port.name)!;
    const value = bit < 0 ? BigInt(level) : (old & ~(1n << BigInt(bit))) | (BigInt(level) << BigInt(bit));
    this.levels.set(port.name, value);
    for (let n = 0; n * 32 < port.width; n++)
      this.core.put(port.word + n, Number((value >> BigInt(32 * n)) & 0xffffffffn));
  }

  private waves = 0;
  private readonly waving = new Map<string, number>();
  /** Start a square wave; period 0 stops it. */
  wave(pin: string, period: number): void {
    const { port, bit } = this.find(pin, this.inputs, "input");
    if (port.width > 1 && bit < 0) throw new TextError(`${pin} has ${port.width} bits; write one bit, as ${pin}[1]`);
    if (period !== 0 && period < 4) throw new TextError("period: too short; write 4 cycles or more, or 0");
    const number = this.waving.get(pin) ?? this.waves++ % 4;
    this.waving.set(pin, number);
    this.set(pin, 0);
    const at = Math.max(bit, 0);
    const high = period >> 1;
    this.core.wave(number, port.word + (at >> 5), (1 << (at & 31)) >>> 0, period - high, high);
  }

  sets(levels: Record<string, number>): void {
    for (const [pin, level] of Object.entries(levels)) this.set(pin, level);
  }

  level(pin: string): number {
    const { port, bit } = this.find(pin, this.outputs, "output");
    if (bit >= 0) return (this.core.output(port.word + (bit >> 5)) >>> (bit & 31)) & 1;
    return this.core.output(port.word);
  }

  *clocks(clk: number): Doing {
    if (clk > 0) yield { clk, until: 0 };
  }

  /** Start to count the pulses. */
  markPulses(): void {
    this.mark = this.part.motors.map((_, axis) => this.core.steps(axis));
  }
  pulses(axis: number): number {
    return this.core.steps(axis) - this.mark[axis]!;
  }

  /** Add a log entry. For an answer, `more.bad` states whether it differs from the value in the text. */
  note(kind: string, text: string, words: string, more: Partial<LogEntry> = {}): void {
    const answer = more.bad === undefined ? {} : { answer: true };
    this.log.push({ from: this.from, t: this.core.now, line: this.line, kind, text, words, ...more, ...answer });
  }
}

export function words(ports: readonly Port[]): number {
  return ports.reduce((sum, port) => sum + Math.ceil(port.width / 32), 0);
}

function joined(parts: readonly number[]): bigint {
  return parts.reduce((sum, part, n) => sum | (BigInt(part >>> 0) << BigInt(32 * n)), 0n);
}

export function hex(byte: number, digits = 2): string {
  return byte.toString(16).toUpperCase().padStart(digits, "0");
}
