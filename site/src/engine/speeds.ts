// Speed of a motor over time, computed from its steps: a staircase with v[n] from t[n] on.

export interface Speeds {
  /** s */
  t: number[];
  /** Steps per second. */
  v: number[];
}

const MOST = 4_000; // entries of a staircase
/** An interval longer than this multiple of its neighbours is a standstill. */
const PAUSE = 8;
/** The multiple for an interval in which the host has written. */
const PAUSE_WRITTEN = 3;

interface Interval {
  from: number;
  clk: number;
  turned: boolean;
  written: boolean;
}

export class Speed {
  private readonly stairs: Speeds = { t: [0], v: [0] };
  private last = -1;
  private way = 0;
  private written = false;
  private open: Interval | undefined;
  private before = 0; // cycles of the previous interval; 0: standstill

  constructor(private readonly clkHz: number) {}

  /** Note that the host has written since the last step. */
  write(): void {
    this.written = true;
  }

  /** Record a step in cycle `t`; way 1: CCW. */
  step(t: number, way: number): void {
    if (this.last >= 0) {
      const next: Interval = {
        from: this.last,
        clk: t - this.last,
        turned: way !== this.way,
        written: this.written,
      };
      if (this.open) {
        const rate = this.rate(this.open, next.turned ? 0 : next.clk);
        this.push(this.stairs, this.open.from, rate);
        this.before = rate ? this.open.clk : 0;
      }
      this.open = next;
    }
    this.last = t;
    this.way = way;
    this.written = false;
    if (this.stairs.t.length > MOST) this.halve();
  }

  /** Return the speed up to cycle `end`. */
  upTo(end: number): Speeds {
    const found = { t: [...this.stairs.t], v: [...this.stairs.v] };
    if (this.open) {
      const rate = this.rate(this.open, 0);
      this.push(found, this.open.from, rate);
      if (end - this.last > PAUSE_WRITTEN * this.open.clk) this.push(found, this.last, 0);
    }
    found.t.push(end / this.clkHz);
    found.v.push(found.v.at(-1)!);
    return found;
  }

  /** Speed in an interval, by comparison with its neighbours; 0: standstill, no speed can be measured. */
  private rate(one: Interval, after: number): number {
    const near = Math.max(this.before, after);
    const stood = near ? one.clk > near * (one.written ? PAUSE_WRITTEN : PAUSE) : one.written;
    return one.turned || stood ? 0 : this.clkHz / one.clk;
  }

  private push(to: Speeds, clk: number, v: number): void {
    if (to.v.at(-1) === v) return;
    to.t.push(clk / this.clkHz);
    to.v.push(v);
  }

  /** Replace each pair of entries by its mean. */
  private halve(): void {
    const { t, v } = this.stairs;
    let count = 0;
    for (let n = 0; n < t.length; n += 2) {
      const whole = n + 2 < t.length ? t[n + 2]! - t[n]! : 0;
      v[count] = whole ? (v[n]! * (t[n + 1]! - t[n]!) + v[n + 1]! * (t[n + 2]! - t[n + 1]!)) / whole : v[n]!;
      t[count++] = t[n]!;
      if (!whole && n + 1 < t.length) {
        t[count] = t[n + 1]!;
        v[count++] = v[n + 1]!;
      }
    }
    t.length = v.length = count;
  }
}

/** Return columns over one time axis; a value is undefined where the speed of a motor does not change. */
export function columns(speeds: readonly Speeds[]): (number | undefined)[][] {
  const times: number[] = [];
  const found: (number | undefined)[][] = speeds.map(() => []);
  const at = speeds.map(() => 0);
  for (;;) {
    const t = Math.min(...speeds.map((one, n) => one.t[at[n]!] ?? Infinity));
    if (t === Infinity) return [times, ...found];
    times.push(t);
    speeds.forEach((one, n) => {
      const here = one.t[at[n]!] === t;
      found[n]!.push(here ? one.v[at[n]!] : undefined);
      if (here) at[n]!++;
    });
  }
}
