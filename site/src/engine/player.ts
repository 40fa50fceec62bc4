// Plays a session on a part: executes statements in order and timed presses of switches, and runs the clock.

import type { PartData } from "../types";
import { makeHost } from "./hosts";
import { Core, STEP } from "./core";
import type { Host } from "./host";
import { MACHINE, Side, type Doing, type Wait } from "./side";
import { statements, TextError, type Statement } from "./text";

const REST = 0.045; // s; a part is at rest when its motors have not stepped for this time

export class Player {
  readonly side: Side;
  private readonly host: Host;
  private todo: Statement[] = [];
  /** Statements that are executed in a given cycle, regardless of the present statement of the host. */
  private timed: Statement[] = [];
  private doing: Doing | undefined;
  private waits: Wait | undefined;
  private stepsAtRest = 0;
  private restFrom = 0;
  line = 0;

  constructor(
    readonly core: Core,
    part: PartData,
  ) {
    this.side = new Side(core, part);
    this.host = makeHost(this.side);
    this.powerUp();
  }

  private powerUp(): void {
    this.core.plant(false);
    this.side.machine = false;
    this.side.part.motors.forEach((_, axis) => this.core.place(axis, [0, ...MACHINE.slice(1)]));
    this.side.powerUp();
  }

  /** Play a text from power-up on. Throws TextError for an invalid text. */
  start(text: string): void {
    const all = statements(text).map((one) => (one.at < 0 ? one : { ...one, at: this.side.cycles(one.at) }));
    for (const one of all)
      if (!(one.words[0]! in this.host.verbs))
        throw new TextError(`line ${one.line}: no such statement: ${one.words[0]}`);
    const pressed = (one: Statement): boolean => one.at >= 0 && ["set", "machine"].includes(one.words[0]!);
    this.todo = all.filter((one) => !pressed(one));
    this.timed = all.filter(pressed).sort((a, b) => a.at - b.at);
    this.powerUp();
    this.doing = this.host.begin();
    this.waits = undefined;
    this.line = 0;
    this.stir();
  }

  /** Append statements to the pending ones. */
  send(text: string): void {
    const more = statements(text);
    for (const one of more)
      if (!(one.words[0]! in this.host.verbs)) throw new TextError(`no such statement: ${one.words[0]}`);
    this.todo.push(...more.map((one) => ({ ...one, line: 0 })));
    this.stir();
  }

  /** Restart the time until the part is at rest. */
  stir(): void {
    this.restFrom = this.core.now;
  }

  /** Whether all statements have been executed. */
  get over(): boolean {
    return !this.doing && !this.todo.length && !this.timed.length && !this.waits;
  }

  /** Whether an output of the part indicates a motion. Between two pulses of a slow motor, the steps do not. */
  private get moving(): boolean {
    const { side } = this;
    const [hold, down] = ["hold", "cd_n"].map((name) => side.part.outputs.find((port) => port.name === name));
    if (hold) return side.level("hold") !== 2 ** hold.width - 1;
    // CD* is asserted after a motion, but not before the first one.
    return down !== undefined && side.level("cd_n") === 1 && side.pulses(0) > 0;
  }

  /** Whether all statements have been executed, no motor has stepped for REST, and no motion is in progress. */
  get resting(): boolean {
    if (!this.over) return false;
    const steps = this.side.part.motors.reduce((sum, _, axis) => sum + this.core.steps(axis), 0);
    if (steps !== this.stepsAtRest) {
      this.stepsAtRest = steps;
      this.restFrom = this.core.now;
    }
    return this.core.now - this.restFrom > REST * this.side.part.clkHz && !this.moving;
  }

  /** Run up to `most` cycles and return their number. With `step`, stop at a step of a motor; with `strict`, stop at
   * the end of the text. */
  advance(most: number, step: boolean, strict = false): number {
    this.pressDue();
    while (!this.waits && this.think()) continue;
    if (strict && !this.waits) return 0;
    let clk = Math.min(most, this.waits ? this.waits.clk : most);
    if (this.timed.length) clk = Math.min(clk, this.timed[0]!.at - this.core.now);
    const until = (this.waits ? this.waits.until : 0) | (step ? STEP : 0);
    const ran = this.core.run(clk, until);
    if (this.waits) {
      this.waits.clk -= ran;
      // A wait for an event ends whenever the part has stopped early; the statement then checks its condition.
      if (this.waits.clk <= 0 || this.waits.until) this.waits = undefined;
    }
    return ran;
  }

  /** Execute immediately the statements of a text; they must need no time. */
  press(text: string): void {
    statements(text).forEach((one) => this.atOnce(one));
  }

  private pressDue(): void {
    while (this.timed.length && this.timed[0]!.at <= this.core.now) this.atOnce(this.timed.shift()!);
  }

  private atOnce(one: Statement): void {
    const { from, line } = this.side; // first cycle and line of the access that the host is executing
    const doing = this.host.statement(one);
    while (!doing.next().done) continue;
    Object.assign(this.side, { from, line });
    this.stir();
  }

  /** Execute the host until its next wait; return false if no statement is left. */
  private think(): boolean {
    if (!this.doing) {
      const one = this.todo.shift();
      if (!one) return false;
      this.line = one.line;
      this.doing = this.host.statement(one);
    }
    try {
      const next = this.doing.next();
      if (next.done) {
        this.doing = undefined;
        if (!this.todo.length) this.stir();
      } else this.waits = { ...next.value };
    } catch (error) {
      this.doing = undefined;
      this.todo = [];
      const where = this.line ? `line ${this.line}: ` : "";
      throw error instanceof TextError ? new TextError(where + error.message) : error;
    }
    return true;
  }
}
