// Loads tables and modules when they are needed: from the web server, or as scripts if the page is a file.

import type { PartData } from "../types";

declare const WORKER: string; // code of the worker, inserted by build.mjs

interface Entry {
  name: string;
  title: string;
  /** Part number in IDENT of the UART bridge; 0: the part is not accessed through a bridge. */
  number: number;
}
interface Loaded {
  parts: Entry[];
  data: Record<string, PartData>;
  wasm: Record<string, string>;
}

const known = ((globalThis as unknown as { openppmc?: Partial<Loaded> }).openppmc ??= {});
let base = "";

/** Set the folder of the files from the address of this script. */
export function setBase(url: string): void {
  base = url.replace(/[^/]*$/, "");
}

export function parts(): Entry[] {
  return known.parts ?? [];
}

function script(file: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const element = document.createElement("script");
    element.src = base + file;
    element.onload = () => resolve();
    element.onerror = () => reject(new Error(`${file} is missing`));
    document.head.append(element);
  });
}

export async function loadPart(name: string): Promise<PartData> {
  if (!known.data?.[name]) await script(`parts/${name}.js`);
  return known.data![name]!;
}

export async function loadWasm(part: PartData): Promise<ArrayBuffer> {
  if (location.protocol !== "file:") {
    const answer = await fetch(base + part.wasm);
    if (!answer.ok) throw new Error(`${part.wasm}: ${answer.status} ${answer.statusText}`);
    return answer.arrayBuffer();
  }
  // A page from a file may load only scripts.
  if (!known.wasm?.[part.wasm]) await script(`${part.wasm}.js`);
  const text = atob(known.wasm![part.wasm]!);
  return Uint8Array.from(text, (letter) => letter.charCodeAt(0)).buffer;
}

export function makeWorker(): Worker {
  return new Worker(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
}
