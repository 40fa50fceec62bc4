// Plot of the speed over time with uPlot.

import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { columns } from "../engine/speeds";
import { paced } from "./paced";
import { frames, part, store } from "./state";

const INKS = ["--pg-one", "--pg-two", "--pg-three", "--pg-four"];

function ink(element: Element, name: string): string {
  return getComputedStyle(element).getPropertyValue(name).trim() || "#888";
}

export function Speed() {
  const box = useRef<HTMLDivElement>(null);
  const name = part.value?.name;
  useEffect(() => {
    const element = box.current;
    if (!element || !part.value) return;
    const axes = part.value.motors.length;
    let plot: uPlot | undefined;
    const make = (): void => {
      plot?.destroy();
      const line = ink(element, "--pg-line");
      const word = ink(element, "--pg-ink");
      const look = { stroke: word, grid: { stroke: line, width: 1 }, ticks: { stroke: line } };
      plot = new uPlot(
        {
          width: element.clientWidth,
          height: 170,
          legend: { show: false },
          cursor: { drag: { x: true, y: false } },
          scales: { x: { time: false } },
          axes: [
            {
              ...look,
              values: (_u, values) => values.map((value) => `${+(value * 1e3).toFixed(3)}`),
              label: "ms",
              labelSize: 16,
              labelGap: 0,
              size: 34,
            },
            {
              ...look,
              size: 64,
              values: (_u, values) => values.map((value) => (value >= 1e3 ? `${value / 1e3} k` : `${value}`)),
            },
          ],
          series: [
            {},
            ...Array.from({ length: axes }, (_, n) => ({
              stroke: ink(element, INKS[n % INKS.length]!),
              width: 1.5,
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
    const sizes = new ResizeObserver(() => plot?.setSize({ width: element.clientWidth, height: 170 }));
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
  }, [name]);
  return (
    <section class="pg-box" aria-labelledby="pg-speed">
      <h2 id="pg-speed">Speed, pulses per second</h2>
      <div ref={box} class="pg-plot" role="img" aria-label="speed over time" />
    </section>
  );
}
