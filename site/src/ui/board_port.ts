// Web Serial: opens the port of a board. Only Chromium on the desktop has it.

import { BASE, BoardError, type Line } from "../engine/serial_link";

interface WebPort extends EventTarget {
  readable: ReadableStream<Uint8Array> | null;
  writable: WritableStream<Uint8Array> | null;
  open(options: { baudRate: number; bufferSize: number }): Promise<void>;
  close(): Promise<void>;
}
interface WebSerial extends EventTarget {
  requestPort(): Promise<WebPort>;
  getPorts(): Promise<WebPort[]>;
}

const LOCK = "openppmc board"; // each tab with an open port holds this lock
const BUFFER = 4096;

export const webSerial = (): WebSerial | undefined => (navigator as unknown as { serial?: WebSerial }).serial;

/** Let the reader choose a port; undefined if none was chosen. Browsers allow this only while they handle a click. */
export async function choosePort(): Promise<WebPort | undefined> {
  try {
    return await webSerial()!.requestPort();
  } catch (error) {
    if (error instanceof DOMException && error.name === "NotFoundError") return undefined;
    throw new BoardError(`the browser does not offer a port: ${error instanceof Error ? error.message : error}`);
  }
}

/** Call `action` whenever a port that was used before appears again; return a function that ends these calls. */
export function onReturn(action: (port: WebPort) => void): () => void {
  const serial = webSerial()!;
  const listen = (event: Event): void => action(event.target as WebPort);
  serial.addEventListener("connect", listen);
  return () => serial.removeEventListener("connect", listen);
}

export class WebLine implements Line {
  onData: (bytes: Uint8Array) => void = () => undefined;
  onLost: () => void = () => undefined;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  private writer: WritableStreamDefaultWriter<Uint8Array> | undefined;
  private closing = false;
  private pumping = Promise.resolve();
  private release: () => void = () => undefined;

  constructor(private readonly port: WebPort) {}

  async open(baud = BASE): Promise<void> {
    const taken = await others();
    try {
      await this.port.open({ baudRate: baud, bufferSize: BUFFER });
    } catch {
      throw new BoardError(
        taken
          ? "another tab of this page uses the port; disconnect the board there"
          : "the port cannot be opened; close other programs that use it, and check that you may use it (Linux: group dialout)",
      );
    }
    void navigator.locks?.request(LOCK, { mode: "shared" }, () => new Promise<void>((done) => (this.release = done)));
    this.start();
  }

  private start(): void {
    this.writer = this.port.writable!.getWriter();
    this.closing = false;
    this.pumping = this.pump();
  }

  private async pump(): Promise<void> {
    // After an error such as a wrong stop bit, the port has a new stream; after its loss, it has none.
    while (this.port.readable && !this.closing) {
      this.reader = this.port.readable.getReader();
      try {
        for (;;) {
          const { value, done } = await this.reader.read();
          if (done) break;
          this.onData(value);
        }
      } catch {
        // The loop checks whether the port has a new stream.
      } finally {
        this.reader.releaseLock();
      }
    }
    if (this.closing) return;
    this.release();
    this.onLost();
  }

  write(bytes: Uint8Array): Promise<void> {
    return this.writer ? this.writer.write(bytes) : Promise.reject(new BoardError("the port is closed"));
  }

  private async stop(): Promise<void> {
    this.closing = true;
    await this.reader?.cancel().catch(() => undefined);
    await this.pumping;
    this.writer?.releaseLock();
    this.writer = undefined;
    await this.port.close();
  }

  async rate(baud: number): Promise<void> {
    await this.stop();
    await this.port.open({ baudRate: baud, bufferSize: BUFFER });
    this.start();
  }

  async close(): Promise<void> {
    this.release();
    await this.stop();
  }
}

/** Return whether another tab of this page has an open port. */
async function others(): Promise<boolean> {
  const state = await navigator.locks?.query();
  return state?.held?.some((lock) => lock.name === LOCK) ?? false;
}
