// The page: host and machine on the left, speed, waves, registers and log on the right.

import { useEffect } from "preact/hooks";
import { Bar } from "./bar";
import { Board } from "./board";
import { HostPane } from "./host";
import { BusLog } from "./log";
import { Machine } from "./machine";
import { Pins } from "./pins";
import { Registers } from "./registers";
import { Speed } from "./speed";
import { clock, running, trouble } from "./state";
import { Waves } from "./waves";

function keys(event: KeyboardEvent): void {
  const at = event.target as HTMLElement;
  if (/^(INPUT|TEXTAREA|SELECT|BUTTON)$/.test(at.tagName) || event.ctrlKey || event.metaKey || event.altKey)
    return;
  if (event.key === " " && at.closest(".pg")) {
    event.preventDefault();
    clock(running.value ? "pause" : "go");
  }
}

export function App() {
  useEffect(() => {
    document.addEventListener("keydown", keys);
    return () => document.removeEventListener("keydown", keys);
  }, []);
  return (
    <div class="pg">
      <Bar />
      {trouble.value && (
        <p class="pg-trouble" role="alert">
          <span>{trouble.value}</span>
          <button type="button" aria-label="close the message" onClick={() => (trouble.value = "")}>
            ×
          </button>
        </p>
      )}
      <div class="pg-columns">
        <div class="pg-left">
          <HostPane />
          <Machine />
          <Pins />
          <Board />
        </div>
        <div class="pg-right">
          <Speed />
          <Waves />
          <Registers />
          <BusLog />
        </div>
      </div>
    </div>
  );
}
