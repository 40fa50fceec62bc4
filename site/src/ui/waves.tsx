// Waves of all pins: zoom with wheel, buttons or keys, drag to move, two cursors that snap to edges.

import { useEffect, useRef, useState } from "preact/hooks";
import { axis, frames, isLine, part, running, selected, selectedIn, selectEdge, store } from "./state";
import type { Row } from "./store";
import { draw, edges, HEIGHT, type View } from "./draw";
import { paced } from "./paced";

const ACCESS_SHARE = 12; // width of the view as a multiple of the access that it shows

function nice(s: number): string {
  const size = Math.abs(s);
  const [scale, unit] =
    size < 1e-6 ? [1e9, "ns"] : size < 1e-3 ? [1e6, "µs"] : size < 1 ? [1e3, "ms"] : [1, "s"];
  return `${+(s * scale).toPrecision(7)} ${unit}`;
}

function interesting(row: Row): boolean {
  return row.track.count > 1 || /^(pout|dir|hold|s\[|s\d_n|int_n|irq_n|mon_step|txd|rxd)/.test(row.name);
}

export function Waves() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const view = useRef<View>({ from: 0, to: 1, a: NaN, b: NaN });
  const follow = useRef(true);
  const [, redraw] = useState(0);
  const [all, setAll] = useState(false);
  const name = part.value?.name;
  const clk = part.value?.clkHz ?? 1;
  // The pins of the motors are above the others.
  const motors = part.value?.motors.flatMap(({ step, dir, phases }) => [step, dir, ...phases]) ?? [];
  // Of a line of stations, the pins of the selected station are shown.
  const station = isLine() ? `[${axis.value}]` : "";
  const found = (store?.rows ?? []).filter((row) => row.name.endsWith(station) && (all || interesting(row)));
  const rows = [true, false].flatMap((first) => found.filter(({ name }) => motors.includes(name) === first));
  const shown = useRef(rows);
  shown.current = rows;

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    let count = -1;
    const paint = (): void => {
      if (!store) return;
      const look = view.current;
      if (follow.current) {
        look.from = -0.02 * store.end;
        look.to = Math.max(1000, store.end * 1.02);
      }
      element.style.maxHeight = `${element.parentElement!.clientHeight}px`;
      draw(element, shown.current, look, store.end, clk, element.parentElement!.scrollTop, selected.value);
      const now = store.rows.filter(interesting).length;
      if (now !== count) {
        count = now;
        redraw((n) => n + 1);
      }
    };
    const soon = paced(paint);
    const stop = frames.subscribe(soon.call);
    const sizes = new ResizeObserver(soon.call);
    sizes.observe(element.parentElement!);
    element.parentElement!.addEventListener("scroll", soon.call);
    const scheme = new MutationObserver(soon.call);
    scheme.observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
    const wheel = (event: WheelEvent): void => {
      if (
        !event.ctrlKey &&
        Math.abs(event.deltaX) <= Math.abs(event.deltaY) &&
        !event.shiftKey &&
        document.activeElement !== element
      )
        return;
      event.preventDefault();
      const look = view.current;
      const x = event.offsetX / element.clientWidth;
      if (Math.abs(event.deltaX) > Math.abs(event.deltaY))
        move((event.deltaX / element.clientWidth) * (look.to - look.from));
      else zoom(Math.exp(event.deltaY * 0.002), look.from + x * (look.to - look.from));
    };
    element.addEventListener("wheel", wheel, { passive: false });
    return () => {
      stop();
      sizes.disconnect();
      scheme.disconnect();
      soon.stop();
      element.parentElement?.removeEventListener("scroll", soon.call);
      element.removeEventListener("wheel", wheel);
    };
  }, [name]);

  useEffect(() => void frames.value++, [station]);

  useEffect(() => {
    view.current = { from: 0, to: 1, a: NaN, b: NaN };
    follow.current = true;
  }, [name]);

  const refresh = (): void => {
    frames.value++;
    redraw((n) => n + 1);
  };
  // Show the access that was selected in the log or in the text.
  useEffect(() => {
    const entry = selected.value;
    if (entry && selectedIn.value !== "waves") {
      const span = ACCESS_SHARE * Math.max(entry.t - entry.from, 8);
      follow.current = false;
      Object.assign(view.current, { from: entry.from - span / 3, to: entry.from + (span * 2) / 3 });
      const first = shown.current.findIndex((row) => edges(row, entry).length);
      canvas.current!.parentElement!.scrollTop = first * HEIGHT;
    }
    refresh();
  }, [selected.value]);
  const zoom = (factor: number, at = (view.current.from + view.current.to) / 2): void => {
    const look = view.current;
    follow.current = false;
    const span = Math.min(Math.max((look.to - look.from) * factor, 8), 4 * Math.max(1000, store?.end ?? 0));
    const share = (at - look.from) / (look.to - look.from);
    look.from = at - share * span;
    look.to = look.from + span;
    refresh();
  };
  const move = (clks: number): void => {
    follow.current = false;
    view.current.from += clks;
    view.current.to += clks;
    refresh();
  };
  const fit = (): void => {
    follow.current = true;
    refresh();
  };

  /** Return the time of the nearest edge of the row under the pointer, else the time of the pointer. */
  const snapped = (x: number, y: number): number => {
    const element = canvas.current!;
    const look = view.current;
    const t = look.from + (x / element.clientWidth) * (look.to - look.from);
    const row = shown.current[Math.floor((y - 20 + element.parentElement!.scrollTop) / HEIGHT)];
    if (!row) return Math.round(t);
    const near = ((look.to - look.from) / element.clientWidth) * 8;
    const at = row.track.at(t);
    const edges = [row.track.times[at], at + 1 < row.track.count ? row.track.times[at + 1] : undefined];
    const best = edges.filter((edge): edge is number => edge !== undefined && Math.abs(edge - t) < near);
    return best.sort((a, b) => Math.abs(a - t) - Math.abs(b - t))[0] ?? Math.round(t);
  };

  const drag = useRef<{ x: number; from: number; moved: boolean } | undefined>(undefined);
  const down = (event: PointerEvent): void => {
    drag.current = { x: event.offsetX, from: view.current.from, moved: false };
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
  };
  const over = (event: PointerEvent): void => {
    const start = drag.current;
    if (!start || Math.abs(event.offsetX - start.x) < 4) return;
    start.moved = true;
    const look = view.current;
    const span = look.to - look.from;
    follow.current = false;
    look.from = start.from - ((event.offsetX - start.x) / canvas.current!.clientWidth) * span;
    look.to = look.from + span;
    refresh();
  };
  const up = (event: PointerEvent): void => {
    const start = drag.current;
    drag.current = undefined;
    if (!start || start.moved) return;
    const t = snapped(event.offsetX, event.offsetY);
    const look = view.current;
    if (event.shiftKey || (!Number.isNaN(look.a) && Number.isNaN(look.b))) look.b = t;
    else {
      look.a = t;
      look.b = NaN;
    }
    selectEdge(t);
    refresh();
  };
  const key = (event: KeyboardEvent): void => {
    const look = view.current;
    const span = look.to - look.from;
    const middle = Math.round((look.from + look.to) / 2);
    const actions: Record<string, () => void> = {
      ArrowLeft: () => move(-span / 10),
      ArrowRight: () => move(span / 10),
      "+": () => zoom(0.6),
      "=": () => zoom(0.6),
      "-": () => zoom(1 / 0.6),
      f: fit,
      a: () => (look.a = middle),
      b: () => (look.b = middle),
      Escape: () => (look.a = look.b = NaN),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
    refresh();
  };

  const entry = selected.value;
  const touched = entry ? rows.filter((row) => edges(row, entry).length).map((row) => row.name) : [];
  const { a, b } = view.current;
  const gap = b - a;
  return (
    <section class="pg-box pg-below" aria-labelledby="pg-waves">
      <h2 id="pg-waves">
        Waves
        <span class="pg-tools">
          <label class="pg-check">
            <input type="checkbox" checked={all} onChange={(event) => setAll(event.currentTarget.checked)} />{" "}
            all pins
          </label>
          <button type="button" onClick={() => zoom(0.5)} aria-label="zoom in">
            +
          </button>
          <button type="button" onClick={() => zoom(2)} aria-label="zoom out">
            −
          </button>
          <button type="button" onClick={fit}>
            fit
          </button>
        </span>
      </h2>
      <div class="pg-waves">
        <ul class="pg-names" style={{ paddingTop: "20px" }}>
          {rows.map((row) => (
            <li
              class={`${row.input ? "pg-in" : "pg-out"}${touched.includes(row.name) ? " pg-touched" : ""}`}
              style={{ height: `${HEIGHT}px` }}
            >
              {row.name}
            </li>
          ))}
        </ul>
        <canvas
          ref={canvas}
          tabIndex={0}
          role="img"
          aria-label="waves; arrows move, plus and minus zoom, a and b set the cursors, f shows all"
          style={{ height: `${20 + rows.length * HEIGHT + 4}px` }}
          onPointerDown={down}
          onPointerMove={over}
          onPointerUp={up}
          onDblClick={fit}
          onKeyDown={key}
        />
      </div>
      <p class="pg-measured" aria-live="polite">
        {Number.isNaN(a)
          ? running.value
            ? " "
            : "Click an edge for cursor A and its access, another edge for cursor B. Ctrl and wheel zoom, drag moves."
          : `A ${nice(a / clk)}` +
            (Number.isNaN(b)
              ? ""
              : `   B ${nice(b / clk)}   B − A = ${nice(gap / clk)} = ${gap} cycles` +
                (gap ? `   1/(B − A) = ${+Math.abs(clk / gap).toPrecision(7)} Hz` : ""))}
      </p>
    </section>
  );
}
