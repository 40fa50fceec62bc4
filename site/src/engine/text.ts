// The text of a session: what it may say, and what is wrong with it. docs/playground.md has the list of statements.

export class TextError extends Error {}

export interface Statement {
  line: number;
  words: string[];
  /** clk before which it does not begin; -1: at once. */
  at: number;
}

export const MOST = 200_000; // characters
const LENGTH = /^(\d+(?:\.\d+)?)(clk|us|ms)?$/;
const HEX = /^[0-9A-Fa-f]{2}$/;

export function statements(text: string): Statement[] {
  if (text.length > MOST) throw new TextError(`a session of ${text.length} characters: ${MOST} at most`);
  const found: Statement[] = [];
  text.split("\n").forEach((full, index) => {
    for (const part of (full.split("#")[0] ?? "").split(";")) {
      let words = part.split(/\s+/).filter(Boolean);
      let at = -1;
      if (words[0]?.startsWith("@")) {
        at = Number(words[0].slice(1));
        if (!Number.isSafeInteger(at) || at < 0)
          throw new TextError(`line ${index + 1}: ${words[0]} is no clk`);
        words = words.slice(1);
      }
      if (words.length) found.push({ line: index + 1, words, at });
    }
  });
  return found;
}

export function isByte(word: string | undefined): word is string {
  return word !== undefined && HEX.test(word);
}

export function byte(word: string | undefined): number {
  if (!isByte(word)) throw new TextError(`${word ?? "nothing"} is no byte: two hexadecimal digits, 00 to FF`);
  return parseInt(word, 16);
}

/** "400", "5us", "2ms" in clk. */
export function clks(word: string | undefined, clkHz: number): number {
  const found = LENGTH.exec(word ?? "");
  if (!found) throw new TextError(`${word ?? "nothing"} is no time: 400, 5us, 2ms`);
  const n = Number(found[1]);
  // As Python rounds: halves to even.
  const scaled =
    found[2] === "us" ? (n * clkHz) / 1e6 : found[2] === "ms" ? (n * clkHz) / 1e3 : Math.floor(n);
  const down = Math.floor(scaled);
  return scaled - down === 0.5 ? down + (down % 2) : Math.round(scaled);
}

export function whole(word: string | undefined, what: string): number {
  if (!/^-?\d+$/.test(word ?? "")) throw new TextError(`${word ?? "nothing"} is no ${what}`);
  return Number(word);
}
