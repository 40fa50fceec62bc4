// Link with a session: part, text and speed after the #. The version is 1; the page rejects other
// versions with a message.

export interface Linked {
  part: string;
  /** Chapter of the manual, or the text itself. */
  run?: string;
  text?: string;
  speed?: number;
  /** Start immediately. */
  go: boolean;
}

export const VERSION = "1";

export function write(state: Linked): string {
  const words = new URLSearchParams({ v: VERSION, part: state.part });
  if (state.run !== undefined) words.set("run", state.run);
  if (state.text !== undefined) words.set("text", state.text);
  if (state.speed !== undefined) words.set("speed", String(state.speed));
  if (state.go) words.set("go", "1");
  return `#${words.toString()}`;
}

/** Whether an address has a session, and not only a position on the page. */
export function isLink(hash: string): boolean {
  return /^#(.*&)?(v|part|run|text|speed|go)=/.test(hash);
}

export interface Read {
  linked?: Linked;
  /** Errors in the link, as messages for the reader. */
  wrong: string[];
}

export function read(hash: string, speeds: readonly number[]): Read {
  if (!isLink(hash)) return { wrong: [] };
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const wrong: string[] = [];
  const version = words.get("v") ?? VERSION;
  if (version !== VERSION)
    return {
      wrong: [
        `this link has version ${version}, the page supports version ${VERSION}; it shows the first session instead`,
      ],
    };
  if (!words.has("part")) wrong.push("this link names no part");
  const given = words.get("speed");
  const speed = given === null || given.trim() === "" ? NaN : Number(given);
  const known = speeds.includes(speed);
  if (given !== null && !known)
    wrong.push(`speed=${given}: unknown speed; use ${speeds.join(", ")}`);
  const go = words.get("go");
  if (go !== null && go !== "1" && go !== "0") wrong.push(`go=${go}: not valid; use 0 or 1`);
  const linked = {
    part: words.get("part") ?? "",
    ...(words.has("run") ? { run: words.get("run")! } : {}),
    ...(words.has("text") ? { text: words.get("text")! } : {}),
    ...(known ? { speed } : {}),
    go: go === "1",
  };
  return { linked, wrong };
}
