"""Bus and pins of a PPMC-2104 as text.

In a port that both axes share, the bit with the index 1 belongs to axis 1.
"""

from __future__ import annotations

from ...model.ppmc2104.codes import AXIS_INPUTS, AXIS_OUTPUTS, INPUTS, OUTPUTS, WIDTHS, decode, strobes
from ..common.byte_bus import byte_part
from ..common.part_decoder import Access, PulseTrain, Wires
from ..common.pulses import train
from .mnemonics import Ppmc2104Decoder


def _levels(access: Access, wires: Wires) -> dict[str, int]:
    busc = wires.ports.get("busc")
    if busc is not None and busc.initial:
        return {"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": int(not access.write), "a0": access.reg}
    return {"cs_n": 0, "ds_wrs_n" if access.write else "rw_rds_n": 0, "a0": access.reg}


def _trains(wires: Wires) -> list[PulseTrain]:
    found = (train(wires, axis + 1, "pout_n", axis, 0, "dir") for axis in (0, 1))
    return [one for one in found if one is not None]


def _axis_of(port: str, bit: int) -> int:
    """Return the axis of a bit, counted from 1; 0 for a port without an axis."""
    return bit + 1 if port in AXIS_OUTPUTS else {"s1_n": 1, "s2_n": 2}.get(port, 0)


DECODER = byte_part(
    "a PPMC-2104",
    (INPUTS, OUTPUTS, WIDTHS),
    ("cs_n", "ds_wrs_n", "rw_rds_n", "busc"),
    strobes,
    Ppmc2104Decoder(),
    lambda code, wires: decode(code),
    _levels,
    _trains,
    {"s1_n": 1, "s2_n": 1, **dict.fromkeys((*AXIS_INPUTS, *AXIS_OUTPUTS), 1)},
    ("s1_n", "s2_n"),
    _axis_of,
    aliases={f"s{phase}{axis}_n": f"s{axis}_n[{phase}]" for phase in range(1, 6) for axis in (1, 2)},
)
