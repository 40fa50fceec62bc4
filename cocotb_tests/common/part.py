"""Pins of the parts as the harness sees them: idle levels of inputs, reset levels of outputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Part:
    """One part.

    `name` is the top module and the folder name, `prefix` the first word of its rule IDs.
    `inputs` maps every input pin except clk/rst_n to its idle level; `outputs` maps every output to
    (width, reset level).
    """

    name: str
    prefix: str
    inputs: Mapping[str, int]
    outputs: Mapping[str, tuple[int, int]] = field(default_factory=dict)

    def reset_levels(self, params: Mapping[str, object] | None = None) -> dict[str, int]:
        """Output levels during reset under the given parameters (P104-PORT-01, P104-PHS-02)."""
        levels = {name: level for name, (_, level) in self.outputs.items()}
        if params and int(params.get("PHASE_IDLE", 1)) == 0 and "s" in levels:  # type: ignore[call-overload]
            levels["s"] = 0
        return levels

    def width(self, output: str) -> int:
        """Width of an output pin in bits."""
        return self.outputs[output][0]


PPMC104 = Part(
    name="ppmc104",
    prefix="P104",
    inputs={
        "a0": 0,
        "cs_n": 1,
        "rd_n": 1,
        "wr_n": 1,
        "d_i": 0,
        "csel": 1,
        "vsel": 1,
        "clock": 0,
        "l1_n": 1,
        "l2_n": 1,
        "l3_n": 1,
        "l4_n": 1,
        "cnp_n": 1,
        "alm_n": 1,
        "auxi": 0,
    },
    outputs={
        "d_o": (8, 0x00),
        "d_oe": (1, 0),
        "int_n": (1, 1),
        "auxo": (4, 0xF),
        "aux_n": (1, 1),
        "s": (5, 0x1F),
        "hold": (1, 1),
        "pout_n": (1, 1),
        "dir": (1, 0),
    },
)

PARTS: dict[str, Part] = {PPMC104.name: PPMC104}

# Also parts whose RTL does not exist yet, so that their rule IDs already sort to the right table.
PREFIXES = {"P104": "ppmc104", "P2104": "ppmc2104", "STMC": "stmc", "P312": "ppmc312", "P006": "pmc006"}
