// Motor and machine: phases, shaft, carriage and switches.

import { useState } from "preact/hooks";
import { Motor } from "./motor";
import { ask, frames, machineOn, outputs, part, places, positions, remember, store } from "./state";
import { level } from "./store";

const NAMES = ["start", "CCW limit", "slow CCW", "origin", "slow CW", "CW limit"];

/** Relative current of a winding, 0 to 1: from a phase, or from the reference of a chopper. */
function lit(pin: string, on: number): number {
  const row = store?.find(pin, false);
  if (!row) return 0;
  const found = level(row, outputs.value);
  return row.width > 1 ? Math.min(1, (2 * found) / row.mask) : Number(found === on);
}

function AxisMotor({ axis }: { axis: number }) {
  const data = part.value!;
  const on = (data.style.phaseOn as number | undefined) ?? 1;
  const phases = data.motors[axis]!.phases.map((pin, n) => ({
    name: /_ref$/.test(pin) ? "AB"[n]! : `S${n + 1}`,
    lit: lit(pin, on),
  }));
  const name = `motor ${axis + Number(data.style.first)}`;
  return <Motor name={name} phases={phases} position={positions.value[axis] ?? 0} />;
}

function Rail({ axis }: { axis: number }) {
  const position = positions.value[axis] ?? 0;
  const on = machineOn.value;
  const [, ccw = 0, slowCcw = 0, origin = 0, slowCw = 0, cw = 0] = places.value;
  const low = Math.min(ccw, position, 0);
  const high = Math.max(cw, position, 1);
  const room = (high - low) * 0.04;
  const x = (place: number): number => 10 + (280 * (place - low + room)) / (high - low + 2 * room);
  const marks: [number, string, string][] = on
    ? [
        [ccw, "CCW", "pg-limit"],
        [slowCcw, "slow", "pg-slow"],
        [origin, "origin", "pg-origin"],
        [slowCw, "slow", "pg-slow"],
        [cw, "CW", "pg-limit"],
      ]
    : [[0, "0", "pg-origin"]];
  return (
    <svg
      viewBox="0 0 300 62"
      class="pg-rail"
      role="img"
      aria-label={`carriage of axis ${axis + Number(part.value!.style.first)} at ${position}`}
    >
      <line x1="6" y1="36" x2="294" y2="36" class="pg-bed" />
      {marks.map(([place, name, kind], n) => (
        <g class={kind}>
          <line x1={x(place)} y1="26" x2={x(place)} y2="46" />
          <text x={x(place)} y={n % 2 ? 57 : 22}>
            {name}
          </text>
        </g>
      ))}
      <rect x={x(position) - 7} y="28" width="14" height="16" rx="2" class="pg-carriage" />
      <text x={x(position)} y="10" class="pg-position">
        {position}
      </text>
    </svg>
  );
}

export function Machine() {
  void frames.value;
  const [open, setOpen] = useState(false);
  const data = part.value;
  if (!data) return null;
  const change = (on: boolean): void => {
    machineOn.value = on;
    ask({ kind: "machine", words: on ? ["machine", "on", ...places.value.map(String)] : ["machine", "off"] });
  };
  return (
    <section class="pg-box" aria-labelledby="pg-machine">
      <h2 id="pg-machine">
        Motor and machine{" "}
        <label class="pg-check">
          <input
            type="checkbox"
            checked={machineOn.value}
            onChange={(event) => change(event.currentTarget.checked)}
          />{" "}
          switches active
        </label>
      </h2>
      <div class={data.motors.length > 2 ? "pg-axes pg-many" : "pg-axes"}>
        {data.motors.map((_, axis) => (
          <div class="pg-axis">
            <AxisMotor axis={axis} />
            <Rail axis={axis} />
          </div>
        ))}
      </div>
      <button type="button" class="pg-more" aria-expanded={open} onClick={() => setOpen(!open)}>
        {open ? "▾" : "▸"} positions of the switches
      </button>
      {open && (
        <div class="pg-places">
          {NAMES.map((name, n) => (
            <label>
              <span>{name}</span>
              <input
                type="number"
                value={places.value[n]}
                onChange={(event) => {
                  const value = Number(event.currentTarget.value);
                  if (!Number.isSafeInteger(value)) return;
                  places.value = places.value.map((old, place) => (place === n ? value : old));
                  remember();
                  if (machineOn.value) change(true);
                }}
              />
            </label>
          ))}
        </div>
      )}
    </section>
  );
}
