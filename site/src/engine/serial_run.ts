// Runs a session on a board, and stops its motors.

import type { PartData } from "../types";
import { BoardError, type Link, Lost, message, word } from "./serial_link";
import {
  type BoardRow,
  busyBits,
  type Op,
  type Pause,
  type Poll,
  pinsOps,
  positionOps,
  statusOps,
  type Step,
  stopScripts,
  Translator,
} from "./serial_steps";
import { hex } from "./side";

const TIMEOUT = 0x04;
const RESET = 0x05;
const STRAPS = 0x07;
const ZERO = [0x09, 0x0b];
const RECORD = 0x0d;
const WAIT_MS = 40; // time limit of one wait operation of the bridge
const WAITS = 3; // wait operations in a frame; Stop is sent after the frame
const MOST_SCRIPT = 253;
const MOST_DATA = 256;
const POSITIONS_MS = 100; // time between two reads of the positions
const STOP_MS = 60; // an axis that is still busy this time after an immediate stop has not stopped
const STOP_HOLD_MS = 150; // the same for a part whose HOLD is asserted 100 ms after the end of a motion
const XTAL_HZ = 16e6; // crystal for which these times apply
const HOLD = 2;
const POLL_MS = 2;
const GAP = 4; // NOPs before a wait that reads only once; in this time, a part with FAST timing accepts a byte
const ASLEEP_MS = 3_000; // if the time between two steps of this program is longer, the page was suspended
const SETTLE_MS = 5;

/** The reader or the page has stopped the session. */
export class Stopped extends BoardError {}

const sleep = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

export class Run {
  readonly rows: BoardRow[] = [];
  positions: number[];
  line = 0;
  /** The text has ended; the motors may still move. */
  over = false;
  /** All answers of the text have arrived, in ms after the start. */
  answered = 0;
  private readonly steps: Step[];
  private readonly firstStraps: number;
  private readonly straps: number;
  private stopping = "";
  private begun = 0;
  private last = 0;
  private asked = 0;

  /** Convert the text; nothing is sent. Throws TextError.
   *
   * record: record all pins; a wait of the bridge then reads once, because each read needs records.
   * changed: called when a row or a position is new. */
  constructor(
    private readonly link: Link,
    readonly part: PartData,
    text: string,
    private readonly record = false,
    private readonly changed: () => void = () => undefined,
  ) {
    this.positions = part.motors.map(() => 0);
    const translator = new Translator(part, text, record ? GAP : 0, (row) => this.rows.push(row));
    this.steps = translator.translate(text);
    this.firstStraps = translator.firstStraps;
    this.straps = translator.straps;
  }

  get counted(): boolean {
    return this.part.bus === "window" || this.link.identity.counter;
  }

  /** Reset the part and execute the text; return when the motors are at rest. Each error stops the motors. */
  async play(): Promise<void> {
    const zero = this.part.bus !== "window" && this.counted ? ZERO.slice(0, this.link.identity.axes) : [];
    try {
      await this.ask([STRAPS, this.firstStraps, ...(this.record ? [RECORD, 1] : []), RESET, ...zero]);
      if (this.link.identity.datasheet) await sleep(SETTLE_MS);
      this.begun = this.last = performance.now();
      await this.execute();
      this.answered = performance.now() - this.begun;
      this.over = true;
      this.changed();
      await this.rest();
    } catch (error) {
      if (!(error instanceof Lost))
        await this.halt().catch((failed: unknown) => {
          throw new BoardError(`${message(error)}; the stop was not confirmed (${message(failed)}): switch the driver off`);
        });
      throw error;
    }
  }

  /** Stop the session and its motors as soon as the present request has been answered. */
  stop(why: string): void {
    this.stopping ||= why;
  }

  /** Stop all motors immediately; if a motor still moves afterwards, reset the part. */
  async halt(): Promise<void> {
    await stopMotors(this.link, this.part);
    if (this.counted) this.positions = await positions(this.link, this.part);
    this.changed();
  }

  private async execute(): Promise<void> {
    const todo = [...this.steps];
    while (todo.length) {
      const next = todo[0]!;
      this.line = next.line;
      if ("pause" in next) {
        todo.shift();
        await this.pause(next);
      } else if ("done" in next) {
        todo.shift();
        await this.poll(next);
      } else await this.frame(todo);
      this.changed();
    }
  }

  /** Send a request, unless the session is being stopped. */
  private async ask(script: number[], duration = 0): ReturnType<Link["request"]> {
    const now = performance.now();
    if (this.last && now - this.last > ASLEEP_MS) this.stop(`this page has slept for ${((now - this.last) / 1e3).toFixed(1)} s`);
    this.last = now;
    if (this.stopping) throw new Stopped(this.stopping);
    const answer = await this.link.request(script, duration);
    this.last = performance.now();
    // 1: a wait has reached its limit; 5: a repeated request or noise has ended a wait. The wait is then repeated.
    if (answer.result > 1 && answer.result !== 5)
      throw new BoardError(`the board rejects an operation (result ${answer.result}); the bitstream does not match this page`);
    return answer;
  }

  /** Execute the next operations, up to the size of a frame. */
  private async frame(todo: Step[]): Promise<void> {
    const ops: Op[] = [];
    let [size, gives, waits] = [3, 0, 0];
    for (const one of todo) {
      if ("pause" in one || "done" in one) break;
      waits += (one.patience ?? 0) > 1_000 ? 1 : 0;
      size += one.bytes.length;
      gives += one.gives;
      if (size > MOST_SCRIPT || gives > MOST_DATA || waits > WAITS) break;
      ops.push(one);
      if (one.ends) break;
    }
    const limit = this.record ? 0 : WAIT_MS;
    const answer = await this.ask([TIMEOUT, limit, 0, ...ops.flatMap((one) => one.bytes)], ops.length * limit);
    let [at, from] = [3, 0];
    for (const one of ops) {
      at += one.bytes.length;
      if (answer.result && answer.at < at) {
        this.again(one, answer.last);
        if (this.record) await sleep(WAIT_MS);
        break;
      }
      todo.shift();
      const more = one.take?.(answer.data.slice(from, from + one.gives));
      if (more) todo.unshift(...more);
      from += one.gives;
    }
    await this.update();
  }

  private readonly since = new Map<Op, number>();
  /** Throw an error if this operation has been repeated for longer than its `patience`. */
  private again(op: Op, last: number): void {
    const first = this.since.get(op) ?? performance.now() - WAIT_MS;
    this.since.set(op, first);
    const patience = op.patience ?? WAIT_MS;
    if (performance.now() - first > patience)
      throw new BoardError(
        `line ${op.line}: ${op.event} does not occur within ${(patience / 1e3).toFixed(0)} s; the part reads ${hex(last)}`,
      );
  }

  private async poll(poll: Poll): Promise<void> {
    for (;;) {
      const { data } = await this.ask(poll.bytes);
      if (poll.done(data)) return;
      this.again(poll, data[0] ?? 0);
      await sleep(POLL_MS);
      await this.update();
    }
  }

  private async pause(one: Pause): Promise<void> {
    const end = (one.since ? this.begun : performance.now()) + one.pause;
    for (let left = one.pause; (left = end - performance.now()) > 0; ) {
      await sleep(Math.min(left, WAIT_MS));
      if (left > WAIT_MS) await this.update();
    }
  }

  private async update(): Promise<void> {
    if (!this.counted || performance.now() - this.asked < POSITIONS_MS) return;
    this.asked = performance.now();
    this.positions = parsePositions((await this.ask(askPositions(this.part))).data);
    this.changed();
  }

  /** Wait until all motors are at standstill (HOLD is high). */
  private async rest(): Promise<void> {
    const script = [...(this.counted ? askPositions(this.part) : []), ...pinsOps(this.part, this.straps)];
    const size = this.counted ? 4 * this.part.motors.length : 0;
    for (;;) {
      const { data } = await this.ask(script);
      const before = this.positions.join();
      if (size) this.positions = parsePositions(data.slice(0, size));
      if (this.positions.join() !== before) this.changed();
      if (data.slice(size).every((pins) => pins & HOLD)) return;
      await sleep(POLL_MS);
    }
  }
}

function askPositions(part: PartData): number[] {
  return part.motors.flatMap((_, axis) => positionOps(part, axis));
}

function parsePositions(data: readonly number[]): number[] {
  return Array.from({ length: data.length >> 2 }, (_, axis) => word(data, 4 * axis) | 0);
}

/** Return the positions of all axes in pulses. */
export async function positions(link: Link, part: PartData): Promise<number[]> {
  return parsePositions((await link.request(askPositions(part))).data);
}

/** Stop all motors immediately; if the part does not report their standstill, reset it. */
export async function stopMotors(link: Link, part: PartData): Promise<void> {
  for (const script of stopScripts(part)) await link.request(script);
  const patience = part.bus === "block" ? STOP_HOLD_MS : STOP_MS;
  const end = performance.now() + (patience * XTAL_HZ) / link.identity.xtalHz;
  while (!(await stopped(link, part))) {
    if (performance.now() > end) {
      await link.request([RESET]);
      return;
    }
    await sleep(POLL_MS);
  }
}

/** Return whether no axis executes an operation.
 *
 * Positions cannot answer this: a slow motor outputs a pulse in four seconds. BUSY and HOLD have the state of the whole
 * motion, and a part with BUSY need not wait for HOLD. */
async function stopped(link: Link, part: PartData): Promise<boolean> {
  const block = part.bus === "block";
  const { data } = await link.request(block ? pinsOps(part, 0xff) : statusOps(part));
  return data.every((value) => (block ? value & HOLD : !(value & busyBits(part))));
}
