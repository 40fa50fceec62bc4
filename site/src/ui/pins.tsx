// Input pins to press: switches, alarms, straps. Low is closed.

import { ask, frames, inputs, part, store } from "./state";

function level(pin: string): number {
  const row = store?.rows.find((one) => one.input && one.name === pin);
  if (!row || !part.value) return 1;
  const index = store!.inputs.indexOf(row.track);
  const idle = part.value.inputs.flatMap((port) => port.idle); // until the part tells its own
  return ((inputs.value[index] ?? idle[index] ?? 0) >>> row.shift) & row.mask;
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
          const high = level(pin);
          return (
            <button
              type="button"
              class={high ? "" : "pg-low"}
              aria-pressed={!high}
              aria-label={`${pin}, ${high ? "high" : "low"}`}
              onClick={() => ask({ kind: "press", pin, level: high ? 0 : 1 })}
            >
              {pin} <b>{high ? "H" : "L"}</b>
            </button>
          );
        })}
      </div>
    </section>
  );
}
