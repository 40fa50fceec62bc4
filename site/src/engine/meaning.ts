// Meaning of a line of a session while the reader types it.

import type { PartData } from "../types";
import { answerWords, blockWords, bytes } from "./blocks";
import { Explainer, type Meant } from "./explain";
import { lineMeaning, type Told } from "./line";
import { isByte, TextError } from "./text";

function blockLine(part: PartData, text: string): Meant[] {
  const found: Meant[] = [];
  for (const one of (text.split("#")[0] ?? "").split(";")) {
    const [verb = "", ...words] = one.split(/\s+/).filter(Boolean);
    try {
      if (verb === ">")
        found.push({ word: one.trim(), meaning: blockWords(part.words, bytes(words)), bad: false });
      else if (verb === "<")
        found.push({
          word: one.trim(),
          meaning: words.length ? answerWords(part.words, bytes(words)) : "wait for an answer",
          bad: false,
        });
      else if (verb === "w" || verb === "r") {
        const name =
          part.words.registers?.[`${verb === "w" ? "write" : "read"} ${words[0]}`] ??
          `register ${words[0] ?? "…"}`;
        const status =
          verb === "r" && words[0] === "0" && isByte(words[1])
            ? `: ${part.words.status[parseInt(words[1], 16)]}`
            : "";
        found.push({
          word: one.trim(),
          meaning: name + status,
          bad: words[1] !== undefined && !isByte(words[1]),
        });
      }
    } catch (error) {
      if (!(error instanceof TextError)) throw error;
      found.push({ word: one.trim(), meaning: error.message, bad: true });
    }
  }
  return found;
}

function stationLine(part: PartData, text: string, told: Told): Meant[] {
  const found: Meant[] = [];
  for (const one of (text.split("#")[0] ?? "").split(";")) {
    const [verb = "", ...words] = one.split(/\s+/).filter(Boolean);
    try {
      const meaning = lineMeaning(part, verb, words, told);
      if (meaning) found.push({ word: one.trim(), meaning, bad: false });
    } catch (error) {
      if (!(error instanceof TextError)) throw error;
      found.push({ word: one.trim(), meaning: error.message, bad: true });
    }
  }
  return found;
}

function frameLine(part: PartData, text: string): Meant[] {
  const found: Meant[] = [];
  for (const one of (text.split("#")[0] ?? "").split(";")) {
    const [verb, letter, data = "0"] = one.split(/\s+/).filter(Boolean);
    if (verb !== "f" || !letter) continue;
    const known = part.words.codes[letter]?.text;
    found.push({
      word: one.trim(),
      meaning: known?.replace(/\{[^}]*\}/, data === "=" ? "0" : data) ?? "no such instruction",
      bad: !known,
    });
  }
  return found;
}

/** Explain each line of a text; the meaning of a line can depend on the lines before it. */
export function meanings(part: PartData, text: string): Meant[][] {
  const explainer = new Explainer(part.words);
  const told: Told = { station: 1, code: "" };
  const byBus: Record<string, (line: string) => Meant[]> = {
    block: (line) => blockLine(part, line),
    frame: (line) => frameLine(part, line),
    line: (line) => stationLine(part, line, told),
  };
  return text.split("\n").map(byBus[part.bus] ?? ((line) => explainer.line(line)));
}
