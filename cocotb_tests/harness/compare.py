"""Edge-by-edge comparison of a run with the golden model.

The pin changes of the run are replayed into the model; every output of both sides must then show the same
levels on the same clk edges. Only outputs forced by an asynchronous reset may be one clk apart, because
rst_n can fall between two edges. A difference gives a text report, a VCD and a PNG.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from openppmc import parts

from .part import PARTS, Part
from .stimulus import Change, Edge, Recording, by_signal

NEIGHBOURS = 8

Waves = dict[str, list[tuple[int, int]]]


@dataclass(frozen=True)
class Mismatch:
    """First difference: at edge `t` `signal` differs; the (t, value) each side shows next, if any."""

    t: int
    signal: str
    expected: tuple[int, int] | None
    actual: tuple[int, int] | None
    differing: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """Both sides of a run, ready to be reported or drawn."""

    recording: Recording
    initial: Mapping[str, int]
    expected: Waves
    actual: Waves
    mismatch: Mismatch | None

    @property
    def edges_compared(self) -> int:
        """Number of output edges of the run."""
        return sum(len(changes) for changes in self.actual.values())


def new_model(recording: Recording) -> Any:
    """Golden model of the recorded part under the recorded parameters."""
    model = parts.part(recording.part).load("model")
    return model(**{name.lower(): value for name, value in recording.params.items()})


def replay(recording: Recording, model: Any) -> list[Edge]:
    """Feed the pin changes into a model, run it to the recording's end, return its output edges.

    The model needs pins(t, **levels), run_until(t) and edges with fields t, signal, value.
    """
    for t, group in groupby(recording.stimulus, key=lambda change: change.t):
        model.pins(t, **{change.pin: change.value for change in group})
    model.run_until(recording.end)
    return [Edge(edge.t, edge.signal, edge.value) for edge in model.edges]


def compare_edges(
    expected: Iterable[Edge],
    actual: Iterable[Edge],
    initial: Mapping[str, int],
    end: int,
    resets: Iterable[int] = (),
) -> tuple[Waves, Waves, Mismatch | None]:
    """Compare two edge lists up to edge `end`.

    `initial` names the outputs to compare (no others are) with their levels before edge 0; `resets` are the
    stamps of falling rst_n. Returns both sides as changes per signal, and the first difference or None.
    """
    snap = {t - 1: t for t in resets}
    sides = []
    for edges in (expected, actual):
        kept = [
            Edge(snap.get(e.t, e.t), e.signal, e.value) for e in edges if e.t <= end and e.signal in initial
        ]
        kept.sort(key=lambda edge: edge.t)
        sides.append(by_signal(kept, initial))
    return sides[0], sides[1], _first_difference(*sides)


def _first_difference(expected: Waves, actual: Waves) -> Mismatch | None:
    found: list[Mismatch] = []
    for signal, wanted in expected.items():
        got = actual[signal]
        if wanted == got:
            continue
        place = next(
            (i for i, (a, b) in enumerate(zip(wanted, got, strict=False)) if a != b),
            min(len(wanted), len(got)),
        )
        left = wanted[place] if place < len(wanted) else None
        right = got[place] if place < len(got) else None
        t = min(side[0] for side in (left, right) if side is not None)
        found.append(Mismatch(t, signal, left, right, ()))
    if not found:
        return None
    first = min(found, key=lambda m: m.t)
    names = tuple(m.signal for m in sorted(found, key=lambda m: m.t))
    return Mismatch(first.t, first.signal, first.expected, first.actual, names)


def compare_recording(recording: Recording, model: Any | None = None) -> Comparison:
    """Replay a recording and compare every output of the part."""
    part = PARTS[recording.part]
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched}
    resets = [c.t for c in recording.stimulus if c.pin == "rst_n" and c.value == 0]
    edges = replay(recording, model if model is not None else new_model(recording))
    expected, actual, mismatch = compare_edges(edges, recording.edges, initial, recording.end, resets)
    return Comparison(recording, initial, expected, actual, mismatch)


# -------------------------------------------------------------------- report


def _merged(waves: Waves) -> list[Edge]:
    return sorted(
        (Edge(t, name, value) for name, changes in waves.items() for t, value in changes), key=lambda e: e.t
    )


def _side(title: str, waves: Waves, t: int, mark: str) -> list[str]:
    edges = _merged(waves)
    before = [edge for edge in edges if edge.t < t][-NEIGHBOURS:]
    after = [edge for edge in edges if edge.t >= t][:NEIGHBOURS]
    rows = [title]
    rows += [f"    {e.t:>9}  {e.signal:<7} {e.value:#04x}" for e in before]
    rows += [f"  {'>>' if e.signal == mark else '  '}{e.t:>9}  {e.signal:<7} {e.value:#04x}" for e in after]
    return [*rows, *(["    (no further edge)"] if not after else [])]


def _pin_rows(part: Part, changes: list[Change], t: int, count: int = 12) -> list[str]:
    pins = [c for c in changes if c.t <= t and c.pin not in part.bus_pins and c.pin != part.clock]
    rows = [f"    {c.t:>9}  {c.pin} = {c.value:#x}" for c in pins[-count:]]
    levels = [part.inputs.get(part.clock, 0), *(c.value for c in changes if c.pin == part.clock)]
    clock = [c.t for c in changes if c.pin == part.clock]
    rises = [t0 for t0, a, b in zip(clock, levels, levels[1:], strict=False) if t0 <= t and b & ~a][-6:]
    return rows + ([f"    external clock rose at {', '.join(map(str, rises))}"] if rises else [])


def report(comparison: Comparison, repro: str = "", history: int = 24) -> str:
    """Text of a mismatch: what, where, neighbourhoods of both sides, stimulus before it."""
    m, recording = comparison.mismatch, comparison.recording
    if m is None:
        return f"no difference in {comparison.edges_compared} output edges up to edge {recording.end}"

    def tell(side: tuple[int, int] | None) -> str:
        return "no further edge" if side is None else f"{side[1]:#x} at {side[0]}"

    late = [a for a in recording.accesses if a.t <= m.t]
    lines = [
        f"{recording.part}: first difference at edge {m.t}: {m.signal}: "
        f"expected {tell(m.expected)}, got {tell(m.actual)}",
        f"signals that differ somewhere, in order: {', '.join(m.differing)}",
        f"parameters: {', '.join(f'{name}={value}' for name, value in recording.params.items())}",
        *_side("golden model:", comparison.expected, m.t, m.signal),
        *_side("RTL:", comparison.actual, m.t, m.signal),
        f"pin changes before it (of {len(recording.stimulus)} in all, bus pins left out):",
        *_pin_rows(PARTS[recording.part], recording.stimulus, m.t),
        f"host accesses before it (last {min(history, len(late))} of {len(late)}):",
        *_folded_accesses(late, history),
        f"seed {recording.seed}",
    ]
    return "\n".join([*lines, *([f"repeat with: {repro}"] if repro else [])])


def _folded_accesses(accesses: list[Any], history: int) -> list[str]:
    """Accesses as text, runs of equal status polls folded into one row."""
    rows: list[tuple[Any, int]] = []
    for access in accesses:
        poll = access.kind == "CSR read" or (access.kind == "read" and access.reg == 1)
        if rows and poll and rows[-1][0][1:] == access[1:]:
            rows[-1] = (access, rows[-1][1] + 1)
        else:
            rows.append((access, 1))
    return [f"    {a}{f'  (x{count})' if count > 1 else ''}" for a, count in rows[-history:]]


def write_report(comparison: Comparison, folder: Path, repro: str = "") -> str:
    """Write compare.txt, compare.vcd, compare.png and recording.json; returns the text."""
    from .compare_draw import draw_png, write_vcd

    folder.mkdir(parents=True, exist_ok=True)
    text = report(comparison, repro)
    (folder / "compare.txt").write_text(text + "\n", encoding="utf-8")
    (folder / "recording.json").write_text(comparison.recording.to_json(), encoding="utf-8")
    write_vcd(comparison, folder / "compare.vcd")
    draw_png(comparison, folder / "compare.png")
    return text


def check_against_model(bench: Any, model: Any | None = None) -> Comparison:
    """Compare all that a bench has seen so far; AssertionError with the report at a difference.

    The files of the report go to bench.out.
    """
    comparison = compare_recording(bench.recording(), model)
    if comparison.mismatch is not None:
        raise AssertionError(write_report(comparison, bench.out, bench.repro))
    return comparison
