"""`make demo PART=ppmc312`: what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from openppmc.capture.ppmc312.words import Words312
from scripts.demo.demos import Demo, View
from scripts.demo.scenes import register_text, rises
from scripts.ppmc312.picture import draw

VIEW = View(
    split={"auxo_n": [f"auxo{n}_n" for n in range(6)], "auxi": [f"auxi{n}" for n in range(8)]},
    motors={"motor": "pout"},
    groups=(
        (
            "host",
            (
                "host.access",
                *(f"pins.{pin}" for pin in ("cs_n", "rs", "we_n", "oe_n", "d_i", "d_o", "d_oe", "irq_n")),
            ),
        ),
        ("motor", ("motor.speed_pps", "motor.pulses", "pins.pout", "pins.dir", "pins.cd_n")),
        ("switches", tuple(f"pins.{pin}" for pin in ("evt0_n", "org_n", "fl_n", "bl_n", "run", "alm_n"))),
    ),
    pulses=rises,
    access=register_text,
)

DEMO = Demo(
    name="ppmc312",
    part="ppmc312",
    module="cocotb_tests.ppmc312.demo",
    test="demo_blocks",
    words=Words312(),
    view=VIEW,
    marks=("free", "sigmoid", "linear", "override", "return"),
    own=draw,
)
