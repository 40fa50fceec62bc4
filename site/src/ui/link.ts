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

/** Throws an Error with a message for the reader. */
export function read(hash: string): Linked | undefined {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  if (![...words.keys()].length || !words.has("part")) return undefined;
  const version = words.get("v") ?? VERSION;
  if (version !== VERSION)
    throw new Error(
      `this link is of version ${version}, the page reads version ${VERSION}: it shows the first session instead`,
    );
  const speed = Number(words.get("speed") ?? "NaN");
  return {
    part: words.get("part")!,
    ...(words.has("run") ? { run: words.get("run")! } : {}),
    ...(words.has("text") ? { text: words.get("text")! } : {}),
    ...(speed >= 0 ? { speed } : {}),
    go: words.get("go") === "1",
  };
}
