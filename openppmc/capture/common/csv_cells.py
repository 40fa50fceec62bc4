"""Single cells of a capture in CSV: times, levels, column headings."""

from __future__ import annotations

import csv
import re
from datetime import datetime, timezone
from fractions import Fraction
from functools import lru_cache

from .rates import unit
from .signals import SECOND

LEVELS = {"0": 0, "1": 1, "L": 0, "l": 0, "H": 1, "h": 1, "low": 0, "high": 1, "false": 0, "true": 1}
LEVELS |= dict.fromkeys(("", "x", "X", "z", "Z", "u", "U", "w", "W", "-", "?", "n/a", "nan", "NaN"), 2)
_TIME = re.compile(
    r"(time|zeit|temps|tiempo|tempo|timestamp|time ?stamp|t"
    r"|(?:milli|micro|nano|pico|femto|atto)?seconds?|[munpfµμ]?s)"
    r"(?:(?:[\s_/]+|(?=[\[(]))[\[(]?\s*([^\W\d]+)\s*[\])]?)?",
    re.I,
)
_SAMPLES = re.compile(r"samples?|sample[ _]?(number|index|no\.?)|index|nr\.?|no\.?|ticks?", re.I)
_ISO = re.compile(
    r"(?P<day>\d{4}-\d\d-\d\d)[T ](?P<second>\d\d:\d\d:\d\d)(?:[.,](?P<part>\d+))?\s*"
    r"(?P<zone>Z|[+-]\d\d:?\d\d)?"
)
_CLOCK = re.compile(r"(?P<second>\d+:\d\d:\d\d)(?:[.,](?P<part>\d+))?(?P<zone>)")
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*([^\W\d]*)", re.I)
_SIGROK = {1: 12, 1000: 9, 10**6: 6, 10**9: 3, 10**12: 0}
"""Unit in which sigrok writes times.

A key is the highest sample rate in Hz at which sigrok uses the unit 10**n ps, its value is n.
"""


def text_of(data: bytes) -> str:
    """Decode bytes as UTF-8, or as Latin-1 if they are not valid UTF-8."""
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data.decode("latin-1")


def cells_of(line: str, separator: str) -> list[str]:
    """Return the cells of a line. A line that contains a very long cell is returned as one cell."""
    try:
        return [cell.strip() for cell in next(csv.reader([line.rstrip("\r\n")], delimiter=separator), [])]
    except csv.Error:
        return [line.strip()]


def time_of(text: str, separator: str) -> tuple[Fraction, bool] | None:
    """Return (time or sample number, True if it is a time in ps). The result is `None` for other text."""
    text = text.strip().strip('"')
    if separator != ",":
        text = text.replace(",", ".")
    if len(text) > 60:
        return None
    match = _NUMBER.fullmatch(text)
    if match:
        exponent = match[1].lower().partition("e")[2]
        if abs(int(exponent or 0)) > 40:
            return None
        value = Fraction(match[1])
        if match[2]:
            ps = unit(match[2])
            return None if ps is None else (value * ps, True)
        return value, False
    if match := _ISO.fullmatch(text) or _CLOCK.fullmatch(text):
        whole = _second(text[: match.end("second")] + (match["zone"] or ""))
        part = match["part"] or "0"
        return None if whole is None else ((whole + Fraction(int(part), 10 ** len(part))) * SECOND, True)
    return None


@lru_cache(maxsize=1000)
def _second(text: str) -> int | None:
    """Convert a time stamp without decimals to seconds; return `None` for an invalid date or time."""
    match = _ISO.fullmatch(text)
    if match is None:
        hours, minutes, seconds = map(int, text.split(":"))
        return (hours * 60 + minutes) * 60 + seconds
    zone = (match["zone"] or "+0000").replace("Z", "+0000").replace(":", "")
    try:
        day = datetime.strptime(f"{match['day']} {match['second']} {zone}", "%Y-%m-%d %H:%M:%S %z")
    except ValueError:
        return None
    return int((day - datetime(2000, 1, 1, tzinfo=timezone.utc)).total_seconds())


def level_of(text: str) -> int | None:
    """Return a level: 0, 1, or 2 if it is unknown. The result is `None` for other text."""
    text = text.strip().strip('"')
    found = LEVELS.get(text)
    if found is None and (found := LEVELS.get(text.lower())) is None:
        match = re.fullmatch(r"([01])[.,]0*", text)
        found = int(match[1]) if match else None
    return found


def is_time(head: str) -> bool:
    """Return True for the heading of a column of times."""
    text = head.strip().strip('"')
    match = _TIME.fullmatch(text)
    if match is None:
        return False
    return not match[2] or match[1].lower() != "t" or unit(match[2]) is not None


def is_samples(head: str) -> bool:
    """Return True for the heading of a column of sample numbers."""
    return bool(_SAMPLES.fullmatch(head.strip().strip('"')))


def unit_of(head: str) -> Fraction | None:
    """Return the unit in a heading such as `Time [s]`, `Time (ms)` or `nanoseconds`, in ps.

    The value is None without a unit, and 0 for an unknown unit.
    """
    match = _TIME.fullmatch(head.strip().strip('"'))
    if match is None:
        return None
    if match[2]:
        found = unit(match[2])
        return Fraction(0) if found is None else found
    return unit(match[1])


def sigrok_unit(rate: Fraction) -> int:
    """Return n such that sigrok writes the times at this sample rate in units of 10**n ps.

    Other programs that write whole times use the same unit.
    """
    return next((ps for hz, ps in _SIGROK.items() if rate <= hz), 0)
