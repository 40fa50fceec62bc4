"""The demo's VCD and its saved views for GTKWave and Surfer.

The VCD holds every pin as recorded at the RTL, and beside them what a reader wants to see at once: the bytes
of the host as text, the number of pulses and the speed. A dump of all inner signals for 100 ms would be half
a gigabyte.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from vcd import VCDWriter

from cocotb_tests.common.part import PARTS
from scripts.demo.picture import bit

# The view: groups of (title, signals).
GROUPS: tuple[tuple[str, tuple[str, ...]], ...] = (
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
            "pins.s1",
            "pins.s2",
            "pins.s3",
            "pins.s4",
            "pins.s5",
            "pins.hold",
        ),
    ),
    ("switches", ("pins.l1_n", "pins.l2_n", "pins.l3_n", "pins.l4_n", "pins.cnp_n", "pins.alm_n")),
)
PHASES = ("s1", "s2", "s3", "s4", "s5")
WIDTHS = {"d_i": 8, "auxi": 4}
LATEST_FALL = 2.1e-3  # s without a pulse: speed 0


def access_text(access: Any) -> str:
    """A host access as a word: C43 command, DE7 data, S04 status read, R83 data read."""
    return f"{('DC' if access.kind == 'write' else 'RS')[access.reg]}{access.byte:02X}"


def speed_changes(pulses: Sequence[int], clk_hz: int) -> Iterator[tuple[int, float]]:
    """(edge, pulses per second) changes, 0 between motions."""
    gap = round(LATEST_FALL * clk_hz)
    level = 0.0
    for first, second in zip(pulses, [*pulses[1:], pulses[-1] + gap + 1] if pulses else [], strict=True):
        speed = clk_hz / (second - first) if second - first <= gap else 0.0
        if speed != level:
            yield first, speed
            level = speed


def single_pins(outputs: Mapping[str, Sequence[tuple[int, int]]]) -> dict[str, Sequence[tuple[int, int]]]:
    """Outputs with the phase vector taken apart into s1 … s5."""
    pins: dict[str, Sequence[tuple[int, int]]] = {
        name: changes for name, changes in outputs.items() if name != "s"
    }
    return pins | {name: bit(outputs["s"], index) for index, name in enumerate(PHASES)}


def write_vcd(comparison: Any, path: Path) -> None:
    """Write all pins, the host's accesses, pulse count and speed."""
    recording = comparison.recording
    part = PARTS[recording.part]
    clk_hz = int(recording.params["CLK_HZ"])
    period = round(1e12 / clk_hz)
    pulses = [t for t, level in comparison.actual["pout_n"] if level == 0]
    rows: list[tuple[int, Any, Any]] = []
    with path.open("w") as file, VCDWriter(file, timescale="1 ps", date="") as writer:
        for pin, level in {"rst_n": 1, **part.inputs}.items():
            var = writer.register_var("pins", pin, "wire", size=WIDTHS.get(pin, 1), init=level)
            rows += [(change.t, var, change.value) for change in recording.stimulus if change.pin == pin]
        for name, changes in single_pins(comparison.actual).items():
            level = comparison.initial["s"] & 1 if name in PHASES else comparison.initial[name]
            var = writer.register_var(
                "pins", name, "wire", size=1 if name in PHASES else part.width(name), init=level
            )
            rows += [(t, var, value) for t, value in changes]
        text = writer.register_var("host", "access", "string", init="")
        rows += [(access.t, text, access_text(access)) for access in recording.accesses]
        speed = writer.register_var("motor", "speed_pps", "real", init=0.0)
        rows += [(t, speed, value) for t, value in speed_changes(pulses, clk_hz)]
        count = writer.register_var("motor", "pulses", "integer", size=32, init=0)
        rows += [(t, count, index + 1) for index, t in enumerate(pulses)]
        for t, var, value in sorted(rows, key=lambda row: row[0]):
            writer.change(var, max(0, t) * period, value)
        writer.close(max(0, recording.end) * period)


def full_names(part: str) -> Mapping[str, str]:
    """Names as the VCD declares them: vectors with their range."""
    widths = {**{name: width for name, (width, _) in PARTS[part].outputs.items()}, **WIDTHS}
    vectors = {f"pins.{name}": f"[{width - 1}:0]" for name, width in widths.items() if width > 1}
    return {name: name + vectors.get(name, "") for _, names in GROUPS for name in names}


def gtkwave(vcd: Path, target: Path, part: str, end_ps: int, marks: Sequence[int]) -> None:
    """Write a GTKWave save file: the whole run, the speed as an analog curve, marks (in ps) as A, B, …"""
    # The zoom is minus log2 of the time between two grid lines, of which the window shows some five.
    zoom = math.log2(end_ps / 5)
    names = full_names(part)
    lines = [
        f'[dumpfile] "{vcd.name}"',
        f'[savefile] "{target.name}"',
        "[timestart] 0",
        "[size] 1500 900",
        f"*-{zoom:.6f} -1 {' '.join(map(str, marks))}",
        "[sst_width] 200",
        "[signals_width] 180",
        "[sst_expanded] 1",
    ]
    for title, group in GROUPS:
        lines += ["@200", f"-{title}"]
        for name in group:
            if name == "motor.speed_pps":
                lines += ["@88420", names[name], "@20000", "-", "-", "-"]
            elif name == "motor.pulses":
                lines += ["@24", names[name]]
            elif name == "host.access":
                lines += ["@20", names[name]]
            else:
                lines += ["@22" if "[" in names[name] else "@28", names[name]]
    target.write_text("\n".join(lines) + "\n")


def surfer(target: Path) -> None:
    """Write a Surfer command file with the same signals."""
    lines = []
    for title, group in GROUPS:
        lines += [f"divider_add {title}", *(f"variable_add {name}" for name in group)]
    target.write_text("\n".join([*lines, "zoom_fit"]) + "\n")
