// Host of the PPMC-312: accesses registers, and transfers blocks through the windows.

import type { Decoded, Field, LogEntry, Words } from "../types";
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
const WRITE_RULES: Record<number, string> = { 0: "P312-PAR-01", 2: "P312-PAR-03", 3: "P312-PAR-04", 5: "P312-PAR-05" };
const LONGEST = 32; // bytes of a block
const REST = "parameters";

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
      const name = this.side.part.words.registers?.[`write ${register}`] ?? `register ${register}`;
      if (!quiet) this.side.note("w", hex(value), name, { rule: WRITE_RULES[register] ?? "P312-PAR-09" });
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
    const more = { rule: register === CSR ? this.side.part.words.statusRule : "P312-PAR-07", bad };
    this.side.note(register === CSR ? "st" : "r", hex(value), bad ? `${name} (the text expects ${hex(expected)})` : name, more);
    return words.slice(isByte(words[1]) ? 2 : 1);
  }

  private *ready(bit: number): Doing {
    const pauses = new Pauses(this.side);
    for (;;) {
      const value = yield* this.get(CSR);
      const { words } = this.side.part;
      if (value !== this.polled) this.side.note("st", hex(value), words.status[value] ?? "", { rule: words.statusRule });
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
    const { side } = this;
    const from = side.core.now;
    yield* this.put(WCR, 0x20);
    yield* this.put(WAR, 0x20 - content.length);
    for (const one of [...content].reverse()) yield* this.put(DWR, one);
    side.from = from;
    side.note(">", spaced(content), blockWords(side.part.words, content), decoded(side.part.words, content, false));
    return [];
  }

  *response(words: string[]): Doing<string[]> {
    const expected = spaced(bytes(words));
    yield* this.ready(MREF);
    const { side } = this;
    const from = side.core.now;
    const count = 0x40 - (yield* this.get(RAR));
    const found: number[] = [];
    for (let n = 0; n < count; n++) found.unshift(yield* this.get(DRR));
    const text = spaced(found);
    const bad = expected !== "" && expected !== text;
    const meaning = answerWords(side.part.words, found);
    side.from = from;
    const more = { ...decoded(side.part.words, found, true), bad };
    side.note("<", text, bad ? `${meaning} (the text expects ${expected})` : meaning, more);
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
      { bad: found !== wanted },
    );
    return words.slice(1);
  }
}

export function spaced(content: readonly number[]): string {
  return content.map((one) => hex(one)).join(" ");
}

function value({ signed, bits, none, names }: Field, content: readonly number[]): string {
  if (names) return names[hex(content[0]!)] ?? hex(content[0]!);
  if (bits) return bits.filter((name, n) => name && (content[0]! >> (7 - n)) & 1).join(", ") || (none ?? "0");
  const number = content.reduce((sum, one) => 256 * sum + one, 0);
  return String(signed && content[0]! & 0x80 ? number - 2 ** (8 * content.length) : number);
}

/** Return parameters as fields; their number of bytes selects one of the lists. rest: name of the other bytes. */
export function named(forms: Field[][] | undefined, content: readonly number[], rest = REST): Decoded[] {
  const fields: Decoded[] = [];
  const size = (form: Field[]): number => form.reduce((sum, field) => sum + field.bytes, 0);
  let left = content;
  for (const field of forms?.find((form) => size(form) === left.length) ?? []) {
    fields.push([field.name, spaced(left.slice(0, field.bytes)), value(field, left.slice(0, field.bytes))]);
    left = left.slice(field.bytes);
  }
  return left.length ? [...fields, [rest, spaced(left), ""]] : fields;
}

/** Return the rule of a block, and its fields: header, length, code and parameters. */
export function decoded(words: Words, content: readonly number[], answer: boolean): Pick<LogEntry, "rule" | "fields"> {
  const [head = 0, length = 0, first] = content;
  const fields: Decoded[] = [
    ["header", hex(head), words.headers?.[`${answer ? "<" : ">"} ${hex(head)}`] ?? ""],
    ["length", hex(length), `${length} bytes follow`],
  ];
  const code = words.codes[hex(first ?? 0)];
  const list = head < 2 || first === undefined;
  const report = answer ? words.reports?.[hex(first ?? 0)] : undefined;
  if (!list) fields.push(["code", hex(first), report ?? code?.text ?? "no such instruction"]);
  const forms = report ? words.reportForms?.[hex(first ?? 0)] : answer ? code?.answerForms : code?.forms;
  if (list) fields.push(...named(undefined, content.slice(2), "data"));
  else fields.push(...named(forms, content.slice(3)));
  return { fields, rule: (report ? words.reportRule : list ? "P312-CMD-FC-2" : code?.rule) ?? "P312-CMD-01" };
}

/** Parse words of hexadecimal digits, two for each byte. */
export function bytes(words: readonly string[]): number[] {
  const text = words.join("");
  if (text.length % 2 || /[^0-9A-Fa-f]/.test(text))
    throw new TextError(`${words.join(" ")}: not bytes; write two hexadecimal digits for each`);
  return Array.from({ length: text.length / 2 }, (_, n) => parseInt(text.slice(2 * n, 2 * n + 2), 16));
}

/** Return the parameters of a block in one line. */
function parameters(words: Words, content: readonly number[], answer: boolean): string {
  return inline(decoded(words, content, answer).fields!.slice(3));
}

/** Return fields in one line, which follows a title. */
export function inline(fields: readonly Decoded[]): string {
  const known = fields.filter(([name]) => name !== REST);
  const told = known.map(([name, , meaning]) => (/flags|profile|code$/.test(name) ? meaning : `${name} ${meaning}`));
  return told.length ? `: ${told.join(", ")}` : "";
}

export function blockWords(words: Words, content: readonly number[]): string {
  if (content[0]! < 2) return "free curve: data";
  const text = words.codes[hex(content[2] ?? 0)]?.text;
  return text === undefined ? "no such instruction" : text + parameters(words, content, false);
}

export function answerWords(words: Words, content: readonly number[]): string {
  const code = content[2] ?? 0;
  if (code === 0xe0) {
    const position = content.slice(4).reduce((sum, one) => (sum << 8) | one, 0);
    return `stopped at ${position}: ${words.causes?.[String(content[3])] ?? ""}`;
  }
  const report = words.reports?.[hex(code)];
  if (report) return code >= 0xf0 ? `rejected: ${report}` : report;
  return `answer to: ${words.codes[hex(code)]?.text ?? hex(code)}${parameters(words, content, true)}`;
}
