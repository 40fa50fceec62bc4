"""Captures in CSV: Saleae Logic, sigrok, DSView, KingstVIS, WaveForms and others with a column per channel.

A row is a sample or a change. Times are in a first column, in a stated unit, as ISO time stamps or as numbers
of samples; without one a sample rate in the head gives them. Times count from the first row.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from fractions import Fraction
from itertools import chain
from pathlib import Path
from typing import Any

from ...errors import needs
from ...textfile import NotTextError, chunks
from .csv_cells import LEVELS, cells_of, is_samples, is_time, level_of, sigrok_unit, time_of, unit_of
from .errors import CaptureError
from .rates import rate_in
from .signals import SECOND, Capture, Channel

_LONGEST = 1 << 62
PREAMBLE = 100
"""Lines before the table, at most."""


def read_csv(path: Path) -> Capture:
    """CaptureError for a file that is none of these, or cut."""
    needs("decode", f"{path.name}: a capture in CSV", "numpy")
    try:
        return _Table(path.name, _lines(path)).read()
    except OSError as error:
        raise CaptureError(f"{path.name}: cannot be read ({error.strerror})") from None
    except NotTextError as error:
        raise CaptureError(f"{path.name}: {error}") from None


def _lines(path: Path) -> Iterator[str]:
    """Lines with their ends; a line without one is the last."""
    rest = b""
    for piece in chunks(path):
        if b"\0" in piece:
            raise CaptureError(f"{path.name}: no text: export the capture as CSV")
        rest += piece
        cut = max(rest.rfind(b"\n"), rest[:-1].rfind(b"\r")) + 1
        if cut:
            yield from _text(rest[:cut]).replace("\r\n", "\n").replace("\r", "\n").splitlines(keepends=True)
            rest = rest[cut:]
        if len(rest) > 1 << 24:
            raise CaptureError(f"{path.name}: a line of {len(rest)} bytes: export the capture as CSV")
    if rest:
        yield _text(rest).replace("\r", "\n")


def _text(data: bytes) -> str:
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data.decode("latin-1")


class _Table:
    """A file while it is read."""

    def __init__(self, name: str, lines: Iterator[str]) -> None:
        self.name, self.lines = name, lines
        self.rate: Fraction | None = None
        self.told: list[str] = []
        self.separator = ","
        self.unit: Fraction | None = None
        self.timed = self.counted = False
        self.line = 0
        """Number of the line that was read last."""

    def fail(self, what: str) -> CaptureError:
        """The error at the current line."""
        return CaptureError(f"{self.name}: line {self.line}: {what}")

    def read(self) -> Capture:
        """All of it. CaptureError."""
        heads, rest = self._head()
        names = heads[1:] if self.timed else heads
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise CaptureError(
                f"{self.name}: two channels of the same name ({twice!r}): give each a name of its own"
            )
        if not names:
            raise CaptureError(f"{self.name}: a column of times and no channel: export digital channels")
        return self._rows(names, rest)

    def _head(self) -> tuple[list[str], Iterator[str]]:
        """Names of all columns, and the rows."""
        before: list[tuple[str, int]] = []
        for line in self.lines:
            self.line += 1
            if line[0] in ";#" or not line.strip() or line.startswith("//"):
                self._comment(line)
                continue
            if before and (found := self._shape(before[-1][0], line)) is not None:
                for text, _ in before[:-1]:
                    self._comment(text)
                return found, chain([line], self.lines)
            before.append((line, self.line))
            if (found := self._headless(line)) is not None:
                return found, chain([line], self.lines)
            if len(before) > PREAMBLE:
                break
        if not before:
            raise CaptureError(f"{self.name}: there is nothing in it: capture again")
        self._blame(before)
        raise CaptureError(
            f"{self.name}: neither a column of times nor a sample rate: export it from Saleae Logic with "
            "times, or from sigrok with its head"
        )

    def _blame(self, before: list[tuple[str, int]]) -> None:
        """CaptureError that says why there is no table, if that is known."""
        for (head, _), (row, number) in zip(before, [*before[1:], ("", 0)], strict=True):
            for separator in "\t;,":
                heads = cells_of(head, separator)
                if len(heads) < 2 or not (is_time(heads[0]) or is_samples(heads[0])):
                    continue
                if not row:
                    raise CaptureError(f"{self.name}: there are no samples in it: capture again")
                self.line = number
                raise self.fail(
                    f"{row.strip()[:40]!r} is cut off or no row of levels: export it again, digital channels "
                    "only"
                )

    def _comment(self, line: str) -> None:
        text = line.strip().lstrip(";#/ ").strip()
        self.rate = rate_in(text) or self.rate
        match = re.match(r"Channels \(\d+/\d+\):\s*(.+)", text)
        if match:
            self.told = [name.strip() for name in match[1].split(",")]

    def _shape(self, head: str, row: str) -> list[str] | None:
        """Names if these two lines are the head and the first row of a table."""
        for separator in "\t;,":
            heads, cells = cells_of(head, separator), cells_of(row, separator)
            if len(heads) < 2 and not self.rate:
                continue
            if len(cells) != len(heads) or all(one in LEVELS for one in heads if one):
                continue
            self.separator = separator
            self.timed = is_time(heads[0]) or is_samples(heads[0])
            self.counted = is_samples(heads[0])
            self.unit = None if self.counted else unit_of(heads[0])
            levels = cells[1:] if self.timed else cells
            if any(level_of(cell) is None for cell in levels):
                continue
            if self.timed:
                if time_of(cells[0], self.separator) is None:
                    continue
                if self.unit == 0:
                    self.line -= 1
                    raise self.fail(
                        f"{heads[0]!r} is no unit of time that is known; write s, ms, us, ns or ps"
                    )
            elif not self.rate:
                continue
            heads = [one.strip() for one in heads]
            own = heads[1:] if self.timed else heads
            if own[0] == "logic" and set(own) <= {"logic", "Trigger"}:
                own = self._names(len(own))
            own = [one or f"column {place + 1 + self.timed}" for place, one in enumerate(own)]
            return [heads[0], *own] if self.timed else own
        return None

    def _names(self, count: int) -> list[str]:
        """Names of the comment, or numbers."""
        if len(self.told) in (count, count - 1):
            return [*self.told, "Trigger"][:count]
        return [f"logic{place}" for place in range(count)]

    def _headless(self, row: str) -> list[str] | None:
        """Names if this is a row of a table of sigrok without a line of names."""
        for separator in "\t;,":
            cells = cells_of(row, separator)
            if len(cells) < 2 and separator != ",":
                continue
            levels = [level_of(cell) for cell in cells]
            self.separator = separator
            timed = bool(self.told) and len(cells) == len(self.told) + 1
            if self.rate and None not in levels and not timed and "" not in cells:
                self.timed = self.counted = False
                self.separator, self.unit = separator, None
                return self.told if len(self.told) == len(cells) else [f"D{n}" for n in range(len(cells))]
            if (
                self.rate
                and timed
                and None not in levels[1:]
                and time_of(cells[0], self.separator) is not None
            ):
                self.timed, self.counted, self.separator, self.unit = True, False, separator, None
                return ["Time", *self.told]
        return None

    def _rows(self, names: list[str], rest: Iterator[str]) -> Capture:
        """Channels from all rows."""
        places = [array("q") for _ in names]
        levels = [bytearray() for _ in names]
        stamps: list[tuple[Fraction, bool]] = []
        """Times of the rows in which something changed; as written."""
        rows = array("q")
        before, numbers, tail, last = [-1] * len(names), -1, None, ""
        count, self.line = len(names) + self.timed, self.line - 1
        for line in rest:
            self.line += 1
            if not line.strip() or line[0] in ";#" and self.separator != ";":
                continue
            numbers += 1
            at = line.find(self.separator) if self.timed else -1
            now = line[at + 1 :]
            if now == tail:
                last = line
                continue
            cells = line.rstrip("\n").split(self.separator)
            if '"' in line:
                cells = cells_of(line, self.separator)
            if len(cells) == count + 1 and not cells[-1].strip():
                cells.pop()
            cut = not line.endswith("\n") and not cells[-1].strip()
            found = [level_of(cell) for cell in (cells[1:] if self.timed else cells)]
            if len(cells) != count or None in found or cut:
                raise self.fail(
                    f"{line.strip()[:40]!r} is cut off or no row of levels: export it again, digital "
                    "channels only"
                )
            if self.timed:
                stamps.append(self._checked(cells[0]))
            rows.append(numbers)
            place = len(rows) - 1
            for n, level in enumerate(found):
                assert level is not None
                if level != before[n]:
                    places[n].append(place)
                    levels[n].append(level)
                    before[n] = level
            tail, last = now, ""
        if last:
            if self.timed:
                stamps.append(self._checked(last.split(self.separator)[0]))
            rows.append(numbers)
        if numbers < 1:
            raise CaptureError(f"{self.name}: there are no samples in it: capture again")
        times, sample = self._times(rows, stamps)
        return self._capture(names, places, levels, times, sample)

    def _checked(self, text: str) -> tuple[Fraction, bool]:
        found = time_of(text, self.separator)
        if found is None:
            raise self.fail(f"{text.strip()[:30]!r} is no time: export it again")
        return found

    def _times(self, rows: Any, stamps: list[tuple[Fraction, bool]]) -> tuple[Any, int]:
        """ps of each row that was kept, from the first, and the distance of two samples."""
        import numpy as np

        period = None if self.rate is None else SECOND / self.rate
        sample = 0 if period is None else round(period)
        if not self.timed:
            assert period is not None
            return _spread(np.array(rows, np.int64), period), sample
        absolute = stamps[0][1]
        if any(one[1] != absolute for one in stamps):
            raise CaptureError(f"{self.name}: times with and without a unit: write all of them alike")
        values = [one[0] for one in stamps]
        whole = all(one.denominator == 1 for one in values)
        if self.counted:
            if not whole:
                raise CaptureError(f"{self.name}: numbers of samples that are not whole: export it again")
            if period is None:
                raise CaptureError(
                    f"{self.name}: numbers of samples without a sample rate: add a first line "
                    "`; Samplerate: 24 MHz`"
                )
            unit_ps: Fraction = period
        elif absolute:
            unit_ps = Fraction(1)
        elif self.unit is not None:
            unit_ps = self.unit
        elif whole and self.rate is not None:
            unit_ps = Fraction(10 ** sigrok_unit(self.rate))
        elif whole and values[-1] - values[0] > 1:
            raise CaptureError(
                f"{self.name}: times are whole numbers without a unit: write it into the first head, "
                "as `Time [ns]`"
            )
        else:
            unit_ps = Fraction(SECOND)
        if period is not None and not self.counted:
            values, unit_ps = self._sampled(values, unit_ps, whole, period)
        first = values[0]
        times = [round((one - first) * unit_ps) for one in values]
        if max(times) > _LONGEST:
            raise CaptureError(f"{self.name}: longer than 50 days: is the unit of the times right?")
        found = np.array(times, np.int64)
        if (np.diff(found) < 0).any():
            back = int(np.flatnonzero(np.diff(found) < 0)[0]) + 1
            raise CaptureError(
                f"{self.name}: row {rows[back] + 1} of the table is earlier than the one before: export it "
                "again"
            )
        return found, sample

    def _sampled(
        self, values: list[Fraction], unit_ps: Fraction, whole: bool, period: Fraction
    ) -> tuple[list[Fraction], Fraction]:
        """Numbers of samples instead of rounded times, where the head states the sample rate."""
        # sigrok counts in periods that are cut to a whole number of units.
        cut = int(period / unit_ps)
        if whole and cut and period != cut * unit_ps and all(one % cut == 0 for one in values):
            return [one / cut for one in values], period
        first = values[0]
        steps = [(one - first) * unit_ps / period for one in values]
        if all(abs(one - round(one)) * period <= max(unit_ps, Fraction(1000)) for one in steps):
            return [Fraction(round(one)) for one in steps], period
        return values, unit_ps

    def _capture(
        self, names: list[str], places: list[Any], levels: list[bytearray], times: Any, sample: int
    ) -> Capture:
        import numpy as np

        channels = {}
        for name, place, level in zip(names, places, levels, strict=True):
            at, found = np.array(place, np.int64), np.frombuffer(bytes(level), np.uint8)
            hidden, known = found >> 1, found & 1
            channels[name] = Channel.of(
                int(known[0]),
                times[at[1:]],
                known[1:],
                1,
                hidden[1:] if hidden.any() else None,
                int(hidden[0]),
            )
        return Capture(self.name, channels, int(times[-1]), sample)


def _spread(rows: Any, period: Fraction) -> Any:
    """ps of samples by their numbers, without an error that adds up."""
    up, down = period.numerator, period.denominator
    if int(rows[-1]) < _LONGEST // up:
        return (rows * up + down // 2) // down
    import numpy as np

    return np.array([round(int(one) * period) for one in rows], np.int64)
