"""Timing diagrams from the golden model: WaveDrom drawings of the levels at chosen clock edges."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from scripts.pages.pictures.kinds import made

Levels = Mapping[str, int]
Schedule = Sequence[tuple[int, Levels]]  # (first edge that samples the levels, levels), in order of time
Samples = Sequence[Levels | None]  # one sample for each column; None represents cycles that are not shown

LEVEL = re.compile(r"(\w+)(?: while (\w+) = (\w+))?")
LONG = 10_000
LETTERS = "nmk"
COLOURS = "345"  # codes of WaveDrom's filled boxes; successive boxes use them in turn


@dataclass(frozen=True)
class Row:
    """One line of a diagram: its name, and a pin, a flag or a function of all levels (None: don't care).

    `text` returns the text in the box of a vector's value; without `text`, the line is a single bit.

    Attributes:
        host: True if the host drives the line. It is then drawn half a cycle before the edge that samples it.
        nodes: letter at each column where an arrow begins or ends.
    """

    name: str
    level: str | Callable[[Levels], int | None]
    text: Callable[[int], str] | None = None
    host: bool = False
    nodes: Mapping[int, str] = field(default_factory=dict)

    def of(self, levels: Levels) -> int | None:
        """Return the level of this line in a sample."""
        return levels[self.level] if isinstance(self.level, str) else self.level(levels)


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
    """Drive a model with the schedule, and return its samples at the edges of the columns.

    The edges must be ascending.

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
    """Return the columns, with a gap in place of columns in which no line changes."""
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
    """Return the texts of the edges, with letters for long numbers, and a line that explains the letters."""
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
    """Return the number of zeros at the end of a decimal number."""
    text = str(number)
    return len(text) - len(text.rstrip("0"))


def labels(name: str, words: Sequence[str | None]) -> dict[str, Any]:
    """Return a line with the word of each column (None: a gap). A word covers empty columns after it."""
    drawn, data = "", list[str]()
    for word, before in zip(words, (None, *words), strict=False):
        begins = word is not None and (word or not before)
        if begins:
            data.append(word)
        drawn += "|" if word is None else "2" if begins else "."
    return {"name": name, "wave": drawn, "data": data}


@dataclass(frozen=True)
class Start:
    """Start of a diagram: a golden model, and the edge from which the diagram counts.

    Attributes:
        base: edge from which columns and actions are counted.
        inputs: levels of the input pins of the model.
        write, read, register: pins of the bus: write strobe, read strobe, register select.
    """

    model: Any
    base: int
    inputs: Levels
    write: str = "wr_n"
    read: str = "rd_n"
    register: str = "a0"
    clk_hz: int = 16_000_000
    flags: Callable[[Any], Levels] = mailbox_flags

    def action(self, edge: int, what: str, *values: Any) -> Schedule:
        """Return the pin changes of an action; see the argument `do` of `diagram`."""
        at = self.base + edge
        if what == "pins":
            return [(at, values[0])]
        strobe, length, data = self.read, 5, {}
        if what == "write":
            strobe, length, data = self.write, 3, {"d_i": values[1]}
        length = values[2] if len(values) > 2 else length
        levels = {"cs_n": 0, strobe: 0, self.register: values[0], **data}
        return [(at, levels), (at + length, {"cs_n": 1, strobe: 1})]


def level(text: str) -> Callable[[Levels], int | None]:
    """Return the function for "pin" or "pin while other = value"; its result is None at another value."""
    found = LEVEL.fullmatch(text)
    if found is None:
        raise ValueError(f"{text}: write `pin` or `pin while other = value`")
    pin, other, value = found.groups()
    return lambda levels: levels[pin] if other is None or levels[other] == int(value, 0) else None


def lettered(row: Row, samples: Samples, letters: str) -> Row:
    """Return the row with one letter at each of its changes, for arrows; a full stop means no letter."""
    levels = [None if found is None else row.of(found) for found in samples]
    changes, last = [], next(found for found in levels if found is not None)
    for column, found in enumerate(samples):
        if found is not None and levels[column] != last:
            changes.append(column)
            last = levels[column]
    nodes = {column: letter for column, letter in zip(changes, letters, strict=False) if letter != "."}
    return replace(row, nodes=nodes)


def lane(entry: Mapping[str, Any], samples: Samples, host: bool = False) -> dict[str, Any]:
    """Return WaveDrom's line for an entry of `rows`; an entry with a `wave` is already complete."""
    if "wave" in entry:
        return dict(entry)
    text = entry["text"].format if "text" in entry else None
    name = entry.get("name", entry["level"])
    row = Row(name, level(entry["level"]), text, entry.get("host", host), entry.get("nodes", {}))
    return wave(lettered(row, samples, entry["letters"]) if "letters" in entry else row, samples)


def columns_of(text: str) -> list[int | None]:
    """Return the columns in a text of edges, ranges of edges (first..last), and | for a gap."""
    found: list[int | None] = []
    for word in text.split():
        first, _, last = word.partition("..")
        found += [None] if word == "|" else range(int(first), int(last or first) + 1)
    return found


def diagram(
    begin: dict[str, Any],
    columns: str,
    rows: Any,
    title: str,
    do: Sequence[Sequence[Any]] = (),
    time: str = "clk edge",
    tick: int | None = None,
    foot: str = "",
    arrows: Sequence[str] = (),
    hides: bool = False,
) -> dict[str, Any]:
    """Return a timing diagram that is recorded on a golden model; edges are counted from the base of `begin`.

    Args:
        begin: `kind` that returns the Start, and its arguments.
        columns: edges to show, in the form that `columns_of` reads.
        rows: entries with `level` (see `level`), `name`, `text` (format of a vector's value), `host` (see
            Row), and `letters` at its changes or `nodes` (column -> letter); or name of a group -> entries.
        do: actions, each with its edge. An action is a write with register, byte and cycles of the strobe, a
            read with register and cycles of the strobe, or pins with levels.
        time: first line: "clk edge" or "us" for numbers, "clk" for the clock.
        tick: number of the first edge, if edges are numbered above the columns.
        foot: text below a diagram with time = clk.
        hides: True if lines may change in a gap, which hides these changes.

    Raises:
        ValueError: a line changes in a gap.
    """
    start: Start = made(begin)
    shown = columns_of(columns)
    schedule = [change for action in do for change in start.action(*action)]
    groups = rows if isinstance(rows, dict) else {"": rows}
    # For a gap, sample the edge before the next column, to find changes that the gap would hide.
    at = [start.base + (shown[n + 1] - 1 if edge is None else edge) for n, edge in enumerate(shown)]
    found = record(start.model, start.inputs, schedule, at, start.flags)
    gaps = [] if hides else [n for n, edge in enumerate(shown) if edge is None]
    for entry in (entry for part in groups.values() for entry in part if "wave" not in entry):
        of = level(entry["level"])
        if hidden := [shown[n + 1] for n in gaps if of(found[n - 1]) != of(found[n])]:
            raise ValueError(f"{entry['level']} changes in the gap before edge {hidden[0]}")
    samples = [None if edge is None else sample for edge, sample in zip(shown, found, strict=True)]
    if time == "clk":
        lines: list[Any] = [{"name": "clk", "wave": "p" + "." * (len(samples) - 1)}]
    elif time == "us":
        mhz = start.clk_hz / 1_000_000
        lines = [labels(time, [e if e is None else "" if e < 0 else f"{e / mhz:.1f}" for e in shown])]
    else:
        words, foot = numbered(shown)
        lines = [labels(time, words)]
    for name, part in groups.items():
        drawn = [lane(entry, samples, name == "host") for entry in part]
        lines += [[name, *drawn]] if name else drawn
    drawing = {"signal": lines, "head": {"text": title}, "edge": list(arrows)}
    if tick is not None:
        drawing["head"]["tick"] = tick
    if time != "clk":
        drawing["config"] = {"hscale": 2}
    return {**drawing, "foot": {"text": foot}} if foot else drawing
