// Meaning of bytes, from the tables of the Python package (scripts/site/texts.py).

import type { Code, Words } from "../types";
import { hex } from "./side";
import { isByte } from "./text";

/** A statement of a line and its meaning. */
export interface Meant {
  word: string;
  meaning: string;
  bad: boolean;
}

export class Explainer {
  private code: Code | undefined;
  private sent: number[] = [];
  private got: number[] = [];

  constructor(private readonly words: Words) {}

  /** Rule of the current command. */
  get rule(): { rule?: string } {
    return this.code ? { rule: this.code.rule } : {};
  }

  status(value: number): string {
    return this.words.status[value] ?? "";
  }

  command(value: number): string {
    this.code = this.words.codes[hex(value)];
    this.sent = [];
    this.got = [];
    if (!this.code) return "";
    const wanted = this.code.fields.map((field) =>
      field.bytes > 1 ? `${field.name} (${field.bytes} bytes)` : field.name,
    );
    return this.code.text + (wanted.length ? `: ${wanted.join(", ")}` : "");
  }

  data(value: number): string {
    this.sent.push(value);
    let at = 0;
    for (const field of this.code?.fields ?? []) {
      if (this.sent.length > at && this.sent.length <= at + field.bytes) {
        const have = this.sent.slice(at);
        if (have.length < field.bytes)
          return `${field.name}, byte ${have.length} of ${field.bytes}, low byte first`;
        return `${field.name} ${number(have) + field.plus}`;
      }
      at += field.bytes;
    }
    return this.code ? "the command does not need this byte" : "";
  }

  answer(value: number): string {
    this.got.push(value);
    if (!this.code?.answer) return "";
    const table = this.words.answers[this.code.answer];
    if (table) return table[value] ?? "";
    if (this.got.length < this.code.count)
      return `${this.code.answer}, byte ${this.got.length} of ${this.code.count}`;
    return `${this.code.answer}: ${number(this.got)}`;
  }

  /** Explain each statement of a line while the reader types it. */
  line(text: string): Meant[] {
    const found: Meant[] = [];
    const words = (text.split("#")[0] ?? "").split(/[\s;]+/).filter(Boolean);
    for (let n = 0; n < words.length; n++) {
      const verb = words[n]!;
      const next = words[n + 1];
      if (["c", "w", "d", "p"].includes(verb)) {
        n++;
        if (!isByte(next)) {
          found.push({
            word: `${verb} ${next ?? "…"}`,
            meaning: "two hexadecimal digits, 00 to FF",
            bad: next !== undefined,
          });
          continue;
        }
        const value = parseInt(next, 16);
        const meaning =
          verb === "d"
            ? this.data(value)
            : verb === "p"
              ? `until ${this.status(value)}`
              : this.command(value);
        found.push({ word: `${verb} ${next}`, meaning: meaning || "no such command", bad: !meaning });
      } else if (verb === "st" || verb === "r") {
        if (isByte(next)) {
          n++;
          const value = parseInt(next, 16);
          found.push({
            word: `${verb} ${next}`,
            meaning: verb === "st" ? this.status(value) : this.answer(value),
            bad: false,
          });
        } else
          found.push({ word: verb, meaning: verb === "st" ? "read the status" : "read a byte", bad: false });
      } else if (verb === "axis") n++;
      else if (verb === "put" || verb === "get") {
        const name = this.words.registers?.[`${verb === "put" ? "write" : "read"} ${next}`];
        found.push({ word: `${verb} ${next ?? ""}`, meaning: name ?? "no such register", bad: !name });
        n += isByte(words[n + 2]) ? 2 : 1;
      } else if (verb !== "idle") return found;
    }
    return found;
  }
}

function number(bytes: readonly number[]): number {
  return bytes.reduce((sum, one, place) => sum + one * 2 ** (8 * place), 0);
}
