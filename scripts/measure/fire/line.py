"""Port with faults: it passes the bytes of another port on and damages selected bytes.

The tests and `make fire` use this class. It needs only the functions of a port, so the other port may be a
model or a real device.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum

from openppmc.host.errors import Disconnected
from openppmc.host.port import Port

OTHER_PROGRAM = b"AT\r"
"""Bytes of another program, which looks for a modem at each new port."""
STOLEN = 5
"""Number of bytes that the other program receives instead of the host."""
MOST_CALLS = 50_000
DELAYS = (0.002, 0.02, 0.06, 0.12, 0.4, 1.5)
"""Delays of a byte in s."""


class Kind(Enum):
    """Kind of a fault.

    Attributes:
        LOSE, DOUBLE, FLIP: the byte is lost, arrives twice, or has an inverted bit.
        DELAY: the byte and all following bytes arrive later.
        SHARE: another program, which ignores the lock of the port, sends bytes, or receives bytes of the
            board.
        UNPLUG: the port disappears before this byte.
        KILL: the host process ends before this byte, as with `kill -9`.
        RESTART: the board loses its power before this byte, and is on again immediately; the port stays.
    """

    LOSE = "lose"
    DOUBLE = "double"
    FLIP = "flip"
    DELAY = "delay"
    SHARE = "share"
    UNPLUG = "unplug"
    KILL = "kill"
    RESTART = "restart"


@dataclass(frozen=True)
class Fault:
    """One fault.

    Attributes:
        to_board: True for a byte from the host to the board.
        place: number of bytes before the damaged byte in this direction.
        detail: number of the inverted bit (modulo 8), or index in DELAYS (modulo its length).
    """

    kind: Kind
    to_board: bool
    place: int
    detail: int = 0

    @property
    def delay(self) -> float:
        """Delay in s."""
        return DELAYS[self.detail % len(DELAYS)]

    def __str__(self) -> str:
        way = "to the board" if self.to_board else "to the host"
        return f"{self.kind.value}, byte {self.place} {way}, detail {self.detail}"


class Killed(BaseException):
    """The host process has ended. No handler for errors may catch this exception."""


class Hang(BaseException):
    """A call needed too much time or too many accesses. No handler for errors may catch this exception."""


class FaultyLine:
    """Port that damages single bytes of another port.

    Args:
        port: the other port. It stays open when this port is closed.
        restart: switches the board off and on.

    Attributes:
        passed: number of bytes to the host, and to the board.
        hit: faults that have occurred.
        limit: time of `clock` in s after which each call raises Hang.
    """

    def __init__(
        self, port: Port, faults: Iterable[Fault] = (), restart: Callable[[], None] = lambda: None
    ) -> None:
        self.name = port.name
        self.port = port
        self.passed = [0, 0]
        self.hit: list[Fault] = []
        self.limit = float("inf")
        self._faults = {(fault.to_board, fault.place): fault for fault in faults}
        self._restart = restart
        self._calls = 0
        self._end: BaseException | None = None
        self._arrived: deque[tuple[float, int]] = deque()
        self._late = 0.0
        self._stolen = 0

    # ------------------------------------------------------------------ port

    def read(self, timeout: float) -> bytes:
        self._check()
        end = self.clock() + timeout
        while True:
            now = self.clock()
            data = bytearray()
            while self._arrived and self._arrived[0][0] <= now:
                data.append(self._arrived.popleft()[1])
            if data or now >= end:
                return bytes(data)
            self._check()
            until = min(end, self._arrived[0][0]) if self._arrived else end
            self._receive(self.port.read(until - now))

    def write(self, data: bytes) -> None:
        self._check()
        passed = bytearray()
        for byte in data:
            fault = self._next_fault(True)
            if fault is None:
                passed.append(byte)
                continue
            if fault.kind is Kind.DELAY:
                self._flush(passed)
                self._pause(fault.delay)
            elif fault.kind is Kind.SHARE:
                passed += OTHER_PROGRAM
            elif fault.kind in (Kind.UNPLUG, Kind.KILL, Kind.RESTART):
                self._flush(passed)
                self._interrupt(fault.kind)
                self._check()
            passed += _damaged(byte, fault)
        self._flush(passed)

    def set_baud(self, baud: int) -> None:
        self._check()
        self.port.set_baud(baud)

    def clock(self) -> float:
        return self.port.clock()

    def close(self) -> None:
        if self._end is None:
            self._end = Disconnected(f"{self.name}: the port is closed")

    # ------------------------------------------------------------------ faults

    def _check(self) -> None:
        """Raise the exception that ended the use of this port."""
        self._calls += 1
        if self._calls > MOST_CALLS or self.clock() > self.limit:
            raise Hang(f"{self._calls} accesses, {self.clock():g} s")
        if self._end is not None:
            raise self._end

    def _next_fault(self, to_board: bool) -> Fault | None:
        fault = self._faults.pop((to_board, self.passed[to_board]), None)
        self.passed[to_board] += 1
        if fault is not None:
            self.hit.append(fault)
        return fault

    def _interrupt(self, kind: Kind) -> None:
        if kind is Kind.RESTART:
            self._restart()
        elif kind is Kind.KILL:
            self._end = Killed()
        else:
            self._end = Disconnected(f"{self.name}: the port went away")

    def _flush(self, passed: bytearray) -> None:
        if passed:
            self.port.write(bytes(passed))
            passed.clear()

    def _pause(self, seconds: float) -> None:
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self._receive(self.port.read(left))

    def _receive(self, data: bytes) -> None:
        """Process bytes that the board has sent."""
        for byte in data:
            fault = self._next_fault(False)
            if self._stolen:
                self._stolen -= 1
                continue
            received = bytes([byte])
            if fault is not None:
                if fault.kind is Kind.DELAY:
                    self._late = self.clock() + fault.delay
                elif fault.kind is Kind.SHARE:
                    self._stolen = STOLEN - 1
                    continue
                elif fault.kind in (Kind.UNPLUG, Kind.KILL, Kind.RESTART):
                    self._interrupt(fault.kind)
                    return
                received = _damaged(byte, fault)
            self._arrived += [(max(self.clock(), self._late), one) for one in received]


def _damaged(byte: int, fault: Fault) -> bytes:
    """Return the bytes that arrive instead of a byte."""
    if fault.kind is Kind.LOSE:
        return b""
    if fault.kind is Kind.DOUBLE:
        return bytes([byte, byte])
    if fault.kind is Kind.FLIP:
        return bytes([byte ^ 1 << fault.detail % 8])
    return bytes([byte])
