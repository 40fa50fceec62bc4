"""Accesses to registers in words: rows of `Words`, with their times, and whether they make sense."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from .kind import Access, Line
from .words import Words


class Said(NamedTuple):
    """An access as `Words` takes it."""

    t: int
    kind: str
    reg: int
    byte: int


class Judged(NamedTuple):
    """What a row is. strange: nothing that this part knows."""

    strange: bool = False
    initialises: bool = False
    axis: int = 0


def spoken(
    accesses: Sequence[Access],
    words: Words,
    said: Callable[[Access], Said],
    judge: Callable[[Any], Judged],
) -> list[Line]:
    """All accesses, a row a command with its answer. A row that the part's words cannot tell is strange."""
    rows = list(words.exchanges([said(one) for one in accesses]))
    found = []
    place = 0
    for number, row in enumerate(rows):
        until = rows[number + 1].t if number + 1 < len(rows) else None
        end = row.t
        while place < len(accesses) and (until is None or accesses[place].begin < until):
            one = accesses[place]
            end = one.end if one.write else end
            place += 1
        found.append(_line(row, end, judge))
    return found


def _line(row: Any, end: int, judge: Callable[[Any], Judged]) -> Line:
    data = _hex(row.sent) if row.sent else ""
    data += f" → {_hex(row.answer)}" if row.answer else ""
    if not data:
        shown = [f"{byte:02X}" for byte in row.statuses]
        data = "st " + " ".join(shown if len(shown) <= 6 else [*shown[:3], "…", *shown[-2:]])
    judged = judge(row)
    try:
        text, reply = row.meaning, row.reply
    except (IndexError, KeyError, ValueError):
        return Line(row.t, data, "cut short, or nothing that this part knows", True, end=end)
    return Line(row.t, data, f"{text} → {reply}" if reply else text, *judged[:2], end=end, axis=judged.axis)


def _hex(data: Sequence[int]) -> str:
    return " ".join(f"{byte:02X}" for byte in data)


def cycle(access: Access, levels: dict[str, int], data: str = "d_i") -> list[tuple[int, dict[str, int]]]:
    """A clean strobe for the golden model: levels at its begin, and those of its end."""
    begin = {**levels, data: access.byte} if access.write else levels
    idle = {pin: 1 for pin, level in levels.items() if pin.endswith("_n") and not level and pin != "rst_n"}
    return [(access.begin, begin), (access.end, idle)]
