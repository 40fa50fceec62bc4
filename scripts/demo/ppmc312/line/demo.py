"""`make demo PART=ppmc312-serial`: sixteen axes on one line, each station compared with its golden model."""

from __future__ import annotations

import shutil
import time

from rich import box
from rich.table import Table

from cocotb_tests.harness.build import SimError, build
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.compare import write_report
from cocotb_tests.harness.project import BUILD, console, fail, relative
from cocotb_tests.harness.runner import run_sim
from cocotb_tests.ppmc312.line.compare import compare_line
from cocotb_tests.ppmc312.line.library import FAST_ARGS
from cocotb_tests.ppmc312.line.setting import F8L, LINE, STATIONS, design
from openppmc.check.comparison import Comparison
from scripts.demo.ppmc312.line import waves
from scripts.demo.ppmc312.line.picture import draw
from scripts.demo.ppmc312.line.talk import Exchange, LineRun, load
from scripts.demo.steps import last_line, step

NAME = "ppmc312-serial"
FOLDER = BUILD / "demo"
RUN = FOLDER / "run"
REPRO = f"make demo PART={NAME}"


def simulate() -> LineRun:
    """Build the line and run it."""
    made = step("build one station and the line with Verilator", lambda: design(F8L, FAST_ARGS))
    step("link sixteen stations", lambda: build(made))
    item = Item("cocotb_tests.ppmc312.line.demo", "demo_line", F8L, LINE.name, ())
    step(
        "drive them over the line",
        lambda: run_sim(made, item, seed=1, folder=RUN, repro=REPRO),
        lambda: last_line(RUN / "progress"),
    )
    return load(RUN)


def show_talk(run: LineRun) -> None:
    """Print one exchange of each kind, byte by byte."""
    table = Table(title="On the line", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for head, justify in (("ms", "right"), ("frame of the master", "left"), ("meaning", "left"),
                          ("reply", "left"), ("meaning", "left"), ("of these", "right")):  # fmt: skip
        table.add_column(head, justify=justify, no_wrap=head != "meaning")  # type: ignore[arg-type]
    clk_hz = int(str(run.recording.params["CLK_HZ"]))
    for chapter in run.chapters:
        inside = [one for one in run.talk if chapter["begin"] <= one.begin < chapter["end"]]
        table.add_row("", f"[bold]{chapter['title']}[/]")
        seen: dict[tuple[int, str], list[Exchange]] = {}
        for one in inside:
            seen.setdefault((one.code, one.kind), []).append(one)
        for rows in seen.values():
            one = rows[0]
            table.add_row(
                f"{one.begin * 1e3 / clk_hz:.3f}", one.sent, one.meaning, one.got, one.reply, str(len(rows))
            )
    console.print(table)


def show_axes(run: LineRun, comparisons: list[Comparison]) -> None:
    """Print, for each axis, its pulses, polls and reports, and the result of the comparison."""
    table = Table(title="Sixteen axes", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    heads = ("station", "pulse 1 / ms", "last pulse / ms", "pulses", "polls: busy", "stop reported / ms")
    for head in (*heads, "position read", "edges of the RTL", "edges of the model", "without a twin"):
        table.add_column(head, justify="right")
    clk_hz = int(str(run.recording.params["CLK_HZ"]))
    for number, comparison in enumerate(comparisons):
        pulses = [t for t, level in comparison.actual["pout"] if level]
        mine = [one for one in run.talk if one.station == number]
        stop = next((one for one in mine if one.kind == "data" and not one.code), None)
        edges = [sum(map(len, side.values())) for side in (comparison.actual, comparison.expected)]
        differing = sum(
            len(set(actual) ^ set(comparison.expected[name])) for name, actual in comparison.actual.items()
        )
        table.add_row(
            str(number),
            *(f"{pulses[end] * 1e3 / clk_hz:.3f}" if pulses else "–" for end in (0, -1)),
            str(len(pulses)),
            str(sum(one.kind == "busy" for one in mine)),
            f"{stop.end * 1e3 / clk_hz:.3f}" if stop else "–",
            str(run.positions[number]),
            *map(str, edges),
            str(differing),
            style="bold red" if differing else None,
        )
    console.print(table)


def main() -> int:
    """Run the demo; return 0 if every edge of the RTL equals that of the golden models."""
    begin = time.monotonic()
    try:
        shutil.rmtree(FOLDER, ignore_errors=True)
        run = simulate()
        comparisons = step("run sixteen golden models", lambda: compare_line(run.recording))
        saved = waves.write(run, comparisons, FOLDER / NAME)
        picture = FOLDER / "profile.png"
        step("draw the picture", lambda: draw(run, comparisons, picture))
    except SimError as error:
        return fail(str(error))
    show_talk(run)
    show_axes(run, comparisons)
    console.print(
        "Look at " + ", ".join(relative(path) for path in [picture, *saved]) + " (`make waves` opens them)"
    )
    for number, comparison in enumerate(comparisons):
        if comparison.mismatch is not None:
            write_report(comparison, FOLDER, REPRO)
            m = comparison.mismatch
            return fail(
                f"demo: RTL and golden model of station {number} differ, first at clk edge {m.t} "
                f"in {m.signal}: see {relative(FOLDER)}/compare.txt"
            )
    total = sum(comparison.edges_compared for comparison in comparisons)
    passed = run.recording.end / int(str(run.recording.params["CLK_HZ"]))
    console.print(
        f"[bold green]demo: {STATIONS} stations, {total} edges compared, 0 differences[/], "
        f"{passed * 1e3:.0f} ms on the line ({time.monotonic() - begin:.0f} s)"
    )
    return 0
