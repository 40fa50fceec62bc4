"""EEPROM engine of the PMC006B4: what is read at power-up, saved, burned and restored (P006 chapter 13)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ...common.blocks import Phase
from ..desk import Desk
from ..settings import FACTORY_PAGE, MAGIC, PAGE, PLACES, Settings
from .i2c import Bus, BusError, Course

PROGRAM, SUM, MARK = 0x0020, 0x0340, 0x0342
COPY = 0x0360
"""Of the parameter page; written first, so that a cut leaves one of the two whole."""
SIZE = SUM - PROGRAM
COMPLETE = 0x5A
POLL_MS = 10


class Engine:
    """One job at a time; a FACT that meets another job waits for its end. device: its address. failed: the
    last job but BOOT ended without an answer of the device."""

    def __init__(self, desk: Desk, bus: Bus, device: int) -> None:
        self._desk, self._bus, self._device = desk, bus, device
        self._kind: str | None = None
        self._restore = False
        self.failed = False

    @property
    def state(self) -> int:
        """What V answers: 1 a job is under way, else 2 the last one has failed."""
        return 1 if self.busy else 2 * self.failed

    @property
    def busy(self) -> bool:
        """A job runs or waits."""
        return self._kind is not None or self._restore

    @property
    def burning(self) -> bool:
        """The program buffer is being written to the device."""
        return self._kind == "burn"

    # ------------------------------------------------------------------ jobs

    def idle(self) -> None:
        """The end of BOOT."""
        self._kind = None

    def begin(self, t: int, kind: str) -> None:
        """t, B, or the restore of the parameters, from edge t on; the engine is idle."""
        course = {"save": self._save, "burn": self._burn, "fact": self.fact}[kind]
        self.run(t, kind, course())

    def run(
        self, t: int, kind: str, course: Course[None], ended: Callable[[int], None] | None = None
    ) -> None:
        """Any course as a job from edge t on; nothing goes wrong that would not end it.

        ended(t): the bus is at rest since one clk; the engine stays busy.
        """
        self._kind = kind
        self.failed = False

        def guarded() -> Course[None]:
            try:
                yield from course
            except BusError:
                self._bus.let_go()
                self.failed = kind != "boot"

        def last(now: int) -> None:
            at = now + 1 if ended else now + self._desk.shared.pace.job
            self._desk.shared.queue.at(at, Phase.STORE, ended or self._end)

        self._bus.begin(t, guarded(), last)

    def _end(self, t: int) -> None:
        self._kind = None
        if self._restore:
            self._restore = False
            self.begin(t + 1, "fact")

    def restore(self, t: int) -> None:
        """FSET; said behind everything else of edge t (P006-EEP-22)."""
        if self._kind is None:
            self.begin(t + self._desk.shared.pace.fact, "fact")
        else:
            self._restore = True

    def _save(self) -> Course[None]:
        """Each of the two as the registers are when it is sent (P006-EEP-10)."""
        for place in (COPY, 0):
            yield from self._page(place, PAGE, sent(self._desk.settings).__next__)

    def fact(self) -> Course[None]:
        """The factory page (P006-EEP-22)."""
        for place in (COPY, 0):
            yield from self._page(place, PAGE, iter(FACTORY_PAGE).__next__)

    def _burn(self) -> Course[None]:
        """A program counts only from its last byte on (P006-EEP-11)."""
        yield from self._page(MARK, 1, lambda: 0)
        code = b"".join(word.to_bytes(4, "little") for word in self._desk.program.words)
        content = iter(code)
        for place in range(0, SIZE, PAGE):
            yield from self._page(PROGRAM + place, PAGE, content.__next__)
        tail = (sum(code) % 65536).to_bytes(2, "little") + bytes([COMPLETE])
        yield from self._page(SUM, len(tail), iter(tail).__next__)

    # ------------------------------------------------------------------ device

    def _send(self, *data: int | Callable[[], int]) -> Course[None]:
        """Bytes that all have to be acknowledged."""
        for byte in data:
            if not (yield from self._bus.write(byte)):
                yield from self._bus.stop()
                raise BusError

    def poll(self) -> Course[None]:
        """Address the device until it answers, for at most 10 ms."""
        first: int | None = None
        while first is None or self._bus.tick + 1 - first < POLL_MS * self._bus.per_ms:
            first = self._bus.tick + 1 if first is None else first
            yield from self._bus.start()
            answered = yield from self._bus.write(self._device << 1)
            yield from self._bus.stop()
            if answered:
                return
        raise BusError

    def _page(self, address: int, count: int, data: Callable[[], int]) -> Course[None]:
        """Write within a page, then poll until the device answers again. data: the next byte."""
        yield from self._bus.start()
        yield from self._send(self._device << 1, address >> 8, address & 0xFF)
        yield from self._send(*(data for _ in range(count)))
        yield from self._bus.stop()
        yield from self.poll()

    def fetch(self, address: int, count: int, store: Callable[[int, int], None]) -> Course[None]:
        """Random read. store(place, byte)."""
        yield from self._bus.start()
        yield from self._send(self._device << 1, address >> 8, address & 0xFF)
        yield from self._bus.start()
        yield from self._send(self._device << 1 | 1)
        for place in range(count):
            store(place, (yield from self._bus.read(place == count - 1)))
        yield from self._bus.stop()


def sent(settings: Settings) -> Iterator[int]:
    """Bytes of the parameter page, each register as it is when its first byte is asked for (P006-EEP-10)."""
    starts = {place: (name, size) for name, (place, size) in PLACES.items()}
    page = bytearray()
    while len(page) < PAGE - 1:
        name, size = starts.get(len(page), ("", 1))
        if name:
            value = int(getattr(settings, name))
        else:
            value = MAGIC[len(page)] if len(page) < len(MAGIC) else 0
        for byte in value.to_bytes(size, "little"):
            page.append(byte)
            yield byte
    yield sum(page) % 256
