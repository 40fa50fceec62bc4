"""Timing diagrams from the golden model: levels at chosen clk edges become lines of a WaveDrom drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

Levels = Mapping[str, int]
Schedule = Sequence[tuple[int, Levels]]  # (clk edge that samples them first, pin levels), in time order
Samples = Sequence[Levels | None]  # one a column; None: many clk that are not shown

COLOURS = "345"  # WaveDrom's filled boxes, in turn


@dataclass(frozen=True)
class Row:
    """One line of a diagram: its name, the pin or flag, or a function of all of them (None: does not matter).

    `text` writes a vector's value in its box; without it the line is a single bit. `host`: driven by the
    host, so it changes half a clk before the edge that samples it. `nodes`: column -> letter for arrows.
    """

    name: str
    level: str | Callable[[Levels], int | None]
    text: Callable[[int], str] | None = None
    host: bool = False
    nodes: Mapping[int, str] = field(default_factory=dict)

    def of(self, levels: Levels) -> int | None:
        """The level in a sample."""
        return levels[self.level] if isinstance(self.level, str) else self.level(levels)


def write_cycle(edge: int, reg: int, byte: int, strobe: int = 3) -> Schedule:
    """Pins of a write whose strobe is sampled from `edge` on for so many clk."""
    return [(edge, {"cs_n": 0, "wr_n": 0, "a0": reg, "d_i": byte}), (edge + strobe, {"cs_n": 1, "wr_n": 1})]


def read_cycle(edge: int, reg: int, strobe: int = 5) -> Schedule:
    """Pins of a read whose strobe is sampled from `edge` on for so many clk."""
    return [(edge, {"cs_n": 0, "rd_n": 0, "a0": reg}), (edge + strobe, {"cs_n": 1, "rd_n": 1})]


def mailbox_flags(chip: Any) -> Levels:
    """OBF, IBF, BUSY of a part with a status register."""
    core = getattr(chip, "core", chip)
    return {"obf": core.status & 1, "ibf": core.status >> 1 & 1, "busy": int(core.busy)}


def record(
    chip: Any,
    inputs: Levels,
    schedule: Schedule,
    columns: Sequence[int | None],
    flags: Callable[[Any], Levels] = mailbox_flags,
) -> Samples:
    """Drive a model by the schedule and look at it on the edges of the columns, which must rise.

    `flags`: what there is to see besides pins.
    """
    pins, due = dict(inputs), list(schedule)
    found: list[Levels | None] = []
    for edge in columns:
        if edge is None:
            found.append(None)
            continue
        while due and due[0][0] <= edge:
            at, levels = due.pop(0)
            chip.pins(at, **levels)
            pins |= levels
        chip.run_until(edge)
        found.append({**pins, **chip.outputs, **flags(chip)})
    return found


def beside_gaps(drawn: str, data: Sequence[str]) -> list[str]:
    """The texts of the boxes, moved to the left where a gap would be drawn over them."""
    starts = [column for column, brick in enumerate(drawn) if brick in COLOURS]
    ends = [
        min((n for n in range(a + 1, len(drawn)) if drawn[n] not in ".|"), default=len(drawn)) for a in starts
    ]
    found = []
    for text, first, end in zip(data, starts, ends, strict=True):
        hit = any(abs(gap + 0.5 - (first + end) / 2) < 0.5 for gap in range(first, end) if drawn[gap] == "|")
        found.append(text + " " * 16 if hit else text)
    return found


def wave(row: Row, samples: Samples) -> dict[str, Any]:
    """WaveDrom's line of a row."""
    drawn, data = "", []
    last: object = "nothing"
    boxes = 0
    for found in samples:
        if found is None:
            drawn += "|"
            continue
        level = row.of(found)
        if level == last:
            drawn += "."
        elif level is None:
            drawn += "x"
        elif row.text is None:
            drawn += str(level)
        else:
            drawn += COLOURS[boxes % len(COLOURS)]
            boxes += 1
            data.append(row.text(level))
        last = level
    line: dict[str, Any] = {"name": row.name, "wave": drawn + ("." if row.host else "")}
    if data:
        line["data"] = beside_gaps(drawn, data)
    if row.host:
        line["phase"] = 0.5
    if row.nodes:
        line["node"] = "".join(row.nodes.get(column, ".") for column in range(len(drawn)))
    return line


def clock(samples: Samples) -> dict[str, Any]:
    """The clk of a diagram without gaps."""
    return {"name": "clk", "wave": "p" + "." * (len(samples) - 1)}


def labels(name: str, words: Sequence[str | None]) -> dict[str, Any]:
    """A line with a word in each column, a gap for None."""
    drawn = "".join("|" if word is None else "2" for word in words)
    return {"name": name, "wave": drawn, "data": [word for word in words if word is not None]}
