"""ISA or PC/104 bus of a J105 STMC board as text."""

from __future__ import annotations

from collections.abc import Mapping

from ...model.stmc.codes import decode
from ...model.stmc.pc104_board import INPUTS, OUTPUTS, WIDTHS
from ..common.byte_bus import byte_part
from ..common.part_decoder import Access, Wires
from .decode import read_map, trains
from .mnemonics import StmcDecoder

BASE = 0x3B0
"""Address of the data register.

For a board at another address, the pin map assigns suitable channels to `sa`.
"""


def _strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    chosen = not pins["aen"] and pins["sa"] >> 1 == BASE >> 1
    return bool(chosen and not pins["iow_n"]), bool(chosen and not pins["ior_n"])


def _levels(access: Access, wires: Wires) -> dict[str, int]:
    return {"sa": BASE | access.reg, "aen": 0, "iow_n" if access.write else "ior_n": 0}


DECODER = byte_part(
    "a J105 STMC board",
    (INPUTS, OUTPUTS, WIDTHS),
    ("sa", "aen", "ior_n", "iow_n"),
    _strobes,
    lambda wires: StmcDecoder(read_map(wires)),
    lambda code, wires: decode(code, read_map(wires)),
    _levels,
    trains,
    {"s": 1, "drv": 1},
    ("s", "drv"),
    address="sa",
    bus="sd",
)
