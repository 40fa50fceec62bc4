// Draws rows of waves on a canvas. Where edges are closer than a pixel, a row is a solid band.

import { hex } from "../engine/side";
import type { Row } from "./store";

export const HEIGHT = 22;
const TOP = 20;

export interface View {
  from: number;
  to: number;
  /** Cursors in cycles; NaN: not set. */
  a: number;
  b: number;
}

/** First and last cycle of the access whose edges are marked, and the text of this access. */
export interface Marked {
  from: number;
  t: number;
  text: string;
}

export function draw(
  canvas: HTMLCanvasElement,
  rows: readonly Row[],
  view: View,
  end: number,
  clkHz: number,
  scrolled: number,
  marked?: Marked,
): void {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const paper = canvas.getContext("2d");
  if (!paper || width === 0) return;
  const style = getComputedStyle(canvas);
  const ink = (name: string): string => style.getPropertyValue(name).trim() || "#888";
  paper.setTransform(ratio, 0, 0, ratio, 0, 0);
  paper.clearRect(0, 0, width, height);
  paper.font = `${style.fontSize} ui-monospace, monospace`;
  paper.lineWidth = 1;
  const scale = width / (view.to - view.from);
  const x = (t: number): number => (t - view.from) * scale;
  grid(paper, view, width, height, scale, clkHz, ink("--pg-line"), ink("--pg-soft"));
  paper.save();
  paper.beginPath();
  paper.rect(0, TOP - 4, width, height);
  paper.clip();
  if (marked) {
    paper.fillStyle = ink("--pg-marked");
    paper.fillRect(x(marked.from) - 1, 0, Math.max(3, (marked.t - marked.from) * scale + 2), height);
  }
  rows.forEach((row, n) => {
    const top = TOP + n * HEIGHT - scrolled;
    if (top + HEIGHT < 0 || top > height) return;
    paper.strokeStyle = paper.fillStyle = ink(row.input ? "--pg-one" : "--pg-two");
    trace(paper, row, top, x, view, width, end);
    if (!marked) return;
    paper.fillStyle = ink("--pg-cursor");
    for (const t of edges(row, marked)) paper.fillRect(x(t) - 1.5, top + 3, 3, HEIGHT - 6);
  });
  paper.restore();
  for (const [name, t] of [
    ["A", view.a],
    ["B", view.b],
  ] as const) {
    if (Number.isNaN(t)) continue;
    paper.strokeStyle = paper.fillStyle = ink("--pg-cursor");
    paper.beginPath();
    paper.moveTo(x(t), 0);
    paper.lineTo(x(t), height);
    paper.stroke();
    paper.fillText(name, x(t) + 3, height - 4);
  }
}

/** Return the times of a row's edges that belong to an access; the last edges can follow its end by a few cycles. */
export function edges(row: Row, { from, t }: Marked): number[] {
  const { times } = row.track;
  return [...times.subarray(row.track.at(from - 1) + 1, row.track.at(t + 2) + 1)].filter((one) => one > 0);
}

function grid(
  paper: CanvasRenderingContext2D,
  view: View,
  width: number,
  height: number,
  scale: number,
  clkHz: number,
  line: string,
  soft: string,
): void {
  const seconds = (8 * parseFloat(paper.font)) / scale / clkHz; // approximate time between two grid lines
  const power = 10 ** Math.floor(Math.log10(seconds));
  const step = [1, 2, 5, 10].map((n) => n * power).find((one) => one >= seconds) ?? power;
  const unit = step >= 1 ? "s" : step >= 1e-3 ? "ms" : "µs";
  const times = { s: 1, ms: 1e3, µs: 1e6 }[unit];
  const digits = Math.max(0, -Math.floor(Math.log10(step * times)));
  for (let n = Math.ceil(view.from / clkHz / step); n * step * clkHz < view.to; n++) {
    const at = (n * step * clkHz - view.from) * scale;
    paper.strokeStyle = line;
    paper.beginPath();
    paper.moveTo(at, TOP - 4);
    paper.lineTo(at, height);
    paper.stroke();
    const text = `${(n * step * times).toFixed(digits)} ${unit}`;
    if (at + paper.measureText(text).width < width) {
      paper.fillStyle = soft;
      paper.fillText(text, at + 2, 13);
    }
  }
}

export function trace(
  paper: CanvasRenderingContext2D,
  row: Row,
  top: number,
  x: (t: number) => number,
  view: View,
  width: number,
  end: number,
): void {
  const { track } = row;
  const high = top + 4;
  const low = top + HEIGHT - 4;
  const stop = Math.min(width, x(Math.min(end, view.to)));
  let index = Math.max(0, track.at(view.from));
  const value = (n: number): number => track.values[n]!;
  const level = (n: number): number => (value(n) ? high : low);
  const bus = row.width > 1;
  let [band, bandWidth] = [-2, 0];
  const fill = (): void => {
    if (bandWidth) paper.fillRect(band, high, bandWidth, low - high);
  };
  let at = Math.max(0, x(track.times[index]!));
  if (at >= stop) return;
  paper.beginPath();
  if (!bus) paper.moveTo(at, level(index));
  while (at < stop) {
    const next = index + 1;
    const to = next < track.count ? Math.min(stop, x(track.times[next]!)) : stop;
    if (bus) box(paper, at, to, high, low, value(index), row.width);
    else paper.lineTo(to, level(index));
    if (to >= stop || next >= track.count) break;
    // All edges within this pixel are drawn as one band.
    let last = next;
    const edge = track.at(view.from + ((to + 1) / width) * (view.to - view.from));
    if (edge > next + 1) {
      last = edge;
      if (!bus) {
        if (band + bandWidth >= to) bandWidth = to + 1 - band;
        else {
          fill();
          [band, bandWidth] = [to, 1];
        }
        paper.moveTo(to + 1, level(last));
      }
      at = to + 1;
    } else {
      if (!bus) paper.lineTo(to, level(next));
      at = to;
    }
    index = last;
  }
  if (!bus) paper.stroke();
  fill();
}

function box(
  paper: CanvasRenderingContext2D,
  from: number,
  to: number,
  high: number,
  low: number,
  value: number,
  width: number,
): void {
  const middle = (high + low) / 2;
  const slope = Math.min(3, (to - from) / 2);
  paper.beginPath();
  paper.moveTo(from, middle);
  paper.lineTo(from + slope, high);
  paper.lineTo(to - slope, high);
  paper.lineTo(to, middle);
  paper.lineTo(to - slope, low);
  paper.lineTo(from + slope, low);
  paper.closePath();
  paper.stroke();
  const text = hex(value, Math.ceil(width / 4));
  if (paper.measureText(text).width + 6 < to - from) paper.fillText(text, from + 5, middle + 4);
}
