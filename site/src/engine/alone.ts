// The engine without a page, for node (tests/common/web/play.mjs): play a session, return all edges of outputs.

import type { PartData } from "../types";
import { Store } from "../ui/store";
import { Core, ROW } from "./core";
import { Player } from "./player";
import type { Speeds } from "./speeds";

export { Deframer, encode } from "./serial_frames";
export { Link } from "./serial_link";

export interface Played {
  end: number;
  /** (t, word of an output, value) */
  edges: [number, number, number][];
  bad: string[];
  /** Data of the speed plot of each motor. */
  speeds: Speeds[];
}

export function play(part: PartData, wasm: Uint8Array, text: string): Played {
  const core = new Core(wasm as BufferSource);
  const player = new Player(core, part);
  player.start(text);
  const edges: [number, number, number][] = [];
  const store = new Store(part);
  let told = 0;
  const take = (): void => {
    const rows = core.rows();
    const view = new DataView(rows.buffer);
    for (let at = 0; at < rows.length; at += ROW) {
      const pin = view.getUint32(at + 8, true);
      if (pin < 1 << 16) edges.push([view.getFloat64(at, true), pin, view.getUint32(at + 12, true)]);
    }
    store.take(rows.slice().buffer, core.now, player.side.log.slice(told));
    told = player.side.log.length;
  };
  for (;;) {
    // Stop after the last wait of the host, so that the end is that of the text.
    const before = core.now;
    if (player.over) break;
    player.advance(1_000_000, false, true);
    take();
    if (player.over && core.now === before) break;
  }
  return {
    end: core.now - 1,
    edges,
    bad: player.side.log.filter((one) => one.bad).map((one) => `${one.kind} ${one.text}: ${one.words}`),
    speeds: store.speeds.map((one) => one.upTo(core.now)),
  };
}
