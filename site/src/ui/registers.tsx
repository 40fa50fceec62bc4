// The last status that the host has read, as bits and with its meaning, and the last answer.

import { part, log, status } from "./state";
import { hex } from "../engine/side";

export function Registers() {
  const data = part.value;
  if (!data) return null;
  const value = status.value;
  const answer = log.value.filter((one) => ["r", "<", "get"].includes(one.kind)).at(-1);
  const bits = (data.style.bits as string[] | undefined) ?? [];
  return (
    <section class="pg-box pg-registers" aria-labelledby="pg-status">
      <h2 id="pg-status">Status and answers</h2>
      <p>
        <b>Status</b> <code>{value < 0 ? "not read yet" : hex(value)}</code>{" "}
        {value >= 0 && <span class="pg-words">{data.words.status[value]}</span>}
      </p>
      {value >= 0 && bits.length > 0 && (
        <p class="pg-bits" aria-hidden="true">
          {bits.map((name, n) => (
            <span class={(value >> (7 - n)) & 1 ? "pg-on" : ""}>{name}</span>
          ))}
        </p>
      )}
      <p>
        <b>Last answer</b> {answer ? <code>{answer.text}</code> : "no answer yet"}{" "}
        <span class="pg-words">{answer?.words}</span>
      </p>
    </section>
  );
}
