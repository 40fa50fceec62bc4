// Tool bar: part, session, clock (run, pause, step, speed), files and links.

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { parts } from "./load";
import {
  chapter,
  choose,
  chosen,
  clock,
  mclk,
  over,
  part,
  pick,
  remember,
  running,
  seconds,
  setSpeed,
  share,
  speed,
  SPEEDS,
  start,
  store,
  why,
} from "./state";
import { vcd } from "./vcd";

function time(s: number): string {
  return s < 1e-3 ? `${(s * 1e6).toFixed(1)} µs` : s < 1 ? `${(s * 1e3).toFixed(3)} ms` : `${s.toFixed(4)} s`;
}

function download(): void {
  if (!store || !part.value) return;
  const file = new Blob([vcd(store)], { type: "text/plain" });
  const anchor = document.createElement("a");
  anchor.href = URL.createObjectURL(file);
  anchor.download = `${part.value.name}.vcd`;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
}

/** children: panels of other components at the end of the bar. */
export function Bar({ children }: { children?: ComponentChildren }) {
  const [copied, setCopied] = useState("");
  const data = part.value;
  const copy = async (): Promise<void> => {
    const address = share();
    try {
      await navigator.clipboard.writeText(address);
      setCopied("link copied");
    } catch {
      setCopied("the address bar has the link");
    }
    setTimeout(() => setCopied(""), 3000);
  };
  return (
    <div class="pg-bar" role="toolbar" aria-label="playground">
      <label>
        <span>Part</span>
        <select
          class="pg-part"
          value={chosen.value}
          onChange={(event) => {
            void choose(event.currentTarget.value);
            remember();
          }}
        >
          {parts().map((one) => (
            <option value={one.name}>{one.title}</option>
          ))}
        </select>
      </label>
      <label class="pg-grow">
        <span>Session</span>
        <select
          class="pg-session"
          value={chapter.value}
          onChange={(event) => {
            pick(event.currentTarget.value);
          }}
        >
          {chapter.value === "" && <option value="">own text</option>}
          {data?.sessions.map((one) => (
            <option value={one.name}>{one.title}</option>
          ))}
        </select>
      </label>
      <button type="button" class="pg-run" onClick={() => start()} title="power the part up and play the text">
        ▶ Run
      </button>
      <button
        type="button"
        onClick={() => clock(running.value ? "pause" : "go")}
        title="Space bar, outside text fields"
      >
        {running.value ? "❚❚" : "▶"} <span>{running.value ? "Pause" : "Continue"}</span>
      </button>
      <button type="button" onClick={() => clock("step")} title="run to the next pulse">
        ▶❚ <span>Next pulse</span>
      </button>
      <label>
        <span>Speed</span>
        <select
          class="pg-pace"
          value={String(speed.value)}
          onChange={(event) => {
            setSpeed(Number(event.currentTarget.value));
            remember();
          }}
        >
          {SPEEDS.map(([value, name]) => (
            <option value={String(value)}>{name}</option>
          ))}
        </select>
      </label>
      <button type="button" class="pg-file" onClick={download} title="all pins since power-up, for GTKWave or Surfer">
        VCD
      </button>
      <button type="button" class="pg-file" onClick={() => void copy()} title="a link that plays this session again">
        Link
      </button>
      <output
        class="pg-clock"
        aria-live="off"
        data-state={running.value ? (over.value ? "over" : "running") : why.value}
      >
        {time(seconds.value)}
        <small>
          {copied || (running.value ? `${mclk.value.toFixed(1)} million cycles/s` : why.value || "ready")}
        </small>
      </output>
      {children}
    </div>
  );
}
