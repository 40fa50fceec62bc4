"""Timing diagrams from the golden model: levels at chosen clk edges become lines of a WaveDrom drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

Levels = Mapping[str, int]
Schedule = Sequence[tuple[int, Levels]]  # (clk edge that samples them first, pin levels), in time order
Samples = Sequence[Levels | None]  # one for each column; None: cycles that are not shown

LONG = 10_000
LETTERS = "nmk"
COLOURS = "345"  # codes of WaveDrom's filled boxes, used in turn


@dataclass(frozen=True)
class Row:
    """One line of a diagram: its name, and a pin or flag or a function of all of them (None: don't care).

    `text` returns the text in the box of a vector's value; without it, the line is a single bit.

    Attributes:
        host: True if the host drives the line, which then changes half a cycle before the edge that samples
            it.
        nodes: column -> letter for arrows.
    """

    name: str
    level: str | Callable[[Levels], int | None]
    text: Callable[[int], str] | None = None
    host: bool = False
    nodes: Mapping[int, str] = field(default_factory=dict)

    def of(self, levels: Levels) -> int | None:
        """Return the level in a sample."""
        return levels[self.level] if isinstance(self.level, str) else self.level(levels)


def write_cycle(edge: int, reg: int, byte: int, strobe: int = 3) -> Schedule:
    """Return the pins of a write whose strobe is sampled from `edge` on for `strobe` cycles."""
    return [(edge, {"cs_n": 0, "wr_n": 0, "a0": reg, "d_i": byte}), (edge + strobe, {"cs_n": 1, "wr_n": 1})]


def read_cycle(edge: int, reg: int, strobe: int = 5) -> Schedule:
    """Return the pins of a read whose strobe is sampled from `edge` on for `strobe` cycles."""
    return [(edge, {"cs_n": 0, "rd_n": 0, "a0": reg}), (edge + strobe, {"cs_n": 1, "rd_n": 1})]


def mailbox_flags(chip: Any) -> Levels:
    """Return OBF, IBF, BUSY of a part with a status register."""
    core = getattr(chip, "core", chip)
    return {"obf": core.status & 1, "ibf": core.status >> 1 & 1, "busy": int(core.busy)}


def record(
    chip: Any,
    inputs: Levels,
    schedule: Schedule,
    columns: Sequence[int | None],
    flags: Callable[[Any], Levels] = mailbox_flags,
) -> Samples:
    """Drive a model with the schedule and sample it at the edges of the columns, which must be ascending.

    Args:
        flags: function that returns further signals in addition to the pins.
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


def wave(row: Row, samples: Samples) -> dict[str, Any]:
    """Return WaveDrom's line of a row."""
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
        line["data"] = data
    if row.host:
        line["phase"] = 0.5
    if row.nodes:
        line["node"] = "".join(row.nodes.get(column, ".") for column in range(len(drawn)))
    return line


def thinned(columns: Sequence[int | None], samples: Samples, rows: Sequence[Row]) -> list[int | None]:
    """Return the columns, with a gap in place of columns between two others in which no line changes."""
    levels = [None if found is None else tuple(row.of(found) for row in rows) for found in samples]
    last = len(columns) - 1
    while last > 1 and levels[last] == levels[last - 1] == levels[last - 2]:
        last -= 1
    still = [0 < n < last and levels[n - 1] == levels[n] == levels[n + 1] for n in range(last + 1)]
    found: list[int | None] = []
    for n, column in enumerate(columns[: last + 1]):
        alone = still[n] and not (still[n - 1] or still[n + 1])
        if not still[n] or alone or column is None:
            found.append(column)
        elif found[-1] is not None:
            found.append(None)
    return found


def numbered(edges: Sequence[int | None]) -> tuple[list[str | None], str]:
    """Return the texts of edges, with a letter for a long number, and a line that explains the letters."""
    words: list[str | None] = []
    told: dict[int, str] = {}
    for edge in edges:
        if edge is None or abs(edge) < LONG:
            words.append(None if edge is None else str(edge))
            continue
        near = [other for other in edges if other is not None and abs(other - edge) < len(edges)]
        base = max(near, key=lambda other: (_zeros(other), -other))
        letter = told.setdefault(base, LETTERS[len(told)])
        words.append(letter if edge == base else f"{letter}{edge - base:+}")
    return words, ", ".join(f"{letter} = {base}" for base, letter in told.items())


def _zeros(number: int) -> int:
    """Return the number of zeros at the end."""
    text = str(number)
    return len(text) - len(text.rstrip("0"))


def table(lines: Sequence[dict[str, Any]], title: str, foot: str, arrows: Sequence[str]) -> dict[str, Any]:
    """Return a drawing of edges with large distances."""
    drawing = {"signal": list(lines), "config": {"hscale": 2}, "head": {"text": title}, "edge": list(arrows)}
    return {**drawing, "foot": {"text": foot}} if foot else drawing


def clock(samples: Samples) -> dict[str, Any]:
    """Return the line of `clk` of a diagram without gaps."""
    return {"name": "clk", "wave": "p" + "." * (len(samples) - 1)}


def labels(name: str, words: Sequence[str | None]) -> dict[str, Any]:
    """Return a line with a word in each column, a gap for None; a word may use the empty columns after it."""
    drawn, data = "", list[str]()
    for word, before in zip(words, (None, *words), strict=False):
        begins = word is not None and (word or not before)
        if begins:
            data.append(word)
        drawn += "|" if word is None else "2" if begins else "."
    return {"name": name, "wave": drawn, "data": data}
