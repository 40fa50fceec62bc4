// Statements of all hosts; cycle-accurate counterpart of tests/common/web/script.py.

import { CHANGE, STEP } from "./core";
import { MACHINE, type Doing, type Side } from "./side";
import { clks, TextError, whole, type Statement } from "./text";

export const PATIENCE = 400_000_000; // time limit of a statement in cycles of the text
const RESET = 16;

export type Verb = (words: string[]) => Doing<string[]>;

export class Host {
  readonly verbs: Record<string, Verb>;

  constructor(readonly side: Side) {
    this.verbs = {
      set: (words) => this.set(words),
      wait: (words) => this.wait(words),
      pulse: (words) => this.pulse(words),
      until: (words) => this.until(words),
      reset: (words) => this.reset(words),
      clock: (words) => this.clock(words),
      machine: (words) => this.machine(words),
    };
  }

  /** Wait from power-up to the first access. */
  *begin(): Doing {
    yield* this.side.clocks(this.side.cycles(Number(this.side.part.style.settle)));
  }

  *statement(one: Statement): Doing {
    const late = one.at - this.side.core.now;
    if (late > 0) yield* this.side.clocks(late);
    let rest = one.words;
    while (rest.length) {
      const verb = this.verbs[rest[0]!];
      if (!verb) throw new TextError(`no such statement: ${rest[0]}`);
      this.side.from = this.side.core.now;
      this.side.line = one.line;
      rest = yield* verb(rest.slice(1));
    }
  }

  *set(words: string[]): Doing<string[]> {
    if (!words.length) throw new TextError("set: no level; write set l1_n=0");
    for (const word of words) {
      const [pin, level, more] = word.split("=");
      if (!pin || !/^(0x[0-9a-f]+|\d+)$/i.test(level ?? "") || more !== undefined)
        throw new TextError(`${word}: not a level; write l1_n=0`);
      this.side.set(pin, BigInt(level!));
    }
    this.side.note("pins", words.join(" "), "");
    return [];
  }

  *wait(words: string[]): Doing<string[]> {
    yield* this.side.clocks(clks(words[0], this.side.part.clkHz, this.side.part.textHz));
    return words.slice(1);
  }

  *pulse(words: string[]): Doing<string[]> {
    const wanted = whole(words[0], "number of pulses");
    const named = /^\d+$/.test(words[1] ?? "");
    const first = Number(this.side.part.style.first);
    const axis = (named ? Number(words[1]) : first) - first;
    if (axis < 0 || axis >= this.side.part.motors.length)
      throw new TextError(`there is no axis ${axis + first}`);
    const end = this.side.core.now + this.side.cycles(PATIENCE);
    while (this.side.pulses(axis) < wanted) {
      if (this.side.core.now > end) throw new TextError(`only ${this.side.pulses(axis)} pulses before the time limit`);
      yield { clk: PATIENCE, until: STEP };
    }
    return words.slice(named ? 2 : 1);
  }

  *until(words: string[]): Doing<string[]> {
    const [pin = "", level] = words;
    const end = this.side.core.now + this.side.cycles(PATIENCE);
    while (this.side.level(pin) !== whole(level, "level")) {
      if (this.side.core.now > end) throw new TextError(`${pin} does not become ${level} before the time limit`);
      yield { clk: PATIENCE, until: CHANGE };
    }
    return words.slice(2);
  }

  *reset(words: string[]): Doing<string[]> {
    this.side.set("rst_n", 0);
    yield* this.side.clocks(RESET);
    this.side.set("rst_n", 1);
    yield* this.side.clocks(RESET);
    this.side.markPulses();
    this.side.note("reset", "", "");
    return words;
  }

  /** `clock ext_clk 329`: a square wave with this period in cycles of the text; 0 stops it. */
  *clock(words: string[]): Doing<string[]> {
    this.side.wave(words[0] ?? "", this.side.cycles(whole(words[1], "period in cycles")));
    return words.slice(2);
  }

  /** `machine on [start ccw slow_ccw origin slow_cw cw]`, `machine off`: machine of all axes. */
  *machine(words: string[]): Doing<string[]> {
    const { core, part } = this.side;
    if (words[0] !== "on" && words[0] !== "off") throw new TextError("machine: write machine on or machine off");
    const places = words.slice(1).map((word) => whole(word, "position"));
    if (places.length && places.length !== 6)
      throw new TextError("machine: write six positions: start, CCW limit, slow CCW, origin, slow CW, CW limit");
    if (words[0] === "on") {
      this.side.places = places.length ? places : [...MACHINE];
      part.motors.forEach((_, axis) => core.place(axis, this.side.places));
    }
    this.side.machine = words[0] === "on";
    core.plant(this.side.machine);
    return [];
  }
}
