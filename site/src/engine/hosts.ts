// Selects the host for the bus of a part.

import { BlockHost } from "./blocks";
import { ByteHost } from "./bytes";
import { FrameHost } from "./frames";
import type { Host } from "./host";
import { LineHost } from "./line";
import type { Side } from "./side";
import { TextError } from "./text";
import { WindowHost } from "./window";

const KINDS: Record<string, new (side: Side) => Host> = {
  byte: ByteHost,
  window: WindowHost,
  block: BlockHost,
  frame: FrameHost,
  line: LineHost,
};

export function makeHost(side: Side): Host {
  const kind = KINDS[side.part.bus];
  if (!kind) throw new TextError(`${side.part.title}: the page does not support the bus of this part`);
  return new kind(side);
}
