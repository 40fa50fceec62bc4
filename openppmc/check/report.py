"""A comparison as text.

The text contains the first difference, nearby expected and actual edges, and the preceding stimulus.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .comparison import Comparison, Waves
from .draw import draw_png
from .pins import Pinned
from .records import Change, Edge
from .vcd import write_vcd

NEIGHBOURS = 8


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


def _pin_rows(part: Pinned, changes: list[Change], t: int, count: int = 12) -> list[str]:
    pins = [c for c in changes if c.t <= t and c.pin not in part.bus_pins and c.pin != part.clock]
    rows = [f"    {c.t:>9}  {c.pin} = {c.value:#x}" for c in pins[-count:]]
    levels = [part.inputs.get(part.clock, 0), *(c.value for c in changes if c.pin == part.clock)]
    clock = [c.t for c in changes if c.pin == part.clock]
    rises = [t0 for t0, a, b in zip(clock, levels, levels[1:], strict=False) if t0 <= t and b & ~a][-6:]
    return rows + ([f"    external clock rose at {', '.join(map(str, rises))}"] if rises else [])


def write_report(comparison: Comparison, folder: Path, repro: str = "") -> str:
    """Write `compare.txt`, `recording.json`, `compare.vcd` and `compare.png`; return the text.

    Raises:
        MissingExtraError: a library for the last two files is missing; the first two are written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    text = report(comparison, repro)
    (folder / "compare.txt").write_text(text + "\n", encoding="utf-8")
    (folder / "recording.json").write_text(comparison.recording.to_json(), encoding="utf-8")
    write_vcd(comparison, folder / "compare.vcd")
    draw_png(comparison, folder / "compare.png")
    return text


def report(comparison: Comparison, repro: str = "", history: int = 24) -> str:
    """Return the text of a mismatch.

    The text contains the first difference, nearby expected and actual edges, and the preceding stimulus.
    """
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
        *_side(f"{comparison.seen}:", comparison.actual, m.t, m.signal),
        f"pin changes before it (of {len(recording.stimulus)} in all, bus pins left out):",
        *_pin_rows(comparison.pins, recording.stimulus, m.t),
        f"host accesses before it (last {min(history, len(late))} of {len(late)}):",
        *_folded_accesses(late, history),
        *([f"seed {recording.seed}"] if recording.seed else []),
    ]
    return "\n".join([*lines, *([f"repeat with: {repro}"] if repro else [])])


def _folded_accesses(accesses: list[Any], history: int) -> list[str]:
    """Return accesses as text. Repeated reads of the status with the same value are one row."""
    rows: list[tuple[Any, int]] = []
    for access in accesses:
        poll = access.kind == "CSR read" or (access.kind == "read" and access.reg == 1)
        if rows and poll and rows[-1][0][1:] == access[1:]:
            rows[-1] = (access, rows[-1][1] + 1)
        else:
            rows.append((access, 1))
    return [f"    {a}{f'  (x{count})' if count > 1 else ''}" for a, count in rows[-history:]]
