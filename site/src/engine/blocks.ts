// Host of the PPMC-312: accesses registers, and transfers blocks through the windows.

import type { Words } from "../types";
import { Host } from "./host";
import { hex, type Doing, type Side } from "./side";
import { Pauses, Strobes } from "./strobes";
import { byte, isByte, TextError, whole } from "./text";

const CSR = 0;
const WCR = 2;
const WAR = 3;
const RAR = 3;
const DWR = 5;
const DRR = 7;
const MWEF = 0x08;
const MREF = 0x04;
const LONGEST = 32; // bytes of a block

export class BlockHost extends Host {
  private readonly bus: Strobes;
  private polled = -1;

  constructor(side: Side) {
    super(side);
    this.bus = new Strobes(side);
    Object.assign(this.verbs, {
      w: (words: string[]) => this.write(words),
      r: (words: string[]) => this.readRegister(words),
      ">": (words: string[]) => this.block(words),
      "<": (words: string[]) => this.response(words),
      count: (words: string[]) => this.count(words),
    });
  }

  private register(word: string | undefined): number {
    const register = whole(word, "register");
    if (register < 0 || register > 7) throw new TextError(`there is no register ${register}`);
    return register;
  }

  private *put(register: number, value: number, quiet = true): Doing {
    yield* this.bus.write(register, value, () => {
      if (!quiet)
        this.side.note(
          "w",
          hex(value),
          this.side.part.words.registers?.[`write ${register}`] ?? `register ${register}`,
        );
    });
  }

  private *get(register: number): Doing<number> {
    const value = yield* this.bus.read(register);
    if (register === CSR) this.side.status = value;
    return value;
  }

  *write(words: string[]): Doing<string[]> {
    yield* this.put(this.register(words[0]), byte(words[1]), false);
    return words.slice(2);
  }

  *readRegister(words: string[]): Doing<string[]> {
    const register = this.register(words[0]);
    const value = yield* this.get(register);
    const expected = isByte(words[1]) ? parseInt(words[1], 16) : value;
    const name =
      register === CSR
        ? (this.side.part.words.status[value] ?? "")
        : (this.side.part.words.registers?.[`read ${register}`] ?? "");
    const bad = expected !== value;
    this.side.note("r", hex(value), bad ? `${name} (the text expects ${hex(expected)})` : name, bad);
    return words.slice(isByte(words[1]) ? 2 : 1);
  }

  private *ready(bit: number): Doing {
    const pauses = new Pauses(this.side);
    for (;;) {
      const value = yield* this.get(CSR);
      if (value !== this.polled) this.side.note("st", hex(value), this.side.part.words.status[value] ?? "");
      this.polled = value;
      if (!(value & bit)) return;
      yield* pauses.next();
    }
  }

  *block(words: string[]): Doing<string[]> {
    const content = bytes(words);
    if (!content.length || content.length > LONGEST)
      throw new TextError(`block of ${content.length} bytes: wrong length; write 1 to ${LONGEST} bytes`);
    yield* this.ready(MWEF);
    yield* this.put(WCR, 0x20);
    yield* this.put(WAR, 0x20 - content.length);
    for (const one of [...content].reverse()) yield* this.put(DWR, one);
    this.side.note(">", content.map((one) => hex(one)).join(" "), blockWords(this.side.part.words, content));
    return [];
  }

  *response(words: string[]): Doing<string[]> {
    const expected = bytes(words)
      .map((one) => hex(one))
      .join(" ");
    yield* this.ready(MREF);
    const count = 0x40 - (yield* this.get(RAR));
    const found: number[] = [];
    for (let n = 0; n < count; n++) found.unshift(yield* this.get(DRR));
    const text = found.map((one) => hex(one)).join(" ");
    const bad = expected !== "" && expected !== text;
    const meaning = answerWords(this.side.part.words, found);
    this.side.note("<", text, bad ? `${meaning} (the text expects ${expected})` : meaning, bad);
    return [];
  }

  *count(words: string[]): Doing<string[]> {
    const wanted = whole(words[0], "number of pulses");
    const found = this.side.pulses(0);
    this.side.markPulses();
    this.side.note(
      "count",
      String(found),
      `pulses${found === wanted ? "" : ` (the text expects ${wanted})`}`,
      found !== wanted,
    );
    return words.slice(1);
  }
}

/** Parse words of hexadecimal digits, two for each byte. */
export function bytes(words: readonly string[]): number[] {
  const text = words.join("");
  if (text.length % 2 || /[^0-9A-Fa-f]/.test(text))
    throw new TextError(`${words.join(" ")}: not bytes; write two hexadecimal digits for each`);
  return Array.from({ length: text.length / 2 }, (_, n) => parseInt(text.slice(2 * n, 2 * n + 2), 16));
}

export function blockWords(words: Words, content: readonly number[]): string {
  if (content[0]! < 2) return "free curve: data";
  return words.codes[hex(content[2] ?? 0)]?.text ?? "no such instruction";
}

export function answerWords(words: Words, content: readonly number[]): string {
  const code = content[2] ?? 0;
  if (code === 0xe0) {
    const position = content.slice(4).reduce((sum, one) => (sum << 8) | one, 0);
    return `stopped at ${position}: ${words.causes?.[String(content[3])] ?? ""}`;
  }
  const report = words.reports?.[hex(code)];
  if (report) return code >= 0xf0 ? `rejected: ${report}` : report;
  return `answer to: ${words.codes[hex(code)]?.text ?? hex(code)}`;
}
