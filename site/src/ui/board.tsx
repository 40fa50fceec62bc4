// Panel "Real board": connect, confirm, run, compare, report.

import { signal } from "@preact/signals";
import { useState } from "preact/hooks";
import { report, reportText, verdict, type Result } from "../engine/serial_report";
import {
  askSelfTest,
  askText,
  board,
  boardPart,
  both,
  cancel,
  confirm,
  connect,
  disconnect,
  golden,
  jobs,
  line,
  mismatch,
  phase,
  positions,
  records,
  replayed,
  results,
  rows,
  stop,
  told,
  trouble,
} from "./board_state";
import { webSerial } from "./board_port";
import { parts } from "./load";
import { choose, part } from "./state";
import "./board.css";

const open = signal(false);
const busy = (): boolean => phase.value !== "ready" && phase.value !== "off";

function save(name: string, type: string, content: string): void {
  const anchor = document.createElement("a");
  anchor.href = URL.createObjectURL(new Blob([content], { type }));
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
}

function Reports() {
  const used = board.value;
  if (!used || !results.value.length) return null;
  const made = () => report(part.value!.title, used, records.value, results.value);
  return (
    <p class="pg-board-row">
      <button type="button" onClick={() => save("selftest.txt", "text/plain", reportText(made()))}>
        Report as text
      </button>
      <button type="button" onClick={() => save("selftest.json", "application/json", JSON.stringify(made(), null, 1))}>
        Report as JSON
      </button>
    </p>
  );
}

function Bitstreams() {
  const data = part.value;
  const [open, setOpen] = useState(false);
  if (!data?.board.boards.length) return null;
  return (
    <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>Bitstreams of the {data.title}</summary>
      <p>
        In a checkout, the first command builds a bitstream and the second one loads it; <code>RECORD=13</code> adds the recorder.
        The third command loads the file from the bitstream archive of a release.
      </p>
      <dl>
        {data.board.boards.map((one) => (
          <>
            <dt>{one.title}</dt>
            <dd>
              <code>{one.build} RECORD=13</code>
              <code>{one.load}</code>
              <code>{one.loader}</code>
            </dd>
          </>
        ))}
      </dl>
    </details>
  );
}

function Confirmation() {
  if (phase.value !== "confirm") return null;
  const lines = jobs.value.flatMap((job) =>
    jobs.value.length > 1 ? [`${job.title}:`, ...job.motions] : job.motions,
  );
  return (
    <div class="pg-board-ask" role="alertdialog" aria-labelledby="pg-board-ask">
      <h3 id="pg-board-ask">{lines.length ? "This will move on the board" : "The simulation outputs no pulse"}</h3>
      <ul>
        {lines.map((one) => (
          <li>{one}</li>
        ))}
      </ul>
      <p>
        The list is that of the simulation. First, the part is reset: a motor that moves stops, and a motor that holds a load
        is released. Limits and alarms of the machine end a motion earlier.
      </p>
      <p class="pg-board-row">
        <button type="button" class="pg-board-go" onClick={() => void confirm()}>
          {lines.length ? "Move the motor" : "Run on the board"}
        </button>
        <button type="button" onClick={cancel}>
          Cancel
        </button>
      </p>
    </div>
  );
}

function Outcome({ result }: { result: Result }) {
  const shown = result.compared.differences;
  const first = shown.find((one) => !one.timing) ?? shown[0];
  const edges = typeof result.edges === "string" ? "" : result.edges.difference;
  const bad = result.error || edges || (first && !first.timing);
  return (
    <li class={bad ? "pg-bad" : "pg-board-good"}>
      <b>{result.title}</b>: {verdict(result)}
      {first && (
        <div>
          First difference: {first.where}: board <code>{first.board}</code>, simulation <code>{first.simulation}</code>{" "}
          {first.words}
          {first.timing && " (this value depends on the speed of the host)"}
        </div>
      )}
      {edges && <div>First different edge: {edges}</div>}
      {typeof result.edges === "string" && <div class="pg-words">Edges: {result.edges}</div>}
    </li>
  );
}

/** Answers of board and simulation side by side. */
function Answers() {
  const answers = rows.value.filter((row) => row.answer);
  const other = golden.value?.answers ?? [];
  if (!answers.length) return null;
  return (
    <div class="pg-log" tabIndex={0} role="region" aria-label="answers of the board and of the simulation">
      <table class="pg-table pg-board-answers">
        <thead>
          <tr>
            <th>line</th>
            <th>board</th>
            <th>simulation</th>
            <th>meaning</th>
          </tr>
        </thead>
        <tbody>
          {answers.map((row, n) => (
            <tr class={row.text === other[n]?.text ? "" : "pg-bad"}>
              <td>{row.line}</td>
              <td>
                <code>{row.text}</code>
              </td>
              <td>
                <code>{other[n]?.text ?? "–"}</code>
              </td>
              <td>{row.words}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Connected() {
  const used = board.value!;
  const { identity, build } = used;
  const wrong = mismatch();
  const fits = parts().find((one) => one.number === identity.part);
  const first = Number(part.value?.style.first ?? 1);
  return (
    <>
      <p>
        <b>{boardPart()}</b> at {identity.clkHz / 1e6} MHz, crystal {identity.xtalHz / 1e6} MHz,{" "}
        {identity.datasheet ? "DATASHEET" : "FAST"} timing; {used.baud} baud;{" "}
        {build ? `bitstream ${build.version} ${build.board}` : "the bitstream does not report its version"};{" "}
        {records.value ? `recorder of ${records.value.most} records` : "no recorder"}
      </p>
      {wrong && (
        <p class="pg-bad" role="alert">
          {wrong}{" "}
          {fits && fits.name !== part.value?.name && (
            <button type="button" onClick={() => void choose(fits.name)}>
              Choose {fits.title}
            </button>
          )}
        </p>
      )}
      <p class="pg-board-row">
        <label>
          <span>Run on</span>
          <select value={both.value ? "both" : "board"} onChange={(event) => (both.value = event.currentTarget.value === "both")}>
            <option value="both">board and simulation</option>
            <option value="board">board</option>
          </select>
        </label>
        <button type="button" class="pg-board-run" disabled={busy() || wrong !== ""} onClick={() => void askText()}>
          Run on the board
        </button>
        <button type="button" disabled={busy() || wrong !== ""} onClick={() => void askSelfTest()}>
          Self-test
        </button>
        <button type="button" onClick={() => void disconnect()}>
          Disconnect
        </button>
        <button type="button" class="pg-board-stop" onClick={() => void stop("stopped by the button")}>
          ■ Stop
        </button>
      </p>
      {phase.value === "simulating" && <p>The session is being simulated first. {told.value}</p>}
      <Confirmation />
      {(phase.value === "running" || phase.value === "comparing") && (
        <p class="pg-board-live" aria-live="off">
          {phase.value === "running"
            ? `line ${line.value}`
            : replayed.value < 0
              ? "comparing"
              : `comparing edges, ${replayed.value} % of the recorded time`}
          ;{" "}
          {positions.value.map((position, axis) => `axis ${axis + first} at ${position}`).join(", ")}
        </p>
      )}
      {results.value.length > 0 && (
        <ul class="pg-board-results" data-ms={results.value.at(-1)!.answeredMs.toFixed(1)}>
          {results.value.map((result) => (
            <Outcome result={result} />
          ))}
        </ul>
      )}
      <Reports />
      <Answers />
    </>
  );
}

/** Button that shows and hides the panel. While a session uses the board, the panel stays open. */
export function BoardButton() {
  return (
    <button type="button" class="pg-real" aria-expanded={open.value || busy()} onClick={() => (open.value = !open.value)}>
      Real board
    </button>
  );
}

export function Board() {
  if (!open.value && !busy()) return null;
  return (
    <section class="pg-box pg-board" aria-labelledby="pg-board" data-phase={phase.value}>
      <h2 id="pg-board">
        Real board
        <button type="button" aria-label="close the panel" disabled={busy()} onClick={() => (open.value = false)}>
          ×
        </button>
      </h2>
      {!webSerial() ? (
        <p>To run the text on a real board, open this page in Chrome or Edge on a desktop computer; this browser has no Web Serial.</p>
      ) : board.value ? (
        <Connected />
      ) : (
        <>
          <p>The same text runs on an FPGA board with the UART bridge. No motor moves before you confirm its motions.</p>
          <p>
            <button type="button" class="pg-board-connect" disabled={phase.value === "opening"} onClick={() => void connect()}>
              {phase.value === "opening" ? "Connecting …" : "Connect a board"}
            </button>
          </p>
        </>
      )}
      {trouble.value && (
        <p class="pg-bad pg-board-trouble" role="alert">
          {trouble.value}
        </p>
      )}
      {told.value && phase.value !== "simulating" && <p role="status">{told.value}</p>}
      {webSerial() && (
        <>
          <Bitstreams />
          <details>
            <summary>What stops a motor</summary>
            <p>
              Stop, Escape, a hidden tab and an error of the session stop all motors immediately. When you close the page, it sends
              the stop as its last bytes. The bridge has no watchdog: if the cable is unplugged, or the browser or the computer
              fails, a move runs to its end, and a motion without an end runs to a limit switch. Keep the switch of the driver
              supply in reach.
            </p>
          </details>
        </>
      )}
    </section>
  );
}
