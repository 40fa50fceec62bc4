// Connection to the UART bridge of a board: identity, line rate, one request at a time.

import { crc16, Deframer, encode, WAKE_UP } from "./serial_frames";

/** Byte stream to a board. The page uses Web Serial (ui/board_port.ts). */
export interface Line {
  write(bytes: Uint8Array): Promise<void>;
  /** Open the port again at another rate. */
  rate(baud: number): Promise<void>;
  close(): Promise<void>;
  onData: (bytes: Uint8Array) => void;
  /** The port has disappeared. */
  onLost: () => void;
}

/** Error that the page shows as one line. */
export class BoardError extends Error {}
/** No valid answer; `received`: number of bytes that arrived instead. */
class NoAnswer extends BoardError {
  constructor(
    told: string,
    readonly received: number,
  ) {
    super(told);
  }
}
/** The port has disappeared. */
export class Lost extends BoardError {}

/** Answer of the bridge (UB-ANS-01). `at` is the position of the operation that ended the script. */
export interface Answer {
  result: number;
  at: number;
  last: number;
  data: number[];
}

export interface Identity {
  part: number;
  axes: number;
  datasheet: boolean;
  counter: boolean;
  bestRate: number;
  xtalHz: number;
  clkHz: number;
}

/** Sources of the bitstream (UB-VER-01). */
export interface Build {
  version: string;
  changed: boolean;
  source: string;
  commit: string;
  board: string;
}

export const BASE = 115_200;
const RATES: readonly number[] = [BASE, 230_400, 460_800, 921_600, 1_000_000, 2_000_000, 3_000_000];
const WORK = 1_000_000;
const PROTOCOL = 1;
const MARGIN = 600; // ms without an answer after which a request is repeated, in addition to its own duration
const TRIES = 4;
const GRACE = 50; // ms from a NAK to the repetition of the request
const QUIET = 30; // ms without a byte before the first request
const IDENT = 0x01;
const RATE = 0x02;
const VERSION = 0x0c;
const LAST_SEQ = 127;
const BUSY_LINE = 5; // ms for which `shout` sends further copies of each script, in addition to COPIES
const COPIES = 4;

export const word = (bytes: readonly number[], at = 0): number =>
  bytes[at]! + bytes[at + 1]! * 0x100 + bytes[at + 2]! * 0x10000 + bytes[at + 3]! * 0x1000000;
export const message = (error: unknown): string => (error instanceof Error ? error.message : String(error));
const sleep = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

export class Link {
  identity!: Identity;
  build: Build | undefined;
  baud = BASE;
  lost = false;
  onLost: () => void = () => undefined;
  /** Requests that were sent again. */
  repeats = 0;
  private seq = 0;
  private received = 0;
  private readonly deframer = new Deframer();
  private take: (content: number[]) => void = () => undefined;
  private fail: (error: Error) => void = () => undefined;
  private queue: Promise<unknown> = Promise.resolve();

  constructor(readonly line: Line) {
    line.onData = (bytes) => {
      this.received += bytes.length;
      for (const content of this.deframer.feed(bytes)) this.take(content);
    };
    line.onLost = () => {
      this.lost = true;
      this.fail(new Lost("the port was lost"));
      this.onLost();
    };
  }

  /** Identify the board, and then use a higher line rate. Sends only IDENT until the board is known. */
  async open(): Promise<void> {
    await this.identify();
    const code = RATES.indexOf(WORK);
    if (this.identity.bestRate >= code) {
      await this.request([RATE, code]);
      try {
        await this.line.rate(WORK);
        this.baud = WORK;
        await this.request([IDENT], 0, 2);
      } catch (error) {
        if (this.lost) throw error;
        this.baud = BASE;
        await this.line.rate(BASE);
        await this.identify();
      }
    }
    const { result, data } = await this.request([VERSION]);
    if (!result && data.some(Boolean)) this.build = parseBuild(data);
  }

  private async identify(): Promise<void> {
    let received = 0;
    for (let attempt = 0; attempt < 3; attempt++) {
      this.received = 0;
      await this.line.write(Uint8Array.from(WAKE_UP));
      await sleep(QUIET);
      received += Math.max(0, this.received - 16); // 16 bytes: two NAKs that the wake-up may cause
      this.deframer.reset();
      this.seq = 0;
      try {
        const { data } = await this.request([IDENT], 0, 1);
        this.identity = parseIdentity(data);
        return;
      } catch (error) {
        if (!(error instanceof NoAnswer)) throw error;
        received += error.received;
      }
    }
    throw new BoardError(
      received
        ? `another device answers on this port (${received} bytes, but no answer of a PPMC bridge); choose the port of the board`
        : "the board does not answer; check its power, that its bitstream is loaded, and that this is its port",
    );
  }

  /** Send a script and return its answer. duration: longest time that it runs, in ms. */
  request(script: readonly number[], duration = 0, tries = TRIES): Promise<Answer> {
    const sent = this.queue.then(() => this.exchange(script, duration, tries));
    this.queue = sent.catch(() => undefined);
    return sent;
  }

  private async exchange(script: readonly number[], duration: number, tries: number): Promise<Answer> {
    const following = (seq: number): number => (seq % LAST_SEQ) + 1;
    let { seq } = this;
    // If the CRC ended with 00, the frame would also be valid without this 00, or with two of them.
    while (!(crc16([seq, ...script]) & 0xff)) seq = following(seq);
    this.seq = following(seq);
    const frame = encode([seq, ...script]);
    const patience = duration + MARGIN + ((frame.length + 300) * 20_000) / this.baud;
    const before = this.received;
    for (let attempt = 0; attempt < tries; attempt++) {
      if (attempt) this.repeats++;
      const answer = await this.once(frame, seq, patience);
      if (answer) return answer;
    }
    throw new NoAnswer("the board does not answer any more; check its power and the cable", this.received - before);
  }

  private once(frame: Uint8Array, seq: number, patience: number): Promise<Answer | undefined> {
    return new Promise((done, fail) => {
      let timer = 0 as unknown as ReturnType<typeof setTimeout>;
      const end = (action: () => void): void => {
        clearTimeout(timer);
        this.take = this.fail = () => undefined;
        action();
      };
      const none = (): void => end(() => done(undefined));
      if (this.lost) {
        fail(new Lost("the port was lost"));
        return;
      }
      this.fail = (error) => end(() => fail(error));
      this.take = (content) => {
        if (content[0] === 0x81) {
          // A NAK may belong to noise before the request; then the answer arrives within GRACE.
          clearTimeout(timer);
          timer = setTimeout(none, GRACE);
        } else if (content[0] === seq && content.length >= 2) end(() => done(parseAnswer(content)));
      };
      timer = setTimeout(none, patience);
      this.line.write(frame).catch(() => this.lost || this.line.onLost());
    });
  }

  /** Send scripts several times each, without waiting for an answer, because the page is being closed.
   *
   * The first bytes end a wait of the bridge. The bridge drops all bytes that arrive until its answer has been sent,
   * and then executes a later copy (UB-FRM-07). A request with SEQ 0 is executed each time. */
  shout(scripts: readonly number[][]): void {
    if (this.lost) return;
    const all = scripts.flatMap((script) => {
      const frame = [...encode([0, ...script])];
      const count = COPIES + Math.ceil((BUSY_LINE * this.baud) / 10_000 / frame.length);
      return Array<number[]>(count).fill(frame).flat();
    });
    this.line.write(Uint8Array.from(all)).catch(() => undefined);
  }

  /** Return to 115 200 baud and close the port. */
  async close(): Promise<void> {
    try {
      if (!this.lost) await this.request([RATE, 0], 0, 1);
    } catch {
      // The board does not answer; the port is closed nevertheless.
    }
    await this.line.close().catch(() => undefined);
  }
}

function parseAnswer(content: readonly number[]): Answer {
  const result = content[1]!;
  if (!result) return { result, at: -1, last: 0, data: content.slice(2) };
  return { result, at: content[2] ?? 0, last: content[3] ?? 0, data: content.slice(4) };
}

function parseIdentity(data: readonly number[]): Identity {
  if (data.length !== 16 || String.fromCharCode(...data.slice(0, 4)) !== "PPMC")
    throw new BoardError("another device answers on this port; choose the port of the board");
  if (data[4] !== PROTOCOL)
    throw new BoardError(
      `the board uses version ${data[4]} of the protocol, this page version ${PROTOCOL}; renew ` +
        (data[4]! > PROTOCOL ? "the page" : "the bitstream"),
    );
  const flags = data[7]!;
  return {
    part: data[5]! | (data[6]! << 8),
    datasheet: (flags & 1) === 1,
    counter: (flags & 2) !== 0,
    axes: ((flags >> 2) & 3) + 1,
    bestRate: flags >> 4,
    xtalHz: word(data, 8),
    clkHz: word(data, 12),
  };
}

function parseBuild(data: readonly number[]): Build {
  const digits = (at: number): string =>
    data
      .slice(at, at + 4)
      .map((one) => one.toString(16).padStart(2, "0"))
      .join("");
  return {
    version: data.slice(0, 3).join("."),
    changed: (data[3]! & 1) === 1,
    source: digits(4),
    commit: digits(8),
    board: String.fromCharCode(...data.slice(12).filter(Boolean)),
  };
}
