// Log of the bus: all accesses with time and meaning.

import { useEffect, useRef, useState } from "preact/hooks";
import { log, part, shows } from "./state";

const NAMES: Record<string, string> = {
  c: "command",
  d: "data",
  r: "read",
  st: "status",
  ">": "block",
  "<": "answer",
  f: "frame",
  w: "write",
  put: "write",
  get: "read",
};
const SHOWN = 300;

export function BusLog() {
  const list = useRef<HTMLDivElement>(null);
  const [only, setOnly] = useState(false);
  const clk = part.value?.clkHz ?? 1;
  const rows = (only ? log.value.filter((row) => row.kind !== "st") : log.value).slice(-SHOWN);
  useEffect(() => {
    const box = list.current;
    if (box) box.scrollTop = box.scrollHeight;
  }, [log.value]);
  return (
    <section class="pg-box" aria-labelledby="pg-log">
      <h2 id="pg-log">
        Bus{" "}
        <label class="pg-check">
          <input type="checkbox" checked={only} onChange={(event) => setOnly(event.currentTarget.checked)} />{" "}
          without status reads
        </label>
      </h2>
      <div
        class="pg-log"
        ref={list}
        data-run={shows.value}
        tabIndex={0}
        role="log"
        aria-label="accesses on the bus"
      >
        <table class="pg-table">
          <thead>
            <tr>
              <th>ms</th>
              <th>access</th>
              <th>byte</th>
              <th>meaning</th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <tr class={row.bad ? "pg-bad" : `pg-${row.kind}`}>
                <td>{((row.t / clk) * 1e3).toFixed(4)}</td>
                <td>{NAMES[row.kind] ?? row.kind}</td>
                <td>
                  <code>{row.text}</code>
                </td>
                <td>{row.words}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
