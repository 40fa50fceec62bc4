// Frames of the UART bridge (docs/uart_bridge.md, UB-FRM).

const FLAG = 0x7e;
const ESCAPE = 0x7d;
const TOGGLE = 0x20;
const MOST = 262; // largest number of bytes between the flags of an answer, CRC included

/** Bytes that return the bridge to its idle state at 115 200 baud (UB-LIN-06). */
export const WAKE_UP: readonly number[] = [0, 0, ESCAPE, FLAG];

export function crc16(bytes: readonly number[]): number {
  let crc = 0xffff;
  for (const one of bytes) {
    crc ^= one << 8;
    for (let n = 0; n < 8; n++) crc = crc & 0x8000 ? ((crc << 1) ^ 0x1021) & 0xffff : (crc << 1) & 0xffff;
  }
  return crc;
}

/** Return the bytes on the line: flag, escaped content and CRC, flag. */
export function encode(content: readonly number[]): Uint8Array {
  const crc = crc16(content);
  const line = [FLAG];
  for (const one of [...content, crc >> 8, crc & 0xff])
    if (one === FLAG || one === ESCAPE) line.push(ESCAPE, one ^ TOGGLE);
    else line.push(one);
  line.push(FLAG);
  return Uint8Array.from(line);
}

/** Receiver: converts bytes of the line to the contents of valid frames, and drops all others. */
export class Deframer {
  private content: number[] = [];
  private hunting = true;
  private escaped = false;

  reset(): void {
    this.content = [];
    this.hunting = true;
    this.escaped = false;
  }

  feed(bytes: Uint8Array): number[][] {
    const found: number[][] = [];
    for (const one of bytes) {
      if (one === FLAG) {
        const { content } = this;
        if (!this.hunting && !this.escaped && content.length > 2 && crc16(content) === 0)
          found.push(content.slice(0, -2));
        this.content = [];
        this.hunting = this.escaped = false;
      } else if (this.hunting) continue;
      else if (one === ESCAPE && !this.escaped) this.escaped = true;
      else {
        this.content.push(this.escaped ? one ^ TOGGLE : one);
        this.escaped = false;
        if (this.content.length > MOST) this.reset();
      }
    }
    return found;
  }
}
