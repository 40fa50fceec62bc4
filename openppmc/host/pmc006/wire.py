"""Frames of the PMC006B4: eight bytes each way, with a check. Pure.

>>> command(1, 0x73, 287).hex(" ")
'a5 01 73 1f 01 00 00 39'
>>> receiver = Receiver(1)
>>> [receiver.take(byte) for byte in bytes.fromhex("A5 7A 01 03 00 00 00 23")][-1]
Reply(address=1, value=3)
"""

from __future__ import annotations

from typing import NamedTuple

from ..basis.arguments import whole
from ..basis.errors import OutOfRange
from ..line.faults import Fault

HEAD, ANSWER, SIZE = 0xA5, 0x7A, 8
FACTORY, LAST = 255, 120
ADDRESSES = (FACTORY, *range(1, LAST + 1))
"""All that a controller can have, in the order in which hosts look for one."""


class Reply(NamedTuple):
    """What a controller says. value: its data, signed."""

    address: int
    value: int


def address_number(address: int) -> int:
    """The address itself if a controller can have it. OutOfRange."""
    number = whole(address, "address")
    if number not in ADDRESSES:
        raise OutOfRange(f"address {number}: controllers have 1 to {LAST}, factory-new ones {FACTORY}")
    return number


def command(address: int, code: int, data: int = 0) -> bytes:
    """A frame to a controller. data: 32 bits, signed or not."""
    return _sealed(bytes([HEAD, address, code]) + (data & 0xFFFFFFFF).to_bytes(4, "little"))


def reply(address: int, value: int) -> bytes:
    """A frame of a controller."""
    return _sealed(bytes([HEAD, ANSWER, address]) + (value & 0xFFFFFFFF).to_bytes(4, "little"))


def _sealed(body: bytes) -> bytes:
    return body + bytes([sum(body) & 0xFF])


class Receiver:
    """Takes the bytes after a frame to `address`; see `master.Listener`. sent: that frame, for masters that
    hear themselves: it is passed over.

    Replies of others and damaged ones are passed over too, as the one that is due may follow; `fault` tells
    of them.
    """

    def __init__(self, address: int, sent: bytes = b"") -> None:
        self._address = address
        self._echo = sent
        self._matched = 0
        self._open = b""
        self._foreign = self._broken = False
        self._noise = False

    @property
    def fault(self) -> Fault | None:
        """What came instead of the reply, None for silence."""
        if self._broken or self._open:
            return Fault.BROKEN
        if self._foreign:
            return Fault.FOREIGN
        return Fault.NOISE if self._noise else None

    def take(self, byte: int) -> Reply | Fault | None:
        """The next byte; the reply when it is complete."""
        if self._matched < len(self._echo):
            if byte == self._echo[self._matched]:
                self._matched += 1
                self._open = b"" if self._matched == len(self._echo) else self._open + bytes([byte])
                return None
            self._echo = b""
        self._open += bytes([byte])
        return self._look()

    def _look(self) -> Reply | None:
        """The reply in what has come, if it is there."""
        while self._open:
            start = next((at for at in range(len(self._open)) if _begins(self._open[at:])), len(self._open))
            self._noise |= start > 0
            self._open = self._open[start:]
            if len(self._open) < SIZE:
                return None
            whole = self._open[:SIZE]
            if sum(whole[:-1]) & 0xFF != whole[-1]:
                self._broken = True
                self._open = self._open[1:]
            elif whole[2] != self._address:
                self._foreign = True
                self._open = self._open[SIZE:]
            else:
                return Reply(whole[2], int.from_bytes(whole[3:7], "little", signed=True))
        return None


def _begins(data: bytes) -> bool:
    """Whether a reply can begin like this."""
    return data[0] == HEAD and data[1:2] in (b"", bytes([ANSWER]))
