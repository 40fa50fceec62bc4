"""Bus and pins of a PPMC-104 as text."""

from __future__ import annotations

from ...model.ppmc104 import INPUTS, OUTPUTS, WIDTHS
from ...model.single.codes import decode
from ...model.single.hostport import strobes
from ..common.byte_bus import byte_part
from ..common.part_decoder import Access, PulseTrain, Wires
from ..common.pulses import train
from .mnemonics import Ppmc104Decoder


def _levels(access: Access, wires: Wires) -> dict[str, int]:
    return {"cs_n": 0, "wr_n" if access.write else "rd_n": 0, "a0": access.reg}


def _trains(wires: Wires) -> list[PulseTrain]:
    one = train(wires, 1, "pout_n", 0, 0, "dir")
    return [] if one is None else [one]


DECODER = byte_part(
    "a PPMC-104",
    (INPUTS, OUTPUTS, WIDTHS),
    ("cs_n", "rd_n", "wr_n"),
    strobes,
    Ppmc104Decoder(),
    lambda code, wires: decode(code),
    _levels,
    _trains,
    {"s": 1},
    ("s",),
)
