"""Accesses to registers as text: the rows of a `CommandDecoder`, checked, with their times."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from .mnemonics import END_STATUS, CommandDecoder, Exchange
from .part_decoder import Access, Accesses, Line
from .signals import numpy

KNOWN = 1000
"""Largest number of rows whose texts are cached."""


class BusAccess(NamedTuple):
    """An access in the form that `CommandDecoder` accepts."""

    t: int
    kind: str
    reg: int
    byte: int


class DecodedAccess(NamedTuple):
    """Result of the check of a row.

    Attributes:
        invalid: True if the row is invalid for this part.
    """

    invalid: bool = False
    initialises: bool = False
    axis: int = 0


def decoded_lines(
    accesses: Accesses,
    decoder: CommandDecoder,
    said: Callable[[Access], BusAccess],
    judge: Callable[[Any], DecodedAccess],
) -> list[Line]:
    """Return all accesses as text, one row per command with its response.

    A row is invalid if the decoder of the part cannot describe it.
    """
    rows = decoder.exchanges(map(said, accesses))
    begin, end = accesses.begin[accesses.write], accesses.end[accesses.write]
    found = []
    place = 0
    for number, row in enumerate(rows):
        after = len(begin)
        if number + 1 < len(rows):
            after = max(place, int(begin.searchsorted(rows[number + 1].t)))
        found.append(_line(row, int(end[after - 1]) if after > place else row.t, judge))
        place = after
    return found


def decoded_byte_lines(
    accesses: Accesses, decoder: CommandDecoder, judge: Callable[[Any], DecodedAccess]
) -> list[Line]:
    """Return all accesses as text, from columns.

    This function supports parts with commands and status in register 1 and data in register 0. It returns the
    same rows as `exchanges`, but computes them from columns.
    """
    np = numpy()
    accesses = accesses.without_polls(1)
    if not len(accesses):
        return []
    row = np.cumsum(accesses.write & (accesses.reg == 1))
    row -= row[0]
    # These columns contain the bytes of each row: bytes sent, status bytes, responses.
    sort = 3 * row + np.where(accesses.write, 0, 2 - accesses.reg)
    content = accesses.byte.astype(np.uint8)[np.argsort(sort, kind="stable")].tobytes()
    bounds = [0, *np.cumsum(np.bincount(sort, minlength=3 * int(row[-1]) + 3)).tolist()]
    begin = accesses.begin[np.flatnonzero(np.diff(row, prepend=-1))]
    end = begin.copy()
    end[row[accesses.write]] = accesses.end[accesses.write]
    stopped: dict[int, bool] = {}
    known: dict[Any, Line] = {}
    found = []
    for number, (t, over) in enumerate(zip(begin.tolist(), end.tolist(), strict=True)):
        sent, polls, answer = (
            content[bounds[place] : bounds[place + 1]] for place in range(3 * number, 3 * number + 3)
        )
        axis = decoder.axis(sent[0]) if sent else 0
        key = (sent, polls, answer, stopped.get(axis, False))
        line = known.get(key)
        if line is None:
            one = Exchange(decoder, t, list(sent), list(answer), list(polls), key[3])
            line = _line(one, over, judge)
            if len(known) < KNOWN:
                known[key] = line
        if answer and sent and sent[0] & ~axis == END_STATUS:
            stopped[axis] = bool(answer[-1] & 0x78)
        found.append(Line(t, *line[1:5], over, line.axis))
    return found


def _line(row: Any, end: int, judge: Callable[[Any], DecodedAccess]) -> Line:
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
    """Return an access as one strobe without glitches for the golden model.

    The result contains the levels of the pins from the beginning of the strobe on, and from its end on.
    """
    begin = {**levels, data: access.byte} if access.write else levels
    idle = {pin: 1 for pin, level in levels.items() if pin.endswith("_n") and not level and pin != "rst_n"}
    return [(access.begin, begin), (access.end, idle)]
