"""The VCD of the bank's demo: the host's bus, and each axis's pulse output, direction and speed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from vcd import VCDWriter

from openppmc.check.records import bit_changes
from scripts.demo.waves import speed_changes

BUS = {"a": 10, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 8}
ANSWERS = {"d_o": 8, "d_oe": 1, "int_n": 1}
IDLE = {"a": 0, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 0}


def write(comparison: Any, pulses: Sequence[Sequence[int]], path: Path) -> None:
    """Write the VCD file.

    Args:
        pulses: edges of the pulses of each axis.
    """
    recording = comparison.recording
    clk_hz = int(recording.params["CLK_HZ"])
    period = round(1e12 / clk_hz)
    rows: list[tuple[int, Any, Any]] = []
    with path.open("w") as file, VCDWriter(file, timescale="1 ps", date="") as writer:
        drive = {
            name: writer.register_var("host", name, "wire", size=size, init=IDLE[name])
            for name, size in BUS.items()
        }
        rows += [(t, drive[pin], value) for t, pin, value in recording.stimulus if pin in drive]
        for name, size in ANSWERS.items():
            var = writer.register_var("host", name, "wire", size=size, init=comparison.initial[name])
            rows += [(t, var, value) for t, value in comparison.actual[name]]
        for axis, found in enumerate(pulses):
            scope = f"axis{axis}"
            for name in ("pout_n", "dir", "hold"):
                start = comparison.initial[name]
                var = writer.register_var(scope, name, "wire", size=1, init=start >> axis & 1)
                rows += [(t, var, level) for t, level in bit_changes(comparison.actual[name], axis, start)]
            speed = writer.register_var(scope, "speed_pps", "real", init=0.0)
            rows += [(t, speed, value) for t, value in speed_changes(found, clk_hz)]
        for t, var, value in sorted(rows, key=lambda row: row[0]):
            writer.change(var, max(0, t) * period, value)
        writer.close(recording.end * period)


def views(vcd: Path, axes: int) -> None:
    """Write the saved views of GTKWave and Surfer next to the VCD; they show the host, then all speeds."""
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
