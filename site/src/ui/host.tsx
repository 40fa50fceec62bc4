// Host: the text of a session, and bytes to send now. The meaning of a line is shown while the reader types.

import { useState } from "preact/hooks";
import type { Meant } from "../engine/explain";
import { meaning } from "../engine/meaning";
import { statements } from "../engine/text";
import { ask, chapter, line, now, part, remember, running, start, text, trouble } from "./state";

function Meaning({ rows }: { rows: Meant[] }) {
  return (
    <ul class="pg-meaning" aria-live="polite">
      {rows.map((row) => (
        <li class={row.bad ? "pg-bad" : ""}>
          <code>{row.word}</code> {row.meaning}
        </li>
      ))}
    </ul>
  );
}

export function HostPane() {
  const [caret, setCaret] = useState(0);
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
  const at = (event: { currentTarget: HTMLTextAreaElement }): void =>
    setCaret(event.currentTarget.selectionStart);
  return (
    <section class="pg-box" aria-labelledby="pg-host">
      <h2 id="pg-host">Host</h2>
      <label class="pg-label" for="pg-text">
        Session, one statement per line {document.getElementById("pg-statements") && <a href="#pg-statements">(list of statements)</a>}
        {running.value && line.value > 0 && <span class="pg-line">line {line.value}</span>}
      </label>
      <textarea
        id="pg-text"
        rows={12}
        spellcheck={false}
        autocomplete="off"
        value={text.value}
        disabled={!data}
        onInput={(event) => {
          text.value = event.currentTarget.value;
          chapter.value = "";
          remember();
          at(event);
        }}
        onKeyUp={at}
        onClick={at}
        onKeyDown={(event) => {
          if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) start();
        }}
      />
      <Meaning rows={data ? meaning(data, text.value, caret) : []} />
      <form onSubmit={send}>
        <label class="pg-label" for="pg-now">
          Send now
        </label>
        <div class="pg-send">
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
        </div>
        <Meaning
          rows={data ? meaning(data, `${text.value}\n${now.value}`, text.value.length + 1 + now.value.length) : []}
        />
        {wrong && (
          <p class="pg-bad" role="alert">
            {wrong}
          </p>
        )}
      </form>
    </section>
  );
}
