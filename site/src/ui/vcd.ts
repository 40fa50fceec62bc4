// Writes the waves as a VCD file: ports of the RTL, times of the rising edges in ps.

import type { Port } from "../types";
import type { Row, Store } from "./store";

interface Signal {
  id: string;
  port: Port;
  rows: Row[];
  value: bigint;
}

export function vcd(store: Store): string {
  const { part } = store;
  const signals: Signal[] = [];
  let row = 0;
  for (const [ports, input] of [
    [part.inputs, true],
    [part.outputs, false],
  ] as const)
    for (const port of ports) {
      const count = store.find(port.name, input) ? 1 : port.width;
      signals.push({
        id: name(signals.length),
        port,
        rows: store.rows.slice(row, row + count),
        value: 0n,
      });
      row += count;
    }
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
  const changes: { t: number; signal: Signal; bit: number; value: number }[] = [];
  for (const signal of signals)
    signal.rows.forEach(({ track }, bit) => {
      for (let n = 0; n < track.count; n++)
        changes.push({ t: track.times[n]!, signal, bit, value: track.values[n]! });
    });
  changes.sort((a, b) => a.t - b.t);
  const changed = new Set<Signal>();
  changes.forEach(({ t, signal, bit, value }, n) => {
    const old = signal.value;
    const whole = signal.rows.length === 1 ? 0xffffffffn : 1n;
    signal.value = (old & ~(whole << BigInt(bit))) | (BigInt(value) << BigInt(bit));
    changed.add(signal);
    if (changes[n + 1]?.t === t) return;
    lines.push(`#${Math.max(0, Math.round((t + 1) * ps))}`);
    for (const { id, port, value: now } of changed)
      lines.push(port.width > 1 ? `b${now.toString(2)} ${id}` : `${now}${id}`);
    changed.clear();
  });
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
