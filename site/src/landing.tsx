// The moving picture of the landing page: the RTL of a PPMC-104 in the worker of the playground, slowed down.

import { render } from "preact";
import "./style.css";
import "./landing.css";
import type { Frame, FromWorker, LogEntry, PartData, ToWorker } from "./types";
import { trace, HEIGHT, type View } from "./ui/draw";
import { loadPart, loadWasm, makeWorker, setBase } from "./ui/load";
import { Motor } from "./ui/motor";
import { level, Store } from "./ui/store";

const PART = "ppmc104";
const SLOWER = 100; // times slower than real time
const TEXT = `c 0A d C7 d 31 d 64 d 00 # 4-phase, start at 2500, high speed 10 000 pulses per second
c 43 d 8F d 01 d 00; until int_n 0; wait 8ms # 400 pulses CW
c 80 r
c 4B d 8F d 01 d 00; until int_n 0; wait 8ms # and back`;
const WINDOW = 0.03; // s of simulated time in the plot
const SPEED = 66; // pixels of the plot of the speed
const MOST_SPEED = 10_500; // pulses per second
const LINES = 5; // bytes of the longest command

setBase((document.currentScript as HTMLScriptElement | null)?.src ?? "");

let part: PartData | undefined;
let store: Store;
let worker: Worker;
let last: Frame | undefined;
let bytes: LogEntry[] = []; // bytes of the current command
let trouble = "";
let stopped = matchMedia("(prefers-reduced-motion: reduce)").matches;
let inView = false;
let started = false;
let moving = false;

const ask = (message: ToWorker): void => worker.postMessage(message);
function start(): void {
  started = true;
  ask({ kind: "start", text: TEXT, speed: 1 / SLOWER, label: "" });
}

/** Start or pause the part; it runs only if the picture is visible. */
function follow(): void {
  const wanted = !stopped && inView && !document.hidden;
  if (!part || wanted === moving) return;
  moving = wanted;
  if (!wanted) ask({ kind: "pause" });
  else if (started) ask({ kind: "go" });
  else start();
}

function toggle(): void {
  stopped = !stopped;
  follow();
  draw();
}

function plot(canvas: HTMLCanvasElement): void {
  const paper = canvas.getContext("2d");
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!paper || !part || !width) return;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  paper.scale(ratio, ratio);
  const ink = (name: string): string => getComputedStyle(canvas).getPropertyValue(name).trim();
  const clk = WINDOW * part.clkHz;
  const from = Math.max(0, store.end - clk);
  const view: View = { from, to: from + clk, a: NaN, b: NaN };
  const x = (t: number): number => ((t - from) * width) / clk;
  const y = (speed: number): number => SPEED - 4 - ((SPEED - 8) * speed) / MOST_SPEED;
  paper.strokeStyle = paper.fillStyle = ink("--pg-one");
  paper.lineWidth = 2;
  paper.beginPath();
  const { t, v } = store.speeds[0]!.upTo(store.end);
  t.forEach((time, n) => {
    const at = x(time * part!.clkHz);
    if (n) paper.lineTo(at, y(v[n - 1]!));
    paper.lineTo(at, y(v[n]!));
  });
  paper.stroke();
  paper.lineTo(x(store.end), y(0));
  paper.lineTo(x(0), y(0));
  paper.globalAlpha = 0.15;
  paper.fill();
  paper.globalAlpha = 1;
  paper.lineWidth = 1;
  paper.strokeStyle = paper.fillStyle = ink("--pg-two");
  part.motors[0]!.phases.slice(0, 4).forEach((pin, n) => {
    const row = store.find(pin, false);
    if (row) trace(paper, row, SPEED + n * HEIGHT, x, view, width, store.end);
  });
}

function Picture() {
  const on = Number(part?.style.phaseOn ?? 1);
  const phases = Array.from({ length: 4 }, (_, n) => {
    const row = part && store.find(part.motors[0]!.phases[n]!, false);
    return { name: `S${n + 1}`, lit: Number(Boolean(row && last && level(row, last.levels.outputs) === on)) };
  });
  return (
    <>
      <div class="landing-live">
        <Motor name="motor" phases={phases} position={last?.positions[0] ?? 0} />
        <ol class="landing-bytes" aria-label="bytes that the host has written">
          {Array.from({ length: LINES }, (_, n) => bytes[n]).map((one) => (
            <li>{one ? [<b>{one.text}</b>, ` ${one.words.split(":")[0]}`] : "\u00a0"}</li>
          ))}
        </ol>
      </div>
      <div class="landing-plot">
        <div aria-hidden="true">
          <span style={{ height: `${SPEED}px` }}>speed</span>
          {phases.map(({ name }) => (
            <span>{name}</span>
          ))}
        </div>
        <canvas role="img" aria-label="speed and phases over time" style={{ height: `${SPEED + 4 * HEIGHT}px` }} />
      </div>
      <p class="landing-caption">
        <button type="button" onClick={toggle}>
          {stopped ? "Play" : "Pause"}
        </button>
        <span>{trouble || `The RTL of the PPMC-104 runs in this page, ${SLOWER} times slower than real time.`}</span>
      </p>
    </>
  );
}

let box: HTMLElement | null = null;
function draw(): void {
  if (!box) return;
  render(<Picture />, box);
  plot(box.querySelector("canvas")!);
}

function onMessage(message: FromWorker): void {
  if (message.kind === "error") {
    trouble = message.text;
    draw();
  } else if (message.kind === "began") {
    store.clear();
    bytes = [];
  } else if (message.kind === "frame") {
    last = message;
    store.take(message.rows, message.t, message.log);
    for (const one of message.log) {
      if (one.kind === "c") bytes = [];
      if (one.kind === "c" || one.kind === "d") bytes.push(one);
    }
    if (moving && message.running && message.over) start();
    requestAnimationFrame(() => {
      draw();
      ask({ kind: "shown" });
    });
  }
}

async function begin(): Promise<void> {
  box = document.getElementById("openppmc-landing");
  if (!box) return;
  box.replaceChildren();
  draw();
  try {
    const data = await loadPart(PART);
    const wasm = await loadWasm(data);
    store = new Store(data);
    part = data;
    worker = makeWorker();
    worker.onmessage = (event: MessageEvent<FromWorker>) => onMessage(event.data);
    ask({ kind: "load", part: data, wasm });
  } catch (error) {
    trouble = String(error instanceof Error ? error.message : error);
    draw();
    return;
  }
  new IntersectionObserver(([entry]) => {
    inView = entry!.isIntersecting;
    follow();
  }).observe(box);
  document.addEventListener("visibilitychange", follow);
  new MutationObserver(draw).observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
  addEventListener("resize", draw);
}

void begin();
