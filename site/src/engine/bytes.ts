// Host of a part with a data register and a register for commands and status.

import { Explainer } from "./explain";
import { Host } from "./host";
import { Pauses, Strobes } from "./strobes";
import { hex, type Doing, type Side } from "./side";
import { byte, isByte } from "./text";

const OBF = 1;
const IBF = 2;

export class ByteHost extends Host {
  protected readonly bus: Strobes;
  protected base = 0;
  private readonly explainers = new Map<number, Explainer>();
  private polled = -1;

  /** Explainer of the selected axis; each axis has a separate command. */
  private get explainer(): Explainer {
    const known = this.explainers.get(this.base) ?? new Explainer(this.side.part.words);
    this.explainers.set(this.base, known);
    return known;
  }

  constructor(side: Side) {
    super(side);
    this.bus = new Strobes(side);
    Object.assign(this.verbs, {
      c: (words: string[]) => this.command(words, true),
      w: (words: string[]) => this.command(words, false),
      d: (words: string[]) => this.data(words),
      r: (words: string[]) => this.readData(words),
      st: (words: string[]) => this.readStatus(words),
      p: (words: string[]) => this.pollStatus(words),
      idle: (words: string[]) => this.idle(words),
    });
  }

  *write(register: number, value: number): Doing {
    yield* this.bus.write(this.base + register, value, () => {
      const words = register ? this.explainer.command(value) : this.explainer.data(value);
      this.side.note(register ? "c" : "d", hex(value), words, this.explainer.rule);
    });
  }

  *read(register: number): Doing<number> {
    return yield* this.bus.read(this.base + register);
  }

  *status(): Doing<number> {
    const value = yield* this.read(1);
    this.side.status = value;
    return value;
  }

  *poll(mask: number, value: number): Doing<number> {
    const pauses = new Pauses(this.side);
    for (;;) {
      const status = yield* this.status();
      if (status !== this.polled) this.side.note("st", hex(status), this.explainer.status(status), this.statusRule);
      this.polled = status;
      if ((status & mask) === value) return status;
      yield* pauses.next();
    }
  }

  private get statusRule(): { rule: string } {
    return { rule: this.side.part.words.statusRule };
  }

  protected check(kind: string, got: number, meaning: string, words: string[], more: { rule?: string }): string[] {
    const expected = isByte(words[0]) ? parseInt(words[0], 16) : got;
    const bad = expected !== got;
    const told = bad ? `${meaning} (the text expects ${hex(expected)})` : meaning;
    this.side.note(kind, hex(got), told, { ...more, bad });
    return isByte(words[0]) ? words.slice(1) : words;
  }

  *command(words: string[], polled: boolean): Doing<string[]> {
    const value = byte(words[0]);
    this.side.markPulses();
    this.polled = -1;
    yield* this.write(1, value);
    if (polled) yield* this.poll(IBF, 0);
    return words.slice(1);
  }

  *data(words: string[]): Doing<string[]> {
    yield* this.write(0, byte(words[0]));
    yield* this.poll(IBF, 0);
    return words.slice(1);
  }

  *readData(words: string[]): Doing<string[]> {
    yield* this.poll(OBF, OBF);
    const value = yield* this.read(0);
    return this.check("r", value, this.explainer.answer(value), words, this.explainer.rule);
  }

  *readStatus(words: string[]): Doing<string[]> {
    const value = yield* this.status();
    this.polled = value;
    return this.check("st", value, this.explainer.status(value), words, this.statusRule);
  }

  *pollStatus(words: string[]): Doing<string[]> {
    yield* this.poll(0xff, byte(words[0]));
    return words.slice(1);
  }

  *idle(words: string[]): Doing<string[]> {
    yield* this.poll(this.bus.style.busy, 0);
    return words;
  }
}
