"""Accesses that are decoded as columns of arrays result in the same lines as accesses decoded singly."""

from __future__ import annotations

import random

import pytest

from openppmc.capture.common.mnemonics import CommandDecoder, Exchange
from openppmc.capture.common.part_decoder import Access, Accesses
from openppmc.capture.common.registers import BusAccess, DecodedAccess, decoded_byte_lines, decoded_lines
from openppmc.capture.common.signals import numpy
from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.capture.ppmc2104.mnemonics import Ppmc2104Decoder
from openppmc.capture.stmc.mnemonics import StmcDecoder

CODES = (0x2A, 0x43, 0x63, 0x4D, 0x42, 0x80, 0xA0, 0x83, 0xA3, 0xC3, 0x81, 0x40, 0x00, 0xFF)


def session(source: random.Random, count: int) -> Accesses:
    """Return random commands, data writes, responses and polls in a random order."""
    np = numpy()
    rows = []
    t = 0
    for _ in range(count):
        kind = source.choices(("command", "data", "answer", "poll"), (2, 4, 3, 6))[0]
        byte = source.choice(CODES) if kind == "command" else source.choice((0, 4, 4, 2, 0x78, 99, 0x90))
        rows.append(Access(t, t + 500, kind in ("command", "data"), int(kind in ("command", "poll")), byte))
        t += source.choice((500, 1000, 9000))
    kinds = (np.int64, np.int64, bool, np.uint8, np.uint8)
    return Accesses(
        *(np.array(column, kind) for column, kind in zip(zip(*rows, strict=True), kinds, strict=True))
    )


def judge(row: Exchange) -> DecodedAccess:
    """Return a result that depends on the bytes but not on a status."""
    return DecodedAccess(len(row.sent) > 3, row.sent[:1] == [0x2A], len(row.answer))


@pytest.mark.parametrize(
    "words", [Ppmc104Decoder(), Ppmc2104Decoder(), StmcDecoder("SHEET")], ids=["104", "2104", "stmc"]
)
@pytest.mark.parametrize("seed", range(5))
def test_rows_at_once(words: CommandDecoder, seed: int) -> None:
    """For accesses in any order, `decoded_byte_lines` returns the lines that `exchanges` returns."""
    accesses = session(random.Random(f"accesses {seed}"), 3000)
    one_by_one = decoded_lines(
        accesses,
        words,
        lambda one: BusAccess(one.begin, "write" if one.write else "read", one.reg, one.byte),
        judge,
    )
    assert decoded_byte_lines(accesses, words, judge) == one_by_one
    assert len(one_by_one) > 300 and len({line.text for line in one_by_one}) > 30


def test_polls_are_left_out() -> None:
    """A status read is omitted only if it repeats the previous read."""
    np = numpy()
    rows = [
        (True, 1, 4),
        (False, 1, 4),
        (False, 1, 4),
        (False, 0, 4),
        (False, 1, 4),
        (False, 1, 0),
        (False, 1, 0),
    ]
    columns = [np.array(column) for column in zip(*((n, n, *row) for n, row in enumerate(rows)), strict=True)]
    kept = Accesses(*columns).without_polls(1)
    assert kept.begin.tolist() == [0, 1, 3, 4, 5]
