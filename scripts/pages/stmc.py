"""Kinds of tables and pictures for docs/stmc/figures.yml, from the golden model of the STMC with a host."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby, pairwise
from typing import Any

from openppmc.model.motion.codes import IBF
from openppmc.model.stmc import pc104_board
from openppmc.model.stmc.commands import profile
from openppmc.model.stmc.part import Stmc
from openppmc.model.stmc.pc104_board import J105Stmc
from scripts.markdown import table
from scripts.pages.pictures.moves import Train
from scripts.pages.pictures.recorded import Start
from scripts.pages.pictures.tables import spaced

CLK_HZ = 16_000_000
INTERNAL_HZ = 12_500
FINISH = 0x80
STANDARD = (20, 5, 8)


@dataclass(frozen=True)
class Outcome:
    """Result of a motion: edges of its steps, gaps between steps in ticks, finish status, remaining steps."""

    steps: list[int]
    gaps: list[int]
    finish: int
    remaining: int


class Bench:
    """The model at 16 MHz with a polling host.

    Keywords are passed to the model.

    Attributes:
        t: next free edge.
    """

    def __init__(self, timing: str = "FAST", **parameters: object) -> None:
        self.chip = Stmc(timing=timing, **parameters)  # type: ignore[arg-type]
        self.t = 8
        self.mark = 0

    def pause(self, cycles: int) -> None:
        """Advance the model by this number of cycles."""
        self.t += cycles

    def pins(self, **levels: int) -> None:
        """Set input pins."""
        self.chip.pins(self.t, **levels)
        self.t += 1

    def write(self, reg: int, byte: int) -> int:
        """Write a byte without polling; return the first edge without the strobe."""
        edge = self.chip.write(self.t, reg, byte)
        self.t = edge + 3
        return edge

    def taken(self) -> int:
        """Wait until the last written byte is accepted; return the edge."""
        self.chip.run_until(self.t)
        if self.chip.status & IBF:
            self.until(lambda: not self.chip.status & IBF)
        self.t = self.chip.now + 1
        return self.chip.now

    def send(self, command: str) -> int:
        """Send a command and its data (hexadecimal) with polling; return the first edge without a strobe."""
        code, *data = bytes.fromhex(command)
        edge = self.write(1, code)
        for byte in data:
            self.taken()
            edge = self.write(0, byte)
        return edge

    def init(self, code: int = 0x0A, ramp: Sequence[int] = STANDARD) -> int:
        """Initialise the part; return the edge of the last byte."""
        slow, fast, steps = ramp
        return self.send(f"{code:02X} {slow:02X} {fast:02X} {steps.to_bytes(2, 'little').hex()}")

    def accepted(self) -> int:
        """Wait until bytes are accepted again; return the edge."""
        self.taken()
        self.write(1, FINISH)
        return self.taken()

    def until(self, seen: Callable[[], bool], limit: int = 1 << 34) -> int:
        """Run from event to event until `seen` is true; return the edge."""
        chip = self.chip
        chip.run_until(max(chip.now, self.t - 1))
        while not seen():
            event = chip.next_event
            if event is None or event > limit:
                raise RuntimeError("the model has no further event before the expected one")
            chip.run_until(event)
        self.t = max(self.t, chip.now + 1)
        return chip.now

    def steps(self) -> list[int]:
        """Return the edges of the steps since the edge `mark`; the chopper must be off."""
        return [t for t, _ in self.chip.log.of("s", self.mark)]

    def in_gap(self, gap: int) -> None:
        """Run to a point within the gap with number `gap` between the steps of the last motion."""
        self.until(lambda: len(self.steps()) > gap)
        self.t = self.chip.now + 300

    def start(self, command: str) -> int:
        """Send a motion command, and count steps from then on; return the edge that `send` returns."""
        self.mark = self.t
        return self.send(command)

    def end(self) -> Outcome:
        """Wait for the end of the motion; return its result."""
        self.taken()
        self.until(lambda: not self.chip.busy)
        edges = self.steps()
        tick = CLK_HZ // INTERNAL_HZ
        gaps = [round((b - a) / tick) for a, b in pairwise(edges)]
        return Outcome(edges, gaps, self.chip.finish, self.chip.remaining)


# ----------------------------------------------------------------------------------------- worked moves


def play(
    command: str, ramp: Sequence[int] = STANDARD, gap: int | None = None, event: Sequence[Any] = ()
) -> Outcome:
    """Run a move with the internal clock; return its result.

    Args:
        gap: gap in which `event` (name and arguments of a method of Bench) is executed; -1: before step 0.
    """
    bench = Bench()
    bench.init(ramp=ramp)
    bench.accepted()
    if gap == -1:
        act(bench, event)
    bench.start(command)
    if gap is not None and gap >= 0:
        bench.taken()
        bench.in_gap(gap)
        act(bench, event)
    return bench.end()


def act(bench: Bench, step: Sequence[Any]) -> None:
    """Call a method of the bench; `step` is its name and arguments."""
    name, *values = step
    if name == "pins":
        bench.pins(**values[0])
    else:
        getattr(bench, name)(*values)


def move(command: str, cause: int | None = None, shown: int | None = None, **case: Any) -> Train:
    """Return a move for a plot.

    Args:
        cause: gap in which a Stop command was sent; the plot shows a triangle there.
        shown: number of gaps to show.
    """
    if cause is None:
        return Train(play(command, **case).gaps[:shown], INTERNAL_HZ, 0)
    gaps = play(command, gap=cause, event=("write", 1, 0x41), **case).gaps
    return Train(gaps, INTERNAL_HZ, 0, cause, STANDARD[0])


def _gaps(gaps: Sequence[int], limit: int = 30) -> str:
    """Return gaps as text; `5×8` means five gaps of 8, and long lists lack their middle."""
    words = []
    for value, group in groupby(gaps):
        count = len(list(group))
        words += [f"{value}×{count}"] if count > 3 else [str(value)] * count
    if len(words) > limit:
        words = [*words[:6], "…", *words[-6:]]
    return " ".join(words) or "none"


def moves(cases: Sequence[Sequence[Any]]) -> str:
    """Return a table of worked moves.

    A row has a name, ramp and command and, if the move is disturbed, text, gap and event of the disturbance.
    """
    heads = [
        "No.",
        "D1/D2/PA",
        "Sent",
        "Disturbed by",
        "Steps",
        "Gaps in ticks",
        "Sum",
        "Finish",
        "Remaining",
    ]
    rows = []
    for name, ramp, command, *more in cases:
        text, *disturbance = more or [""]
        made = play(command, ramp, *disturbance)
        left = made.remaining.to_bytes(3, "little").hex(" ").upper()
        cells = [name, "/".join(map(str, ramp)), f"`{command}`", text, len(made.steps), _gaps(made.gaps)]
        rows.append([*cells, spaced(sum(made.gaps)), f"{made.finish:02X}", left])
    return table(heads, rows)


def ramps(ramps: Sequence[Sequence[int]], long: Sequence[int], some: Sequence[int]) -> str:
    """Return a table of divisors: short ramps at all levels, and a long ramp at some levels."""
    rows = []
    for ramp in (*ramps, long):
        values = [rate + 1 for rate in profile(*ramp).rates()]
        text = " ".join(map(str, values[:8] if ramp is long else values))
        if ramp is long:
            text += f" … {', '.join(f'x({k}) = {values[k]}' for k in some)}"
        rows.append([*ramp, text])
    return table(["D1", "D2", "PA", "x(0), x(1), … x(PA)"], rows)


# ---------------------------------------------------------------------------------------------- times


def _time(clk: int) -> str:
    """Return a time in a suitable unit."""
    micros = Fraction(clk * 1_000_000, CLK_HZ)
    if micros < 1:
        return f"{clk} cycles" if clk else "same cycle"
    if micros >= 10_000:
        return f"{float(micros / 1000):.4g} ms"
    return f"{float(micros):.4g} µs"


def motion_time(timing: str, which: str, command: str, stop: bool = False) -> int:
    """Return a time of a motion in cycles.

    Args:
        which: begin, step: time from the end of the last write until BUSY rises, or until step 0.
            end, accepted: time from the last step, or from the cause of the end (`stop`), until the end, or
            until bytes are accepted again.
    """
    bench = Bench(timing)
    bench.init()
    bench.accepted()
    sent = bench.start(command)
    begin = bench.until(lambda: bool(bench.chip.log.of("hold", bench.mark)))
    first = bench.until(lambda: len(bench.steps()) > 0)
    if stop:
        bench.in_gap(2)
        cause = bench.write(1, 0x40)
    end = bench.until(lambda: not bench.chip.busy)
    if not stop:
        cause = bench.steps()[-1]
    bench.t = max(bench.t, end + 1)
    accepted = end if timing == "FAST" else bench.accepted()
    return {"begin": begin - sent, "step": first - sent, "end": end - cause, "accepted": accepted - cause}[
        which
    ]


def init_time(timing: str, which: str, ramp: Sequence[int]) -> int:
    """Return the cycles from an initialisation's last byte until phases are on or bytes are accepted."""
    bench = Bench(timing)
    sent = bench.init(ramp=ramp)
    if which == "phases":
        return bench.until(lambda: bench.chip.outputs["s"] != 0) - sent
    return bench.accepted() - sent


def times(inits: Sequence[Sequence[Any]], motions: Sequence[Sequence[Any]]) -> str:
    """Return a table of times with both timings, at 16 MHz with the internal clock.

    Args:
        inits, motions: rows with a text and the arguments of `init_time` or `motion_time`.
    """
    measured = [(init_time, row) for row in inits] + [(motion_time, row) for row in motions]
    rows = [
        [text, *(_time(measure(timing, *values)) for timing in ("FAST", "DATASHEET"))]
        for measure, (text, *values) in measured
    ]
    return table(["From … to", "FAST", "DATASHEET"], rows)


# --------------------------------------------------------------------------------------------- diagrams


def ready(code: int = 0x0A, then: Sequence[Sequence[Any]] = (), **parameters: object) -> Start:
    """Return the model after its initialisation and the calls `then` of Bench methods."""
    bench = _ready(code, **parameters)
    for step in then:
        act(bench, step)
    return Start(bench.chip, bench.t, bench.chip.inputs)


def _ready(code: int, **parameters: object) -> Bench:
    bench = Bench(**parameters)  # type: ignore[arg-type]
    bench.init(code)
    bench.accepted()
    bench.pause(10)
    bench.chip.read(bench.t, 0)
    bench.pause(40)
    return bench


def moved(command: str, code: int = 0x0A) -> Start:
    """Return the model before the last step of a move; the edge of this step is the base of the diagram."""
    ahead = _ready(code)
    ahead.start(command)
    last = ahead.end().steps[-1]
    bench = _ready(code)
    bench.send(command)
    return Start(bench.chip, last, bench.chip.inputs)


def board() -> Start:
    """Return the model of the board."""
    return Start(J105Stmc(), 20, pc104_board.INPUTS)
