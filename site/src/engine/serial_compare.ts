// Comparison of a session on a board with its simulation, and the motions of a simulation as text.

import type { BoardRow } from "./serial_steps";

export interface Answered {
  kind: string;
  text: string;
  words: string;
}

/** Result of a simulation. */
export interface Simulated {
  answers: Answered[];
  positions: number[];
  motions: Motion[];
  /** Reason why the simulation has not ended, "" if the motors are at rest. */
  open: string;
}

/** Pulses of an axis in one direction, at intervals below PAUSE_S. */
export interface Motion {
  axis: number;
  ccw: boolean;
  pulses: number;
  /** `first` and `fastest`: speed at the first interval and greatest speed, in pulses per second. */
  first: number;
  fastest: number;
}

export interface Difference {
  /** "line 12, r", or "position of axis 1". */
  where: string;
  board: string;
  simulation: string;
  words: string;
  /** The simulated value depends on the speed of the host, so this is not counted as a difference. */
  timing: boolean;
}

export interface Compared {
  answers: number;
  positions: number;
  differences: Difference[];
}

const NONE = "no answer";
const SHOWN = 6; // number of motions of an axis that are listed one by one
const PAUSE_S = 0.045; // a longer interval separates two motions

/** Compare all answers and positions. slower: the simulation with a slower host. first: number of the first axis. */
export function compare(
  rows: readonly BoardRow[],
  positions: readonly number[],
  golden: Simulated,
  first: number,
  slower?: Simulated,
): Compared {
  const differences: Difference[] = [];
  const answers = rows.filter((row) => row.answer);
  const count = Math.max(answers.length, golden.answers.length);
  for (let n = 0; n < count; n++) {
    const [board, other, late] = [answers[n], golden.answers[n], slower?.answers[n]];
    if (board && other && board.kind === other.kind && board.text === other.text) continue;
    differences.push({
      where: board ? `line ${board.line}, ${board.kind}` : `answer ${n + 1}`,
      board: board?.text ?? NONE,
      simulation: other?.text ?? NONE,
      words: board?.words ?? other?.words ?? "",
      timing: slower !== undefined && other?.text !== late?.text && board?.text === late?.text,
    });
  }
  const whole = golden.open ? [] : positions;
  whole.forEach((position, axis) => {
    if (position === golden.positions[axis]) return;
    differences.push({
      where: `position of axis ${axis + first}`,
      board: String(position),
      simulation: String(golden.positions[axis]),
      words: "",
      timing: slower !== undefined && slower.positions[axis] !== golden.positions[axis],
    });
  });
  return { answers: count, positions: whole.length, differences };
}

/** Return the text with a pause before each line, as if the host were slower. */
export function slowed(text: string, ms = 20): string {
  return text
    .split("\n")
    .map((line) => (line.split("#")[0]!.trim() ? `wait ${ms}ms; ${line}` : line))
    .join("\n");
}

/** Combines the steps of a simulation to motions. */
export class Motions {
  readonly all: Motion[] = [];
  private readonly now = new Map<number, { motion: Motion; t: number }>();

  constructor(private readonly clkHz: number) {}

  step(axis: number, t: number, ccw: boolean): void {
    const known = this.now.get(axis);
    const interval = known ? (t - known.t) / this.clkHz : Infinity;
    if (known && known.motion.ccw === ccw && interval < PAUSE_S) {
      const { motion } = known;
      motion.pulses++;
      motion.first ||= 1 / interval;
      motion.fastest = Math.max(motion.fastest, 1 / interval);
      known.t = t;
      return;
    }
    const motion = { axis, ccw, pulses: 1, first: 0, fastest: 0 };
    this.all.push(motion);
    this.now.set(axis, { motion, t });
  }
}

/** Return one line for each axis and each motion. scale: crystal of the board divided by that of the simulation. */
export function motionLines(motions: readonly Motion[], axes: number, first: number, scale = 1): string[] {
  const found: string[] = [];
  for (let axis = 0; axis < axes; axis++) {
    const own = motions.filter((motion) => motion.axis === axis);
    const name = `axis ${axis + first}`;
    for (const motion of own.slice(0, SHOWN)) {
      const rate = (value: number): string => String(Math.round(value * scale));
      const speed = motion.fastest
        ? `, from ${rate(motion.first)} up to ${rate(motion.fastest)} pulses/s`
        : "";
      found.push(`${name}: ${motion.pulses} pulse${motion.pulses === 1 ? "" : "s"} ${motion.ccw ? "CCW" : "CW"}${speed}`);
    }
    const rest = own.slice(SHOWN);
    if (!rest.length) continue;
    const sum = (ccw: boolean): number => rest.reduce((all, one) => all + (one.ccw === ccw ? one.pulses : 0), 0);
    const fastest = Math.round(Math.max(...rest.map((one) => one.fastest)) * scale);
    found.push(`${name}: ${rest.length} more motions, ${sum(false)} pulses CW and ${sum(true)} CCW, up to ${fastest} pulses/s`);
  }
  return found;
}
