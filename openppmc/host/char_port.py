"""Port `char:<port>`: a board whose FPGA has the character host (docs/char_host.md), not the UART bridge.

This program executes the scripts of the wire protocol itself: it contains the golden model of the bridge, and
sends each bus access of this model to the character host.
"""

from __future__ import annotations

import time
from typing import Protocol

from ..model.carrier.bridge import INT_PIN, Bridge
from .errors import NoAnswer, ProtocolError, WrongDevice

MARK, VERSION = 0x43, 1
_FIRST, _WRITE, _OWN = 0x80, 0x40, 0x20
_INFO_BYTES, _PINS = 15, 15
_RELEASED = 0x80
ANSWER_SECONDS = 0.3
"""Longest time in s from a request to its answer, including the delays of USB adapters and busy computers."""
POLL_SECONDS = 0.005
"""Time in s between two reads of the level of `int_n` while a caller waits for an event."""


class Line(Protocol):
    """Members of a port (`port.Port`) that this module needs."""

    name: str

    def read(self, timeout: float) -> bytes: ...
    def write(self, data: bytes) -> None: ...
    def clock(self) -> float: ...
    def close(self) -> None: ...


class CharBus:
    """Registers of the part, accessed through the character host. Implements `bridge_ops.Bus`."""

    def __init__(self, line: Line) -> None:
        self._line = line
        self._control = 0xFF

    def read(self, a: int) -> int:
        return self._ask(bytes([_FIRST | a << 1]))

    def write(self, a: int, byte: int) -> None:
        self._store(_FIRST | _WRITE | a << 1, byte)

    def info(self, n: int) -> int:
        """Return info byte n (0 to 15) of the character host."""
        return self._ask(bytes([_FIRST | _OWN | n << 1]))

    def pins(self) -> int:
        """Return the levels of the pins, in the order of op PINS."""
        return self.info(_PINS)

    def straps(self, byte: int) -> None:
        """Set the strap outputs of the character host."""
        self._set_control(byte | _RELEASED)

    def reset(self) -> None:
        """Reset the part; the strap outputs keep their levels."""
        straps = self._control
        self._set_control(straps & ~_RELEASED)
        self._set_control(straps)

    def now_ms(self) -> float:
        """Return the time in ms, for the time limits of waits."""
        return time.perf_counter() * 1000

    def _set_control(self, byte: int) -> None:
        self._store(_FIRST | _WRITE | _OWN, byte)
        self._control = byte

    def _store(self, head: int, byte: int) -> None:
        """Send `head` and a byte to write; raise ProtocolError if the answer is not this byte."""
        if (got := self._ask(bytes([head | byte >> 7, byte & 0x7F]))) != byte:
            raise ProtocolError(
                f"{self._line.name}: the board received 0x{got:02X} instead of 0x{byte:02X}: check the cable"
            )

    def _ask(self, request: bytes) -> int:
        """Send a request and return the character of its answer. Raises NoAnswer."""
        while self._line.read(0):
            pass  # discard late answers to requests that have ended with NoAnswer
        self._line.write(request)
        end = self._line.clock() + ANSWER_SECONDS
        while not (answer := self._line.read(max(0.0, end - self._line.clock()))):
            if self._line.clock() >= end:
                raise NoAnswer(
                    f"{self._line.name}: no answer of a character host; check the power, and that the "
                    "bitstream was built with BRIDGE=0"
                )
        return answer[-1]


class CharPort:
    """Board with the character host; see `port.Port`.

    Args:
        line: port of the board at 115 200 baud.

    Raises:
        NoAnswer, WrongDevice: there is no character host at this port.
    """

    def __init__(self, line: Line) -> None:
        self.name = "char:" + line.name
        self._line = line
        self._bus = CharBus(line)
        self._waiting = bytearray()
        try:
            self._bridge = self._identify()
        except BaseException:
            line.close()
            raise
        self._level = 1

    def _identify(self) -> Bridge:
        """Read the info bytes, and return a golden model of the bridge for this board."""
        info = bytes(map(self._bus.info, range(_INFO_BYTES)))
        if info[:2] != bytes([MARK, VERSION]):
            raise WrongDevice(
                f"{self.name}: the device that answers has no character host of version {VERSION}: "
                "check the port, or open it without char:"
            )
        xtal_hz, clk_hz = (int.from_bytes(info[at : at + 4], "little") for at in (5, 9))
        part = int.from_bytes(info[2:4], "little")
        return Bridge(self._bus, part, clk_hz, xtal_hz, bool(info[4] & 1), counter=False)

    def read(self, timeout: float) -> bytes:
        end = self.clock() + timeout
        while not self._waiting and (left := end - self.clock()) > 0:
            level = self._bus.pins() & INT_PIN
            if self._level and not level:
                self._waiting += self._bridge.interrupt()
            self._level = level
            if not self._waiting:
                time.sleep(min(POLL_SECONDS, left))
        data = bytes(self._waiting)
        self._waiting.clear()
        return data

    def write(self, data: bytes) -> None:
        self._waiting += self._bridge.receive(data)
        # Between two reads of the level of int_n, a script may have set int_n high, and the part may have set
        # it low again. Therefore, a low level after a script is treated as a new falling edge.
        self._level = 1

    def set_baud(self, baud: int) -> None:
        """Do nothing: the rate of the line to a character host is fixed."""

    def clock(self) -> float:
        return self._line.clock()

    def close(self) -> None:
        self._line.close()
