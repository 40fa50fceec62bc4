"""Bus and phases of a J105 STMC as text."""

from __future__ import annotations

from ...model.single.hostport import strobes
from ...model.stmc.codes import decode
from ...model.stmc.pins import INPUTS, OUTPUTS, WIDTHS
from ..common.byte_bus import byte_part
from ..common.part_decoder import Access, PulseTrain, Wires
from ..common.pulses import phase_train
from .mnemonics import StmcDecoder


def _levels(access: Access, wires: Wires) -> dict[str, int]:
    return {"cs_n": 0, "wr_n" if access.write else "rd_n": 0, "a0": access.reg}


def read_map(wires: Wires) -> str:
    """Return the parameter READ_MAP of the part from the pin map."""
    return str(wires.params.get("READ_MAP", "FAMILY"))


def trains(wires: Wires) -> list[PulseTrain]:
    """Return the steps that the phases output."""
    one = phase_train(wires, 1, "s")
    return [] if one is None else [one]


DECODER = byte_part(
    "a J105 STMC",
    (INPUTS, OUTPUTS, WIDTHS),
    ("cs_n", "rd_n", "wr_n"),
    strobes,
    lambda wires: StmcDecoder(read_map(wires)),
    lambda code, wires: decode(code, read_map(wires)),
    _levels,
    trains,
    {"s": 1},
    ("s",),
)
