"""`make demo PART=ppmc104`: what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from openppmc.capture.ppmc104.words import Words104
from scripts.demo.demos import Demo, View
from scripts.ppmc104.picture import picture

VIEW = View(
    split={"s": ("s1", "s2", "s3", "s4", "s5")},
    motors={"motor": "pout_n"},
    groups=(
        (
            "host",
            (
                "host.access",
                "pins.cs_n",
                "pins.a0",
                "pins.wr_n",
                "pins.rd_n",
                "pins.d_i",
                "pins.d_o",
                "pins.d_oe",
                "pins.int_n",
            ),
        ),
        (
            "motor",
            (
                "motor.speed_pps",
                "motor.pulses",
                "pins.pout_n",
                "pins.dir",
                *(f"pins.s{n}" for n in range(1, 6)),
                "pins.hold",
            ),
        ),
        ("switches", ("pins.l1_n", "pins.l2_n", "pins.l3_n", "pins.l4_n", "pins.cnp_n", "pins.alm_n")),
    ),
)

DEMO = Demo(
    name="ppmc104",
    part="ppmc104",
    module="cocotb_tests.ppmc104.demo",
    test="demo_move",
    words=Words104(),
    picture=picture,
    view=VIEW,
    marks=("move", "limit", "rest"),
)
