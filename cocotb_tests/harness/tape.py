"""Tapes: what a host did to a golden model, played on the RTL with every output compared.

A script of a synchronous host runs on the model alone, checks what it wants to check, and leaves a tape of
all pin changes and of the model's output edges. The RTL then gets the same pin changes on the same clk. As
every output must change on the same edges, what the script has checked holds for the RTL as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .bench import Bench
from .compare import leave_digest, write_report
from .comparison import Comparison, compare_edges
from .part import PARTS
from .rerun import rerun
from .stimulus import Access, Change, Edge, Recording

TAIL = 24
"""clk after the last thing that a script has done."""


class Tape:
    """Recorder on a model; `part` names it, `params` are the parameters of its top module."""

    def __init__(self, part: str, model: Any, params: dict[str, object]) -> None:
        self.part, self.model, self.params = part, model, params
        self.changes: list[Change] = []
        self.accesses: list[Access] = []
        self._levels = dict(PARTS[part].inputs)
        self._pins = model.pins
        model.pins = self._record
        for shelf in _shelves:
            shelf.append(self)

    def _record(self, t: int, **levels: int) -> None:
        self._pins(t, **levels)
        for pin, level in levels.items():
            if self._levels.get(pin, 1) != level:
                self._levels[pin] = level
                self.changes.append(Change(t, pin, level))

    def finish(self) -> int:
        """Run the model a little further than anything was done; returns its last edge."""
        last = self.changes[-1].t if self.changes else 0
        self.model.run_until(max(self.model.now, last) + TAIL)
        end: int = self.model.now
        return end


_shelves: list[list[Tape]] = []


@contextmanager
def taping() -> Iterator[list[Tape]]:
    """The tapes that are begun inside."""
    shelf: list[Tape] = []
    _shelves.append(shelf)
    try:
        yield shelf
    finally:
        _shelves.remove(shelf)


async def record(bench: Bench, tape: Tape) -> Recording:
    """Reset the part and play the tape; what was recorded, from the first edge on."""
    end = tape.finish()
    return Recording(
        part=bench.part.name,
        params=tape.params,
        seed=bench.seed,
        end=end,
        stimulus=tape.changes,
        edges=await rerun(bench, tape.changes, end),
        accesses=tape.accesses,
    )


async def play(bench: Bench, tape: Tape, what: str = "") -> Comparison:
    """Play the tape and compare; AssertionError with the report at a difference.

    `what` says what is played. The files of the report go to bench.out.
    """
    recording, part = await record(bench, tape), bench.part
    leave_digest(recording, bench.out)
    end = recording.end
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched}
    resets = [change.t for change in tape.changes if change.pin == "rst_n" and not change.value]
    edges = [Edge(edge.t, edge.signal, edge.value) for edge in tape.model.edges]
    expected, actual, mismatch = compare_edges(edges, recording.edges, initial, end, resets)
    comparison = Comparison(recording, initial, expected, actual, mismatch)
    if mismatch is not None:
        raise AssertionError(f"{what}\n{write_report(comparison, bench.out, bench.repro)}".lstrip())
    return comparison
