// Interface to the module of a part: the functions of site/core/core.cpp. Times are in cycles.

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  power_up(): void;
  place(
    axis: number,
    start: number,
    ccw: number,
    slowCcw: number,
    origin: number,
    slowCw: number,
    cw: number,
  ): void;
  plant(on: number): void;
  position(axis: number): number;
  steps(axis: number): number;
  put(pin: number, value: number): void;
  wave(number: number, pin: number, mask: number, low: number, high: number): void;
  output(pin: number): number;
  input(pin: number): number;
  clk_now(): number;
  row_at(): number;
  take(): number;
  run(n: number, until: number): number;
}

/** Bits of `until`. */
export const STEP = 1;
export const CHANGE = 2;
export const ROW = 16;

export class Core {
  private readonly exports: Exports;
  private said = "";

  constructor(bytes: BufferSource) {
    const module = new WebAssembly.Module(bytes);
    let memory: WebAssembly.Memory | undefined;
    const view = (): DataView => new DataView((memory as WebAssembly.Memory).buffer);
    const known: Record<string, (...words: number[]) => number> = {
      fd_write: (_fd, vectors, count, written) => {
        let total = 0;
        for (let n = 0; n < count!; n++) {
          const at = view().getUint32(vectors! + 8 * n, true);
          const size = view().getUint32(vectors! + 8 * n + 4, true);
          this.said += new TextDecoder().decode(new Uint8Array(memory!.buffer, at, size));
          total += size;
        }
        view().setUint32(written!, total, true);
        return 0;
      },
      proc_exit: (code) => {
        throw new Error(`the module ended with code ${code}`);
      },
    };
    const empty = (count: number, size: number): number => {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    };
    known.environ_sizes_get = empty as never;
    known.args_sizes_get = empty as never;
    const wasi: Record<string, unknown> = {};
    for (const { name } of WebAssembly.Module.imports(module)) wasi[name] = known[name] ?? (() => 0);
    const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: wasi as never });
    this.exports = instance.exports as unknown as Exports;
    memory = this.exports.memory;
    this.exports._initialize();
    this.exports.power_up();
  }

  /** Return and clear the messages of the RTL ($fatal, $error). */
  message(): string {
    const text = this.said.trim();
    this.said = "";
    return text;
  }

  get now(): number {
    return this.exports.clk_now();
  }
  powerUp(): void {
    this.exports.power_up();
  }
  run(clk: number, until: number): number {
    return this.exports.run(clk, until);
  }
  put(word: number, value: number): void {
    this.exports.put(word, value);
  }
  wave(number: number, word: number, mask: number, low: number, high: number): void {
    this.exports.wave(number, word, mask, low, high);
  }
  output(word: number): number {
    return this.exports.output(word) >>> 0;
  }
  input(word: number): number {
    return this.exports.input(word) >>> 0;
  }
  position(axis: number): number {
    return this.exports.position(axis);
  }
  steps(axis: number): number {
    return this.exports.steps(axis) >>> 0;
  }
  plant(on: boolean): void {
    this.exports.plant(on ? 1 : 0);
  }
  place(axis: number, at: readonly number[]): void {
    const [start = 0, ccw = 0, slowCcw = 0, origin = 0, slowCw = 0, cw = 0] = at;
    this.exports.place(axis, start, ccw, slowCcw, origin, slowCw, cw);
  }
  /** Return the rows of the last `run`: time as a double, pin and value as 32 bits each. */
  rows(): Uint8Array {
    const count = this.exports.take();
    return new Uint8Array(this.exports.memory.buffer, this.exports.row_at(), count * ROW).slice();
  }
}
