"""Pins of the parts as the harness sees them: idle levels of inputs, reset levels of outputs, bus styles.

A port of several bits is one number, as in the simulator. One bit of it has a name of its own: "pout_n[2]"
is bit 2 of a port declared `[2:1]`, whose lowest bit is number 1.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .config import Config

_BIT = re.compile(r"^(\w+)\[(\d+)\]$")


@dataclass(frozen=True)
class BusStyle:
    """Pin levels of each half of an access; `address` is the register-select pin."""

    write_on: Mapping[str, int]
    write_off: Mapping[str, int]
    read_on: Mapping[str, int]
    read_off: Mapping[str, int]
    address: str = "a0"

    @property
    def off(self) -> dict[str, int]:
        """Levels with both strobes off."""
        return {**self.write_off, **self.read_off}


STROBES_RD_WR = BusStyle(
    write_on={"cs_n": 0, "wr_n": 0},
    write_off={"cs_n": 1, "wr_n": 1},
    read_on={"cs_n": 0, "rd_n": 0},
    read_off={"cs_n": 1, "rd_n": 1},
)
# The same two pins in both styles of the PPMC-2104AFP: WRS*/RDS*, or DS* with R/W*.
STROBES_WRS_RDS = BusStyle(
    write_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 1},
    write_off={"cs_n": 1, "ds_wrs_n": 1},
    read_on={"cs_n": 0, "ds_wrs_n": 1, "rw_rds_n": 0},
    read_off={"cs_n": 1, "rw_rds_n": 1},
)
# R/W* keeps its level after the strobe, as a processor's does until its next access.
STROBES_DS_RW = BusStyle(
    write_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 0},
    write_off={"cs_n": 1, "ds_wrs_n": 1},
    read_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 1},
    read_off={"cs_n": 1, "ds_wrs_n": 1},
)
# The PPMC-312: eight registers, chosen by rs.
STROBES_WE_OE = BusStyle(
    write_on={"cs_n": 0, "we_n": 0},
    write_off={"cs_n": 1, "we_n": 1},
    read_on={"cs_n": 0, "oe_n": 0},
    read_off={"cs_n": 1, "oe_n": 1},
    address="rs",
)
# 8-bit ISA cycles: the address says which register, no chip select of its own.
STROBES_ISA = BusStyle(
    write_on={"iow_n": 0},
    write_off={"iow_n": 1},
    read_on={"ior_n": 0},
    read_off={"ior_n": 1},
    address="sa",
)


@dataclass(frozen=True)
class Part:
    """One part.

    `name` is the top module and the folder name, `prefix` the first word of its rule IDs.
    `inputs` maps every input pin except clk/rst_n to its idle level; `outputs` maps every output to
    (width, reset level). `widths` are those of inputs wider than one bit. `lowest` names ports whose lowest
    bit is not number 0. `parameters` are those of the top module. `styles` are the styles of the host bus by
    the level of `style_pin`; a part with one style has no such pin, one without a bus has none at all.
    `clock` is the external base clock. `unwatched` outputs run freely all the time: only tests that ask for
    them record their edges. `defaults` are the parameters of a build that names none.
    """

    name: str
    prefix: str
    inputs: Mapping[str, int]
    outputs: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    widths: Mapping[str, int] = field(default_factory=dict)
    parameters: tuple[str, ...] = ("CLK_HZ", "XTAL_HZ", "TIMING")
    styles: tuple[BusStyle, ...] = (STROBES_RD_WR,)
    clock: str = "clock"
    style_pin: str = ""
    lowest: Mapping[str, int] = field(default_factory=dict)
    unwatched: frozenset[str] = frozenset()
    defaults: Mapping[str, object] = field(default_factory=dict)

    @property
    def watched(self) -> tuple[str, ...]:
        """Outputs whose every edge a bench records, and that are compared with the golden model."""
        return tuple(name for name in self.outputs if name not in self.unwatched)

    def params(self, config: Config) -> dict[str, Any]:
        """Parameters of the top module in a build configuration: its own, and whatever that one adds."""
        added = dict(config.extra)
        return {name: v for name, v in config.params.items() if name in self.parameters or name in added}

    def reset_levels(self, params: Mapping[str, object] | None = None) -> dict[str, int]:
        """Output levels during reset under the given parameters (P104-PORT-01, P104-PHS-02)."""
        levels = {name: level for name, (_, level) in self.outputs.items()}
        if params and "PHASE_IDLE" in params:
            levels["s"] = 0x1F if int(str(params["PHASE_IDLE"])) else 0
        return levels

    def width(self, pin: str) -> int:
        """Width of an input or output in bits."""
        return self.outputs[pin][0] if pin in self.outputs else self.widths.get(pin, 1)

    def locate(self, pin: str) -> tuple[str, int | None]:
        """Port of a pin name, and the place of the bit in it; None for the port as a whole.

        Raises KeyError for a bit that the port does not have.
        """
        if "[" not in pin:
            return pin, None
        match = _BIT.match(pin)
        if not match:
            raise KeyError(f"{self.name} has no pin {pin}")
        port, place = match[1], int(match[2]) - self.lowest.get(match[1], 0)
        if not 0 <= place < self.width(port):
            raise KeyError(f"{self.name} has no pin {pin}")
        return port, place

    def style(self, pins: Mapping[str, int]) -> BusStyle:
        """Style of the host bus at these input levels."""
        return self.styles[pins[self.style_pin] if self.style_pin else 0]

    @cached_property
    def bus_pins(self) -> frozenset[str]:
        """Input pins of the host bus; on a part with none its serial line."""
        used = {pin for style in self.styles for pin in (*style.write_on, *style.read_on, style.address)}
        data = ("d_i", "sd_i") if self.styles else ("rxd",)
        return frozenset(used | {pin for pin in data if pin in self.inputs})


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
    widths={"d_i": 8, "auxi": 4},
    parameters=("CLK_HZ", "XTAL_HZ", "TIMING", "PHASE_IDLE"),
    lowest={"s": 1},
)

# Per axis, bit 1 for axis 1 and bit 2 for axis 2.
_AXIS_INPUTS = ("run", "extck", "csel", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n")

PPMC2104 = Part(
    name="ppmc2104",
    prefix="P2104",
    inputs={
        "a0": 0,
        "cs_n": 1,
        "busc": 0,
        "ds_wrs_n": 1,
        "rw_rds_n": 1,
        "d_i": 0,
        "errint_n": 1,
        **{pin: 0 if pin == "extck" else 0b11 for pin in _AXIS_INPUTS},
        "auxi": 0,
    },
    outputs={
        "d_o": (8, 0x00),
        "d_oe": (1, 0),
        "int_n": (1, 1),
        "pout_n": (2, 0b11),
        "dir": (2, 0b00),
        "hold": (2, 0b11),
        "s1_n": (5, 0x1F),
        "s2_n": (5, 0x1F),
        "auxo": (2, 0b11),
        "clk_o": (1, 0),
    },
    widths={"d_i": 8, "auxi": 2, **dict.fromkeys(_AXIS_INPUTS, 2)},
    styles=(STROBES_WRS_RDS, STROBES_DS_RW),
    style_pin="busc",
    clock="extck",
    lowest=dict.fromkeys((*_AXIS_INPUTS, "pout_n", "dir", "hold", "s1_n", "s2_n"), 1),
    unwatched=frozenset({"clk_o"}),
)

_SWITCHES = {"l1_n": 1, "l2_n": 1, "l3_n": 1, "l4_n": 1, "cnp_n": 1, "mon": 1}

STMC = Part(
    name="stmc",
    prefix="STMC",
    inputs={"ext_clk": 0, "cs_n": 1, "a0": 0, "rd_n": 1, "wr_n": 1, "d_i": 0, **_SWITCHES},
    outputs={"d_o": (8, 0x00), "d_oe": (1, 0), "int_n": (1, 1), "s": (5, 0x00), "hold": (1, 1)},
    widths={"d_i": 8},
    clock="ext_clk",
    lowest={"s": 1},
)

J105_STMC = Part(
    name="j105_stmc",
    prefix="J105",
    inputs={"sa": 0, "aen": 0, "ior_n": 1, "iow_n": 1, "sd_i": 0, **_SWITCHES},
    outputs={
        "sd_o": (8, 0x00),
        "sd_oe": (1, 0),
        "irq": (1, 0),
        "s": (5, 0x00),
        "drv": (4, 0x0),
        "hold": (1, 1),
    },
    widths={"sa": 10, "sd_i": 8},
    styles=(STROBES_ISA,),
    lowest={"s": 1, "drv": 1},
)

PPMC312 = Part(
    name="ppmc312",
    prefix="P312",
    inputs={
        "mode": 1,
        "d_i": 0,
        "rs": 0,
        "cs_n": 1,
        "we_n": 1,
        "oe_n": 1,
        "rxd": 1,
        "hsp": 0,
        "mod": 0,
        "adr": 0,
        "evt0_n": 1,
        "evt1_n": 1,
        "auxi": 0,
        "alm_n": 1,
        "end_n": 1,
        "epin": 0,
        "epdir": 0,
        "index_n": 1,
        "org_n": 1,
        "fl_n": 1,
        "bl_n": 1,
        "fhl_n": 1,
        "bhl_n": 1,
        "extck": 0,
        "run": 1,
    },
    outputs={
        "d_o": (8, 0x00),
        "d_oe": (1, 0),
        "wrq_n": (1, 1),
        "irq_n": (1, 1),
        "txd": (1, 1),
        "snd": (1, 0),
        "auxo_n": (6, 0x3F),
        "exon_n": (1, 1),
        "cclr_n": (1, 1),
        "aclr_n": (1, 1),
        "zclmp_n": (1, 1),
        "cd_n": (1, 1),
        "pout": (1, 0),
        "dir": (1, 0),
        "intlk_n": (1, 1),
        "out_oe": (1, 0),
    },
    widths={"d_i": 8, "rs": 3, "mod": 3, "adr": 4, "auxi": 8},
    styles=(STROBES_WE_OE,),
    clock="extck",
    defaults={
        "CLK_HZ": 16_000_000,
        "XTAL_HZ": 16_000_000,
        "TIMING": "FAST",
        "VERSION": 0x12,
        "SUM_MODE": "BINARY",
    },
)

PMC006 = Part(
    name="pmc006",
    prefix="P006",
    inputs={
        "rxd": 1,
        "ext1": 1,
        "ext2": 1,
        "fset_n": 1,
        "gpi": 0x1F,
        "adc_data": 0,
        "adc_valid": 0,
        "bemf_level": 0,
        "bemf_valid": 0,
        "cmp_a": 0,
        "cmp_b": 0,
        "scl_i": 1,
        "sda_i": 1,
    },
    outputs={
        "txd": (1, 1),
        "de": (1, 0),
        "ext1_pu": (1, 1),
        "ext2_pu": (1, 1),
        "gpo": (5, 0),
        "phase_a_ref": (8, 0),
        "phase_a_sign": (1, 0),
        "phase_b_ref": (8, 0),
        "phase_b_sign": (1, 0),
        "pwm_a_ref": (1, 0),
        "pwm_b_ref": (1, 0),
        "bridge_a_en": (1, 0),
        "bridge_b_en": (1, 0),
        "m10": (1, 0),
        "m11": (1, 0),
        "m20": (1, 0),
        "m21": (1, 0),
        "scl_o": (1, 0),
        "scl_oe": (1, 0),
        "sda_o": (1, 0),
        "sda_oe": (1, 0),
        "mon_step": (1, 0),
        "mon_dir": (1, 1),
        "mon_busy": (1, 0),
    },
    widths={"gpi": 5, "adc_data": 10, "bemf_level": 10},
    styles=(),
    clock="",
    unwatched=frozenset({"pwm_a_ref", "pwm_b_ref"}),
    defaults={
        "CLK_HZ": 16_000_000,
        "XTAL_HZ": 16_000_000,
        "TIMING": "FAST",
        "STEP_ACK": "MANUAL",
        "BAUD": 9600,
        "I2C_HZ": 400_000,
        "EE_DEV": 0x50,
        "T_OFF_NS": 20_000,
        "T_BLANK_NS": 1_000,
        "FW_VERSION": 0x123,
    },
)

PARTS: dict[str, Part] = {part.name: part for part in (PPMC104, PPMC2104, STMC, J105_STMC, PPMC312, PMC006)}

# Also parts whose RTL does not exist yet, so that their rule IDs already sort to the right table.
PREFIXES = {
    "P104": "ppmc104",
    "P2104": "ppmc2104",
    "STMC": "stmc",
    "J105": "stmc",
    "P312": "ppmc312",
    "P006": "pmc006",
}
