"""The script engine of the bridge's golden model.

Rules: UB-ANS-02..05, UB-OPS, UB-WAIT and the table of operations ("Ops").

Before an operation begins, its number, its operands, its length and the free space for its data are checked
(UB-ANS-05).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

from ..motion.codes import ERR, IBF, OBF

T = TypeVar("T")

RATES = (115_200, 230_400, 460_800, 921_600, 1_000_000, 2_000_000, 3_000_000)
PROTOCOL_VERSION = 1
MAX_DATA = 256
DEFAULT_LIMIT_MS = 250
ALL_HIGH = 0xFF
READ_CYCLE_CLK = 11
FIXED_OPERANDS = dict(enumerate((0, 0, 1, 1, 2, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0)))
OF_AXIS_2 = (0xA, 0xB)
OF_RECORDER = (0xD, 0xE)
BUILD_BYTES = INFO_BYTES = 16
RECORD_END, RECORD_BEGIN, RECORD_REWIND = 0, 1, 2


class Bus(Protocol):
    """Part that the bridge accesses. `read` and `write` are one bus access each.

    A bus may also have these methods. If it does not have a method, the second column states what happens
    instead, or the value that the bridge uses:

        reset()             nothing happens
        straps(byte)        nothing happens
        pins() -> int       FF
        count() -> int      0
        zero()              nothing happens
        now_ms() -> float   duration of all read accesses of this script so far
        skip(limit_ms)      nothing happens

    The result of `count` is signed. With two axes, `count(2)` and `zero(2)` are called for axis 2. `skip` is
    called during a wait. It advances the time until the value of a register may have changed, but by at most
    limit_ms.

    A bus with a recorder also has: `record(what)` (0 = end, 1 = begin, 2 = rewind); `recorded() -> bytes`
    (answer to RECORDED); `fetch() -> int` (next byte of the records).
    """

    def read(self, a: int) -> int:
        """Return the byte of register a, 0..15."""

    def write(self, a: int, byte: int) -> None:
        """Write the byte to register a."""


class Stop(Exception):  # noqa: N818 - not an error of the program: the script ends here
    """Exception that ends the execution of a script; its argument is the RESULT of the answer."""

    def __init__(self, result: int) -> None:
        super().__init__(result)
        self.result = result


class Engine:
    """Interpreter of scripts.

    Args:
        set_events: called by the operation EVENTS with True (enable) or False; it must handle a pending
        event.
        build: answer to VERSION.
        recorder: True if the bus has a recorder.

    Attributes:
        events: True if the operation EVENTS has enabled events.
        rate: rate code that the operation RATE has requested, or `None`.
    """

    def __init__(
        self,
        bus: Bus,
        part: int,
        clk_hz: int,
        xtal_hz: int,
        datasheet: bool,
        counter: bool,
        axes: int,
        set_events: Callable[[bool], None],
        build: bytes = bytes(BUILD_BYTES),
        recorder: bool = False,
    ) -> None:
        self._bus, self._set_events = bus, set_events
        self._build, self._recorder = build, recorder
        self._unknown = (*(OF_AXIS_2 if axes == 1 else ()), *(() if recorder else OF_RECORDER))
        self._clk_hz = clk_hz
        self.best_rate = max((c for c, rate in enumerate(RATES) if c and clk_hz >= 5 * rate), default=0)
        flags = int(datasheet) | counter << 1 | axes - 1 << 2 | self.best_rate << 4
        self._identity = (
            b"PPMC"
            + bytes([PROTOCOL_VERSION])
            + part.to_bytes(2, "little")
            + bytes([flags])
            + xtal_hz.to_bytes(4, "little")
            + clk_hz.to_bytes(4, "little")
        )
        self.events = False
        self.rate: int | None = None

    def hook(self, name: str, default: T, *arguments: object) -> T:
        """Call an optional method of the bus; return `default` if the bus does not have it."""
        method: Callable[..., T] | None = getattr(self._bus, name, None)
        return default if method is None else method(*arguments)

    def run(self, script: bytes, interrupted: Callable[[], bool]) -> tuple[int, int, int, bytes]:
        """Execute a script; return the fields RESULT, POS and LAST of its answer, followed by the data."""
        self._data = bytearray()
        self._last = 0
        self._reads = 0
        self._limit_ms = DEFAULT_LIMIT_MS
        self._interrupted = interrupted
        self.rate = None
        position = 0
        try:
            while position < len(script):
                position += self._op(script[position:])
        except Stop as stop:
            return stop.result, position, self._last, bytes(self._data)
        return 0, 0, self._last, bytes(self._data)

    # ------------------------------------------------------------------ one op

    def _op(self, rest: bytes) -> int:
        """Execute the operation at the beginning of `rest`; return its length."""
        code, group, low = rest[0], rest[0] >> 4, rest[0] & 15
        length = self._length(rest)
        if length is None or length > len(rest):
            raise Stop(3)
        operands = rest[1:length]
        if group == 0:
            self._plain(code, operands)
        elif group == 1:
            self._bus.write(low, operands[0])
        elif group == 2:
            self._append(lambda: self._read(low))
        elif group == 3:
            for _ in range(operands[0]):
                self._append(lambda: self._read(low))
        elif group == 4:
            for byte in operands[1:]:
                self._wait(1, IBF, 0)
                self._bus.write(low, byte)
        elif group == 5:
            self._call(operands)
        elif group == 6:
            for _ in range(low):
                self._append(self._fetch)
        elif group == 7:
            self._append(lambda: self._wait(low, *operands))
        elif group == 8:
            for byte in operands[1:]:
                self._bus.write(low, byte)
        else:
            for _ in range(operands[0]):
                self._append(lambda: self.hook("fetch", 0))
        return length

    def _length(self, rest: bytes) -> int | None:
        """Return the length of an operation with its operands.

        The result is `None` if the operation does not exist or a count is 0.
        """
        group, low = rest[0] >> 4, rest[0] & 15
        if group == 0:
            return None if low in self._unknown or low not in FIXED_OPERANDS else 1 + FIXED_OPERANDS[low]
        if group == 9 and (low or not self._recorder):
            return None
        if group in (1, 3, 9):
            if group != 1 and rest[1:2] == b"\0":
                return None
            return 2
        if group == 2:
            return 1
        if group in (4, 8):
            if len(rest) < 2 or rest[1] == 0:
                return None
            return 2 + rest[1]
        if group in (5, 6):
            return (1 + low if group == 5 else 1) if low else None
        return 3 if group == 7 else None

    def _plain(self, code: int, operands: bytes) -> None:
        if code == 0x01:
            self._append_all(self._identity)
        elif code == 0x02:
            if operands[0] and not (operands[0] < len(RATES) and self._clk_hz >= 5 * RATES[operands[0]]):
                raise Stop(3)
            self.rate = operands[0]
        elif code == 0x03:
            if operands[0] > 1:
                raise Stop(3)
            self._set_events(bool(operands[0]))
        elif code == 0x04:
            self._limit_ms = int.from_bytes(operands, "little")
        elif code == 0x05:
            self.hook("reset", None)
        elif code == 0x06:
            self._append_all(bytes([self.hook("pins", ALL_HIGH)]))
        elif code == 0x07:
            self.hook("straps", None, operands[0])
        elif code == 0x08:
            self._append_all((self.hook("count", 0) & 0xFFFF_FFFF).to_bytes(4, "little"))
        elif code == 0x09:
            self.hook("zero", None)
        elif code == 0x0A:
            self._append_all((self.hook("count", 0, 2) & 0xFFFF_FFFF).to_bytes(4, "little"))
        elif code == 0x0B:
            self.hook("zero", None, 2)
        elif code == 0x0C:
            self._append_all(self._build)
        elif code == 0x0D:
            if operands[0] > RECORD_REWIND:
                raise Stop(3)
            self.hook("record", None, operands[0])
        elif code == 0x0E:
            self._append_all(self.hook("recorded", bytes(INFO_BYTES)))

    def _call(self, command: bytes) -> None:
        if len(self._data) >= MAX_DATA:
            raise Stop(4)
        for place, byte in enumerate(command):
            self._wait(1, IBF, 0)
            self._bus.write(1 if place == 0 else 0, byte)
            status = self._wait(1, IBF, 0)
            if status & ERR:
                raise Stop(2)
        self._append_all(bytes([status]))

    def _fetch(self) -> int:
        self._wait(1, OBF, OBF)
        return self._read(0)

    # ------------------------------------------------------------------ bus and data

    def _append(self, make: Callable[[], int]) -> None:
        """Append one byte to the answer.

        If the answer is full, the operation ends before it reads a further byte.
        """
        if len(self._data) >= MAX_DATA:
            raise Stop(4)
        self._data.append(make())

    def _append_all(self, values: bytes) -> None:
        """Append all bytes of an operation to the answer, or none of them if they do not all fit."""
        if len(self._data) + len(values) > MAX_DATA:
            raise Stop(4)
        self._data += values

    def _read(self, a: int) -> int:
        self._last = self._bus.read(a)
        self._reads += 1
        return self._last

    def _now_ms(self) -> float:
        return self.hook("now_ms", self._reads * READ_CYCLE_CLK * 1000 / self._clk_hz)

    def _wait(self, a: int, mask: int, value: int) -> int:
        """Read a register until its masked bits match (UB-WAIT-01)."""
        end = self._now_ms() + self._limit_ms
        while True:
            byte = self._read(a)
            if byte & mask == value:
                return byte
            if self._interrupted():
                raise Stop(5)
            left = end - self._now_ms()
            if left <= 0:
                raise Stop(1)
            self.hook("skip", None, left)
