"""The demos: for each part what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness.config import F16, Config
from cocotb_tests.harness.stimulus import steps as phase_steps
from cocotb_tests.pmc006.story import BUILD
from openppmc.plot.motion import draw
from openppmc.plot.signals import Run
from scripts.demo.scenes import Changes, access_text, falls, frame_text, register_text, rises
from scripts.demo.words import Words
from scripts.pmc006 import picture
from scripts.pmc006.words import Words006
from scripts.ppmc104 import picture as picture104
from scripts.ppmc104.words import Words104
from scripts.ppmc312 import picture as picture312
from scripts.ppmc312.words import Words312
from scripts.ppmc2104 import picture as picture2104
from scripts.ppmc2104.words import Words2104
from scripts.stmc import picture as picture_stmc
from scripts.stmc.words import WordsStmc


@dataclass(frozen=True)
class View:
    """The VCD: `split` names the single bits of a vector, lowest first; `motors` maps a scope to the pin or
    vector in which `pulses` finds its pulses; `groups` are (title, signals) of the saved views; `access` is
    the text of a host access.
    """

    split: Mapping[str, Sequence[str]]
    motors: Mapping[str, str]
    groups: Sequence[tuple[str, Sequence[str]]]
    pulses: Callable[[Changes], list[int]] = falls
    access: Callable[[Any], str] = access_text


@dataclass(frozen=True)
class Demo:
    """One demo of PART=`name`, which is played on `part`.

    `picture` gives what the usual picture shows; `own` draws another one instead. `config`: its build.
    `marks`: chapters marked in the saved views; `motors`: names of axes in the list of moves.
    """

    name: str
    part: str
    module: str
    test: str
    words: Words
    picture: Callable[[Any, Sequence[Mapping[str, Any]]], Run] | None
    view: View
    marks: Sequence[str]
    motors: Mapping[str, str] = field(default_factory=dict)
    own: Callable[[Any, Sequence[Mapping[str, Any]], Path], None] | None = None
    config: Config = F16

    def draw(self, comparison: Any, chapters: Sequence[Mapping[str, Any]], path: Path) -> None:
        """Draw the picture of a run."""
        if self.own is not None:
            self.own(comparison, chapters, path)
        elif self.picture is not None:
            draw(self.picture(comparison, chapters), path)


VIEW_104 = View(
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

_PER_AXIS = (
    "pout_n",
    "dir",
    "hold",
    "run",
    "csel",
    "extck",
    "fl_n",
    "bl_n",
    "fhl_n",
    "bhl_n",
    "org_n",
    "alm_n",
)


def _name(port: str, axis: int) -> str:
    """Name of one axis's pin: pout_n becomes pout1_n, run becomes run1."""
    return f"{port.removesuffix('_n')}{axis}{'_n' if port.endswith('_n') else ''}"


def _axis_group(axis: int) -> tuple[str, Sequence[str]]:
    pins = [_name(port, axis) for port in ("run", "pout_n", "dir")]
    pins += [f"s{n}{axis}_n" for n in range(1, 6)]
    pins += [_name(port, axis) for port in ("hold", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n")]
    signals = [f"axis{axis}.speed_pps", f"axis{axis}.pulses", *(f"pins.{pin}" for pin in pins)]
    return f"axis {axis}", signals


VIEW_2104 = View(
    split={
        **{port: (_name(port, 1), _name(port, 2)) for port in _PER_AXIS},
        **{f"s{axis}_n": [f"s{n}{axis}_n" for n in range(1, 6)] for axis in (1, 2)},
    },
    motors={"axis1": "pout1_n", "axis2": "pout2_n"},
    groups=(
        (
            "host",
            (
                "host.access",
                *(
                    f"pins.{pin}"
                    for pin in (
                        "cs_n",
                        "a0",
                        "busc",
                        "ds_wrs_n",
                        "rw_rds_n",
                        "d_i",
                        "d_o",
                        "d_oe",
                        "int_n",
                        "errint_n",
                    )
                ),
            ),
        ),
        _axis_group(1),
        _axis_group(2),
    ),
)

_SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon")
VIEW_STMC = View(
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
    pulses=phase_steps,
)

VIEW_312 = View(
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

_BRIDGES = ("bridge_a_en", "m10", "m11", "cmp_a", "bridge_b_en", "m20", "m21", "cmp_b")
VIEW_006 = View(
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

DEMOS = {
    demo.name: demo
    for demo in (
        Demo(
            "ppmc104",
            "ppmc104",
            "cocotb_tests.ppmc104.demo",
            "demo_move",
            Words104(),
            picture104.picture,
            VIEW_104,
            ("move", "limit", "rest"),
        ),
        Demo(
            "ppmc2104",
            "ppmc2104",
            "cocotb_tests.ppmc2104.demo",
            "demo_two_axes",
            Words2104(),
            picture2104.picture,
            VIEW_2104,
            ("wait", "move", "limits", "rest"),
            {"axis1": "axis 1", "axis2": "axis 2"},
        ),
        Demo(
            "stmc",
            "j105_stmc",
            "cocotb_tests.stmc.demo",
            "demo_board",
            WordsStmc(),
            picture_stmc.picture,
            VIEW_STMC,
            ("move", "limit", "reference", "rest"),
        ),
        Demo(
            "ppmc312",
            "ppmc312",
            "cocotb_tests.ppmc312.demo",
            "demo_blocks",
            Words312(),
            None,
            VIEW_312,
            ("free", "sigmoid", "linear", "override", "return"),
            own=picture312.draw,
        ),
        Demo(
            "pmc006",
            "pmc006",
            "cocotb_tests.pmc006.demo",
            "demo_program",
            Words006(),
            None,
            VIEW_006,
            ("move4", "move16", "move32", "program"),
            own=picture.draw,
            config=BUILD,
        ),
    )
}
