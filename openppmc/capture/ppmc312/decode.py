"""Parallel bus and pins of a PPMC-312 as text.

The text consists of the blocks that the host transfers through the bus registers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...model.ppmc312.codes import INPUTS, OUTPUTS, WIDTHS, Code
from ...model.ppmc312.front.mailbox import ADDRESS, CSR, READ, WRITE
from ..common.bus import accesses
from ..common.part_decoder import Access, Accesses, Line, Needs, PartDecoder, PulseTrain, Wires
from ..common.pinmap import Pins
from ..common.pulses import train
from ..common.registers import BusAccess, DecodedAccess, cycle, decoded_lines
from .mnemonics import CUT, Ppmc312Decoder, Row

SHORTEST = 200_000
STROBES = ("cs_n", "we_n", "oe_n")
SERIAL = ("txd", "snd")


def _strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    chosen = not pins["cs_n"] and pins["we_n"] != pins["oe_n"]
    return bool(chosen and not pins["we_n"]), bool(chosen and not pins["oe_n"])


def _seen(wires: Wires) -> Accesses:
    return accesses(wires, STROBES, "rs", INPUTS, _strobes)


def _bus_access(one: Access) -> BusAccess:
    names = {(CSR, True): "CSR :=", (CSR, False): "CSR", (ADDRESS, True): "WAR :=", (ADDRESS, False): "RAR"}
    names |= {(WRITE, True): "DWR :=", (READ, False): "DRR"}
    return BusAccess(one.begin, names.get((one.reg, one.write), "other"), one.reg, one.byte)


def _check(row: Row) -> DecodedAccess:
    block = row.sent
    if len(block) < 3 or row.meaning == CUT:
        return DecodedAccess(row.meaning == CUT)
    good = block[1] == len(block) - 2
    data = block[0] in (0, 1)
    return DecodedAccess(
        not good or not (data or block[2] in list(Code)),
        good and (block[0] == 1 or (not data and block[2] in (Code.RESET, Code.INITIAL))),
    )


def _lines(wires: Wires) -> list[Line]:
    return decoded_lines(_seen(wires).without_polls(CSR), Ppmc312Decoder(), _bus_access, _check)


def _stimulus(wires: Wires) -> Iterator[tuple[int, dict[str, int]]]:
    for one in _seen(wires):
        yield from cycle(one, {"cs_n": 0, "we_n" if one.write else "oe_n": 0, "rs": one.reg})


def trains(wires: Wires) -> list[PulseTrain]:
    """Return the pulses."""
    one = train(wires, 1, "pout", 0, 1, "dir")
    return [] if one is None else [one]


NAMES = {name: WIDTHS.get(name, 1) for name in (*INPUTS, *OUTPUTS)} | {"d": 8, "clk": 1}
DECODER = PartDecoder(
    "a PPMC-312",
    Pins(NAMES),
    INPUTS,
    lambda wires: Needs((*STROBES, "rs", "d" if "d" in wires.bits else "d_i"), SHORTEST),
    _lines,
    _stimulus,
    trains,
    frozenset((*STROBES, "rs", "d_i")),
    tuple(name for name in OUTPUTS if name not in ("d_o", "d_oe", *SERIAL, "out_oe")),
    row_noun="instructions",
    reset_levels=OUTPUTS,
)
