"""Parallel bus and pins of a PPMC-312 as text: blocks through its windows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...model.ppmc312.codes import INPUTS, OUTPUTS, WIDTHS, Code
from ...model.ppmc312.front.mailbox import ADDRESS, CSR, READ, WRITE
from ..common.bus import accesses
from ..common.kind import Access, Accesses, DecodeKind, Line, Needs, Train, Wires
from ..common.pinmap import Pins
from ..common.pulses import train
from ..common.registers import Judged, Said, cycle, spoken
from .words import CUT, Row, Words312

SHORTEST = 200_000
STROBES = ("cs_n", "we_n", "oe_n")
SERIAL = ("txd", "snd")


def _strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    chosen = not pins["cs_n"] and pins["we_n"] != pins["oe_n"]
    return bool(chosen and not pins["we_n"]), bool(chosen and not pins["oe_n"])


def _seen(wires: Wires) -> Accesses:
    return accesses(wires, STROBES, "rs", INPUTS, _strobes)


def _said(one: Access) -> Said:
    names = {(CSR, True): "CSR :=", (CSR, False): "CSR", (ADDRESS, True): "WAR :=", (ADDRESS, False): "RAR"}
    names |= {(WRITE, True): "DWR :=", (READ, False): "DRR"}
    return Said(one.begin, names.get((one.reg, one.write), "other"), one.reg, one.byte)


def _judge(row: Row) -> Judged:
    block = row.sent
    if len(block) < 3 or row.meaning == CUT:
        return Judged(row.meaning == CUT)
    good = block[1] == len(block) - 2
    data = block[0] in (0, 1)
    return Judged(
        not good or not (data or block[2] in list(Code)),
        good and (block[0] == 1 or (not data and block[2] in (Code.RESET, Code.INITIAL))),
    )


def _lines(wires: Wires) -> list[Line]:
    return spoken(_seen(wires).without_polls(CSR), Words312(), _said, _judge)


def _stimulus(wires: Wires) -> Iterator[tuple[int, dict[str, int]]]:
    for one in _seen(wires):
        yield from cycle(one, {"cs_n": 0, "we_n" if one.write else "oe_n": 0, "rs": one.reg})


def trains(wires: Wires) -> list[Train]:
    """Return the pulses."""
    one = train(wires, 1, "pout", 0, 1, "dir")
    return [] if one is None else [one]


NAMES = {name: WIDTHS.get(name, 1) for name in (*INPUTS, *OUTPUTS)} | {"d": 8, "clk": 1}
DECODER = DecodeKind(
    "a PPMC-312",
    Pins(NAMES),
    INPUTS,
    lambda wires: Needs((*STROBES, "rs", "d" if "d" in wires.bits else "d_i"), SHORTEST),
    _lines,
    _stimulus,
    trains,
    frozenset((*STROBES, "rs", "d_i")),
    tuple(name for name in OUTPUTS if name not in ("d_o", "d_oe", *SERIAL, "out_oe")),
    unnamed="instructions",
    rests=OUTPUTS,
)
