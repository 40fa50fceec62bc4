// Parser for the text of a session. docs/playground.md has the list of statements.

export class TextError extends Error {}

export interface Statement {
  line: number;
  words: string[];
  /** Cycle at which the statement may begin at the earliest; -1: immediately. */
  at: number;
}

export const MOST = 200_000; // characters
const LENGTH = /^(\d+(?:\.\d+)?)(clk|us|ms)?$/;
const HEX = /^[0-9A-Fa-f]{2}$/;

export function statements(text: string): Statement[] {
  if (text.length > MOST) throw new TextError(`session of ${text.length} characters: too long; ${MOST} at most`);
  const found: Statement[] = [];
  text.split("\n").forEach((full, index) => {
    for (const part of (full.split("#")[0] ?? "").split(";")) {
      let words = part.split(/\s+/).filter(Boolean);
      let at = -1;
      if (words[0]?.startsWith("@")) {
        at = Number(words[0].slice(1));
        if (!Number.isSafeInteger(at) || at < 0)
          throw new TextError(`line ${index + 1}: ${words[0]}: not a number of cycles`);
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
  if (!isByte(word)) throw new TextError(`${word ?? "missing word"}: not a byte; write two hexadecimal digits, 00 to FF`);
  return parseInt(word, 16);
}

/** Convert "400", "5us" or "2ms" to cycles. textHz: clock of the cycles in the text. */
export function clks(word: string | undefined, clkHz: number, textHz = clkHz): number {
  const found = LENGTH.exec(word ?? "");
  if (!found) throw new TextError(`${word ?? "missing word"}: not a time; write 400, 5us or 2ms`);
  const n = Number(found[1]);
  // Round halves to even, as Python does.
  const scaled =
    found[2] === "us" ? (n * clkHz) / 1e6 : found[2] === "ms" ? (n * clkHz) / 1e3 : (Math.floor(n) * clkHz) / textHz;
  const down = Math.floor(scaled);
  return scaled - down === 0.5 ? down + (down % 2) : Math.round(scaled);
}

export function whole(word: string | undefined, what: string): number {
  if (!/^-?\d+$/.test(word ?? "")) throw new TextError(`${word ?? "missing word"}: not a valid ${what}`);
  return Number(word);
}
