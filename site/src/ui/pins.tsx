// Buttons for input pins: switches, alarms, straps. A closed switch is low.

import { ask, frames, inputs, part, store } from "./state";
import { level } from "./store";

function high(pin: string): number {
  const row = store?.find(pin, true);
  if (!row) return 1;
  const idle = part.value!.inputs.flatMap((port) => port.idle); // shown until the part reports its levels
  return level(row, inputs.value.length ? inputs.value : idle);
}

export function Pins() {
  void frames.value;
  const data = part.value;
  if (!data) return null;
  const names = [...data.motors.flatMap((motor) => motor.switches.filter(Boolean)), ...data.straps];
  return (
    <section class="pg-box" aria-labelledby="pg-pins">
      <h2 id="pg-pins">Switches, straps, alarms</h2>
      <div class="pg-pins">
        {names.map((pin) => {
          const is = high(pin);
          return (
            <button
              type="button"
              class={is ? "" : "pg-low"}
              aria-pressed={!is}
              aria-label={`${pin}, ${is ? "high" : "low"}`}
              onClick={() => ask({ kind: "press", pin, level: is ? 0 : 1 })}
            >
              {pin} <b>{is ? "H" : "L"}</b>
            </button>
          );
        })}
      </div>
    </section>
  );
}
