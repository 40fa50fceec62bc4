// Converts the statements of a session to operations of the UART bridge (docs/uart_bridge.md, Ops).

import type { PartData } from "../types";
import { answerWords, blockWords, bytes } from "./blocks";
import { Explainer } from "./explain";
import { word } from "./serial_link";
import { hex } from "./side";
import { byte, clks, isByte, statements, TextError, whole } from "./text";

/** Operation of the bridge. */
export interface Op {
  line: number;
  bytes: number[];
  /** Number of data bytes in the answer. */
  gives: number;
  /** Function that receives the data of the answer, and returns the operations to execute next. */
  take?: (data: number[]) => Op[] | void;
  /** Time in ms for which an operation that waits may be repeated; `event` is the text of what it waits for. */
  patience?: number;
  event?: string;
  /** True: the next operation is sent only after `take` has processed the data of this one. */
  ends?: boolean;
}
/** Repeat the operation until `done` accepts its data. */
export interface Poll extends Op {
  done: (data: number[]) => boolean;
}
/** Wait for `pause` ms, or, if `since` is true, until `pause` ms after the start. */
export interface Pause {
  line: number;
  pause: number;
  since: boolean;
}
export type Step = Op | Poll | Pause;

/** Row of the log of a board. */
export interface BoardRow {
  line: number;
  kind: string;
  text: string;
  words: string;
  /** The row is an answer that is compared with that of the simulation. */
  answer: boolean;
  bad: boolean;
}

const MAILBOX_MS = 1_000; // longest time until the part accepts or returns a byte
const EVENT_MS = 600_000; // longest time of a motion; it may be long, because Stop can end it
const OBF = 1;
const IBF = 2;
const MWEF = 0x08;
const MREF = 0x04;
const PINS = 0x06;
const RESET = 0x05;
const STRAPS = 0x07;
const SELECT = 3;
const POSITION = 4;
const WINDOW = 0x20;
const MACHINE = "the board has a real machine";

/** Pins that the bridge can set to 0, by the bit of STRAPS. */
const STRAP_BITS: Record<string, readonly string[]> = {
  ppmc104: ["csel", "vsel"],
  ppmc2104: ["csel[1]", "csel[2]", "run[1]", "run[2]", "errint_n"],
  ppmc312: ["run", "evt0_n", "evt1_n"],
};

export const write = (register: number, value: number): number[] => [0x10 | register, value];
const waitFor = (register: number, mask: number, value: number): number[] => [0x70 | register, mask, value];
export const read = (register: number): number[] => [0x20 | register];
const signed = (data: readonly number[]): number => word(data) | 0;

/** Operations that read the position of an axis (from 0), and the conversion of their data. */
export function positionOps(part: PartData, axis: number): number[] {
  if (part.bus !== "window") return [axis ? 0x0a : 0x08];
  return [...write(SELECT, axis), ...[0, 1, 2, 3].flatMap((n) => read(POSITION + n))];
}

/** Script that reads PINS of each axis; bit 1 is HOLD. straps: the present levels of the strap outputs. */
export function pinsOps(part: PartData, straps: number): number[] {
  if (part.bus === "window") return part.motors.flatMap((_, axis) => [...write(SELECT, axis), PINS]);
  if (part.motors.length === 1) return [PINS];
  return [STRAPS, straps | 0x80, PINS, STRAPS, straps & 0x7f, PINS, STRAPS, straps];
}

/** Script that reads the status register; a part with a window has one for each axis. */
export function statusOps(part: PartData): number[] {
  if (part.bus !== "window") return read(1);
  return part.motors.flatMap((_, axis) => [...write(SELECT, axis), ...read(1)]);
}

/** Bits of a status that are 1 until the part has executed all bytes and the motion has ended. */
export const busyBits = (part: PartData): number => Number(part.style.busy) | IBF;

/** Scripts that stop all motors immediately. They read no register, and work in any state of the part. */
export function stopScripts(part: PartData): number[][] {
  if (part.bus === "block") return [[...write(2, WINDOW), ...write(3, WINDOW - 4), 0x85, 4, 0x00, 0x80, 0x02, 0x03]];
  if (part.bus === "window") return [part.motors.flatMap((_, axis) => [...write(SELECT, axis), ...write(1, 0x40)])];
  return part.motors.map((_, axis) => write(1, 0x40 | (axis << 5)));
}

export class Translator {
  /** The latest positions by axis. */
  positions: number[];
  private readonly marks: number[];
  private readonly explainers = new Map<number, Explainer>();
  private axis = 0;
  /** Levels of the strap outputs before and after the text. */
  readonly firstStraps: number;
  straps: number;
  private line = 0;
  private steps: Step[] = [];
  private readonly counted: boolean;

  /** Convert the text. Throws TextError for a statement that a board cannot execute. gap: NOPs before a wait. */
  constructor(
    private readonly part: PartData,
    text: string,
    private readonly gap: number,
    private readonly log: (row: BoardRow) => void,
  ) {
    this.positions = part.motors.map(() => 0);
    this.marks = [...this.positions];
    this.counted = /\bpulse\b/.test(text);
    // With a recorder, strap output 0 of an STMC stops the step clock of the board, whose edges would fill the memory.
    const still = part.name === "stmc" && !/\bclock\b/.test(text);
    this.straps = this.firstStraps = still ? 0xfe : 0xff;
  }

  translate(text: string): Step[] {
    this.steps = [];
    for (const one of statements(text)) {
      this.line = one.line;
      try {
        if (one.at >= 0) this.steps.push({ line: this.line, pause: (one.at * 1e3) / this.part.textHz, since: true });
        let rest = one.words;
        while (rest.length) rest = this.verb(rest[0]!, rest.slice(1));
      } catch (error) {
        throw error instanceof TextError ? new TextError(`line ${one.line}: ${error.message}`) : error;
      }
    }
    return this.steps;
  }

  private verb(verb: string, words: string[]): string[] {
    const byBus: Record<string, Record<string, (words: string[]) => string[]>> = {
      block: {
        w: (words) => this.writeRegister(words),
        r: (words) => this.readRegister(words, "r"),
        ">": (words) => this.block(words),
        "<": (words) => this.response(words),
        count: (words) => this.count(words),
      },
      byte: {
        c: (words) => this.command(words, true),
        w: (words) => this.command(words, false),
        d: (words) => this.data(words),
        r: (words) => this.readData(words),
        st: (words) => this.readStatus(words),
        p: (words) => this.event(words.slice(1), 1, 0xff, byte(words[0]), `status ${words[0]}`),
        idle: (words) => this.event(words, 1, Number(this.part.style.busy), 0, "BUSY = 0"),
      },
      window: {
        axis: (words) => this.select(words),
        put: (words) => this.writeRegister(words, "put"),
        get: (words) => this.readRegister(words, "get"),
      },
    };
    const common: Record<string, (words: string[]) => string[]> = {
      wait: (words) => this.pause(words),
      pulse: (words) => this.pulse(words),
      until: (words) => this.until(words),
      set: (words) => this.set(words),
      reset: (words) => this.reset(words),
      clock: (words) => this.clock(words),
      machine: (words) => this.machine(words),
    };
    const { bus } = this.part;
    const found = common[verb] ?? byBus[bus]?.[verb] ?? (bus === "window" ? byBus.byte![verb] : undefined);
    if (!found) throw new TextError(`no such statement: ${verb}`);
    return found(words);
  }

  private op(bytes: number[], gives = 0, take?: Op["take"], more: Partial<Op> = {}): void {
    const select = this.part.bus === "window" && bytes[0]! >= 0x10 ? write(SELECT, this.axis) : [];
    const nops = Array<number>(more.patience ? this.gap : 0).fill(0);
    const op: Op = { line: this.line, bytes: [...nops, ...select, ...bytes], gives, ...more };
    if (take) op.take = take;
    this.steps.push(op);
  }

  private wait(register: number, mask: number, value: number, event: string, patience = MAILBOX_MS): void {
    this.op(waitFor(register, mask, value), 1, undefined, { patience, event });
  }

  /** Return a function that logs a row with the present line. */
  private noted(kind: string, line = this.line): (text: string, words: string, expected?: string) => void {
    return (text, words, expected) => {
      const bad = expected !== undefined && expected !== text;
      const row = { line, kind, text, words: bad ? `${words} (the text expects ${expected})` : words };
      this.log({ ...row, answer: expected !== undefined || ["r", "st", "<", "get", "count"].includes(kind), bad });
    };
  }

  private get explainer(): Explainer {
    const known = this.explainers.get(this.axis) ?? new Explainer(this.part.words);
    this.explainers.set(this.axis, known);
    return known;
  }

  // Parts with a data register and a register for commands and status. The bank has a window of such registers.

  private command(words: string[], polled: boolean): string[] {
    const value = byte(words[0]);
    if (this.counted) this.mark();
    const { explainer } = this;
    const note = this.noted("c");
    this.op(write(1, value), 0, () => note(hex(value), explainer.command(value)));
    if (polled) this.wait(1, IBF, 0, "IBF = 0");
    return words.slice(1);
  }

  private data(words: string[]): string[] {
    const value = byte(words[0]);
    const { explainer } = this;
    const note = this.noted("d");
    this.op(write(0, value), 0, () => note(hex(value), explainer.data(value)));
    this.wait(1, IBF, 0, "IBF = 0");
    return words.slice(1);
  }

  private readData(words: string[]): string[] {
    const { explainer } = this;
    const note = this.noted("r");
    const wanted = isByte(words[0]) ? hex(parseInt(words[0], 16)) : undefined;
    this.wait(1, OBF, OBF, "OBF = 1");
    this.op(read(0), 1, ([value]) => note(hex(value!), explainer.answer(value!), wanted));
    return words.slice(wanted === undefined ? 0 : 1);
  }

  private readStatus(words: string[]): string[] {
    const { explainer } = this;
    const note = this.noted("st");
    const wanted = isByte(words[0]) ? hex(parseInt(words[0], 16)) : undefined;
    this.op(read(1), 1, ([value]) => note(hex(value!), explainer.status(value!), wanted));
    return words.slice(wanted === undefined ? 0 : 1);
  }

  private event(rest: string[], register: number, mask: number, value: number, event: string): string[] {
    this.wait(register, mask, value, event, EVENT_MS);
    return rest;
  }

  private select(words: string[]): string[] {
    const axis = whole(words[0], "axis");
    if (axis < 0 || axis >= this.part.motors.length) throw new TextError(`there is no axis ${axis}`);
    this.axis = axis;
    return words.slice(1);
  }

  // Registers, blocks

  private register(text: string | undefined, most: number): number {
    const register = whole(text, "register");
    if (register < 0 || register > most) throw new TextError(`there is no register ${register}`);
    return register;
  }

  private writeRegister(words: string[], kind = "w"): string[] {
    const register = this.register(words[0], kind === "w" ? 7 : 15);
    const value = byte(words[1]);
    const name = this.part.words.registers?.[`write ${register}`] ?? `register ${register}`;
    const note = this.noted(kind);
    this.op(write(register, value), 0, () => note(hex(value), name));
    return words.slice(2);
  }

  private readRegister(words: string[], kind: string): string[] {
    const register = this.register(words[0], kind === "r" ? 7 : 15);
    const wanted = isByte(words[1]) ? hex(parseInt(words[1], 16)) : undefined;
    const name = this.part.words.registers?.[`read ${register}`] ?? "";
    const status = kind === "r" && register === 0;
    const note = this.noted(status ? "st" : kind);
    this.op(read(register), 1, ([value]) =>
      note(hex(value!), status ? (this.part.words.status[value!] ?? "") : name, wanted),
    );
    return words.slice(wanted === undefined ? 1 : 2);
  }

  private block(words: string[]): string[] {
    const content = bytes(words);
    if (!content.length || content.length > WINDOW)
      throw new TextError(`block of ${content.length} bytes: wrong length; write 1 to ${WINDOW} bytes`);
    const note = this.noted(">");
    this.event([], 0, MWEF, 0, "MWEF = 0");
    const script = [...write(2, WINDOW), ...write(3, WINDOW - content.length), 0x85, content.length];
    this.op([...script, ...[...content].reverse()], 0, () =>
      note(content.map((one) => hex(one)).join(" "), blockWords(this.part.words, content)),
    );
    return [];
  }

  private response(words: string[]): string[] {
    const wanted = words.length ? bytes(words).map((one) => hex(one)).join(" ") : undefined;
    const note = this.noted("<");
    const { line } = this;
    this.event([], 0, MREF, 0, "an answer (MREF = 0)");
    const read1 = (data: number[]): void => {
      const content = [...data].reverse();
      note(content.map((one) => hex(one)).join(" "), answerWords(this.part.words, content), wanted);
    };
    this.op(
      read(3),
      1,
      ([left]) => {
        const count = 0x40 - left!;
        return count > 0 && count <= WINDOW ? [{ line, bytes: [0x37, count], gives: count, take: read1 }] : [];
      },
      { ends: true },
    );
    return [];
  }

  private count(words: string[]): string[] {
    const wanted = String(whole(words[0], "number of pulses"));
    const note = this.noted("count");
    this.op(positionOps(this.part, 0), 4, (data) => {
      note(String(Math.abs(signed(data) - this.marks[0]!)), "pulses", wanted);
      this.marks[0] = signed(data);
    });
    return words.slice(1);
  }

  // Statements of all parts

  private mark(): void {
    this.part.motors.forEach((_, axis) =>
      this.op(positionOps(this.part, axis), 4, (data) => void (this.marks[axis] = signed(data))),
    );
  }

  private pause(words: string[]): string[] {
    const pause = (clks(words[0], this.part.textHz) * 1e3) / this.part.textHz;
    this.steps.push({ line: this.line, pause, since: false });
    return words.slice(1);
  }

  private poll(bytes: number[], gives: number, event: string, done: (data: number[]) => boolean): void {
    this.steps.push({ line: this.line, bytes, gives, patience: EVENT_MS, event, done });
  }

  private pulse(words: string[]): string[] {
    const wanted = whole(words[0], "number of pulses");
    const named = /^\d+$/.test(words[1] ?? "");
    const first = Number(this.part.style.first);
    const axis = (named ? Number(words[1]) : first) - first;
    if (axis < 0 || axis >= this.part.motors.length) throw new TextError(`there is no axis ${axis + first}`);
    this.poll(positionOps(this.part, axis), 4, `pulse ${wanted}`, (data) => {
      return Math.abs(signed(data) - this.marks[axis]!) >= wanted;
    });
    return words.slice(named ? 2 : 1);
  }

  private until(words: string[]): string[] {
    const [pin = "", level] = words;
    const wanted = whole(level, "level");
    const name = this.part.bus === "block" ? "irq_n" : "int_n";
    if (pin !== name) throw new TextError(`until ${pin}: the page reads only ${name} of a board`);
    this.poll([PINS], 1, `${pin} = ${wanted}`, ([pins]) => (pins! & 1) === wanted);
    return words.slice(2);
  }

  private set(words: string[]): string[] {
    const bits = STRAP_BITS[this.part.name] ?? [];
    for (const item of words) {
      const [pin = "", level] = item.split("=");
      const value = whole(level, "level");
      const single = bits.indexOf(pin);
      const wide = bits.map((name, bit) => [name, bit] as const).filter(([name]) => name.startsWith(`${pin}[`));
      const places = single >= 0 ? [single] : wide.map(([, bit]) => bit);
      if (!places.length)
        throw new TextError(`set ${pin}: ${MACHINE}, so the page cannot set this input; run the text in the simulation`);
      places.forEach((bit, n) => {
        this.straps = (this.straps & ~(1 << bit)) | (((value >> n) & 1) << bit);
      });
    }
    const text = words.join(" ");
    const note = this.noted("pins");
    this.op([STRAPS, this.straps], 0, () => note(text, ""));
    return [];
  }

  private reset(words: string[]): string[] {
    const note = this.noted("reset");
    this.op([RESET], 0, () => note("", ""));
    return words;
  }

  private clock(words: string[]): string[] {
    if (this.part.name !== "stmc" || words[0] !== "ext_clk")
      throw new TextError(`clock ${words[0] ?? ""}: the page cannot apply a clock to a board; run the text in the simulation`);
    whole(words[1], "period in cycles");
    return words.slice(2);
  }

  private machine(words: string[]): string[] {
    if (words[0] !== "off") throw new TextError(`machine: ${MACHINE}; run the text in the simulation`);
    return [];
  }
}
