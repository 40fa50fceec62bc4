// Characters of a serial line with 8 data bits, sent and received bit by bit.

import { CHANGE } from "./core";
import { Host } from "./host";
import type { Doing, Side } from "./side";

export class CharacterHost extends Host {
  protected readonly bit: number;

  constructor(side: Side) {
    super(side);
    this.bit = Number(side.part.style.bit);
  }

  /** Level of the line to the part. */
  protected get driven(): boolean {
    return Boolean(this.side.levels.get("rxd"));
  }
  protected drive(level: number): void {
    this.side.set("rxd", level);
  }
  /** Level of the line from the part. */
  protected heard(): number {
    return this.side.level("txd");
  }

  private *reach(clk: number): Doing {
    yield* this.side.clocks(clk - this.side.core.now);
  }

  /** Send characters back to back; end when the line is free again. */
  protected *say(line: readonly number[]): Doing {
    let free = this.side.core.now;
    for (const one of line) {
      const start = free;
      for (let place = 0; place < 10; place++) {
        const level = place === 0 ? 0 : place === 9 ? 1 : (one >> (place - 1)) & 1;
        if (Number(this.driven) === level) continue;
        yield* this.reach(up(start + place * this.bit));
        this.drive(level);
      }
      free = up(start + 10 * this.bit);
    }
    yield* this.reach(free);
  }

  /** Receive a character; return undefined if it does not begin within `limit` cycles. */
  protected *hear(limit: number): Doing<number | undefined> {
    const end = this.side.core.now + limit;
    while (this.heard()) {
      if (this.side.core.now >= end) return undefined;
      yield { clk: end - this.side.core.now, until: CHANGE };
    }
    const start = this.side.core.now;
    let value = 0;
    for (let place = 1; place < 10; place++) {
      yield* this.reach(start + up((place + 0.5) * this.bit));
      value |= this.heard() << (place - 1);
    }
    return value & 0xff;
  }
}

/** Round up to whole cycles; a sum of bit times that is a whole number except for rounding is not changed. */
function up(clk: number): number {
  return Math.ceil(clk - 1e-6);
}
