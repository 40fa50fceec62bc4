// Accesses on a bus with strobes, and pauses between polls, equal to tests/common/web/script.py and players.py.

import { PATIENCE } from "./host";
import type { Doing, Side } from "./side";
import { TextError } from "./text";

const DENSE = 16;
const FIRST = 4;
const LONGEST = 8_000;

type Levels = Record<string, number>;

/** Pin levels of each half of an access, its times in cycles: BusStyle in cocotb_tests/harness/part.py */
export interface Style {
  address: string;
  writeOn: Levels;
  writeOff: Levels;
  readOn: Levels;
  readOff: Levels;
  busy: number;
  lead: number;
  strobe: number;
  readStrobe: number;
  gap: number;
}

export class Strobes {
  readonly style: Style;

  constructor(private readonly side: Side) {
    this.style = side.part.style as unknown as Style;
  }

  private *address(address: number): Doing {
    if (!this.style.lead) return;
    this.side.set(this.style.address, address);
    yield* this.side.clocks(this.style.lead);
  }

  /** Write a byte; `done` is called when the strobe ends. */
  *write(address: number, value: number, done: () => void): Doing {
    const { side, style } = this;
    side.from = side.core.now;
    yield* this.address(address);
    side.sets({ [style.address]: address, d_i: value, ...style.writeOn });
    yield* side.clocks(style.strobe);
    side.sets(style.writeOff);
    done();
    yield* side.clocks(style.gap);
  }

  *read(address: number): Doing<number> {
    const { side, style } = this;
    side.from = side.core.now;
    yield* this.address(address);
    side.sets({ [style.address]: address, ...style.readOn });
    yield* side.clocks(style.readStrobe);
    const value = side.level("d_o");
    side.sets(style.readOff);
    yield* side.clocks(style.gap);
    return value;
  }
}

/** Pauses between polls, of increasing length. */
export class Pauses {
  private count = 0;
  private pause = FIRST;
  private readonly end: number;

  constructor(private readonly side: Side) {
    this.end = side.core.now + side.cycles(PATIENCE);
  }

  *next(): Doing {
    if (this.side.core.now > this.end) throw new TextError("the polled status does not occur before the time limit");
    if (++this.count < DENSE) return;
    this.pause = Math.min(LONGEST, Math.floor((this.pause * 5) / 4) + 1);
    yield* this.side.clocks(this.pause);
  }
}
