// Plot of the speed over time with uPlot.

import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { columns } from "../engine/speeds";
import { paced } from "./paced";
import { axis, frames, isLine, part, store } from "./state";

const INKS = ["one", "two", "three", "four", "five", "six", "seven", "eight"].map((name) => `--pg-${name}`);

function ink(element: Element, name: string): string {
  return getComputedStyle(element).getPropertyValue(name).trim() || "#888";
}

export function Speed() {
  const box = useRef<HTMLDivElement>(null);
  const name = part.value?.name;
  const line = isLine();
  const station = axis.value;
  useEffect(() => {
    const element = box.current;
    if (!element || !part.value) return;
    const axes = part.value.motors.length;
    let plot: uPlot | undefined;
    const make = (): void => {
      plot?.destroy();
      const line = ink(element, "--pg-line");
      const word = ink(element, "--pg-ink");
      const { fontSize } = getComputedStyle(element);
      const size = parseFloat(fontSize);
      const font = `${fontSize} system-ui, sans-serif`;
      const look = { stroke: word, font, labelFont: font, grid: { stroke: line, width: 1 }, ticks: { stroke: line } };
      plot = new uPlot(
        {
          width: element.clientWidth,
          height: element.clientHeight,
          legend: { show: false },
          cursor: { drag: { x: true, y: false } },
          scales: { x: { time: false } },
          axes: [
            {
              ...look,
              values: (_u, values) => values.map((value) => `${+(value * 1e3).toFixed(3)}`),
              label: "time in ms",
              labelSize: 1.2 * size,
              labelGap: 0,
              size: 2.3 * size,
              space: 5 * size,
            },
            {
              ...look,
              size: 4 * size,
              space: 3 * size,
              values: (_u, values) => values.map((value) => (value >= 1e3 ? `${value / 1e3} k` : `${value}`)),
            },
          ],
          series: [
            {},
            ...Array.from({ length: axes }, (_, n) => ({
              stroke: ink(element, line ? (n === station ? INKS[0]! : "--pg-pale") : INKS[n % INKS.length]!),
              width: line && n === station ? 2 : 1.5,
              points: { show: false },
              spanGaps: true,
              paths: uPlot.paths.stepped!({ align: 1 }),
            })),
          ],
        },
        [[], ...Array.from({ length: axes }, () => [])] as uPlot.AlignedData,
        element,
      );
      draw();
    };
    const draw = (): void => {
      if (!plot || !store) return;
      const { speeds, end } = store;
      if (speeds.length) plot.setData(columns(speeds.map((one) => one.upTo(end))) as uPlot.AlignedData);
    };
    const soon = paced(draw);
    make();
    const stop = frames.subscribe(soon.call);
    const sizes = new ResizeObserver(() => plot?.setSize({ width: element.clientWidth, height: element.clientHeight }));
    sizes.observe(element);
    const scheme = new MutationObserver(make);
    scheme.observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
    return () => {
      stop();
      sizes.disconnect();
      scheme.disconnect();
      soon.stop();
      plot?.destroy();
    };
  }, [name, line && station]);
  const first = Number(part.value?.style.first ?? 0);
  const axes = part.value?.motors ?? [];
  return (
    <section class="pg-box pg-rate" aria-labelledby="pg-speed">
      <h2 id="pg-speed">
        Speed, pulses per second
        {line && (
          <span class="pg-legend">
            <span>
              <i style={{ background: `var(${INKS[0]})` }} /> station {station}
            </span>
            <span>
              <i style={{ background: "var(--pg-pale)" }} /> others
            </span>
          </span>
        )}
        {axes.length > 1 && !line && (
          <span class="pg-legend">
            {axes.map((_, n) => (
              <span>
                <i style={{ background: `var(${INKS[n % INKS.length]})` }} /> {n + first}
              </span>
            ))}
          </span>
        )}
      </h2>
      <div ref={box} class="pg-plot" role="img" aria-label="speed over time" />
    </section>
  );
}
