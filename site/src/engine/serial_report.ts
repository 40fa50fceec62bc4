// Report of the runs on a board, as text and as values for JSON.

import type { Compared } from "./serial_compare";
import type { Link } from "./serial_link";
import type { Edges, Recorder } from "./serial_record";

export interface Result {
  title: string;
  motions: string[];
  compared: Compared;
  /** Comparison of the recorded edges, or a text with the reason why there is none. */
  edges: Edges | string;
  /** Reason why the run has ended early, "" if it is complete. */
  error: string;
  /** Time from the start to the last answer in ms. */
  answeredMs: number;
}

export interface Report {
  part: string;
  timing: string;
  crystalHz: number;
  clockHz: number;
  baud: number;
  repeats: number;
  bitstream: string;
  recorder: string;
  browser: string;
  time: string;
  runs: Result[];
  differences: number;
  verdict: string;
}

const strict = (result: Result): number =>
  result.compared.differences.filter((one) => !one.timing).length +
  Number(typeof result.edges !== "string" && result.edges.difference !== "");

const count = (n: number, what: string): string => `${n} ${what}${n === 1 ? "" : "s"}`;

/** Return the result of a run in one line. */
export function verdict(result: Result): string {
  const { compared, edges, error } = result;
  if (error) return error;
  const counted = `${count(compared.answers, "answer")}, ${count(compared.positions, "position")}`;
  const edgeText = typeof edges === "string" ? "" : `, ${edges.edges} edges${edges.end && ` (${edges.end})`}`;
  const different = strict(result);
  const timed = compared.differences.length - compared.differences.filter((one) => !one.timing).length;
  const late = timed ? `; ${timed} depend on the speed of the host` : "";
  return `${counted}${edgeText}: ${different ? `${different} different` : "all equal"}${late}`;
}

export function report(part: string, link: Link, info: Recorder | undefined, runs: Result[]): Report {
  const { identity, build } = link;
  const differences = runs.reduce((sum, one) => sum + strict(one), 0);
  const failed = runs.filter((one) => one.error).length;
  const sum = (count: (one: Result) => number): number => runs.reduce((all, one) => all + count(one), 0);
  const edges = sum((one) => (typeof one.edges === "string" ? 0 : one.edges.edges));
  return {
    part,
    timing: identity.datasheet ? "DATASHEET" : "FAST",
    crystalHz: identity.xtalHz,
    clockHz: identity.clkHz,
    baud: link.baud,
    repeats: link.repeats,
    bitstream: build
      ? `version ${build.version}, sources ${build.source}, commit ${build.commit}${build.changed ? " with changes" : ""}, board ${build.board}`
      : "does not report its version",
    recorder: info ? `${info.most} records` : "none",
    browser: navigator.userAgent,
    time: new Date().toISOString(),
    runs,
    differences,
    verdict:
      `${runs.length - failed} of ${runs.length} runs complete, ${sum((one) => one.compared.answers)} answers, ` +
      `${sum((one) => one.compared.positions)} positions and ${edges} edges compared, ${differences} differences`,
  };
}

export function reportText(data: Report): string {
  const rows: [string, string][] = [
    ["part", `${data.part}, ${data.timing} timing, crystal ${data.crystalHz / 1e6} MHz, clk ${data.clockHz / 1e6} MHz`],
    ["bitstream", data.bitstream],
    ["line", `${data.baud} baud, ${data.repeats} requests repeated`],
    ["recorder", data.recorder],
    ["browser", data.browser],
    ["time", data.time],
  ];
  const lines = ["OpenPPMC self-test in the playground", "", ...rows.map(([name, text]) => `${name.padEnd(10)} ${text}`)];
  for (const run of data.runs) {
    lines.push("", `${run.title}: ${verdict(run)}`, ...run.motions.map((motion) => `  ${motion}`));
    for (const one of run.compared.differences)
      lines.push(
        `  ${one.timing ? "depends on the speed of the host" : "different"}: ${one.where}: board ${one.board}, ` +
          `simulation ${one.simulation} ${one.words}`.trimEnd(),
      );
    if (typeof run.edges === "string") lines.push(`  edges not compared: ${run.edges}`);
    else if (run.edges.difference) lines.push(`  different: ${run.edges.difference}`);
  }
  return [...lines, "", data.verdict, ""].join("\n");
}
