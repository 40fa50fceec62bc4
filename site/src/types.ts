// Types that the page, the worker and the exported tables (scripts/site/export.py) share.

export interface Port {
  name: string;
  width: number;
  /** Idle level of an input, reset level of an output; low word first. */
  idle: number[];
  /** Number of the port's lowest bit, as in the pin name s[1]. */
  lowest: number;
  /** Number of the port's first 32-bit word in the module; inputs and outputs are numbered separately. */
  word: number;
}

export interface Field {
  name: string;
  bytes: number;
  /** Added to the value for display, because counts are sent minus one. */
  plus: number;
  /** How the value is displayed: as a signed number, or with the names of its bits (bit 7 first), or `none`. */
  signed?: boolean;
  bits?: string[];
  none?: string;
  /** Or with the name of the value, by the value in hexadecimal digits. */
  names?: Record<string, string>;
}

export interface Code {
  text: string;
  fields: Field[];
  /** Key in `answers`, or else the name of the value that is read; count: number of bytes of the answer. */
  answer: string;
  count: number;
  /** ID of the rule in the manual. */
  rule: string;
  /** Alternative lists of parameters, of an instruction and of its answer; the length of a block selects the list. */
  forms?: Field[][];
  answerForms?: Field[][];
}

/** Rule of a manual: its text, and the address of its row. */
export interface Rule {
  text: string;
  page: string;
}

export interface Words {
  codes: Record<string, Code>;
  status: string[];
  /** Rules by their ID; statusRule: the one of the status register. */
  rules: Record<string, Rule>;
  statusRule: string;
  answers: Record<string, string[]>;
  /** Names of registers, by "read 4" or "write 4". */
  registers?: Record<string, string>;
  reports?: Record<string, string>;
  causes?: Record<string, string>;
  /** For parts with blocks: meaning of a header by direction and byte, parameters of reports, rule of reports. */
  headers?: Record<string, string>;
  reportForms?: Record<string, Field[][]>;
  reportRule?: string;
  /** For a line: data of the reply to a poll. */
  pollForms?: Field[][];
}

export interface Session {
  name: string;
  title: string;
  text: string;
}

export interface MotorPins {
  /** Pins of the switches in the order CW, CCW, slow CW, slow CCW, origin, alarm. */
  switches: string[];
  step: string;
  /** Level of `step` after the edge that counts as a step. */
  edge: number;
  dir: string;
  /** Pins of the phases, S1 first. */
  phases: string[];
}

/** Data that differ between the builds of a part. */
export interface Build {
  clkHz: number;
  /** Parameters of the RTL. */
  params: Record<string, number | string>;
  /** Pins in a record of a board, and their widths, lowest bit first. */
  recorder: [string, number][];
  inputs: Port[];
  outputs: Port[];
  /** File with the module. */
  wasm: string;
}

export interface PartData extends Build {
  name: string;
  title: string;
  bus: string;
  /** Clock of the cycles in a text: that of the build in the page, also if the text is played on another build. */
  textHz: number;
  motors: MotorPins[];
  /** Further pins that the reader can press. */
  straps: string[];
  words: Words;
  sessions: Session[];
  style: Record<string, unknown>;
  board: BoardData;
}

/** Data for a real board with the UART bridge; undefined for a part without a bridge. */
export interface BoardData {
  /** Part number in IDENT; 0: the part is not accessed through a bridge. */
  number: number;
  /** Builds with the parameters of boards, without the values that are equal to those of the page. */
  builds: Partial<Build>[];
  boards: Bitstream[];
}

/** A board for which a bitstream of the part can be built. */
export interface Bitstream {
  title: string;
  /** Commands in a checkout, and the command that loads a file of a release. */
  build: string;
  load: string;
  loader: string;
}

/** Field of a block: name, bytes, meaning. */
export type Decoded = [name: string, bytes: string, value: string];

export interface LogEntry {
  /** First and last cycle of the access. */
  from: number;
  t: number;
  /** Line of the text; 0: the access is not from the text. */
  line: number;
  kind: string;
  text: string;
  words: string;
  rule?: string;
  fields?: Decoded[];
  /** Station of a line that sends or receives the frame. */
  station?: number;
  bad?: boolean;
  /** The entry is a value that the text reads. */
  answer?: boolean;
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
  /** The end of the text has been played; the part may still move. */
  over: boolean;
  /** Whether the switches of the machine are active; places: positions as in MACHINE (side.ts). */
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
