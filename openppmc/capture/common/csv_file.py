"""Captures in CSV with one column per channel.

Such files are written by Saleae Logic, sigrok, DSView, KingstVIS, WaveForms and other programs.

A row is a sample or a change. The first column contains times in a stated unit, ISO time stamps or sample
numbers. Without this column, a sample rate in the header defines the times. All times are relative to the
first row.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import needs
from ...textfile import NotTextError, chunks
from .csv_cells import LEVELS, cells_of, is_samples, is_time, level_of, sigrok_unit, text_of, time_of, unit_of
from .csv_rows import LONGEST, Layout, Rows, too_long
from .errors import CaptureError
from .rates import rate_in
from .signals import BLOCK, SECOND, Capture, Channel, numpy

if TYPE_CHECKING:
    from .signals import Column

PREAMBLE = 100
"""Largest number of lines before the table."""


def read_csv(path: Path) -> Capture:
    """Read a capture. Raises CaptureError if the file has another format or is incomplete."""
    needs("decode", f"{path.name}: a capture in CSV", "numpy")
    try:
        return _Table(path.name, _Lines(path)).read()
    except OSError as error:
        raise CaptureError(f"{path.name}: cannot be read ({error.strerror})") from None
    except NotTextError as error:
        raise CaptureError(f"{path.name}: {error}") from None


class _Lines:
    """Iterator over the lines of a file. The method `rest` yields the remaining lines in blocks."""

    def __init__(self, path: Path) -> None:
        self._blocks = _blocks(path)
        self._block, self._place, self._next = b"", 0, 0

    def __iter__(self) -> Iterator[str]:
        while True:
            if self._next == len(self._block):
                self._block, self._next = next(self._blocks, b""), 0
                if not self._block:
                    return
            self._place = self._next
            self._next = self._block.find(b"\n", self._place) + 1 or len(self._block)
            yield text_of(self._block[self._place : self._next])

    def rest(self) -> Iterator[bytes]:
        """Yield the line that was read last, and all lines after it."""
        yield self._block[self._place :]
        self._block = b""
        yield from self._blocks


def _blocks(path: Path) -> Iterator[bytes]:
    """Yield blocks of whole lines.

    Each line ends in a line feed, except possibly the last line of the file.
    """
    rest = b""
    for piece in chunks(path):
        if b"\0" in piece:
            raise CaptureError(f"{path.name}: no text: export the capture as CSV")
        rest += piece
        cut = max(rest.rfind(b"\n"), rest[:-1].rfind(b"\r")) + 1
        if cut:
            block = rest[:cut]
            yield block.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in block else block
            rest = rest[cut:]
        if len(rest) > 1 << 24:
            raise CaptureError(f"{path.name}: a line of {len(rest)} bytes: export the capture as CSV")
    if rest:
        yield rest.replace(b"\r", b"\n")


class _Table:
    """File that is being read."""

    def __init__(self, name: str, lines: _Lines) -> None:
        self.name, self.lines = name, lines
        self.rate: Fraction | None = None
        self.column_names: list[str] = []
        self.separator = ","
        self.unit: Fraction | None = None
        self.timed = self.counted = False
        self.line = 0
        """Number of the line that was read last."""

    def fail(self, what: str) -> CaptureError:
        """Return the error for the current line."""
        return CaptureError(f"{self.name}: line {self.line}: {what}")

    def read(self) -> Capture:
        """Read the whole file. Raises CaptureError."""
        heads = self._head()
        names = heads[1:] if self.timed else heads
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise CaptureError(f"{self.name}: two channels have the name {twice!r}: rename one of them")
        if not names:
            raise CaptureError(f"{self.name}: a column of times, but no channel: export digital channels")
        return self._rows(names)

    def _head(self) -> list[str]:
        """Read the lines up to the first row of the table; return the names of all columns."""
        before: list[tuple[str, int]] = []
        for line in self.lines:
            self.line += 1
            if line[0] in ";#" or not line.strip() or line.startswith("//"):
                self._comment(line)
                continue
            if before and (found := self._shape(before[-1][0], line)) is not None:
                for text, _ in before[:-1]:
                    self._comment(text)
                return found
            before.append((line, self.line))
            if (found := self._headless(line)) is not None:
                return found
            if len(before) > PREAMBLE:
                break
        if not before:
            raise CaptureError(f"{self.name}: there is nothing in it: capture again")
        self._explain(before)
        raise CaptureError(
            f"{self.name}: neither a column of times nor a sample rate: export it from Saleae Logic with "
            "times, or from sigrok with its head"
        )

    def _explain(self, before: list[tuple[str, int]]) -> None:
        """Raise a CaptureError that states why the file has no table; return if the reason is unknown."""
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
                    "only, a column for each"
                )

    def _comment(self, line: str) -> None:
        text = line.strip().lstrip(";#/ ").strip()
        self.rate = rate_in(text) or self.rate
        match = re.match(r"Channels \(\d+/\d+\):\s*(.+)", text)
        if match:
            self.column_names = [name.strip() for name in match[1].split(",")]

    def _shape(self, head: str, row: str) -> list[str] | None:
        """Return the names of the columns if these two lines are the heading and first row of a table."""
        for separator in "\t;,":
            heads, cells = cells_of(head, separator), cells_of(row, separator)
            # A comma in the row separates cells; it is not a decimal comma.
            if len(heads) < 2 and (not self.rate or separator != ","):
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
                    raise self.fail(f"{heads[0]!r} is not a known unit of time; write s, ms, us, ns or ps")
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
        """Return the channel names in the comment, or `logic0`, `logic1`, … if their number is wrong."""
        if len(self.column_names) in (count, count - 1):
            return [*self.column_names, "Trigger"][:count]
        return [f"logic{place}" for place in range(count)]

    def _headless(self, row: str) -> list[str] | None:
        """Return the names of the columns if this is a row of a sigrok table without a heading."""
        for separator in "\t;,":
            cells = cells_of(row, separator)
            if len(cells) < 2 and separator != ",":
                continue
            levels = [level_of(cell) for cell in cells]
            self.separator = separator
            timed = bool(self.column_names) and len(cells) == len(self.column_names) + 1
            if self.rate and None not in levels and not timed and "" not in cells:
                self.timed = self.counted = False
                self.separator, self.unit = separator, None
                return (
                    self.column_names
                    if len(self.column_names) == len(cells)
                    else [f"D{n}" for n in range(len(cells))]
                )
            if (
                self.rate
                and timed
                and None not in levels[1:]
                and time_of(cells[0], self.separator) is not None
            ):
                self.timed, self.counted, self.separator, self.unit = True, False, separator, None
                return ["Time", *self.column_names]
        return None

    def _rows(self, names: list[str]) -> Capture:
        """Read the channels from all rows. Raises CaptureError."""
        layout = Layout(
            self.name,
            self.line,
            len(names),
            self.separator,
            self.timed,
            self.counted,
            None if self.counted else self.unit,
        )
        rows = Rows(layout)
        for block in self.lines.rest():
            rows.add(block)
        end = rows.end
        if rows.count < 2:
            raise CaptureError(f"{self.name}: there are no samples in it: capture again")
        unit, first = self._unit_of_times(rows), rows.times[0][0]
        if (end - first) * unit >= LONGEST:
            raise too_long(self.name)
        scale = self._sampled(rows, _Scale(first, unit))
        np = numpy()
        end = int(scale.of(np.array([end]))[0])
        channels = {}
        for name, times, levels in zip(names, rows.times, rows.levels, strict=True):
            found = np.frombuffer(levels, np.uint8)
            hidden, known = found >> 1, found & 1
            channels[name] = Channel.of(
                int(known[0]),
                scale.column(times)[1:],
                known[1:],
                1,
                hidden[1:] if hidden.any() else None,
                int(hidden[0]),
            )
        return Capture(self.name, channels, end, 0 if self.rate is None else round(SECOND / self.rate))

    def _unit_of_times(self, rows: Rows) -> Fraction:
        """Return the unit of the times in the columns, in ps. Raises CaptureError if it is unknown."""
        if not self.timed or self.counted:
            if not rows.whole:
                raise CaptureError(f"{self.name}: numbers of samples that are not whole: export it again")
            if self.rate is None:
                raise CaptureError(
                    f"{self.name}: numbers of samples without a sample rate: add a first line "
                    "`; Samplerate: 24 MHz`"
                )
            return SECOND / self.rate
        if rows.absolute:
            unit = Fraction(1)
        elif self.unit is not None:
            unit = self.unit
        elif rows.whole and self.rate is not None:
            unit = Fraction(10 ** sigrok_unit(self.rate))
        elif rows.whole and rows.end - rows.times[0][0] > 1:
            raise CaptureError(
                f"{self.name}: times are whole numbers without a unit: write it into the first head, "
                "as `Time [ns]`"
            )
        else:
            unit = Fraction(SECOND)
        return unit / Fraction(10**rows.decimals)

    def _sampled(self, rows: Rows, scale: _Scale) -> _Scale:
        """Return a scale with the exact times of the samples if the table has rounded times.

        This requires a sample rate in the header. Otherwise, `scale` is returned unchanged.
        """
        if self.rate is None or not self.timed or self.counted:
            return scale
        period, part = SECOND / self.rate, 10**rows.decimals
        unit = scale.unit * part
        # sigrok truncates the sample period to a whole number of units, and writes multiples of this period.
        cut = int(period / unit)
        if rows.whole and cut and period != cut * unit:
            offset = (rows.base or 0) % cut * part
            if all(((piece + offset) % (cut * part) == 0).all() for piece in rows.pieces()):
                return _Scale(scale.first, period / (cut * part))
        near, most = _Scale(scale.first, scale.unit, period), int(max(unit, Fraction(1000)))
        if all((abs(near.of(piece) - scale.of(piece)) <= most).all() for piece in rows.pieces()):
            return near
        return scale


class _Scale:
    """Conversion of the times in a table to ps, counted from the first row.

    Args:
        unit: length of one unit of the table in ps.
        period: sample period in ps if the times are rounded times of samples.
    """

    def __init__(self, first: int, unit: Fraction, period: Fraction | None = None) -> None:
        self.first, self.unit, self.period = first, unit, period

    def of(self, times: Column) -> Column:
        """Return these times of the table in ps."""
        found = _multiplied(times - self.first, self.unit)
        if self.period is not None:
            found = _multiplied(_multiplied(found, 1 / self.period), self.period)
        return found

    def column(self, times: array[int]) -> Column:
        """Convert a whole column of times to ps in place, and return it."""
        found: Column = numpy().frombuffer(times, "i8")
        for at in range(0, len(found), BLOCK):
            found[at : at + BLOCK] = self.of(found[at : at + BLOCK])
        return found


def _multiplied(values: Column, factor: Fraction) -> Column:
    """Return the values multiplied by a factor, rounded.

    Args:
        values: numbers in ascending order.
    """
    up, down = factor.numerator, factor.denominator
    if not len(values) or max(abs(int(values[0])), abs(int(values[-1]))) < LONGEST // up:
        found: Column = (values * up + down // 2) // down
    else:
        found = numpy().array([round(one * factor) for one in values.tolist()], "i8")
    return found
