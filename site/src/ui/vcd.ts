// The waves as a VCD file: ports as the RTL has them, times in ns of clk edges.

import type { Port } from "../types";
import { joined } from "../engine/side";
import type { Store, Track } from "./store";

interface Signal {
  id: string;
  port: Port;
  tracks: Track[];
}

export function vcd(store: Store): string {
  const { part } = store;
  const signals: Signal[] = [];
  const add = (ports: readonly Port[], tracks: readonly Track[]): void => {
    for (const port of ports)
      signals.push({
        id: name(signals.length),
        port,
        tracks: port.idle.map((_, n) => tracks[port.word + n]!),
      });
  };
  add(part.inputs, store.inputs);
  add(part.outputs, store.tracks);
  const ps = 1e12 / part.clkHz;
  const lines = [
    "$timescale 1ps $end",
    `$comment ${part.title}, clk ${part.clkHz} Hz; from the OpenPPMC playground $end`,
    `$scope module ${part.name} $end`,
  ];
  for (const { id, port } of signals) {
    const range = port.width > 1 ? ` [${port.width - 1 + port.lowest}:${port.lowest}]` : "";
    lines.push(`$var wire ${port.width} ${id} ${port.name}${range} $end`);
  }
  lines.push("$upscope $end", "$enddefinitions $end");
  const changes: { t: number; signal: Signal }[] = [];
  for (const signal of signals)
    for (const track of signal.tracks)
      for (let n = 0; n < track.count; n++) changes.push({ t: track.times[n]!, signal });
  changes.sort((a, b) => a.t - b.t);
  let now = NaN;
  for (const { t, signal } of changes) {
    if (t !== now) lines.push(`#${Math.max(0, Math.round((t + 1) * ps))}`);
    now = t;
    const value = joined(signal.tracks.map((track) => track.values[track.at(t)]!));
    lines.push(signal.port.width > 1 ? `b${value.toString(2)} ${signal.id}` : `${value}${signal.id}`);
  }
  lines.push(`#${Math.round((store.end + 1) * ps)}`);
  return lines.join("\n") + "\n";
}

function name(number: number): string {
  let text = "";
  for (let left = number; ; left = Math.floor(left / 94) - 1) {
    text += String.fromCharCode(33 + (left % 94));
    if (left < 94) return text;
  }
}
