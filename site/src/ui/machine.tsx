// Motor and machine: phases, shaft, carriage, and the input pins that the reader can press. A closed switch is low.

import { useState } from "preact/hooks";
import { Motor } from "./motor";
import { ask, axis as chosen, frames, isLine, inputs, machineOn, outputs, part, places, positions, remember, store } from "./state";
import { level } from "./store";

const NAMES = ["start", "CCW limit", "slow CCW", "origin", "slow CW", "CW limit"];
/** Switches of a motor from the CCW end to the CW end: place in `switches`, name. */
const SWITCHES: [number, string][] = [
  [1, "CCW limit"],
  [3, "slow CCW"],
  [4, "origin"],
  [2, "slow CW"],
  [0, "CW limit"],
  [5, "alarm"],
];

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
  const [, ccw = 0, slowCcw = 0, origin = 0, slowCw = 0, cw = 0] = places.value;
  const low = Math.min(ccw, position, 0);
  const high = Math.max(cw, position, 1);
  const x = (place: number): string => `${5 + (90 * (place - low)) / (high - low)}%`;
  const marks: [number, string, string][] = machineOn.value
    ? [
        [ccw, "CCW", "pg-limit"],
        [slowCcw, "slow", "pg-slow"],
        [origin, "0", "pg-origin"],
        [slowCw, "slow", "pg-slow"],
        [cw, "CW", "pg-limit"],
      ]
    : [[0, "0", "pg-origin"]];
  return (
    <svg
      class="pg-rail"
      role="img"
      aria-label={`carriage of ${isLine() ? "station" : "axis"} ${axis + Number(part.value!.style.first)} at ${position}`}
    >
      <line x1="1%" y1="38" x2="99%" y2="38" class="pg-bed" />
      {marks.map(([place, name, kind], n) => (
        <g class={kind}>
          <line x1={x(place)} y1="27" x2={x(place)} y2="49" />
          <text x={x(place)} y={n % 2 ? 23 : 64}>
            {name}
          </text>
        </g>
      ))}
      <rect x={x(position)} y="29" width="16" height="18" rx="2" transform="translate(-8 0)" class="pg-carriage" />
      <text x={x(position)} y="16" class="pg-position">
        {position}
      </text>
      {part.value!.motors.length > 1 && !isLine() && (
        <text x="1%" y="59" class="pg-name">
          axis {axis + Number(part.value!.style.first)}
        </text>
      )}
    </svg>
  );
}

function high(pin: string): number {
  const row = store?.find(pin, true);
  if (!row) return 1;
  const idle = part.value!.inputs.flatMap((port) => port.idle); // shown until the part reports its levels
  return level(row, inputs.value.length ? inputs.value : idle);
}

/** A button for each station, with its position. */
function Stations() {
  return (
    <div class="pg-stations" role="group" aria-label="stations on the line">
      {part.value!.motors.map((_, n) => (
        <button type="button" aria-pressed={n === chosen.value} onClick={() => (chosen.value = n)}>
          <b>{n}</b> <small>{positions.value[n] ?? 0}</small>
        </button>
      ))}
    </div>
  );
}

function Pin({ pin, name = "" }: { pin: string; name?: string }) {
  const is = high(pin);
  return (
    <button
      type="button"
      class={is ? "" : "pg-low"}
      aria-pressed={!is}
      onClick={() => ask({ kind: "press", pin, level: is ? 0 : 1 })}
    >
      {name} <code>{pin}</code> <b>{is ? "H" : "L"}</b>
    </button>
  );
}

export function Machine() {
  void frames.value;
  const [open, setOpen] = useState(false);
  const data = part.value;
  if (!data) return <section class="pg-box pg-machine" />;
  const line = isLine();
  const several = data.motors.length > 1 && !line;
  const present = Math.min(chosen.value, data.motors.length - 1);
  const switches = data.motors[present]!.switches;
  const change = (on: boolean): void => {
    machineOn.value = on;
    ask({ kind: "machine", words: on ? ["machine", "on", ...places.value.map(String)] : ["machine", "off"] });
  };
  return (
    <section class={`pg-box pg-machine ${several ? "" : "pg-single"} ${line ? "pg-line-of-stations" : ""}`} aria-labelledby="pg-machine">
      <h2 id="pg-machine">
        Motor and machine{line && `, station ${present}`}{" "}
        <label class="pg-check">
          <input
            type="checkbox"
            checked={machineOn.value}
            onChange={(event) => change(event.currentTarget.checked)}
          />{" "}
          the carriage operates the switches
        </label>
      </h2>
      {line && <Stations />}
      <div class={`pg-axes pg-axes-${line ? 1 : data.motors.length}`}>
        {data.motors.map(
          (_, n) =>
            (!line || n === present) && (
              <div class="pg-axis">
                <AxisMotor axis={n} />
                <Rail axis={n} />
              </div>
            ),
        )}
      </div>
      <div class="pg-pins" role="group" aria-label="switches, alarms and straps">
        {several && (
          <label>
            Axis{" "}
            <select value={present} onChange={(event) => (chosen.value = Number(event.currentTarget.value))}>
              {data.motors.map((_, n) => (
                <option value={n}>{n + Number(data.style.first)}</option>
              ))}
            </select>
          </label>
        )}
        {SWITCHES.map(([n, name]) => switches[n] && <Pin pin={switches[n]!} name={name} />)}
        {data.straps.map((pin) => (
          <Pin pin={line ? `${pin}[${present}]` : pin} />
        ))}
        <button type="button" class="pg-more" aria-expanded={open} onClick={() => setOpen(!open)}>
          {open ? "▾" : "▸"} positions of the switches
        </button>
      </div>
      <div class="pg-places">
        {open && NAMES.map((name, n) => (
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
    </section>
  );
}
