// The build of a part whose parameters are those of a board.

import type { PartData } from "../types";
import type { Identity } from "./serial_link";
import type { Recorder } from "./serial_record";

/** Return the part in the build of a board, or the reason why the page has no such build.
 *
 * info: the recorder of the board; its pins distinguish banks with different numbers of axes. */
export function buildOf(part: PartData, { clkHz, xtalHz, datasheet }: Identity, info?: Recorder): PartData | string {
  if (datasheet) return "the board has DATASHEET timing, the RTL of this page FAST; use openppmc selftest";
  const all = [part, ...part.board.builds.map((one) => ({ ...part, ...one }))];
  const same = all.filter(({ params }) => params.CLK_HZ === clkHz && params.XTAL_HZ === xtalHz);
  if (!same.length)
    return `the page has no RTL with CLK_HZ = ${clkHz} and XTAL_HZ = ${xtalHz}, the values of the board; use openppmc selftest`;
  const width = info ? 8 * info.bytes - info.timeBits : 0;
  const found = same.find(({ recorder }) => !width || recorder.reduce((sum, [, bits]) => sum + bits, 0) === width);
  return found ?? "the recorder has other pins than the part of this page; renew the bitstream";
}

/** Return the part in the build that simulates the texts for a board.
 *
 * A simulation with the clock of the page is faster, and the times in a text do not depend on the clock. Therefore the
 * build of the board is used only if other parameters differ, too. */
export function simulatedBuild(part: PartData, identity: Identity, info?: Recorder): PartData {
  const found = buildOf(part, identity, info);
  if (typeof found === "string") return part;
  const names = Object.keys(part.params).filter((name) => name !== "CLK_HZ");
  return names.every((name) => found.params[name] === part.params[name]) ? part : found;
}
