// Details of the selected access, or else of the last answer: status bits, fields of a block, and the rule.

import type { LogEntry } from "../types";
import { hex } from "../engine/side";
import { log, part, selected, status } from "./state";

function Status({ value }: { value: number }) {
  const { style, words } = part.value!;
  const bits = (style.bits as string[] | undefined) ?? [];
  if (!bits.length) return null;
  return (
    <>
      <p>
        <b>Status</b> <code>{value < 0 ? "not read yet" : hex(value)}</code> {value >= 0 && words.status[value]}
      </p>
      {value >= 0 && (
        <ul class="pg-bits">
          {bits.map((name, n) => (
            <li class={(value >> (7 - n)) & 1 ? "pg-on" : ""}>
              {name === "0" ? `b${7 - n}` : name} {(value >> (7 - n)) & 1}
            </li>
          ))}
        </ul>
      )}
    </>
  );
}

function Access({ row }: { row: LogEntry }) {
  const rule = row.rule ? part.value!.words.rules[row.rule] : undefined;
  return (
    <>
      <p>
        <b>{row === selected.value ? "Selected" : "Last answer"}</b> <code>{row.text}</code> {row.words}
        {row.line > 0 && ` (line ${row.line})`}
      </p>
      {row.fields && (
        <table class="pg-fields">
          <tbody>
            {row.fields.map(([name, bytes, value]) => (
              <tr>
                <th scope="row">{name}</th>
                <td>
                  <code>{bytes}</code>
                </td>
                <td>{value}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {rule && (
        <p class="pg-rule">
          <a href={rule.page} target="_blank">
            {row.rule}
          </a>{" "}
          {rule.text}
        </p>
      )}
    </>
  );
}

export function Details() {
  if (!part.value) return null;
  const answer = log.value.filter((one) => ["r", "<", "get"].includes(one.kind)).at(-1);
  const row = selected.value ?? answer;
  return (
    <div class="pg-registers" tabIndex={0} role="region" aria-label="status, and details of an access">
      <Status value={selected.value?.kind === "st" ? parseInt(selected.value.text, 16) : status.value} />
      {row && <Access row={row} />}
    </div>
  );
}
