"""Rows of a CSV capture: regular rows are converted in blocks, irregular rows one by one."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from .csv_cells import cells_of, level_of, text_of, time_of
from .errors import CaptureError
from .signals import BLOCK, SECOND, numpy

if TYPE_CHECKING:
    from .signals import Column

LONGEST = 1 << 62
_DIGITS = 18
"""Largest number of digits of a number that always fits into an int64."""
_NONE = 255
"""Code of a cell that is not a level."""


class Layout(NamedTuple):
    """Form of a table.

    Attributes:
        first: line number of the first row of the table.
        counted: True if times are sample numbers.
        unit: unit of the times in ps, `None` if the header states no unit.
    """

    name: str
    first: int
    channels: int
    separator: str
    timed: bool
    counted: bool
    unit: Fraction | None

    @property
    def width(self) -> int:
        """Number of bytes that the levels of a row, with their separators, occupy."""
        return 2 * self.channels - (not self.timed)


class _Block:
    """Lines that are read together.

    Attributes:
        changed: True for a line whose levels differ from those of the previous line.
        odd: True for a line that does not consist of a time and levels of one character each.
        levels: levels of those changed lines that are not odd.
    """

    def __init__(self, block: bytes, layout: Layout, level: Column) -> None:
        np = numpy()
        timed, width, separator = layout.timed, layout.width, layout.separator.encode()
        self.cut = not block.endswith(b"\n")
        self.block = block + b"\n" * self.cut
        plain = self.block
        if b'"' in plain:
            ends = [b'"' + separator, b'"\n', separator + b'"', b'\n"']
            if plain.count(b'"') == sum(map(plain.count, ends)) + plain.startswith(b'"'):
                plain = plain.replace(b'"', b"")
        if b" " in plain:
            for old in (separator + b" ", b" " + separator, b" \n"):
                plain = plain.replace(old, old.strip(b" "))
        # The last bytes of a line are the levels with their separators. They are compared as words of 8
        # bytes.
        words = -(-width // 8)
        pad = 8 * words + 32
        self.buf: Column = np.frombuffer(b" " * pad + plain, np.uint8)
        ends = np.flatnonzero(self.buf == 10)
        self.starts: Column = np.concatenate(([pad], ends[:-1] + 1))
        tails = self.gather(ends, 8 * words).view("<u8").reshape(-1, words)
        tails[:, 0] &= np.uint64((1 << 64) - (1 << 8 * (8 * words - width)))
        self.changed: Column = np.ones(len(ends), bool)
        self.changed[1:] = tails[1:, 0] != tails[:-1, 0]
        for word in range(1, words):
            self.changed[1:] |= tails[1:, word] != tails[:-1, word]
        self.odd: Column = ends - self.starts <= width if timed else ends - self.starts != width
        first = self.buf[self.starts]
        self.odd |= (first == ord("#")) | (first == ord(";"))
        self.odd[-1] |= self.cut
        each = layout.channels - (not timed)
        marks = self.buf == separator[0]
        if self.odd.any() or np.count_nonzero(marks) != each * len(ends):
            self.odd |= np.diff(np.flatnonzero(marks).searchsorted(ends), prepend=0) != each
        self.changed[1:] |= self.odd[:-1]
        cells = tails[self.changed].view(np.uint8)[:, 8 * words - width :]
        self.levels: Column = cells[:, int(timed) :: 2]
        # For the digits 0 and 1, an AND takes a third of the time of the look-up in `level`.
        digits = (self.levels | 1 == ord("1")).all()
        self.levels = self.levels & 1 if digits else level[self.levels]
        marks = cells[:, 1 - timed :: 2] == separator[0]
        if not marks.all() or (self.levels == _NONE).any():
            bad = ~marks.all(axis=1) | (self.levels == _NONE).any(axis=1)
            # If a line equals the previous line, either both lines are odd or neither is.
            self.odd |= bad[np.cumsum(self.changed) - 1]
        self.levels = self.levels[~self.odd[self.changed]]
        self.ends = ends - width
        """Index at which the time of each line ends."""
        self._lines: list[bytes] = []

    def gather(self, ends: Column, size: int) -> Column:
        """Return the `size` bytes before each of these indices."""
        window = numpy().ndarray((len(self.buf) - size + 1,), f"V{size}", self.buf, 0, (1,))
        found: Column = window[ends - size]
        return found

    def line(self, row: int) -> str:
        """Return the text of a line."""
        self._lines = self._lines or self.block.split(b"\n")
        return text_of(self._lines[row])

    def cell(self, row: int) -> str:
        """Return the time of a line as text. The line must not be odd."""
        return text_of(self.buf[self.starts[row] : self.ends[row]].tobytes())


class _Numbers(NamedTuple):
    """Columns of numbers; each number is value / 10**decimals.

    Attributes:
        valid: True for a cell that contains a plain number.
    """

    value: Column
    decimals: Column
    valid: Column


class Rows:
    """Changes of all channels, in columns that grow while the file is read.

    Attributes:
        times: whole numbers, counted from `base`, in units of 10**-decimals of the file's unit. In a file
            without times, these are the numbers of the rows.
        levels: 0, 1, 2 (unknown).
        count: number of rows that were read so far.
        whole: True if no time has decimals.
        absolute: True if the cells with times contain a unit or a date.
    """

    def __init__(self, layout: Layout) -> None:
        np = numpy()
        self.np, self.layout = np, layout
        self.times = [array("q") for _ in range(layout.channels)]
        self.levels = [bytearray() for _ in range(layout.channels)]
        self.count = self.decimals = 0
        self.base: int | None = None
        self.whole = True
        self.absolute: bool | None = None
        self._finest = max(0, math.floor(math.log10(layout.unit or SECOND)))
        if layout.unit:
            self.decimals = self._finest
        self._before = np.full(layout.channels, _NONE, np.uint8)
        self._line = layout.first
        self._end: int | None = None
        self._last: tuple[int, str] | None = None
        """Line number and time of the last line if no level changed in that line, else `None`."""
        self._level = np.full(256, _NONE, np.uint8)
        for char in map(chr, range(33, 127)):
            level = level_of(char)
            if level is not None and char not in ('"', layout.separator):
                self._level[ord(char)] = level
        self._powers = np.array([10**n for n in range(_DIGITS + 1)], np.int64)

    def fail(self, line: int, what: str) -> CaptureError:
        """Return the error for a line."""
        return CaptureError(f"{self.layout.name}: line {line}: {what}")

    @property
    def end(self) -> int:
        """Time of the last row. Raises CaptureError."""
        if self._last is not None:
            value = self._time(*self._last)
            self._rescale(value.denominator == 1)
            end, self._last = self._scaled(value), None
            if end < (self._end or 0):
                raise self._earlier(self.count - 1)
            self._end = end
        return self._end or 0

    def pieces(self) -> Iterator[Column]:
        """Yield all times in short columns."""
        for column in self.times:
            times = self.np.frombuffer(column, self.np.int64)
            for at in range(0, len(times), BLOCK):
                yield times[at : at + BLOCK]
        yield self.np.array([self.end])

    def add(self, data: bytes) -> None:
        """Read whole lines. Only the last line of a file may lack its line feed. Raises CaptureError."""
        np = self.np
        block = _Block(data, self.layout, self._level)
        kept = np.flatnonzero(block.changed | block.odd)
        levels = np.empty((len(kept), self.layout.channels), np.uint8)
        levels[~block.odd[kept]] = block.levels
        # Times of the lines that are read one by one, by the number of the row.
        exact: dict[int, Fraction] = {}
        skipped = np.zeros(len(block.odd), bool)
        for place in np.flatnonzero(block.odd[kept]).tolist():
            row = int(kept[place])
            text = block.line(row)
            if not text.strip() or (text[0] in ";#" and self.layout.separator != ";"):
                skipped[row] = True
            else:
                cut = block.cut and row + 1 == len(skipped)
                levels[place], exact[row] = self._row(text, self._line + row, cut)
        used = ~skipped[kept]
        kept, levels = kept[used], levels[used]
        numbers = self.count + np.arange(len(skipped)) - np.cumsum(skipped)
        self.count += int((~skipped).sum())
        if len(kept):
            times = self._times(block, kept, exact) if self.layout.timed else numbers[kept]
            back = np.flatnonzero(np.diff(times, prepend=times[:1] if self._end is None else self._end) < 0)
            if len(back):
                raise self._earlier(int(numbers[kept[back[0]]]))
            self._add(times, levels)
        rows = np.flatnonzero(~skipped)
        if len(rows):
            last = int(rows[-1])
            self._last = None
            if not len(kept) or last != kept[-1]:
                if self.layout.timed:
                    self._last = (self._line + last, block.cell(last))
                else:
                    self._end = self.count - 1
        self._line += len(skipped)

    def _add(self, times: Column, levels: Column) -> None:
        """Add rows in which a level may have changed."""
        np = self.np
        whole = np.ascontiguousarray(np.concatenate((self._before[None], levels)).T)
        for column, bits, channel in zip(self.times, self.levels, whole, strict=True):
            at = np.flatnonzero(channel[1:] != channel[:-1])
            column.frombytes(times[at].tobytes())
            bits += channel[1:][at].tobytes()
        self._before, self._end = levels[-1], int(times[-1])

    def _earlier(self, number: int) -> CaptureError:
        return CaptureError(
            f"{self.layout.name}: row {number + 1} of the table is earlier than the one before: export it "
            "again"
        )

    def _row(self, text: str, line: int, cut: bool) -> tuple[list[int], Fraction]:
        """Read one line; return its levels and its time.

        Args:
            cut: True if the line has no line feed.
        """
        timed, separator = self.layout.timed, self.layout.separator
        cells = cells_of(text, separator) if '"' in text else text.split(separator)
        if len(cells) == self.layout.channels + timed + 1 and not cells[-1].strip():
            cells.pop()
        cut = cut and not cells[-1].strip()
        levels = [level for cell in cells[int(timed) :] if (level := level_of(cell)) is not None]
        if len(levels) != self.layout.channels or len(cells) != self.layout.channels + timed or cut:
            raise self.fail(
                line,
                f"{text.strip()[:40]!r} is cut off or no row of levels: export it again, digital channels "
                "only, a column for each",
            )
        return levels, self._time(line, cells[0]) if timed else Fraction(0)

    def _time(self, line: int, text: str) -> Fraction:
        """Return the time in the text of one cell. Raises CaptureError."""
        found = time_of(text, self.layout.separator)
        if found is None:
            raise self.fail(line, f"{text.strip()[:30]!r} is no time: export it again")
        value, absolute = found
        self._agree(line, absolute)
        return value

    def _agree(self, line: int, absolute: bool) -> None:
        if self.absolute is None:
            self.absolute = absolute
            # Times with a unit or a date are in ps, so they have no decimals.
            self.decimals *= not absolute
        if self.absolute != absolute:
            raise self.fail(line, "times with and without a unit: write all of them alike")

    def _times(self, block: _Block, kept: Column, exact: dict[int, Fraction]) -> Column:
        """Return the times of the lines with the indices `kept`.

        Args:
            exact: times that were read one by one, by row.
        """
        np = self.np
        plain = kept[~block.odd[kept]]
        value, decimals, valid = self._numbers(block, block.starts[plain], block.ends[plain])
        if valid.any():
            self._agree(self._line + int(plain[valid][0]), False)
        dated = plain[~valid]
        stamps = self._stamps(block, dated)
        if stamps is None:
            exact |= {row: self._time(self._line + row, block.cell(row)) for row in dated.tolist()}
        plain, value, decimals = plain[valid], value[valid], decimals[valid]
        if len(decimals) and int(decimals.min()) == int(decimals.max()):
            # All times have the same number of decimals, so one value is enough.
            decimals = decimals[:1]
        power = self._powers[decimals.clip(0, _DIGITS)]
        whole = not (self.whole and (value % power).any())
        if self.base is None:
            first = int(kept[0])
            start = exact[first] if first in exact else _exact(value[0], decimals[0])
            self.base = math.floor(start)
        self._rescale(whole and all(one.denominator == 1 for one in exact.values()))
        shift = self.decimals - decimals
        up, down = self._powers[shift.clip(0, _DIGITS)], self._powers[(-shift).clip(0, _DIGITS)]
        base = max(-LONGEST, min(LONGEST, self.base))
        short = (decimals >= 0) & (abs(shift) <= _DIGITS) & (abs(base) < LONGEST // power)
        rest = value - np.where(short, base, 0) * power
        short = short & (np.abs(rest) < LONGEST // up)
        found: Column = (np.where(short, rest, 0) * up + (down >> 1)) // down
        for place in np.flatnonzero(~short).tolist():
            found[place] = self._scaled(_exact(value[place], decimals[place % len(decimals)]))
        times: Column = np.empty(len(kept), np.int64)
        times[kept.searchsorted(plain)] = found
        if stamps is not None:
            times[kept.searchsorted(dated)] = stamps
        times[kept.searchsorted(list(exact))] = [self._scaled(value) for value in exact.values()]
        return times

    def _stamps(self, block: _Block, rows: Column) -> Column | None:
        """Read time stamps of one form, such as hh:mm:ss.fff; return `None` for another form."""
        np = self.np
        size = block.ends[rows] - block.starts[rows]
        form = (
            re.fullmatch(r"(.*:\d\d[.,])(\d{1,12})(\D.*)?", block.cell(int(rows[0]))) if len(rows) else None
        )
        if form is None or (size != size[0]).any():
            return None
        chars = block.gather(block.ends[rows], int(size[0])).view(np.uint8).reshape(len(rows), -1)
        begin, end = form.span(2)
        digits = chars[:, begin:end] - np.uint8(ord("0"))
        if (digits > 9).any() or (chars[:, end:] != chars[0, end:]).any():
            return None
        # Only few time stamps begin a new second; convert only these one by one.
        fresh = np.ones(len(rows), bool)
        fresh[1:] = (chars[1:, :begin] != chars[:-1, :begin]).any(axis=1)
        seconds = []
        for row in rows[fresh].tolist():
            text = block.cell(row)
            seconds.append(self._time(self._line + row, text[: begin - 1] + text[end:]))
        if self.base is None:
            self.base = int(seconds[0])
        whole = np.array([self._scaled(one) for one in seconds])
        part = digits.astype(np.int64) @ (10 ** np.arange(11, 11 - end + begin, -1))
        found: Column = whole[np.cumsum(fresh) - 1] + part
        return found

    def _scaled(self, value: Fraction) -> int:
        """Return a time, counted from `base`. Raises CaptureError."""
        found: int = round((value - (self.base or 0)) * 10**self.decimals)
        if abs(found) >= LONGEST:
            raise too_long(self.layout.name)
        return found

    def _rescale(self, whole: bool) -> None:
        """Store whether all times are whole numbers.

        When the first time with decimals is read, the unit of `times` is made smaller.
        """
        self.whole &= whole
        layout = self.layout
        if self.whole or self.decimals or self.absolute or layout.counted or layout.unit is not None:
            return
        self.decimals, factor = self._finest, 10**self._finest
        for column in self.times:
            times = self.np.frombuffer(column, self.np.int64)
            if len(times) and int(times[-1]) >= LONGEST // factor:
                raise too_long(layout.name)
            times *= factor
            del times
        self._end = None if self._end is None else self._end * factor

    def _numbers(self, block: _Block, starts: Column, ends: Column, exponents: bool = True) -> _Numbers:
        """Read the plain numbers between these indices."""
        np = self.np
        size = ends - starts
        widest = max(1, min(int(size.max(initial=0)), _DIGITS + 6))
        # The array has one row per character position, so that the same position of all cells is processed
        # together.
        chars = np.ascontiguousarray(block.gather(ends, widest).view(np.uint8).reshape(-1, widest).T)
        value, decimals = np.zeros(len(size), np.int64), np.zeros(len(size), np.int64)
        points, signs = np.zeros(len(size), np.int64), np.zeros(len(size), bool)
        minus, bad = np.zeros(len(size), bool), (size > widest) | (size < 1)
        for place, char in zip(range(widest - 1, -1, -1), chars, strict=True):
            digit, live = char - np.uint8(ord("0")), size > place
            number = live & (digit < 10)
            if number.all():
                value = value * 10 + digit
                continue
            point = live & ((char == ord(".")) | ((char == ord(",")) & (self.layout.separator != ",")))
            decimals[point] = place
            points += point
            sign = (size == place + 1) & ((char == ord("+")) | (char == ord("-")))
            signs |= sign
            minus |= sign & (char == ord("-"))
            value = np.where(number, value * 10 + digit, value)
            bad |= live & ~(number | point | sign)
        digits = size - points - signs
        bad |= (points > 1) | (digits < 1) | (digits > _DIGITS)
        value = np.where(minus, -value, value)
        if exponents and widest > 4 and bad.any():
            mark, sign, tens, ones = chars[-4:]
            form = (mark | 32 == ord("e")) & ((sign == ord("+")) | (sign == ord("-"))) & (size > 4)
            form &= (tens - np.uint8(48) < 4) & (ones - np.uint8(48) < 10)
            power = (tens.astype(np.int64) - 48) * 10 + ones - 48
            part = self._numbers(block, starts[form], ends[form] - 4, False)
            value[form], bad[form] = part.value, ~part.valid
            decimals[form] = part.decimals - np.where(sign == ord("-"), -power, power)[form]
        return _Numbers(value, decimals, ~bad)


def too_long(name: str) -> CaptureError:
    """Return the error for a capture whose times exceed the range."""
    return CaptureError(f"{name}: longer than 50 days: is the unit of the times right?")


def _exact(value: int, decimals: int) -> Fraction:
    return Fraction(int(value)) / Fraction(10) ** int(decimals)
