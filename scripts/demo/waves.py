"""The demo's VCD and its saved views for GTKWave and Surfer.

The VCD holds every pin as recorded at the RTL, and in addition the bytes of the host as text, the number of
pulses and the speed of each motor. It has no internal signals of the RTL, because the waveforms of all
internal signals over 100 ms would need half a gigabyte.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from vcd import VCDWriter

from cocotb_tests.harness.part import PARTS, recorded
from openppmc.capture.common.vcd_file import core_comment
from openppmc.check.records import Recording
from scripts.demo.demos import View
from scripts.demo.scenes import bit

Signal = tuple[str, str, int | str, Any, Sequence[tuple[int, Any]]]
"""Scope, name, width in bits or kind (string, real, integer), first value, changes (edge, value)."""
TEXTS = ("host.access", "line.question", "line.answer")
LATEST_FALL = 2.1e-3  # largest interval between pulses in s; above it, the speed is 0


def speed_changes(pulses: Sequence[int], clk_hz: int) -> Iterator[tuple[int, float]]:
    """Yield (edge, pulses per second) for each change of speed; between motions, the speed is 0."""
    gap = round(LATEST_FALL * clk_hz)
    level = 0.0
    for first, second in zip(pulses, [*pulses[1:], pulses[-1] + gap + 1] if pulses else [], strict=True):
        speed = clk_hz / (second - first) if second - first <= gap else 0.0
        if speed != level:
            yield first, speed
            level = speed


def single_pins(
    levels: Mapping[str, int],
    changes: Mapping[str, Sequence[tuple[int, int]]],
    split: Mapping[str, Sequence[str]],
) -> dict[str, tuple[int, Sequence[tuple[int, int]]]]:
    """Return the first level and the changes of each pin; a vector in `split` is replaced by its bits."""
    pins: dict[str, tuple[int, Sequence[tuple[int, int]]]] = {}
    for name, level in levels.items():
        for index, single in enumerate(split.get(name, ())):
            pins[single] = (level >> index & 1, bit(changes.get(name, ()), index))
        if name not in split:
            pins[name] = (level, changes.get(name, ()))
    return pins


def motor_pulses(comparison: Any, view: View) -> dict[str, list[int]]:
    """Return the edges of the pulses or steps of each motor, as recorded at the RTL, by its scope."""
    pins = single_pins(comparison.initial, comparison.actual, view.split)
    whole = comparison.actual
    return {
        scope: view.pulses(list(pins[pin][1] if pin in pins else whole[pin]))
        for scope, pin in view.motors.items()
    }


def write(path: Path, signals: Iterable[Signal], recording: Recording, comment: str = "") -> None:
    """Write a VCD with these signals of a recorded run.

    Args:
        comment: names part and parameters for `openppmc decode`, which reads the file (`core_comment`).
    """
    period = round(1e12 / int(str(recording.params["CLK_HZ"])))
    rows: list[tuple[int, Any, Any]] = []
    with path.open("w") as file, VCDWriter(file, timescale="1 ps", date="", comment=comment) as writer:
        for scope, name, kind, init, changes in signals:
            if isinstance(kind, int):
                var = writer.register_var(scope, name, "wire", size=kind, init=init)
            else:
                size = 32 if kind == "integer" else None
                var = writer.register_var(scope, name, kind, size=size, init=init)
            rows += [(t, var, value) for t, value in changes]
        for t, var, value in sorted(rows, key=lambda row: row[0]):
            writer.change(var, max(0, t) * period, value)
        writer.close(max(0, recording.end) * period)


def write_vcd(comparison: Any, view: View, path: Path) -> None:
    """Write all pins, the host's accesses, and each motor's pulse count and speed."""
    recording = comparison.recording
    comment = core_comment(recording.part, recording.params)
    write(path, _signals(comparison, view), recording, comment)


def _signals(comparison: Any, view: View) -> Iterator[Signal]:
    recording = comparison.recording
    part = recorded(recording.part, recording.params)
    driven: dict[str, list[tuple[int, int]]] = {}
    for change in recording.stimulus:
        driven.setdefault(change.pin, []).append((change.t, change.value))
    pins = single_pins({"rst_n": 1, **part.inputs}, driven, view.split)
    pins |= single_pins(comparison.initial, comparison.actual, view.split)
    for name, (level, changes) in pins.items():
        # A bit of a vector is not a port of the part.
        size = part.width(name) if name in part.inputs or name in part.outputs else 1
        yield "pins", name, size, level, changes
    yield "host", "access", "string", "", [(one.t, view.access(one)) for one in recording.accesses]
    for scope, pulses in motor_pulses(comparison, view).items():
        speeds = list(speed_changes(pulses, int(recording.params["CLK_HZ"])))
        yield scope, "speed_pps", "real", 0.0, speeds
        yield scope, "pulses", "integer", 0, [(t, index + 1) for index, t in enumerate(pulses)]


def full_names(part: str, view: View) -> Mapping[str, str]:
    """Return the names as declared in the VCD, where a vector has its range."""
    pins = PARTS[part]
    widths = {name: pins.width(name) for name in (*pins.inputs, *pins.outputs) if name not in view.split}
    vectors = {f"pins.{name}": f"[{width - 1}:0]" for name, width in widths.items() if width > 1}
    return {name: name + vectors.get(name, "") for _, names in view.groups for name in names}


def gtkwave(vcd: Path, target: Path, part: str, view: View, end_ps: int, marks: Sequence[int]) -> None:
    """Write a GTKWave save file: the whole run, speed as an analog curve, marks A, B, … at times in ps."""
    # The zoom is minus log2 of the time between two grid lines; the window shows about five grid lines.
    zoom = math.log2(end_ps / 5)
    names = full_names(part, view)
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
    for title, group in view.groups:
        lines += ["@200", f"-{title}"]
        for name in group:
            if name.endswith(".speed_pps"):
                lines += ["@88420", names[name], "@20000", "-", "-", "-"]
            elif name.endswith(".pulses"):
                lines += ["@24", names[name]]
            elif name.endswith(".position"):
                lines += ["@420", names[name]]
            elif name in TEXTS:
                lines += ["@20", names[name]]
            else:
                lines += ["@22" if "[" in names[name] else "@28", names[name]]
    target.write_text("\n".join(lines) + "\n")


def surfer(target: Path, view: View) -> None:
    """Write a Surfer command file with the same signals."""
    lines = []
    for title, group in view.groups:
        lines += [f"divider_add {title}", *(f"variable_add {name}" for name in group)]
    target.write_text("\n".join([*lines, "zoom_fit"]) + "\n")
