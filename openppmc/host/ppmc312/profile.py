"""Acceleration tables of the PPMC-312 from speeds in pulses/s: linear and sigmoid. Pure.

A speed is base clock / rate; a rate has 16 bits. A computed table has 127 stages, a free curve has 2 to 127.
Only `read_stages` does I/O: it reads the file of a free curve.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from io import StringIO
from math import ceil
from pathlib import Path
from typing import NamedTuple

from ...model.ppmc312 import stages as tables
from ...model.ppmc312.stages import DIVIDERS, LEAST_PULSES, STAGES, SettingError, Table
from ...parts import part
from ...textfile import NotTextError, read_text
from .. import speeds as units
from ..capabilities import COILS_OFF, CURVES, FREE_CURVES, LONG, OWN_STOP, PHASES, Capabilities, SetupRequest
from ..errors import OutOfRange
from . import blocks
from .errors import command_error

# Free curves of the PPMC-312: 2 to 127 stages from a list or a CSV file.

LEAST_TICKS = 256
"""Shortest duration of a stage that the data sheet permits, in base clock cycles (pulses times rate)."""


class Stage(NamedTuple):
    """Stage of a free curve.

    Attributes:
        pps: speed.
        up: pulses at this speed during the acceleration.
        down: pulses at this speed during the deceleration; `None` if the stage is not part of it.
    """

    pps: float
    up: int | None
    down: int | None = None


def plan_curve(clock: units.BaseClock, stages: Iterable[Sequence[float | int | None]]) -> Setup:
    """Return the set-up of a free curve.

    If no stage states pulses for the deceleration, the deceleration is the reversed acceleration.

    Args:
        stages: (pps, pulses) or (pps, pulses up, pulses down), slowest first.

    Raises:
        OutOfRange: the curve is invalid.

    >>> clock = choose_clock(16_000_000, 2500, 1_000_000)
    >>> setup = plan_curve(clock, [(2500, 3), (5000, 4), (10_000, 5)])
    >>> [block.hex(" ") for block in setup.blocks]
    ['02 03 01 01 03', '00 06 00 64 00 c8 01 90', '01 09 00 00 05 00 00 04 00 00 03']
    """
    rows = [Stage(*row) for row in stages]  # type: ignore[arg-type] # users give rows of two or three
    if not 2 <= len(rows) <= STAGES:
        raise OutOfRange(f"a free curve of {len(rows)} stages: 2 to {STAGES} are possible")
    speeds = [clock.choose(row.pps, f"stage {place}: speed") for place, row in enumerate(rows, 1)]
    separate = any(row.down is not None for row in rows)
    sides = [[row.up for row in rows], [row.down for row in rows] if separate else []]
    counts = [_side(values, name) for values, name in zip(sides, ("up", "down"), strict=True)]
    if max(len(side) for side in counts) < len(rows):
        raise OutOfRange("stage 1: pulses are missing on both sides: leave the stage out")
    for place, (speed, row) in enumerate(zip(speeds, rows, strict=True), 1):
        for pulses in (row.up, row.down):
            if pulses is not None and pulses * speed.rate < LEAST_TICKS:
                raise OutOfRange(
                    f"stage {place}: {pulses} pulses at {speed} last less than {LEAST_TICKS} base clocks: "
                    "give it more pulses"
                )
    rates = [speed.rate for speed in reversed(speeds)]
    up, down = (list(reversed(side)) for side in counts)
    try:
        table = tables.curve(rates, up, down if separate else None, clock.clk)
    except SettingError as error:
        raise OutOfRange(f"free curve: {command_error(0xF0, bytes([error.number]))}") from None
    return Setup(
        clock,
        speeds[len(rows) - len(up)],
        speeds[len(rows) - len(down or up)],
        speeds[-1],
        table,
        "free curve",
    )


def plan_file(
    xtal_hz: int,
    path: Path,
    base_clock: units.Number | None = None,
    external_clock: units.Number | None = None,
) -> Setup:
    """Return the set-up of a free curve from a file. The clock arguments are those of `choose_clock`.

    Raises OutOfRange if the file is invalid or the part cannot output the curve.
    """
    return plan_stages(xtal_hz, read_stages(path), base_clock, external_clock)


def plan_stages(
    xtal_hz: int,
    stages: Iterable[Sequence[float | int | None]],
    base_clock: units.Number | None = None,
    external_clock: units.Number | None = None,
) -> Setup:
    """Select a base clock that reaches the speed of the slowest stage; return the set-up of `plan_curve`."""
    rows = [tuple(row) for row in stages]
    slowest = min((float(row[0] or 0) for row in rows), default=0.0)
    return plan_curve(choose_clock(xtal_hz, slowest, base_clock, external_clock), rows)


def _side(values: Sequence[int | None], name: str) -> list[int]:
    """Return the pulses of the stages for one ramp, beginning with the first stage that has pulses."""
    given = [place for place, pulses in enumerate(values) if pulses is not None]
    if not given:
        return []
    rest = values[given[0] :]
    if None in rest:
        raise OutOfRange(f"stage {given[0] + rest.index(None) + 1}: pulses {name} are missing")
    if len(rest) < 2:
        raise OutOfRange(f"pulses {name}: a side has 2 stages or more")
    return [int(pulses) for pulses in rest if pulses is not None]


def read_stages(path: Path) -> list[Stage]:
    """Read stages from a CSV file: speed in pps, pulses up[, pulses down], slowest first.

    A heading in the first line, and lines that begin with #, are ignored.

    Raises:
        OutOfRange: the file is invalid; the message states file and line.
    """
    stages: list[Stage] = []
    try:
        with StringIO(read_text(path)) as file:
            for place, row in enumerate(csv.reader(file), 1):
                cells = [cell.strip() for cell in row]
                if not any(cells) or cells[0].startswith("#") or (not stages and _is_names(cells)):
                    continue
                try:
                    pps, up, down = (
                        float(cells[0]),
                        *(int(c) if c else None for c in (*cells[1:], "", "")[:2]),
                    )
                    if len(cells) > 3:
                        raise ValueError
                except ValueError:
                    raise OutOfRange(
                        f"{path}:{place}: a line is a speed in pps, whole pulses up and perhaps pulses down"
                    ) from None
                stages.append(Stage(pps, up, down))
    except OSError as error:
        raise OutOfRange(f"{path}: cannot be read ({error.strerror})") from error
    except NotTextError as error:
        raise OutOfRange(f"{path}: not a text file in UTF-8 or UTF-16: {error}") from error
    return stages


def _is_names(cells: Sequence[str]) -> bool:
    """Return True if this line is a heading: names without a number."""
    return not any(cell[:1].isdigit() or cell[:1] in ".-+" for cell in cells if cell)


# Capabilities of a PPMC-312.


class TableCapabilities(Capabilities):
    """Capabilities of a part with 16-bit rates.

    A speed is base clock / rate. The table of a set-up also selects the base clock. The part has no phase
    outputs, and no straps that select a function.
    """

    def plan(self, xtal_hz: int, request: SetupRequest) -> Setup:
        self.check_axis(request.axis)
        motor = request.half_step or request.phases != 4 or request.chop or request.positive_logic
        for requested, what in (
            (motor, PHASES),
            (request.long_intervals, LONG),
            (request.own_stop, OWN_STOP),
            (request.curve is not None, FREE_CURVES),
        ):
            if requested:
                self.need(what)
        clocks = (request.base_clock, request.external_clock)
        if request.curve is not None:
            if request.sigmoid or request.own_stop:
                raise OutOfRange("a free curve has its own speeds and pulses: give either it or those")
            return plan_file(xtal_hz, Path(request.curve), *clocks)
        start, stop = request.start_pps, request.stop_pps
        clock = choose_clock(xtal_hz, start if stop is None else min(start, stop), *clocks)
        ramp = self.usual_ramp if request.ramp_pulses is None else request.ramp_pulses
        return plan_setup(clock, start, request.high_pps, ramp, stop, request.down_pulses, request.sigmoid)


CAPABILITIES = TableCapabilities(
    part("ppmc312"),
    has=frozenset((COILS_OFF, OWN_STOP, CURVES, FREE_CURVES)),
    outputs=63,
    alarm=("alarm input", "clear the drive's alarm, then the part's"),
    origin_between=True,
    usual_ramp=2000,
)


SLOWEST_RATE, FASTEST_RATE = 0xFFFF, 2
RISING = 6
MOST_HZ = 2_000_000


def base_clocks(xtal_hz: int) -> list[units.BaseClock]:
    """Return the internal base clocks, fastest first.

    >>> [float(clock.hertz) for clock in base_clocks(16_000_000)]
    [8000000.0, 1000000.0, 500000.0, 250000.0, 62500.0, 15625.0]
    >>> base_clocks(16_000_000)[1].choose(1000).rate
    1000
    """
    return [_clock(Fraction(divider, xtal_hz), clk) for clk, divider in DIVIDERS.items()]


def _clock(period: Fraction, clk: int, external: bool = False) -> units.BaseClock:
    return units.BaseClock(
        period,
        external=external,
        least_rate=FASTEST_RATE,
        beyond=0,
        slowest_rate=SLOWEST_RATE,
        clk=clk,
    )


def choose_clock(
    xtal_hz: int,
    slowest_pps: units.Number,
    base_clock: units.Number | None = None,
    external_clock: units.Number | None = None,
) -> units.BaseClock:
    """Return the base clock of a table.

    Args:
        slowest_pps: slowest speed of the table.
        base_clock: frequency in Hz. `None` selects the fastest clock that reaches the slowest speed, because
            this clock has the finest speed resolution.
        external_clock: frequency at the pin extck in Hz, up to 2 MHz.

    Raises:
        OutOfRange: the part does not have this base clock.
    """
    if external_clock is not None:
        if not 0 < units.exact(external_clock, "external clock") <= MOST_HZ:
            raise OutOfRange(f"external clock {units.nearby(external_clock)} Hz is outside 0 to {MOST_HZ} Hz")
        return _clock(1 / Fraction(external_clock), RISING, external=True)
    clocks = base_clocks(xtal_hz)
    if base_clock is None:
        slowest = units.exact(slowest_pps, "start speed")
        return next((clock for clock in clocks if clock.slowest <= slowest), clocks[-1])
    for clock in clocks:
        if clock.hertz == units.exact(base_clock, "base clock"):
            return clock
    there = ", ".join(units.nearby(clock.hertz) for clock in clocks)
    raise OutOfRange(f"base clock {units.nearby(base_clock)} Hz: this part has {there} Hz")


@dataclass(frozen=True)
class Setup:
    """Table of a set-up, and the instruction blocks that load it.

    Attributes:
        start, stop, high: speeds of the table, as requested and as reached.
    """

    clock: units.BaseClock = field(repr=False)
    start: units.Speed
    stop: units.Speed
    high: units.Speed
    table: Table = field(repr=False)
    shape: str

    def __str__(self) -> str:
        stop = f", stop {self.stop}, down {self.table.nd} pulses" if self.table.separate else ""
        ramp = f"{self.shape}{'' if self.shape == 'free curve' else ' ramp'} {self.ramp_pulses} pulses"
        return f"start {self.start}, high {self.high}, {ramp}{stop}, {self.clock}"

    @cached_property
    def blocks(self) -> list[bytes]:
        """Instruction blocks that load the table, in logical order."""
        table, clk = self.table, self.clock.clk
        if self.shape == "free curve":
            lists = [list(reversed(values)) for values in (table.rates, table.pa, table.pd)]
            rates, up, down = (
                values[: STAGES - first]
                for values, first in zip(lists, (table.first, table.sa, table.sd), strict=True)
            )
            return blocks.free_curve(clk, rates, up, down if table.separate else None)
        speeds, sigmoid = (self.start.rate, self.high.rate), self.shape == "sigmoid"
        if not table.separate:
            return [blocks.initial_setting(clk, *speeds, table.na, sigmoid=sigmoid)]
        return [blocks.initial_setting(clk, *speeds, table.na, self.stop.rate, table.nd, sigmoid)]

    @property
    def ramp_pulses(self) -> int:
        """Pulses of the acceleration."""
        return self.table.na

    def seconds(self, pulses: Sequence[int]) -> float:
        """Return the duration in s of a ramp with these numbers of pulses.

        The argument is `table.pa` for the acceleration and `table.pd` for the deceleration.
        """
        ticks = sum(n * rate for n, rate in zip(pulses, self.table.rates, strict=True))
        return float(ticks * self.clock.period)

    def rate_of(self, pps: units.Number, what: str = "speed") -> int:
        """Return the rate of a speed within the table. Raises OutOfRange."""
        rate = self.clock.choose(pps, what).rate
        if not self.table.contains(rate):
            low, high = (
                units.nearby(self.clock.speed(rate)) for rate in (self.table.slowest, self.table.high)
            )
            raise OutOfRange(
                f"{what} {units.nearby(pps)} pps is outside {low} to {high} pps, the speeds of the table"
            )
        return rate


def plan_setup(
    clock: units.BaseClock,
    start_pps: units.Number,
    high_pps: units.Number,
    up: int,
    stop_pps: units.Number | None = None,
    down: int | None = None,
    sigmoid: bool = False,
) -> Setup:
    """Return the set-up of a linear or sigmoid table.

    Args:
        up: pulses of the acceleration, 24 bits.
        stop_pps: final speed of the deceleration, default: start_pps.
        down: pulses of the deceleration, 24 bits, default: up.

    Raises:
        OutOfRange: the part would reject this table.

    >>> setup = plan_setup(base_clocks(16_000_000)[1], 1000, 5000, 2000)
    >>> setup.blocks[0].hex(" ")
    '03 09 00 01 03 e8 00 c8 00 07 d0'
    >>> plan_setup(base_clocks(16_000_000)[1], 1000, 5000, 761)
    Traceback (most recent call last):
    openppmc.host.errors.OutOfRange: 761 pulses: the ramp is too short: each of its stages needs 2 \
pulses: 762 or more
    """
    separate = stop_pps is not None or down is not None
    start, high = clock.choose(start_pps, "start speed"), clock.choose(high_pps, "high speed")
    stop = start if stop_pps is None else clock.choose(stop_pps, "stop speed")
    down = up if down is None else down
    for pulses, what in ((up, "acceleration"), (down, "deceleration")):
        if not 1 <= pulses <= 0xFFFFFF:
            raise OutOfRange(f"{what} of {pulses} pulses is outside 1 to {0xFFFFFF}")
    numbers = (start.rate, stop.rate, high.rate)

    try:
        table = tables.build(*numbers, up, down, clock.clk, sigmoid, separate)
    except SettingError as error:
        text = str(command_error(0xF0, bytes([error.number])))
        if error.number == 5:
            least = _least(numbers, sigmoid)
            which = f"{least[0]} up and {least[1]} down" if separate else f"{least[0]}"
            raise OutOfRange(f"{up} pulses: {text}: {which} or more") from None
        raise OutOfRange(f"start {start}, stop {stop}, high {high}: {text}") from None
    return Setup(clock, start, stop, high, table, "sigmoid" if sigmoid else "linear")


def _least(numbers: tuple[int, int, int], sigmoid: bool) -> list[int]:
    """Return the smallest permitted numbers of pulses for the acceleration and the deceleration.

    The slowest stage of a ramp has the fewest pulses, so it determines the limit. A linear ramp over all 127
    stages requires about 127 * (1 + Rs / RH) pulses (P312-TBL-04, P312-TBL-05).
    """
    start, stop, high = numbers
    speeds = tables.speeds(max(start, stop), high, sigmoid)
    rates = [int(1 / speed + Fraction(1, 2)) for speed in speeds]
    firsts = (tables.first_stage(rates, slow) for slow in (start, stop))
    return [ceil(LEAST_PULSES * sum(speeds[first:]) / speeds[first]) for first in firsts]
