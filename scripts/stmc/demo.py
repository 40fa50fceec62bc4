"""`make demo PART=stmc`: what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from openppmc.capture.stmc.words import WordsStmc
from openppmc.check.records import steps
from scripts.demo.demos import Demo, View
from scripts.stmc.picture import picture

_SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon")
VIEW = View(
    split={"s": ("s1", "s2", "s3", "s4", "s5"), "drv": ("drv1", "drv2", "drv3", "drv4")},
    motors={"motor": "s"},
    groups=(
        (
            "ISA bus",
            (
                "host.access",
                *(f"pins.{pin}" for pin in ("sa", "aen", "iow_n", "ior_n", "sd_i", "sd_o", "sd_oe", "irq")),
            ),
        ),
        (
            "motor",
            (
                "motor.speed_pps",
                "motor.pulses",
                *(f"pins.drv{n}" for n in range(1, 5)),
                "pins.hold",
            ),
        ),
        ("switches", tuple(f"pins.{pin}" for pin in _SWITCHES)),
    ),
    pulses=steps,
)

DEMO = Demo(
    name="stmc",
    part="j105_stmc",
    module="cocotb_tests.stmc.demo",
    test="demo_board",
    words=WordsStmc("FAMILY"),
    picture=picture,
    view=VIEW,
    marks=("move", "limit", "reference", "rest"),
)
