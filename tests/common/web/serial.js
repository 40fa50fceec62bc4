// Stand-in for navigator.serial. Its port calls the functions boardOpen, boardWrite and boardClose of the test.
// The test reports events through globalThis.fakeSerial.
(() => {
  const failed = (text, name) => new DOMException(text, name);
  class FakePort extends EventTarget {
    readable = null;
    writable = null;
    async open({ baudRate }) {
      if (this.readable) throw failed("The port is already open.", "InvalidStateError");
      if (!(await globalThis.boardOpen(baudRate))) throw failed("Failed to open serial port.", "NetworkError");
      this.readable = new ReadableStream({ start: (to) => (this.to = to) });
      this.writable = new WritableStream({ write: (bytes) => globalThis.boardWrite([...bytes]) });
    }
    async close() {
      if (this.readable?.locked || this.writable?.locked) throw new TypeError("Cannot cancel a locked stream");
      this.readable = this.writable = null;
      await globalThis.boardClose();
    }
  }
  const port = new FakePort();
  const serial = new EventTarget();
  serial.getPorts = async () => [port];
  serial.requestPort = async () => {
    if (!navigator.userActivation.isActive) throw failed("Must be handling a user gesture.", "SecurityError");
    if (globalThis.noPort) throw failed("No port selected by the user.", "NotFoundError");
    return port;
  };
  globalThis.fakeSerial = {
    data: (bytes) => port.to?.enqueue(Uint8Array.from(bytes)),
    lose() {
      const { to } = port;
      port.readable = port.writable = port.to = null;
      to.error(failed("The device has been lost.", "NetworkError"));
    },
    again: () => {
      const event = new Event("connect");
      Object.defineProperty(event, "target", { value: port });
      serial.dispatchEvent(event);
    },
  };
  Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
})();
