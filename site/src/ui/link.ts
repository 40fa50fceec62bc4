// A session in a link: part, text and speed behind the #. Version 1; a page that gets another one says so.

export interface Linked {
  part: string;
  /** Chapter of the manual, or the text itself. */
  run?: string;
  text?: string;
  speed?: number;
  /** Begin at once. */
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

/** Whether an address has a session, and is not just a place on the page. */
export function isLink(hash: string): boolean {
  return /^#(.*&)?(v|part|run|text|speed|go)=/.test(hash);
}

export interface Read {
  linked?: Linked;
  /** What is wrong with the link, for the reader. */
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
        `this link is of version ${version}, the page reads version ${VERSION}: it shows the first session instead`,
      ],
    };
  if (!words.has("part")) wrong.push("this link names no part");
  const given = words.get("speed");
  const speed = given === null || given.trim() === "" ? NaN : Number(given);
  const known = speeds.includes(speed);
  if (given !== null && !known)
    wrong.push(`speed=${given}: there is no such speed; the page has ${speeds.join(", ")}`);
  const go = words.get("go");
  if (go !== null && go !== "1" && go !== "0") wrong.push(`go=${go}: it is 0 or 1`);
  const linked = {
    part: words.get("part") ?? "",
    ...(words.has("run") ? { run: words.get("run")! } : {}),
    ...(words.has("text") ? { text: words.get("text")! } : {}),
    ...(known ? { speed } : {}),
    go: go === "1",
  };
  return { linked, wrong };
}
