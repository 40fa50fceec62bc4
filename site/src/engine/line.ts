// Host of PPMC-312 stations in serial mode: sends frames to the stations, polls them, and receives their replies.

import type { Decoded, PartData, Words } from "../types";
import { bytes, inline, named, spaced } from "./blocks";
import { CharacterHost } from "./characters";
import { hex, type Doing, type Side } from "./side";
import { TextError, whole } from "./text";

const POLL = 0x80;
const INSTRUCTION = 0x90;
const BUSY = 0x80;
const DONE = 0x90;
const DATA = 0xa0;
const REPORT = 0xb0;
const SILENCE = "-";
const REPLY_S = 0.025; // limit for the begin of a reply: 20 ms after an unknown code, and the frame
const BETWEEN_BITS = 1.5; // from the middle of a stop bit: a longer pause ends a reply
const POLL_S = 0.005; // pause between the polls of `idle`

export class LineHost extends CharacterHost {
  private station = 1;
  private unplugged = 0; // a bit for each station
  /** Code of the last instruction, which defines the data of the next reply; a poll has no code. */
  private code = "";

  constructor(side: Side) {
    super(side);
    Object.assign(this.verbs, {
      axis: (words: string[]) => this.axis(words),
      unplug: (words: string[]) => this.plug(words, true),
      plug: (words: string[]) => this.plug(words, false),
      ">": (words: string[]) => this.instruction(words),
      "<": (words: string[]) => this.expect(words, form),
      "?": (words: string[]) => this.poll(words),
      m: (words: string[]) => this.raw(words),
      s: (words: string[]) => this.expect(words, spaced),
      idle: (words: string[]) => this.idle(words),
      count: (words: string[]) => this.count(words),
    });
  }

  override *begin(): Doing {
    this.station = 1;
    this.unplugged = 0;
    this.code = "";
    yield* super.begin();
  }

  protected override get driven(): boolean {
    return this.side.levels.get("rxd") === this.everywhere;
  }
  protected override drive(level: number): void {
    this.side.set("rxd", level ? this.everywhere : BigInt(this.unplugged));
  }
  /** The line is low while an enabled driver that is connected outputs 0. */
  protected override heard(): number {
    return Number(!(this.side.level("snd") & ~this.side.level("txd") & ~this.unplugged));
  }
  private get everywhere(): bigint {
    return (1n << BigInt(this.side.part.motors.length)) - 1n;
  }

  private number(word: string | undefined): number {
    const number = whole(word, "station");
    const last = this.side.part.motors.length - 1;
    if (number < 0 || number > last) throw new TextError(`there is no station ${number}; write 0 to ${last}`);
    return number;
  }

  private *axis(words: string[]): Doing<string[]> {
    this.station = this.number(words[0]);
    return words.slice(1);
  }

  private *plug(words: string[], out: boolean): Doing<string[]> {
    const bit = 1 << this.number(words[0]);
    this.unplugged = out ? this.unplugged | bit : this.unplugged & ~bit;
    this.drive(1);
    this.side.note("pins", words[0]!, `station ${words[0]} ${out ? "is disconnected from" : "is connected to"} the line`);
    return words.slice(1);
  }

  /** Send characters and note them. kind: entry of the log. */
  private *send(line: readonly number[], kind = "f"): Doing {
    const { side } = this;
    const found = sent(side.part, line);
    this.code = found.code;
    side.from = side.core.now;
    yield* this.say(line);
    const { rule, fields, station } = found;
    side.note(kind, found.text, found.words, { rule, fields, station });
  }

  private *instruction(words: string[]): Doing<string[]> {
    const content = bytes(words);
    if (!content.length) throw new TextError("no instruction; write its code and data, as > 42");
    yield* this.send(frame(INSTRUCTION | this.station, content));
    return [];
  }

  private *raw(words: string[]): Doing<string[]> {
    const line = bytes(words);
    if (!line.length) throw new TextError("no characters; write their bytes, as m 81 7E");
    yield* this.send(line);
    return [];
  }

  private *poll(words: string[]): Doing<string[]> {
    yield* this.send(frame(POLL | this.station, []), "?");
    return yield* this.expect(words, form);
  }

  /** Receive the characters of a reply; an empty list means that no station replies. */
  private *reply(): Doing<number[]> {
    const { side } = this;
    const got: number[] = [];
    let limit = Math.round(REPLY_S * side.part.clkHz);
    for (;;) {
      const byte = yield* this.hear(limit);
      if (byte === undefined) return got;
      if (!got.length) side.from = side.core.now - Math.round(9.5 * this.bit);
      got.push(byte);
      limit = Math.round(BETWEEN_BITS * this.bit);
    }
  }

  /** Receive a reply, and compare it with the bytes in the text. */
  private *expect(words: string[], shown: (line: number[]) => string): Doing<string[]> {
    const wanted = words[0] === SILENCE ? SILENCE : spaced(bytes(words));
    const { side } = this;
    side.from = side.core.now;
    const got = yield* this.reply();
    const found = heard(side.part.words, got, this.code, this.station);
    const told = got.length ? shown(got) : SILENCE;
    const bad = wanted !== "" && wanted !== told;
    const meaning = bad ? `${found.words} (the text expects ${wanted})` : found.words;
    const { rule, fields, station } = found;
    side.note(found.busy ? "!" : "<", told, meaning, { rule, fields, station, bad });
    return [];
  }

  /** Poll the station until it is not busy. */
  private *idle(words: string[]): Doing<string[]> {
    for (;;) {
      yield* this.send(frame(POLL | this.station, []), "?");
      const got = yield* this.reply();
      const found = heard(this.side.part.words, got, "", this.station);
      const { rule, fields, station } = found;
      const more = { rule, fields, station, bad: false };
      this.side.note(found.busy ? "!" : "<", got.length ? form(got) : SILENCE, found.words, more);
      if (!got.length) throw new TextError(`station ${this.station} does not reply; plug connects it to the line`);
      if (!found.busy) return words;
      yield* this.side.clocks(Math.round(POLL_S * this.side.part.clkHz));
    }
  }

  override *pulse(words: string[]): Doing<string[]> {
    const named = /^\d+$/.test(words[1] ?? "");
    return yield* super.pulse(named ? words : [words[0] ?? "", String(this.station), ...words.slice(1)]);
  }

  private *count(words: string[]): Doing<string[]> {
    const wanted = whole(words[0], "number of pulses");
    const { side, station } = this;
    const found = side.pulses(station);
    side.mark[station] = side.core.steps(station);
    const more = found === wanted ? "" : ` (the text expects ${wanted})`;
    side.note("count", String(found), `pulses of station ${station}${more}`, { bad: found !== wanted });
    return words.slice(1);
  }
}

function digits(content: readonly number[]): number[] {
  return [...content.map((one) => hex(one).toLowerCase()).join("")].map((digit) => digit.charCodeAt(0));
}

function checksum(control: number, content: readonly number[]): number {
  return ~content.reduce((sum, one) => sum + one, control) & 0x7f;
}

/** Return the characters of a frame: control code, data in hexadecimal digits, checksum. */
function frame(control: number, content: readonly number[]): number[] {
  return [control, ...digits(content), checksum(control, content)];
}

/** Return the data bytes of a frame; undefined if its characters are not pairs of digits. */
function dataOf(line: readonly number[]): number[] | undefined {
  const text = String.fromCharCode(...line.slice(1, -1));
  return /^([0-9a-f]{2})*$/.test(text) && line.length >= 2 ? bytes([text]) : undefined;
}

/** Kind of a reply without the station, and its data. */
function form(line: readonly number[]): string {
  return spaced([line[0]! & 0xf0, ...(dataOf(line) ?? [])]);
}

interface Found {
  text: string;
  words: string;
  rule: string;
  fields: Decoded[];
  station: number;
}

function kindOf(words: Words, way: string, control: number): string {
  return words.headers?.[`${way} ${hex(control & 0xf0)}`] ?? "no such kind of frame";
}

/** Return the fields around the data of a frame: control code before it, checksum and characters after it. */
function around(line: readonly number[], kind: string, inside: Decoded[] = []): Decoded[] {
  const control = line[0] ?? 0;
  const data = dataOf(line);
  const right = data && checksum(control, data);
  const check =
    right === line.at(-1) ? "right" : right === undefined ? "no whole frame" : `wrong: ${hex(right)} is right`;
  return [
    ["control code", hex(control), kind],
    ["address", hex(control & 15, 1), `station ${control & 15}`],
    ...inside,
    ["checksum", hex(line.at(-1) ?? 0), check],
    ["characters", "", spaced(line)],
  ];
}

/** Explain a frame of the master. code: key of its instruction in the tables, or "". */
export function sent({ words }: PartData, line: readonly number[]): Found & { code: string } {
  const control = line[0]!;
  const data = dataOf(line);
  const station = control & 15;
  const kind = kindOf(words, ">", control);
  if (!data || checksum(control, data) !== line.at(-1)) {
    const told = `station ${station}: ${data ? "wrong checksum" : "not a whole frame"}`;
    return { text: spaced(line), words: told, rule: "P312-SER-14", fields: around(line, kind), station, code: "" };
  }
  const text = spaced([control, ...data]);
  if (!data.length) {
    const fields = around(line, kind);
    return { text, words: `station ${station}: ${kind}`, rule: "P312-SER-30", fields, station, code: "" };
  }
  const code = words.codes[hex(data[0]!)];
  const inside = named(code?.forms, data.slice(1));
  const title = code?.text ?? "no such instruction";
  return {
    text,
    words: `station ${station}: ${title}${inline(inside)}`,
    rule: code?.rule ?? "P312-SER-17",
    fields: around(line, kind, [["code", hex(data[0]!), title], ...inside]),
    station,
    code: hex(data[0]!),
  };
}

/** Station and code of the last instruction: the state on which the meaning of a statement depends. */
export interface Told {
  station: number;
  code: string;
}

/** Explain a statement of a session. */
export function lineMeaning(part: PartData, verb: string, words: string[], told: Told): string {
  const { station, code } = told;
  const frames: Record<string, () => number[]> = {
    ">": () => frame(INSTRUCTION | station, bytes(words)),
    "?": () => frame(POLL | station, []),
    m: () => bytes(words),
  };
  if (verb === "axis") return `station ${(told.station = whole(words[0], "station"))}`;
  if (verb === "plug" || verb === "unplug") return `${verb} station ${words[0] ?? "…"}`;
  if (verb === "idle") return "poll until it is not busy";
  const line = frames[verb]?.();
  let text = "";
  if (line?.length) {
    const found = sent(part, line);
    told.code = found.code;
    text = verb === "m" ? found.words : bare(found.words);
    if (verb !== "?") return text;
  }
  if (!["<", "?", "s"].includes(verb)) return "";
  if (!words.length) return text || "wait for a reply";
  const [kind = 0, ...data] = words[0] === SILENCE ? [] : bytes(words);
  const reply = words[0] === SILENCE ? [] : verb === "s" ? [kind, ...data] : frame(kind | station, data);
  const answer = heard(part.words, reply, verb === "?" ? "" : code, station).words;
  return text ? `${text}: ${bare(answer)}` : verb === "s" ? answer : bare(answer);
}

/** Remove the station from a meaning. */
function bare(text: string): string {
  return text.replace(/^station \d+: /, "");
}

/** Explain a reply to a station's instruction, or to a poll if `code` is "". */
export function heard(
  words: Words,
  line: readonly number[],
  code: string,
  asked: number,
): Omit<Found, "text"> & { busy: boolean } {
  if (!line.length)
    return { words: "no station replies", rule: "P312-SER-10", fields: [], station: asked, busy: false };
  const kind = line[0]! & 0xf0;
  const station = line[0]! & 15;
  const data = dataOf(line) ?? [];
  const name = kind === DONE && code ? "done" : kindOf(words, "<", kind);
  let inside: Decoded[] = [];
  let told = name;
  if (kind === DATA) {
    inside = named(code ? words.codes[code]?.answerForms : words.pollForms, data);
    told = inline(inside).replace(/^: /, "") || name;
  } else if (kind === REPORT && data.length) {
    const title = words.reports?.[hex(data[0]!)] ?? "no such report";
    inside = [["report", hex(data[0]!), title], ...named(words.reportForms?.[hex(data[0]!)], data.slice(1))];
    told = title + inline(inside.slice(1));
  }
  return {
    words: `station ${station}: ${told}`,
    rule: code ? (words.reportRule ?? "") : "P312-SER-30",
    fields: around(line, name, inside),
    station,
    busy: kind === BUSY,
  };
}
