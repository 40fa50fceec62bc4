// Log of the bus: all accesses with time and meaning. The reader selects one with the pointer or the arrow keys.

import { useEffect, useRef, useState } from "preact/hooks";
import { isLine, log, part, select, selected, shows } from "./state";

const NAMES: Record<string, string> = {
  c: "command",
  d: "data",
  r: "read",
  st: "status",
  ">": "block",
  "<": "answer",
  f: "frame",
  "?": "poll",
  "!": "answer",
  w: "write",
  put: "write",
  get: "read",
};
const SHOWN = 300;
/** Entries without news: reads of the status, polls, and replies of busy stations. */
const POLLS = new Set(["st", "?", "!"]);

export function BusLog() {
  const list = useRef<HTMLDivElement>(null);
  const [only, setOnly] = useState(false);
  const clk = part.value?.clkHz ?? 1;
  const chosen = selected.value;
  const all = only ? log.value.filter((row) => !POLLS.has(row.kind) || row === chosen) : log.value;
  const at = chosen ? all.indexOf(chosen) : -1;
  const end = at < 0 ? all.length : Math.min(all.length, at + SHOWN / 2);
  const rows = all.slice(Math.max(0, end - SHOWN), end);
  useEffect(() => {
    const box = list.current;
    if (box && !selected.value) box.scrollTop = box.scrollHeight;
  }, [log.value]);
  useEffect(() => {
    const box = list.current;
    const row = box?.querySelector<HTMLElement>("[aria-current]");
    if (!box || !row) return;
    const y = row.offsetTop - box.scrollTop;
    if (y < row.offsetHeight || y + row.offsetHeight > box.clientHeight)
      box.scrollTop = row.offsetTop - box.clientHeight / 2;
  }, [chosen]);
  const key = (event: KeyboardEvent): void => {
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (event.key === "Escape") select(undefined, "log");
    if (!step) return;
    event.preventDefault();
    select(all[at < 0 ? all.length - 1 : Math.min(Math.max(at + step, 0), all.length - 1)], "log");
  };
  return (
    <>
      <h2 id="pg-log">
        {isLine() ? "Line" : "Bus"}{" "}
        <label class="pg-check">
          <input type="checkbox" checked={only} onChange={(event) => setOnly(event.currentTarget.checked)} />{" "}
          {isLine() ? "without polls" : "without status reads"}
        </label>
      </h2>
      <div
        class="pg-log"
        ref={list}
        data-run={shows.value}
        tabIndex={0}
        role="region"
        aria-label="accesses on the bus; the arrow keys select one"
        onKeyDown={key}
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
              <tr
                class={row.bad ? "pg-bad" : POLLS.has(row.kind) ? "pg-st" : ""}
                aria-current={row === chosen ? "true" : undefined}
                onClick={() => select(row === chosen ? undefined : row, "log")}
              >
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
    </>
  );
}
