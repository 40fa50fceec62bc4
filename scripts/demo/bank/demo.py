"""`make demo PART=bank`: start 32 axes with 32 different ramps by one GO, and check every edge.

The host runs on the golden model first. The Verilated RTL then receives the same pin changes. Its edges are
compared with those of the golden model, and its pulses with a prediction.
"""

from __future__ import annotations

import shutil
import time
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

from rich import box
from rich.table import Table

from cocotb_tests.harness.build import Design, SimError
from cocotb_tests.harness.part import Part
from cocotb_tests.harness.project import (
    BUILD,
    ProjectError,
    console,
    fail,
    include_dirs,
    part,
    relative,
    sources,
)
from openppmc.check.comparison import Comparison, compare_edges
from openppmc.check.records import Recording, bit_changes
from openppmc.model.bank import group
from openppmc.model.bank.window import GO
from scripts.demo.bank import waves
from scripts.demo.bank.moves import AXES, CLK_HZ, INIT, ORDERS, Order
from scripts.demo.bank.picture import draw
from scripts.demo.bank.session import READ_FINISH, Session
from scripts.demo.steps import step
from scripts.fpga.flow import plain_sim

NAME = "bank"
FOLDER = BUILD / "demo"
REST = 2000  # number of cycles that the demo records after the last access
PINS = SimpleNamespace(INPUTS=group.inputs(AXES), OUTPUTS=group.outputs(AXES, 1), WIDTHS=group.widths(AXES))
TABLE = Part.of_model(NAME, PINS, parameters=("AXES", "CLK_HZ"), clock="")


@dataclass(frozen=True)
class Played:
    """Result of the host session.

    Attributes:
        go: edge of the write event of GO.
        ends: finish status and position of each axis.
    """

    session: Session
    go: int
    ends: list[tuple[int, int]]

    @property
    def first(self) -> int:
        """Edge at which all axes output their first pulse (BANK-GRP-02)."""
        model = self.session.model
        return self.go + 4 + model.round + model.timebase.w


def play() -> Played:
    """Run the host: initialise all axes, load a move into each, send GO, read the results of all axes."""
    host = Session(AXES, CLK_HZ)
    for one in ORDERS:
        host.send(one.axis, INIT, *one.ramp)
    for one in ORDERS:
        host.poll(one.axis)
    host.group((1 << AXES) - 1)
    for one in ORDERS:
        host.send(one.axis, one.code, *one.distance)
    host.t += 1000
    go = host.write(0, GO, 0)
    ends = []
    for one in ORDERS:
        host.idle(one.axis)
        ends.append((host.answer(one.axis, READ_FINISH), host.position(one.axis)))
    host.run(host.t + REST)
    return Played(host, go, ends)


def build() -> Path:
    """Build the Verilated RTL and return its program."""
    row = part(NAME)
    design = Design(row.top, sources(row), include_dirs(), {"AXES": AXES, "CLK_HZ": CLK_HZ})
    return plain_sim.build(design, BUILD / "plain" / NAME, TABLE)


def simulate(program: Path, played: Played) -> Comparison:
    """Apply the host's pin changes to the RTL; compare all output edges with those of the golden model."""
    model = played.session.model
    recording = Recording(NAME, {"AXES": AXES, "CLK_HZ": CLK_HZ}, end=model.now, stimulus=model.stimulus)
    recording.edges = plain_sim.play(program, recording, TABLE)
    initial = TABLE.reset_levels()
    expected, actual, mismatch = compare_edges(model.edges, recording.edges, initial, recording.end)
    return Comparison(recording, initial, expected, actual, mismatch, TABLE)


def trains(comparison: Comparison) -> list[list[int]]:
    """Return the pulse edges of each axis of the RTL."""
    changes = comparison.actual["pout_n"]
    return [
        [t for t, level in bit_changes(changes, axis, comparison.initial["pout_n"]) if not level]
        for axis in range(AXES)
    ]


def wrong(one: Order, pulses: list[int], played: Played) -> str:
    """Return the first deviation of an axis from the prediction as text, or ""."""
    status, position = played.ends[one.axis]
    if len(pulses) != one.pulses:
        return f"{len(pulses)} pulses, not {one.pulses}"
    if pulses[0] != played.first:
        return f"pulse 1 on edge {pulses[0]}, not {played.first}"
    expected = [played.first + t for t in one.predicted().clk]
    if pulses != expected:
        number = next(i for i, (a, b) in enumerate(zip(pulses, expected, strict=True)) if a != b)
        return f"pulse {number + 1} on edge {pulses[number]}, predicted for {expected[number]}"
    if status != 0x83 or position != one.signed:
        return f"finish status {status:02X}, position {position}"
    return ""


def show(pulses: list[list[int]], played: Played, faults: dict[int, str]) -> None:
    """Print one line for each axis."""
    table = Table(title="32 axes, one GO", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for head in ("axis", "RL", "RH", "PA", "pulses", "top / kpps", "pulse 1 after GO / cycles", "last / ms"):
        table.add_column(head, justify="right")
    table.add_column("finish status", justify="right")
    table.add_column("position read", justify="right")
    table.add_column("compared with the prediction")
    for one, found, (status, position) in zip(ORDERS, pulses, played.ends, strict=True):
        gap = min((b - a for a, b in zip(found, found[1:], strict=False)), default=0)
        table.add_row(
            *map(str, (one.axis, one.rl, one.rh, one.pa, len(found))),
            f"{CLK_HZ / gap / 1e3:.1f}" if gap else "–",
            str(found[0] - played.go) if found else "–",
            f"{(found[-1] - played.go) * 1e3 / CLK_HZ:.3f}" if found else "–",
            f"{status:02X}",
            str(position),
            faults.get(one.axis, "equal in every cycle"),
            style="bold red" if one.axis in faults else None,
        )
    console.print(table)


def main() -> int:
    """Run the demo; return 0 if all edges equal the golden model's and all profiles equal the prediction."""
    begin = time.monotonic()
    picture, vcd = FOLDER / "profile.png", FOLDER / f"{NAME}.vcd"
    try:
        shutil.rmtree(FOLDER, ignore_errors=True)
        program = step("build the RTL with Verilator", build)
        played = step("run a host of 32 axes on the golden model", play)
        comparison = step("apply the same pin changes to the RTL", lambda: simulate(program, played))
        pulses = trains(comparison)
        faults = {one.axis: text for one in ORDERS if (text := wrong(one, pulses[one.axis], played))}
        FOLDER.mkdir(parents=True, exist_ok=True)
        waves.write(comparison, pulses, vcd)
        waves.views(vcd, AXES)
        step("draw the picture", lambda: draw(comparison, pulses, played.first, picture))
    except (SimError, ProjectError) as error:
        return fail(str(error))
    show(pulses, played, faults)
    firsts = {found[0] for found in pulses if found}
    skew = max(firsts) - min(firsts) if firsts else 0
    console.print(f"first pulses of {AXES} axes: on {len(firsts)} edge(s), skew [bold]{skew} cycles[/]")
    console.print(f"Look at {relative(picture)}, {relative(vcd)} (`make waves` opens it)")
    if comparison.mismatch is not None:
        m = comparison.mismatch
        return fail(f"demo: RTL and golden model differ, first at clk edge {m.t} in {m.signal}")
    if faults:
        axis, text = next(iter(faults.items()))
        return fail(f"demo: axis {axis}: {text} ({len(faults)} of {AXES} axes not as predicted)")
    console.print(
        f"[bold green]demo: {AXES} axes, {comparison.edges_compared} edges compared, 0 differences[/] "
        f"({time.monotonic() - begin:.0f} s)"
    )
    return 0
