"""Test bench of the PMC006B4: defaults of the builds. Names and levels of the pins are those of the golden
model.
"""

from __future__ import annotations

from dataclasses import replace

from cocotb_tests.harness import Part
from openppmc.model.pmc006 import pins

DEFAULTS = {
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
}

LINES = frozenset({"scl_i", "sda_i"})
STAGES = {
    "u_pins": ("fset_n", "scl_i", "sda_i", "ext2", "ext1", "gpi"),
    "u_serial.u_line": ("stage.rxd",),
    "u_serial.u_rx.u_sync": ("rxd",),
    "u_drive.u_bridge_a.u_cmp": ("cmp_a",),
    "u_drive.u_bridge_b.u_cmp": ("cmp_b",),
}

PMC006 = Part.of_model(
    "pmc006",
    pins,
    styles=(),
    clock="",
    unwatched=frozenset({"pwm_a_ref", "pwm_b_ref"}),
    defaults=DEFAULTS,
    stages=STAGES,
)
WITH_EEPROM = replace(
    PMC006,
    inputs={**{name: level for name, level in PMC006.inputs.items() if name not in LINES}, "ee_on": 0},
    outputs={**PMC006.outputs, **dict.fromkeys(LINES, (1, 1))},
    fed=LINES,
    aside=frozenset({"ee_on"}),
    stages={f"u_part.{path}": pins for path, pins in STAGES.items()},
)
"""The part and its EEPROM in one top (eeprom_bench.sv), which drives the levels of the I2C lines."""
PARTS = (PMC006,)
