"""Captures in CSV: Saleae Logic 1 and 2 (a row a change, times in s), sigrok (a row a sample)."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path

from .errors import CaptureError
from .signals import SECOND, Capture, Channel

_RATE = re.compile(r"[Ss]amplerate:\s*([\d.]+)\s*([kMG]?)Hz")
_PREFIX = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}
_LEVELS = {"0": 0, "1": 1}
_UNIT = {"s": SECOND, "ms": 10**9, "us": 10**6, "µs": 10**6, "ns": 10**3, "ps": 1}


def read_csv(path: Path) -> Capture:
    """CaptureError for a file that is none of these, or cut."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            return _read(path.name, file)
    except UnicodeDecodeError:
        raise CaptureError(f"{path.name}: no text: export the capture as CSV") from None
    except OSError as error:
        raise CaptureError(f"{path.name}: cannot be read ({error.strerror})") from None


def _read(name: str, lines: Iterable[str]) -> Capture:
    sample = 0
    rows: list[str] = []
    iterator = iter(lines)
    for line in iterator:
        if line.startswith(";") or line.startswith("#") or not line.strip():
            if match := _RATE.search(line):
                hz = Fraction(match[1]) * _PREFIX[match[2]]
                sample = round(SECOND / hz)
            continue
        rows.append(line)
        break
    if not rows:
        raise CaptureError(f"{name}: there is nothing in it: capture again")
    heads = [head.strip() for head in next(csv.reader(rows))]
    timed = heads[0].lower().startswith("time")
    if not timed and _numeric(heads):
        # sigrok without heads: the channels are in the order of the comment.
        heads, iterator = [f"D{n}" for n in range(len(heads))], _again(rows[0], iterator)
    if not timed and not sample:
        raise CaptureError(
            f"{name}: neither a column of times nor a sample rate: export it from Saleae Logic with times, "
            "or from sigrok with its head"
        )
    unit = _unit_of(heads[0]) if timed else 0
    return _table(name, heads, iterator, timed, unit, sample)


def _again(first: str, rest: Iterator[str]) -> Iterator[str]:
    yield first
    yield from rest


def _numeric(heads: list[str]) -> bool:
    return all(head in ("0", "1") for head in heads)


def _unit_of(head: str) -> int:
    """Picoseconds of the unit in `Time [s]`, `Time (ms)` …; s if it names none."""
    match = re.search(r"[\[(]\s*(\w+)\s*[\])]", head)
    return _UNIT.get(match[1] if match else "s", SECOND)


def _table(name: str, heads: list[str], lines: Iterable[str], timed: bool, unit: int, sample: int) -> Capture:
    names = heads[1:] if timed else heads
    channels = {one: Channel() for one in names}
    known = list(channels.values())
    if len(known) < len(names):
        raise CaptureError(f"{name}: two channels of the same name: give each a name of its own")
    t, number, before = 0, -1, ""
    for line in lines:
        if not line.strip():
            continue
        number += 1
        if not timed:
            t = number * sample
            # Most samples are as the one before.
            if line == before:
                continue
            before = line
        row = line.rstrip("\r\n").split(",")
        try:
            if len(row) < len(heads) or not line.endswith("\n") and len(row[-1].strip()) != 1:
                raise ValueError
            if timed:
                t = round(Fraction(row[0].strip()) * unit)
            levels = [_LEVELS[text.strip()] for text in (row[1:] if timed else row)[: len(names)]]
        except (ValueError, KeyError):
            raise CaptureError(
                f"{name}: row {number + 1} of the table is cut off or no row of levels: export it again, "
                "digital channels only"
            ) from None
        for channel, level in zip(known, levels, strict=True):
            if number == 0:
                channel.initial = level
            else:
                channel.add(t, level)
    if number < 1:
        raise CaptureError(f"{name}: there are no samples in it: capture again")
    return Capture(name, channels, t, sample)
