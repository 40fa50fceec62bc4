"""Frames of the PMC006 (docs/pmc006/README.md, 3) as sent and received by the host of the tests."""

from __future__ import annotations

HEAD, REPLY = 0xA5, 0x7A


def number(code: str | int) -> int:
    """Return an instruction code as a number; the argument is the letter or the number of the instruction."""
    return ord(code) if isinstance(code, str) else code


def checked(*content: int) -> bytes:
    """Return bytes followed by their check byte."""
    return bytes([*content, sum(content) & 0xFF])


def command(address: int, code: str | int, data: int = 0) -> bytes:
    """Return a command frame; `data` is a signed or unsigned 32-bit number."""
    return checked(HEAD, address, number(code), *(data & 0xFFFFFFFF).to_bytes(4, "little"))


def of_reply(frame: bytes) -> tuple[int, int]:
    """Return the address and the data of a reply; raise AssertionError if the bytes are not a valid reply."""
    assert len(frame) == 8 and frame[:2] == bytes([HEAD, REPLY]), f"{frame.hex(' ')} is no reply"
    assert frame == checked(*frame[:7]), f"{frame.hex(' ')}: wrong check"
    return frame[2], int.from_bytes(frame[3:7], "little")


def reply(address: int, data: int) -> bytes:
    """Return the reply frame of a node."""
    return checked(HEAD, REPLY, address, *(data & 0xFFFFFFFF).to_bytes(4, "little"))


def signed(value: int) -> int:
    """Return 32-bit data as a signed number."""
    return value - (1 << 32) if value >> 31 else value
