"""VCD and saved views of the line: who sends, and each station's pins, position and speed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from vcd import VCDWriter

from cocotb_tests.ppmc312.line.models import straps
from cocotb_tests.ppmc312.line.setting import LINE
from openppmc.capture.common.vcd_file import core_comment
from openppmc.check.comparison import Comparison
from scripts.demo import waves
from scripts.demo.demos import View
from scripts.demo.ppmc312.line.talk import LineRun
from scripts.demo.scenes import pin

PINS = ("txd", "snd", "pout", "dir", "cd_n")
STRAPS = {"adr": 4, "mod": 3}
"""Strap pins of a station, with their numbers of bits."""
MOVING = ("speed_pps", "position")


def positions(comparison: Comparison) -> list[tuple[int, int]]:
    """Return (edge of the pulse, position after it) for each pulse."""
    turns = [(t, 2, level) for t, level in comparison.actual["dir"]]
    pulses = [(t, 1, level) for t, level in comparison.actual["pout"] if level]
    where, sign, rows = 0, 1, []
    for t, kind, level in sorted(turns + pulses):
        if kind == 2:
            sign = -1 if level else 1
        else:
            where += sign
            rows.append((t, where))
    return rows


def view(stations: int) -> View:
    """Return the groups of signals in the saved views: the line, then each station."""
    groups = [("line", ("line.master", "line.line", "line.question", "line.answer"))]
    groups += [
        (f"station {n}", tuple(f"station{n}.{name}" for name in (*MOVING, *PINS))) for n in range(stations)
    ]
    return View({}, {}, groups)


def write(run: LineRun, comparisons: list[Comparison], stem: Path) -> list[Path]:
    """Write the VCD and the saved views for GTKWave and Surfer, with this file stem; return their paths."""
    vcd, gtkw, sucl = (stem.with_suffix(suffix) for suffix in (".vcd", ".gtkw", ".sucl"))
    recording = run.recording
    clk_hz = int(str(recording.params["CLK_HZ"]))
    period = round(1e12 / clk_hz)
    first = {**LINE.inputs, **{change.pin: change.value for change in recording.stimulus if change.t == 0}}
    comment = core_comment("ppmc312-serial", comparisons[0].recording.params)
    rows: list[tuple[int, Any, Any]] = []
    with vcd.open("w") as file, VCDWriter(file, timescale="1 ps", date="", comment=comment) as writer:
        for name, changes in (
            ("master", pin(recording.stimulus, "master")),
            ("line", [(edge.t, edge.value) for edge in recording.edges if edge.signal == "line"]),
        ):
            var = writer.register_var("line", name, "wire", size=1, init=1)
            rows += [(t, var, level) for t, level in changes]
        for name, said in (
            ("question", [(one.begin, one.sent_end, one.meaning) for one in run.talk]),
            ("answer", [(one.replied, one.end, one.reply) for one in run.talk if one.answer]),
        ):
            var = writer.register_var("line", name, "string", init="")
            rows += [row for begin, end, text in said for row in ((begin, var, text), (end, var, ""))]
        for number, comparison in enumerate(comparisons):
            scope = f"station{number}"
            for name in PINS:
                var = writer.register_var(scope, name, "wire", size=1, init=comparison.initial[name])
                rows += [(t, var, level) for t, level in comparison.actual[name]]
            levels = straps(first, number)
            heard = {change.pin for change in comparison.recording.stimulus} | {"rxd"}
            for name in [*STRAPS, *sorted(heard)]:
                size, level = STRAPS.get(name, 1), levels.get(name, 1)
                var = writer.register_var(scope, name, "wire", size=size, init=level)
                rows += [(t, var, now) for t, now in pin(comparison.recording.stimulus, name)]
            var = writer.register_var(scope, "speed_pps", "real", init=0.0)
            pulses = [t for t, level in comparison.actual["pout"] if level]
            rows += [(t, var, value) for t, value in waves.speed_changes(pulses, clk_hz)]
            var = writer.register_var(scope, "position", "integer", size=32, init=0)
            rows += [(t, var, value) for t, value in positions(comparison)]
        for t, var, value in sorted(rows, key=lambda row: row[0]):
            writer.change(var, max(0, t) * period, value)
        writer.close(max(0, recording.end) * period)
    marks = [chapter["begin"] * period for chapter in run.chapters]
    shown = view(len(comparisons))
    waves.gtkwave(vcd, gtkw, recording_part(comparisons), shown, recording.end * period, marks)
    waves.surfer(sucl, shown)
    return [vcd, gtkw, sucl]


def recording_part(comparisons: list[Comparison]) -> str:
    """Return the name of the part in each station."""
    return comparisons[0].recording.part
