// A session on a part: statements one after the other, pressed switches in between, and the clock of all of it.

import type { PartData } from "../types";
import { makeHost } from "./hosts";
import { Core, STEP } from "./core";
import type { Host } from "./host";
import { MACHINE, Side, type Doing, type Wait } from "./side";
import { statements, TextError, type Statement } from "./text";

const REST = 0.045; // s without a step of a motor after which the part is said to rest

export class Player {
  readonly side: Side;
  private readonly host: Host;
  private todo: Statement[] = [];
  /** Pressed at a certain clk, whatever the host is doing then. */
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

  /** From power-up on. TextError for a text that is none. */
  start(text: string): void {
    const all = statements(text);
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

  /** More statements behind those that there are. */
  send(text: string): void {
    const more = statements(text);
    for (const one of more)
      if (!(one.words[0]! in this.host.verbs)) throw new TextError(`no such statement: ${one.words[0]}`);
    this.todo.push(...more.map((one) => ({ ...one, line: 0 })));
    this.stir();
  }

  /** Something has been done: the part does not rest. */
  stir(): void {
    this.restFrom = this.core.now;
  }

  /** All statements are done. */
  get over(): boolean {
    return !this.doing && !this.todo.length && !this.timed.length && !this.waits;
  }

  /** Nothing is to be done and no motor has moved for a while. */
  get resting(): boolean {
    if (!this.over) return false;
    const steps = this.side.part.motors.reduce((sum, _, axis) => sum + this.core.steps(axis), 0);
    if (steps !== this.stepsAtRest) {
      this.stepsAtRest = steps;
      this.restFrom = this.core.now;
    }
    return this.core.now - this.restFrom > REST * this.side.part.clkHz;
  }

  /** Up to so many clk; returns how many it was. With `step` no further than to a step of a motor, with `strict` no
   * further than the text goes. */
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
      // A wait for something is over whenever the part has stopped early: whoever waits looks for himself.
      if (this.waits.clk <= 0 || this.waits.until) this.waits = undefined;
    }
    return ran;
  }

  /** Statements that take no time, at once. */
  press(text: string): void {
    statements(text).forEach((one) => this.atOnce(one));
  }

  private pressDue(): void {
    while (this.timed.length && this.timed[0]!.at <= this.core.now) this.atOnce(this.timed.shift()!);
  }

  private atOnce(one: Statement): void {
    const doing = this.host.statement(one);
    while (!doing.next().done) continue;
    this.stir();
  }

  /** What the host does next, up to where it waits; false if it has nothing to do. */
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
