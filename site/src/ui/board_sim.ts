// Simulates a session in a separate worker: answers, positions and motions, before a board executes it.

import { Motions, type Simulated } from "../engine/serial_compare";
import { ROW } from "../engine/core";
import type { Frame, FromWorker, LogEntry, PartData, ToWorker } from "../types";
import { loadWasm, makeWorker } from "./load";

const STEP = 1 << 17;
const LONGEST_MS = 60_000; // longest simulation
const AFTER_S = 0.5; // if a motor still moves this long after the end of the text, its motion is taken as endless

export class Simulation {
  private worker: Worker | undefined;
  private ready: Promise<void> | undefined;
  private take: (message: FromWorker) => void = () => undefined;
  private abort: () => void = () => undefined;

  /** part: in the build that simulates the texts. */
  constructor(readonly part: PartData) {}

  load(): Promise<void> {
    this.ready ??= loadWasm(this.part).then(
      (wasm) =>
        new Promise<void>((done, fail) => {
          const worker = makeWorker();
          this.worker = worker;
          worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
            if (data.kind === "ready") done();
            else this.take(data);
            // The worker waits for the message "shown" before it sends the next frame.
            if (data.kind === "frame") worker.postMessage({ kind: "shown" } satisfies ToWorker);
          };
          worker.onerror = (event) => fail(new Error(event.message));
          worker.postMessage({ kind: "load", part: this.part, wasm } satisfies ToWorker, [wasm]);
        }),
    );
    return this.ready;
  }

  close(): void {
    this.worker?.terminate();
  }

  /** Simulate a text. A simulation that is still running is aborted. */
  async run(text: string): Promise<Simulated> {
    this.abort();
    await this.load();
    const ask = (message: ToWorker): void => this.worker!.postMessage(message);
    const log: LogEntry[] = [];
    const motions = new Motions(this.part.clkHz);
    let over = Infinity;
    return new Promise((done, fail) => {
      let began = false;
      const end = (frame: Frame | undefined, open: string): void => {
        clearTimeout(timer);
        this.take = () => undefined;
        ask({ kind: "pause" });
        const answers = log.filter((entry) => entry.answer);
        done({ answers, positions: frame?.positions ?? [], motions: motions.all, open });
      };
      let latest: Frame | undefined;
      this.abort = () => {
        clearTimeout(timer);
        fail(new Error("aborted by another simulation"));
      };
      const timer = setTimeout(() => end(latest, "the simulation takes longer than a minute"), LONGEST_MS);
      this.take = (message) => {
        if (message.kind === "began") began = true;
        if (message.kind === "error") {
          clearTimeout(timer);
          this.take = () => undefined;
          fail(new Error(message.text));
        }
        if (message.kind !== "frame" || !began) return;
        latest = message;
        log.push(...message.log);
        const view = new DataView(message.rows);
        for (let at = 0; at + ROW <= message.rows.byteLength; at += ROW) {
          const pin = view.getUint32(at + 8, true);
          if (pin >= STEP) motions.step(pin - STEP, view.getFloat64(at, true), view.getUint32(at + 12, true) === 1);
        }
        if (message.over) over = Math.min(over, message.t);
        if (message.over && !message.running) end(message, "");
        else if (message.t - over > AFTER_S * this.part.clkHz) end(message, "a motor continues until it is stopped");
      };
      ask({ kind: "start", text, speed: 0, label: "" });
    });
  }
}
