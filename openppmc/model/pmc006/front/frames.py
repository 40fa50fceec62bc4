"""Frames of the PMC006B4: eight bytes, a check, addresses (P006-FRM-01..08). No time here."""

from __future__ import annotations

from typing import NamedTuple

HEAD, ANSWER, SIZE = 0xA5, 0x7A, 8


class Command(NamedTuple):
    """A frame with a right check: address, instruction code, data as a signed number of 32 bits."""

    address: int
    code: int
    data: int


def checked(*parts: int, data: int) -> bytes:
    """Byte 0xA5, two bytes, the data and the check."""
    body = bytes((HEAD, *parts)) + (data & 0xFFFF_FFFF).to_bytes(4, "little")
    return body + bytes([sum(body) % 256])


def command(address: int, code: int | str, data: int = 0) -> bytes:
    """What a host sends; code also as the letter of an instruction."""
    return checked(address, ord(code) if isinstance(code, str) else code, data=data)


def reply(address: int, data: int) -> bytes:
    """What a controller answers."""
    return checked(ANSWER, address, data=data)


class Assembler:
    """Makes commands of bytes."""

    def __init__(self) -> None:
        self._open = b""

    @property
    def unfinished(self) -> bool:
        """A frame has begun."""
        return bool(self._open)

    def drop(self) -> None:
        """Forget a frame that has begun."""
        self._open = b""

    def take(self, byte: int) -> Command | None:
        """The next byte; the command that it completes."""
        if not self._open and byte != HEAD:
            return None
        self._open += bytes([byte])
        if len(self._open) < SIZE:
            return None
        whole, self._open = self._open, b""
        if sum(whole[:-1]) % 256 != whole[-1]:
            return None
        return Command(whole[1], whole[2], int.from_bytes(whole[3:7], "little", signed=True))
