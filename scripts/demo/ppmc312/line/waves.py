"""VCD and saved views of the line: who sends, and each station's pins, position and speed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

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
    recording, part = run.recording, comparisons[0].recording
    comment = core_comment("ppmc312-serial", part.params)
    waves.write(vcd, _signals(run, comparisons), recording, comment)
    period = round(1e12 / int(str(recording.params["CLK_HZ"])))
    marks = [chapter["begin"] * period for chapter in run.chapters]
    shown = view(len(comparisons))
    waves.gtkwave(vcd, gtkw, part.part, shown, recording.end * period, marks)
    waves.surfer(sucl, shown)
    return [vcd, gtkw, sucl]


def _signals(run: LineRun, comparisons: list[Comparison]) -> Iterator[waves.Signal]:
    stimulus, edges = run.recording.stimulus, run.recording.edges
    clk_hz = int(str(run.recording.params["CLK_HZ"]))
    first = {**LINE.inputs, **{change.pin: change.value for change in stimulus if change.t == 0}}
    yield "line", "master", 1, 1, pin(stimulus, "master")
    yield "line", "line", 1, 1, [(edge.t, edge.value) for edge in edges if edge.signal == "line"]
    asked = [((one.begin, one.meaning), (one.sent_end, "")) for one in run.talk]
    answered = [((one.replied, one.reply), (one.end, "")) for one in run.talk if one.answer]
    for name, said in (("question", asked), ("answer", answered)):
        yield "line", name, "string", "", [change for changes in said for change in changes]
    for number, comparison in enumerate(comparisons):
        scope, own = f"station{number}", comparison.recording.stimulus
        for name in PINS:
            yield scope, name, 1, comparison.initial[name], comparison.actual[name]
        levels = straps(first, number)
        for name in [*STRAPS, *sorted({change.pin for change in own} | {"rxd"})]:
            yield scope, name, STRAPS.get(name, 1), levels.get(name, 1), pin(own, name)
        pulses = [t for t, level in comparison.actual["pout"] if level]
        yield scope, "speed_pps", "real", 0.0, list(waves.speed_changes(pulses, clk_hz))
        yield scope, "position", "integer", 0, positions(comparison)
