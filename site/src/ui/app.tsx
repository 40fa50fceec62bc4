// The page on one screen: motor and speed above, text and log next to each other, waves below the text.

import { useEffect } from "preact/hooks";
import { Bar } from "./bar";
import { Board, BoardButton } from "./board";
import { Details } from "./details";
import { HostPane } from "./host";
import { BusLog } from "./log";
import { Machine } from "./machine";
import { Speed } from "./speed";
import { chosen, clock, running, trouble, welcome } from "./state";
import { parts } from "./load";
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

function Invitation() {
  const title = parts().find((one) => one.name === chosen.value)?.title;
  return (
    <p class="pg-note">
      <span>
        The RTL of a {title} drives this motor in your browser: press <b>▶ Run</b> or a limit switch, or change a byte
        of the text.
      </span>
    </p>
  );
}

export function App() {
  useEffect(() => {
    document.addEventListener("keydown", keys);
    return () => document.removeEventListener("keydown", keys);
  }, []);
  return (
    <div class="pg">
      <Bar>
        <BoardButton />
      </Bar>
      {trouble.value ? (
        <p class="pg-note pg-trouble" role="alert">
          <span>{trouble.value}</span>
          <button type="button" aria-label="close the message" onClick={() => (trouble.value = "")}>
            ×
          </button>
        </p>
      ) : (
        welcome.value && <Invitation />
      )}
      <Board />
      <Machine />
      <HostPane />
      <section class="pg-box pg-bus" aria-labelledby="pg-log">
        <BusLog />
        <Details />
      </section>
      <Speed />
      <Waves />
    </div>
  );
}
