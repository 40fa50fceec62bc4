"""`make demo PART=pmc006`: what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from cocotb_tests.pmc006.story import BUILD
from openppmc.capture.pmc006.words import Words006
from scripts.demo.demos import Demo, View
from scripts.demo.scenes import frame_text, rises
from scripts.pmc006.picture import draw

_BRIDGES = ("bridge_a_en", "m10", "m11", "cmp_a", "bridge_b_en", "m20", "m21", "cmp_b")
VIEW = View(
    split={"gpo": [f"gpo{n}" for n in range(1, 6)], "gpi": [f"gpi{n}" for n in range(1, 6)]},
    motors={"motor": "mon_step"},
    groups=(
        ("line", ("host.access", "pins.rxd", "pins.txd", "pins.de")),
        ("motor", ("motor.speed_pps", "motor.pulses", "pins.mon_step", "pins.mon_dir", "pins.mon_busy")),
        ("currents", tuple(f"pins.phase_{phase}_{what}" for phase in "ab" for what in ("ref", "sign"))),
        ("bridges", tuple(f"pins.{pin}" for pin in _BRIDGES)),
        ("ports", ("pins.ext1", "pins.gpo1", "pins.gpo2")),
    ),
    pulses=rises,
    access=frame_text,
)

DEMO = Demo(
    name="pmc006",
    part="pmc006",
    module="cocotb_tests.pmc006.demo",
    test="demo_program",
    words=Words006(),
    view=VIEW,
    marks=("move4", "move16", "move32", "program"),
    own=draw,
    config=BUILD,
)
