"""EEPROM engine of the PMC006B4: power-up read, save, burn and restore (P006-EEP)."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping
from fractions import Fraction
from math import ceil
from typing import TypeVar

from ...chip import Phase
from ..execution_context import ExecutionContext
from ..pins import Services, Ticks
from ..settings import FACTORY_PAGE, MAGIC, PAGE, PLACES, Settings

# I2C master of the PMC006B4, modelled with a resolution of quarter bits (docs/pmc006/README.md, 14). The
# actions of a master are generators: each `yield` waits for the next quarter tick, and the code after it runs
# at the edge of this tick.

R = TypeVar("R")
BusSequence = Generator[None, None, R]
LOW = Fraction(55, 100)
"""Low time of SCL as a fraction of its period: slightly more than two quarters."""


class BusError(Exception):
    """SCL was held low for too long, or no device responded."""


class Bus:
    """The two lines of the bus.

    Attributes:
        levels: synchronised levels of scl and sda.
        hz: frequency of SCL.
        tick: number of the current quarter tick.
        per_ms: number of quarter ticks in a millisecond.
    """

    def __init__(self, services: Services, levels: Mapping[str, int], hz: int) -> None:
        self._services, self._levels = services, levels
        self._ticks = Ticks(services.clk_hz, 4 * hz, services.us.origin)
        self._scl_low_cycles = ceil(Fraction(LOW * services.clk_hz, hz)) - services.clk_hz // (2 * hz)
        self.hz = hz
        self.tick = 0

    @property
    def per_ms(self) -> int:
        """Number of quarter ticks in a millisecond."""
        return 4 * self.hz // 1000

    # ------------------------------------------------------------------ time

    def begin(self, t: int, sequence: BusSequence[None], ended: Callable[[int], None]) -> None:
        """Run a sequence from the first tick at or after edge t.

        At its last tick, `ended` is called with the edge of this tick.
        """
        next(sequence)
        self._wait(self._ticks.first(t), sequence, ended)

    def _wait(self, tick: int, sequence: BusSequence[None], ended: Callable[[int], None]) -> None:
        at = self._ticks.edge_of(tick)
        self._services.queue.at(at, Phase.FLAG, lambda now: self._resume(now, tick, sequence, ended))

    def _resume(self, t: int, tick: int, sequence: BusSequence[None], ended: Callable[[int], None]) -> None:
        self.tick, self._now = tick, t
        try:
            next(sequence)
        except StopIteration:
            ended(t)
        else:
            self._wait(tick + 1, sequence, ended)

    # ------------------------------------------------------------------ lines

    def level(self, pin: str) -> int:
        """Return the synchronised level of the line `pin`."""
        return self._levels[pin]

    def release(self) -> None:
        """Release both lines."""
        self._drive("scl", 1)
        self._drive("sda", 1)

    def _drive(self, line: str, level: int) -> None:
        self._services.log.set(self._now, f"{line}_oe", int(not level))

    def _release_scl(self) -> None:
        """Wait until SCL was low for `LOW` of its period, then release it."""
        at = self._now + self._scl_low_cycles
        self._services.queue.at(at, Phase.PIN, lambda now: self._services.log.set(now, "scl_oe", 0))

    def _rise(self) -> BusSequence[None]:
        """Wait until SCL is high; a device may hold it low for at most a millisecond."""
        for _ in range(self.per_ms + 1):
            yield
            if self._levels["scl_i"]:
                return
        raise BusError

    # ------------------------------------------------------------------ actions of a master

    def start(self) -> BusSequence[None]:
        """Send a START or a repeated START."""
        yield
        self._drive("sda", 1)
        yield
        self._release_scl()
        yield from self._rise()
        yield
        self._drive("sda", 0)
        yield
        yield
        self._drive("scl", 0)

    def stop(self) -> BusSequence[None]:
        """Send a STOP."""
        yield
        self._drive("scl", 0)
        self._drive("sda", 0)
        yield
        self._release_scl()
        yield from self._rise()
        yield
        self._drive("sda", 1)
        yield
        yield

    def bit(self, level: int) -> BusSequence[int]:
        """Send a bit and return the level of the line; to receive a bit, send 1."""
        yield
        received = yield from self._bit_now(level)
        yield
        self._drive("scl", 0)
        return received

    def _bit_now(self, level: int) -> BusSequence[int]:
        """Send or receive a bit; the generator ends at the tick that samples the bit."""
        self._drive("scl", 0)
        self._drive("sda", level)
        yield
        self._release_scl()
        yield from self._rise()
        return self._levels["sda_i"]

    def write(self, byte: int | Callable[[], int]) -> BusSequence[bool]:
        """Send a byte; return True if it was acknowledged.

        Args:
            byte: byte to send, or a function that returns it; the function is called at the first tick of the
                byte.
        """
        yield
        value = byte if isinstance(byte, int) else byte()
        for place in reversed(range(8)):
            if place < 7:
                yield
            yield from self._bit_now(value >> place & 1)
            yield
            self._drive("scl", 0)
        return not (yield from self.bit(1))

    def read(self, last: bool) -> BusSequence[int]:
        """Receive a byte; acknowledge it unless it is the last one."""
        byte = 0
        for _ in range(8):
            byte = byte << 1 | (yield from self.bit(1))
        yield from self.bit(int(last))
        return byte

    def clear(self) -> BusSequence[None]:
        """Pulse SCL up to 9 times until the device releases SDA, then send a STOP.

        See docs/pmc006/README.md, 14.
        """
        for _ in range(8):
            if (yield from self.bit(1)):
                break
        else:
            yield
            received = yield from self._bit_now(1)
            yield
            if not received:
                raise BusError
            self._drive("scl", 0)
        yield from self.stop()


PROGRAM, SUM, MARK = 0x0020, 0x0340, 0x0342
COPY = 0x0360
"""Address of the copy of the parameter page."""
SIZE = SUM - PROGRAM
COMPLETE = 0x5A
POLL_MS = 10


class Engine:
    """Engine for one job at a time. A factory restore during another job waits until that job ends.

    Args:
        device: address of the device.

    Attributes:
        failed: True if the last job other than BOOT ended because the device did not respond.
        page_valid: False if the parameter page may be invalid and its copy is valid. Normally the copy is
            written first; in this case the page is. Therefore, after a power cut at any time one of the two
            is valid.
    """

    def __init__(self, context: ExecutionContext, bus: Bus, device: int) -> None:
        self._context, self._bus, self._device = context, bus, device
        self._kind: str | None = None
        self._restore = False
        self.failed = False
        self.page_valid = True

    @property
    def state(self) -> int:
        """Answer to instruction V: 1 = a job is in progress, 2 = the last job failed, 0 = neither."""
        return 1 if self.busy else 2 * self.failed

    @property
    def busy(self) -> bool:
        """True if a job is running or waiting."""
        return self._kind is not None or self._restore

    @property
    def burning(self) -> bool:
        """True while the program buffer is being written to the device."""
        return self._kind == "burn"

    # ------------------------------------------------------------------ jobs

    def idle(self) -> None:
        """Process the end of BOOT."""
        self._kind = None

    def begin(self, t: int, kind: str) -> None:
        """At edge t, start the job of instruction t or B, or the restore of the parameters.

        The engine must be idle.
        """
        sequence = {"save": self._save, "burn": self._burn, "fact": self.fact}[kind]
        self.run(t, kind, sequence())

    def run(
        self, t: int, kind: str, sequence: BusSequence[None], ended: Callable[[int], None] | None = None
    ) -> None:
        """Run a sequence as a job from edge t on. Any error ends the job.

        `ended(t)` is called when the bus has been idle for one cycle; the engine remains busy until then.
        """
        self._kind = kind
        self.failed = False

        def guarded() -> BusSequence[None]:
            try:
                yield from sequence
            except BusError:
                self._bus.release()
                self.failed = kind != "boot"

        def last(now: int) -> None:
            at = now + 1 if ended else now + self._context.services.core_timing.job
            self._context.services.queue.at(at, Phase.STORE, ended or self._end)

        self._bus.begin(t, guarded(), last)

    def _end(self, t: int) -> None:
        self._kind = None
        if self._restore:
            self._restore = False
            self.begin(t + 1, "fact")

    def restore(self, t: int) -> None:
        """Process FSET after all other events of edge t are processed (P006-EEP-22)."""
        if self._kind is None:
            self.begin(t + self._context.services.core_timing.fact, "fact")
        else:
            self._restore = True

    def _save(self) -> BusSequence[None]:
        """Save the registers (P006-EEP-10). Each is saved with its value at the time when it is sent."""
        return self._both(lambda: sent(self._context.settings))

    def fact(self) -> BusSequence[None]:
        """Write the factory page (P006-EEP-22)."""
        return self._both(lambda: iter(FACTORY_PAGE))

    def _both(self, content: Callable[[], Iterator[int]]) -> BusSequence[None]:
        """Write the parameter page and its copy."""
        for place in (COPY, 0) if self.page_valid else (0, COPY):
            if place == 0:
                self.page_valid = False
            yield from self._page(place, PAGE, content().__next__)
            if place == 0:
                self.page_valid = True

    def _burn(self) -> BusSequence[None]:
        """Write the program. It becomes valid only with its last byte (P006-EEP-11)."""
        yield from self._page(MARK, 1, lambda: 0)
        code = b"".join(word.to_bytes(4, "little") for word in self._context.program.words)
        content = iter(code)
        for place in range(0, SIZE, PAGE):
            yield from self._page(PROGRAM + place, PAGE, content.__next__)
        tail = (sum(code) % 65536).to_bytes(2, "little") + bytes([COMPLETE])
        yield from self._page(SUM, len(tail), iter(tail).__next__)

    # ------------------------------------------------------------------ device

    def _send(self, *data: int | Callable[[], int]) -> BusSequence[None]:
        """Send bytes. The device must acknowledge each of them."""
        for byte in data:
            if not (yield from self._bus.write(byte)):
                yield from self._bus.stop()
                raise BusError

    def poll(self) -> BusSequence[None]:
        """Address the device repeatedly for at most 10 ms, until it responds."""
        first: int | None = None
        while first is None or self._bus.tick + 1 - first < POLL_MS * self._bus.per_ms:
            first = self._bus.tick + 1 if first is None else first
            yield from self._bus.start()
            answered = yield from self._bus.write(self._device << 1)
            yield from self._bus.stop()
            if answered:
                return
        raise BusError

    def _page(self, address: int, count: int, data: Callable[[], int]) -> BusSequence[None]:
        """Write `count` bytes within one page, then poll until the device responds again.

        Args:
            data: function that returns the next byte at each call.
        """
        yield from self._bus.start()
        yield from self._send(self._device << 1, address >> 8, address & 0xFF)
        yield from self._send(*(data for _ in range(count)))
        yield from self._bus.stop()
        yield from self.poll()

    def fetch(self, address: int, count: int, store: Callable[[int, int], None]) -> BusSequence[None]:
        """Read `count` bytes from an address on; call store(index, byte) for each of them."""
        yield from self._bus.start()
        yield from self._send(self._device << 1, address >> 8, address & 0xFF)
        yield from self._bus.start()
        yield from self._send(self._device << 1 | 1)
        for place in range(count):
            store(place, (yield from self._bus.read(place == count - 1)))
        yield from self._bus.stop()


def sent(settings: Settings) -> Iterator[int]:
    """Yield the bytes of the parameter page.

    Each register has its value at the time when its first byte is requested (P006-EEP-10).
    """
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
