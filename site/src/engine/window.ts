// Host of the bank: for each axis that of a PPMC-104, and the registers of the window.

import { ByteHost } from "./bytes";
import { hex, type Doing, type Side } from "./side";
import { byte, TextError, whole } from "./text";

const WINDOW_RULE = "BANK-WIN-02"; // registers of the window

export class WindowHost extends ByteHost {
  constructor(side: Side) {
    super(side);
    Object.assign(this.verbs, {
      axis: (words: string[]) => this.axis(words),
      put: (words: string[]) => this.put(words),
      get: (words: string[]) => this.get(words),
    });
  }

  *axis(words: string[]): Doing<string[]> {
    const axis = whole(words[0], "axis");
    if (axis < 0 || axis >= this.side.part.motors.length) throw new TextError(`there is no axis ${axis}`);
    if (this.base !== axis << 4) this.side.note("axis", String(axis), "");
    this.base = axis << 4;
    return words.slice(1);
  }

  private register(word: string | undefined): number {
    const register = whole(word, "register");
    if (register < 0 || register > 15) throw new TextError(`there is no register ${register}`);
    return register;
  }

  *put(words: string[]): Doing<string[]> {
    const register = this.register(words[0]);
    const value = byte(words[1]);
    const name = this.side.part.words.registers?.[`write ${register}`] ?? `register ${register}`;
    const more = { rule: WINDOW_RULE };
    yield* this.bus.write(this.base + register, value, () => this.side.note("put", hex(value), name, more));
    return words.slice(2);
  }

  *get(words: string[]): Doing<string[]> {
    const register = this.register(words[0]);
    const value = yield* this.bus.read(this.base + register);
    return this.check(
      "get",
      value,
      this.side.part.words.registers?.[`read ${register}`] ?? "",
      words.slice(1),
      { rule: WINDOW_RULE },
    );
  }
}
