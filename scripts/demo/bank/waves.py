"""The VCD of the bank's demo: the host's bus, and each axis's pulse output, direction and speed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from openppmc.check.records import bit_changes
from scripts.demo import waves
from scripts.demo.scenes import pin

BUS = {"a": 10, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 8}
ANSWERS = {"d_o": 8, "d_oe": 1, "int_n": 1}
IDLE = {"a": 0, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 0}


def write(comparison: Any, pulses: Sequence[Sequence[int]], path: Path) -> None:
    """Write the VCD file.

    Args:
        pulses: edges of the pulses of each axis.
    """
    waves.write(path, _signals(comparison, pulses), comparison.recording)


def _signals(comparison: Any, pulses: Sequence[Sequence[int]]) -> Iterator[waves.Signal]:
    recording, initial, actual = comparison.recording, comparison.initial, comparison.actual
    for name, size in BUS.items():
        yield "host", name, size, IDLE[name], pin(recording.stimulus, name)
    for name, size in ANSWERS.items():
        yield "host", name, size, initial[name], actual[name]
    for axis, found in enumerate(pulses):
        for name in ("pout_n", "dir", "hold"):
            start = initial[name]
            yield f"axis{axis}", name, 1, start >> axis & 1, bit_changes(actual[name], axis, start)
        speeds = list(waves.speed_changes(found, int(recording.params["CLK_HZ"])))
        yield f"axis{axis}", "speed_pps", "real", 0.0, speeds


def views(vcd: Path, axes: int) -> None:
    """Write saved views of the host and all speeds for GTKWave and Surfer next to the VCD."""
    names = [f"host.{name}{f'[{size - 1}:0]' if size > 1 else ''}" for name, size in (BUS | ANSWERS).items()]
    speeds = [f"axis{axis}.speed_pps" for axis in range(axes)]
    lines = [f'[dumpfile] "{vcd.name}"', "[timestart] 0", "[size] 1500 900"]
    for name in names:
        lines += ["@22" if "[" in name else "@28", name]
    for name in speeds:
        lines += ["@88420", name, "@20000", "-"]
    vcd.with_suffix(".gtkw").write_text("\n".join(lines) + "\n")
    plain = [name.partition("[")[0] for name in names]
    vcd.with_suffix(".sucl").write_text(
        "\n".join([*(f"variable_add {name}" for name in plain + speeds), "zoom_fit", ""])
    )
