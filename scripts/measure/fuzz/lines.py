"""The serial lines: generators of valid frames, and the events of the golden models for received words.

The frames are made without functions of the models, so that mistakes in these functions are detected.
"""

from __future__ import annotations

import random
from array import array
from binascii import crc_hqx
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

from openppmc.model.carrier.bridge import NAK_FRAMING, NAK_SEQ, NAK_SILENCE, SEQ_LIMIT, Receiver, Request
from openppmc.model.pmc006.line import Assembler
from openppmc.model.ppmc312.front.serial import LENGTHS, Outcome, Parser
from scripts.measure.fuzz.words import BROKEN, SILENCE, Frame, digest

Events = Iterator[tuple[int, int]]
"""Event: (number of the word, event in the format of the output `what_o` in tb/fuzz)."""
PMC006_ADDRESS, PPMC312_ADDRESS = 3, 5


@dataclass(frozen=True)
class Line:
    """A line.

    Attributes:
        top: name of the top module in tb/fuzz.
        group: name of the group in rtl/files.yml.
        good, special: arguments of `words.stream`.
        params: parameters of the top module.
        expected: function that returns the events of the golden model.
    """

    top: str
    group: str
    good: Frame
    special: bytes
    expected: Callable[[array[int]], Events]
    params: dict[str, int] = field(default_factory=dict)


# ---------------------------------------------------------------------- UART bridge


def bridge_frame(rng: random.Random) -> bytes:
    """Return a frame of UB-FRM-01 … 04; some frames have a length near the limit."""
    size = rng.choice((0, 1, 2, 5, 12, 30)) if rng.random() < 0.98 else rng.randint(250, 256)
    content = bytes([rng.randrange(256)]) + bytes(rng.choices((0x7D, 0x7E, 0x5E, 0, 0x80, 0x20), k=size))
    content += crc_hqx(content, 0xFFFF).to_bytes(2, "big")
    escaped = content.replace(b"\x7d", b"\x7d\x5d").replace(b"\x7e", b"\x7d\x5e")
    return b"\x7e" + escaped + b"\x7e"


def bridge_events(words: array[int]) -> Events:
    """Yield requests and NAKs."""
    receiver = Receiver()
    for place, word in enumerate(words):
        if word & SILENCE:
            item = receiver.drop(NAK_SILENCE) if receiver.inside else None
        elif word & BROKEN:
            item = receiver.drop(NAK_FRAMING)
        else:
            item = receiver.take(word)
        if isinstance(item, Request):
            if item.seq >= SEQ_LIMIT:
                item = NAK_SEQ
            else:
                yield place, 1 << 56 | item.seq << 48 | len(item.script) << 32 | digest(item.script)
                continue
        if item is not None:
            yield place, 2 << 56 | item


# ---------------------------------------------------------------------- PMC006B4


def pmc006_frame(rng: random.Random) -> bytes:
    """Return a frame of P006-FRM-01, -02."""
    address = PMC006_ADDRESS if rng.random() < 0.8 else rng.randrange(256)
    data = rng.choice((b"\xa5" * 4, rng.randbytes(4), bytes(4)))
    body = bytes([0xA5, address, rng.randrange(256)]) + data
    return body + bytes([sum(body) & 0xFF])


def pmc006_events(words: array[int]) -> Events:
    """Yield frames for this controller."""
    assembler = Assembler()
    for place, word in enumerate(words):
        if word & (SILENCE | BROKEN):
            assembler.drop()
        elif (found := assembler.take(word)) and found.address == PMC006_ADDRESS:
            yield place, 1 << 56 | found.code << 48 | found.data & 0xFFFF_FFFF


# ---------------------------------------------------------------------- PPMC-312, serial mode


def ppmc312_frame(rng: random.Random, chars: bool) -> bytes:
    """Return a poll or an instruction of P312-SER-10 … 13.

    Args:
        chars: True if the checksum is that of the characters.
    """
    poll = rng.random() < 0.2
    control = (0x80 if poll else 0x90) | (PPMC312_ADDRESS if rng.random() < 0.9 else rng.randrange(16))
    code = rng.choice(list(LENGTHS)) if rng.random() < 0.9 else rng.randrange(256)
    size = LENGTHS.get(code, 0) if rng.random() < 0.95 else rng.randrange(12)
    data = b"" if poll else bytes([code]) + rng.randbytes(size)
    text = data.hex().encode()
    total = sum(text) if chars else control + sum(data)
    return bytes([control]) + text + bytes([~total & 0x7F])


_KINDS = {Outcome.POLL: 1, Outcome.INSTRUCTION: 2, Outcome.FAULT: 3, Outcome.UNKNOWN: 4}


def ppmc312_events(words: array[int], chars: bool) -> Events:
    """Yield frames for this station, valid and invalid."""
    parser = Parser(PPMC312_ADDRESS, LENGTHS, "CHARS" if chars else "BINARY")
    for place, word in enumerate(words):
        found = None
        if word & SILENCE:
            found = parser.silence()
        elif word & BROKEN:
            parser.abandon()
        else:
            found = parser.take(word)
        if found is not None:
            what = _KINDS[found.outcome] << 56 | found.code << 48
            if found.outcome is Outcome.INSTRUCTION:
                what |= len(found.data) << 32 | digest(found.data)
            yield place, what


_HEX = b"0123456789abcdefAFg/:"
LINES = {
    "bridge": Line("bridge_fuzz", "ppmc104_carrier", bridge_frame, b"\x7d\x7e\x5d\x5e\x00", bridge_events),
    "pmc006": Line("pmc006_fuzz", "pmc006", pmc006_frame, b"\xa5\xa5\x03\x7a\x00\xff\x4d", pmc006_events),
    **{
        f"ppmc312{'-chars' if chars else ''}": Line(
            "ppmc312_fuzz",
            "ppmc312",
            partial(ppmc312_frame, chars=chars),
            b"\x85\x95\x85\x95\x84\x96\xa5\x00\x7f\x06" + _HEX,
            partial(ppmc312_events, chars=chars),
            {"CharsSum": int(chars)},
        )
        for chars in (False, True)
    },
}
