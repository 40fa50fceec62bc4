"""`make demo PART=ppmc2104`: what is played, in which words, and how its waves and picture look."""

from __future__ import annotations

from collections.abc import Sequence

from openppmc.capture.ppmc2104.words import Words2104
from scripts.demo.demos import Demo, View
from scripts.ppmc2104.picture import picture

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


VIEW = View(
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

DEMO = Demo(
    name="ppmc2104",
    part="ppmc2104",
    module="cocotb_tests.ppmc2104.demo",
    test="demo_two_axes",
    words=Words2104(),
    picture=picture,
    view=VIEW,
    marks=("wait", "move", "limits", "rest"),
    motors={"axis1": "axis 1", "axis2": "axis 2"},
)
