// What the page, the worker and the exported tables (scripts/site/export.py) have in common.

export interface Port {
  name: string;
  width: number;
  /** Level at rest of an input, in reset of an output; low word first. */
  idle: number[];
  /** Number of its lowest bit in names. */
  lowest: number;
  /** Number of its first word of 32 bits in the module. */
  word: number;
}

export interface Field {
  name: string;
  bytes: number;
  /** Added to the number for display: counts are sent less one. */
  plus: number;
}

export interface Code {
  text: string;
  fields: Field[];
  /** Table that explains the answer, and its bytes. */
  answer: string;
  count: number;
}

export interface Words {
  codes: Record<string, Code>;
  status: string[];
  answers: Record<string, string[]>;
  /** "read 4" and "write 4": names of registers. */
  registers?: Record<string, string>;
  reports?: Record<string, string>;
  causes?: Record<string, string>;
}

export interface Session {
  name: string;
  title: string;
  text: string;
}

export interface MotorPins {
  /** Names of pins: switches in the order CW, CCW, slow CW, slow CCW, origin, alarm. */
  switches: string[];
  step: string;
  /** Level that a step comes with. */
  edge: number;
  dir: string;
  /** Names of phases, S1 first; on: the level of a winding that is on. */
  phases: string[];
}

export interface PartData {
  name: string;
  title: string;
  bus: string;
  clkHz: number;
  inputs: Port[];
  outputs: Port[];
  motors: MotorPins[];
  /** Pins to press beside the switches. */
  straps: string[];
  words: Words;
  sessions: Session[];
  style: Record<string, unknown>;
  wasm: string;
}

export interface LogEntry {
  t: number;
  kind: string;
  text: string;
  words: string;
  bad?: boolean;
}

export type ToWorker =
  | { kind: "load"; part: PartData; wasm: ArrayBuffer }
  | { kind: "start"; text: string; speed: number; label: string }
  | { kind: "send"; text: string }
  | { kind: "press"; pin: string; level: number }
  | { kind: "machine"; words: string[] }
  | { kind: "speed"; speed: number }
  | { kind: "pause" }
  | { kind: "go" }
  | { kind: "step" }
  /** The page has drawn the last frame. */
  | { kind: "shown" };

export interface Frame {
  kind: "frame";
  t: number;
  rows: ArrayBuffer;
  positions: number[];
  log: LogEntry[];
  status: number;
  line: number;
  running: boolean;
  /** The text has been played to its end; the part may go on moving. */
  over: boolean;
  /** Whether the machine's switches act, and its places (host.ts). */
  machine: boolean;
  places: number[];
  why: string;
  mclk: number;
  levels: { inputs: number[]; outputs: number[] };
}

export type FromWorker =
  | Frame
  | { kind: "ready" }
  | { kind: "began"; label: string }
  | { kind: "journal"; line: string }
  | { kind: "error"; text: string };
