"""Block diagram of docs/pmc006/design.md."""

from __future__ import annotations

from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import svg

BOXES = {
    "line": Box(0.3, 0, "rxd, txd,\nde", "pin", 0.7, 0.5),
    "serial": Box(1.75, 0, "pmc006_serial, _frame\ndeframer, replies", "host", 1.7),
    "exec": Box(4.25, 0, "pmc006_exec\none instruction\nat a time", "part", 1.5, 0.85),
    "program": Box(6.75, 0, "pmc006_program\nuser program, keys", "part", 1.65),
    "settings": Box(4.25, 1.2, "pmc006_settings\nregisters, ranges", "part", 1.5),
    "eeprom": Box(6.75, 1.2, "pmc006_eeprom\npages, boot", "plain", 1.65),
    "i2c": Box(9.1, 1.2, "ppmc_i2c_master\n24LC32A", "plain", 1.6),
    "i2cpins": Box(10.6, 1.2, "scl, sda", "pin", 0.7, 0.4),
    "ext": Box(0.3, 2.3, "ext1, ext2,\nstall", "pin", 0.8, 0.5),
    "guard": Box(1.75, 2.3, "pmc006_ext_stop, _stall\ncauses of a stop", "motion", 1.7),
    "motion": Box(4.25, 2.3, "pmc006_motion\nplan, S-curve,\naccumulator", "motion", 1.5, 0.85),
    "position": Box(6.75, 2.85, "pmc006_position\nsteps counted", "motion", 1.65),
    "drive": Box(6.75, 2.05, "pmc006_drive\nangle, currents", "motion", 1.65),
    "bridge": Box(9.1, 2.05, "pmc006_hbridge\nchopper, both bridges", "motion", 1.6),
    "bridges": Box(10.6, 2.05, "m10 … m21,\nreferences", "pin", 0.8, 0.5),
    "cmp": Box(10.6, 2.85, "cmp_a,\ncmp_b", "pin", 0.7, 0.5),
}
ARROWS = (
    Arrow("line", "serial", both=True),
    Arrow("serial", "exec", "frames", both=True),
    Arrow("program", "exec", "instruction"),
    Arrow("exec", "settings", "writes"),
    Arrow("settings", "motion", "ramp, speed"),
    Arrow("settings", "eeprom", "saved", both=True),
    Arrow("eeprom", "i2c"),
    Arrow("i2c", "i2cpins", both=True),
    Arrow("ext", "guard"),
    Arrow("guard", "motion", "halt"),
    Arrow("motion", "drive", "step", via=((5.5, 2.15), (5.5, 2.05))),
    Arrow("motion", "position", via=((5.5, 2.45), (5.5, 2.85))),
    Arrow("drive", "bridge", "current"),
    Arrow("bridge", "bridges"),
    Arrow("cmp", "bridge", via=((9.1, 2.85),)),
)


def inside() -> bytes:
    """Draw the blocks of the PMC006B4, from its line to the bridges."""
    return svg(draw(BOXES, ARROWS, (10.4, 3.2)))


PLOTS = {"inside": inside}
