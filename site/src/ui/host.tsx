// Host: the text of a session with the meaning of each line next to it, and bytes to send now.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Meant } from "../engine/explain";
import { meanings } from "../engine/meaning";
import { statements } from "../engine/text";
import { ask, chapter, line, now, over, part, remember, running, selected, selectedIn, selectLine, start } from "./state";
import { text, trouble } from "./state";

const AROUND = 40; // number of lines above and below the visible lines that are also in the DOM
const PAGE = 60; // number of lines that the largest window shows

function Meaning({ rows, named = true }: { rows: Meant[]; named?: boolean }) {
  return (
    <>
      {rows.map((row) => (
        <span class={row.bad ? "pg-bad" : ""}>
          {named && <code>{row.word}</code>} {row.meaning}
        </span>
      ))}
    </>
  );
}

/** Text and meanings in one box that scrolls; all lines have the height --pg-row. */
function Editor() {
  const box = useRef<HTMLDivElement>(null);
  const [top, setTop] = useState(0);
  const [caret, setCaret] = useState(0);
  const data = part.value;
  const lines = useMemo(() => (data ? meanings(data, text.value) : [[]]), [data, text.value]);
  const present = running.value && !over.value ? line.value : 0;
  const marked = selected.value?.line ?? 0;
  const first = Math.max(0, top - AROUND);
  const place = (n: number) => ({ top: `calc(${n} * var(--pg-row))` });
  const show = (number: number): void => {
    const element = box.current;
    if (!element || number < 1) return;
    const row = element.scrollHeight / (lines.length + 1);
    const y = (number - 1) * row;
    if (y < element.scrollTop || y + 2 * row > element.scrollTop + element.clientHeight)
      element.scrollTop = y - element.clientHeight / 3;
  };
  useEffect(() => {
    if (document.activeElement?.id !== "pg-text") show(present);
  }, [present]);
  useEffect(() => {
    if (selectedIn.value !== "text") show(marked);
  }, [selected.value]);
  const moved = (event: { currentTarget: HTMLTextAreaElement }): number => {
    const { value, selectionStart } = event.currentTarget;
    const number = value.slice(0, selectionStart).split("\n").length;
    setCaret(number - 1);
    return number;
  };
  return (
    <>
      <div
        class="pg-editor"
        ref={box}
        onScroll={({ currentTarget: { scrollTop, scrollHeight } }) =>
          setTop(Math.floor((scrollTop / scrollHeight) * (lines.length + 1)))
        }
      >
        <div class="pg-sheet" style={{ height: `calc(${lines.length + 1} * var(--pg-row))` }}>
          {present > 0 && <i class="pg-mark pg-running" style={place(present - 1)} />}
          {marked > 0 && <i class="pg-mark pg-marked" style={place(marked - 1)} />}
          <ol class="pg-numbers" aria-hidden="true">
            {lines.slice(first, top + PAGE + AROUND).map((_, n) => (
              <li class={first + n + 1 === present ? "pg-line" : ""} style={place(first + n)}>
                {first + n + 1}
              </li>
            ))}
          </ol>
          <textarea
            id="pg-text"
            aria-label="session, one statement per line"
            spellcheck={false}
            autocomplete="off"
            wrap="off"
            value={text.value}
            disabled={!data}
            onInput={(event) => {
              text.value = event.currentTarget.value;
              chapter.value = "";
              remember();
              moved(event);
            }}
            onKeyUp={moved}
            onClick={(event) => selectLine(moved(event))}
            onKeyDown={(event) => {
              if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) start();
            }}
          />
          <ul class="pg-decoded" aria-label="meaning of each line">
            {lines.slice(first, top + PAGE + AROUND).map((rows, n) => (
              <li style={place(first + n)} title={rows.map((row) => `${row.word}: ${row.meaning}`).join("\n")}>
                <Meaning rows={rows} named={false} />
              </li>
            ))}
          </ul>
        </div>
      </div>
      <p class="pg-caret" aria-live="polite">
        <Meaning rows={lines[caret] ?? []} />
      </p>
    </>
  );
}

export function HostPane() {
  const [wrong, setWrong] = useState("");
  const data = part.value;
  const send = (event: Event): void => {
    event.preventDefault();
    try {
      if (!statements(now.value).length) return;
      ask({ kind: "send", text: now.value });
      now.value = "";
      remember();
      setWrong("");
      trouble.value = "";
    } catch (error) {
      setWrong(String(error instanceof Error ? error.message : error));
    }
  };
  const meant = data && now.value ? (meanings(data, `${text.value}\n${now.value}`).at(-1) ?? []) : [];
  return (
    <section class="pg-box pg-host" aria-labelledby="pg-host">
      <h2 id="pg-host">
        Text of the host
        {document.getElementById("pg-statements") && (
          <button type="button" {...{ popovertarget: "pg-statements" }}>
            statements
          </button>
        )}
      </h2>
      <Editor />
      <form class="pg-send" onSubmit={send}>
        <label for="pg-now">Send now</label>
        <input
          id="pg-now"
          value={now.value}
          spellcheck={false}
          autocomplete="off"
          placeholder={part.value?.style.hint as string | undefined}
          onInput={(event) => {
            now.value = event.currentTarget.value;
            remember();
            setWrong("");
          }}
          aria-invalid={wrong !== ""}
        />
        <button type="submit">Send</button>
        {(wrong || meant.length > 0) && (
          <p class="pg-meaning" role="status">
            {wrong ? <span class="pg-bad">{wrong}</span> : <Meaning rows={meant} />}
          </p>
        )}
      </form>
    </section>
  );
}
