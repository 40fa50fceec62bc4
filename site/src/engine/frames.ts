// Host of the PMC006B4: sends frames on the serial line and receives the replies.

import { CharacterHost } from "./characters";
import { PATIENCE } from "./host";
import { hex, type Doing, type Side } from "./side";
import { TextError } from "./text";

const ADDRESS = 0xff;
const HEAD = 0xa5;
const REPLY = 0x7a;

export class FrameHost extends CharacterHost {
  constructor(side: Side) {
    super(side);
    Object.assign(this.verbs, {
      f: (words: string[]) => this.frame(words),
      idle: (words: string[]) => this.idle(words),
    });
  }

  private *ask(letter: string, data: number): Doing<number> {
    const content = [
      HEAD,
      ADDRESS,
      letter.charCodeAt(0),
      ...[0, 8, 16, 24].map((place) => (data >> place) & 0xff),
    ];
    const frame = [...content, sum(content)];
    const { side } = this;
    const more = { rule: side.part.words.codes[letter]?.rule ?? "P006-CMD-48" };
    side.from = side.core.now;
    yield* this.say(frame);
    const meaning = (this.side.part.words.codes[letter]?.text ?? "no such instruction").replace(
      /\{[^}]*\}/,
      letter === "W" ? hex(data >>> 0, 8) : String(data),
    );
    side.note("f", `${letter} ${frame.map((one) => hex(one)).join(" ")}`, meaning, {
      ...more,
      fields: [
        ["start", hex(HEAD), ""],
        ["address", hex(ADDRESS), "any"],
        ["code", hex(content[2]!), `${letter}: ${meaning}`],
        ["data", frame.slice(3, 7).map((one) => hex(one)).join(" "), String(data)],
        ["sum", hex(frame[7]!), "of the seven bytes, modulo 256"],
      ],
    });
    side.from = side.core.now;
    const got: number[] = [];
    for (let n = 0; n < 8; n++) {
      const byte = yield* this.hear(PATIENCE / 100);
      if (byte === undefined) throw new TextError("no reply before the time limit");
      got.push(byte);
    }
    if (got[0] !== HEAD || got[1] !== REPLY || sum(got.slice(0, 7)) !== got[7])
      throw new TextError(`${got.map((one) => hex(one)).join(" ")}: not a valid reply`);
    const value = got.slice(3, 7).reduceRight((whole, one) => (whole << 8) | one, 0);
    if (letter === "j") side.status = value & 0xff;
    const told = letter === "j" ? (side.part.words.status[value & 0xff] ?? "") : String(value);
    const bytes = got.map((one) => hex(one));
    side.note("r", bytes.join(" "), told, {
      ...more,
      fields: [
        ["start", bytes[0]!, ""],
        ["reply", bytes[1]!, ""],
        ["address", bytes[2]!, String(got[2])],
        ["data", bytes.slice(3, 7).join(" "), told],
        ["sum", bytes[7]!, "of the seven bytes, modulo 256"],
      ],
    });
    return value;
  }

  *frame(words: string[]): Doing<string[]> {
    const [letter = "", ...more] = words;
    if (letter.length !== 1) throw new TextError(`${letter || "missing word"}: not an instruction; write one letter`);
    let rest = more;
    let data = 0;
    if (rest.length && rest[0] !== "=") {
      data = number(rest[0]!);
      rest = rest.slice(1);
    }
    if ("sz".includes(letter)) this.side.markPulses();
    const got = yield* this.ask(letter, data);
    if (rest[0] !== "=") return rest;
    if (got !== (number(rest[1] ?? "") | 0))
      this.side.note("r", String(got), `the text expects ${rest[1]}`, { bad: true });
    return rest.slice(2);
  }

  *idle(words: string[]): Doing<string[]> {
    while ((yield* this.ask("j", 0)) & 1) yield* this.side.clocks(Math.floor(this.side.part.clkHz / 1000));
    return words;
  }
}

function sum(bytes: readonly number[]): number {
  return bytes.reduce((whole, one) => whole + one, 0) & 0xff;
}

function number(word: string): number {
  if (!/^(-?\d+|0x[0-9a-f]{1,8})$/i.test(word) || Math.abs(Number(word)) > 0xffffffff)
    throw new TextError(`${word || "missing word"}: not a 32-bit number`);
  return Number(word) | 0;
}
