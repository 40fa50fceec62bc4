"""Free curves of the PPMC-312: 2 to 127 stages from a list or a CSV file. Pure but for reading the file."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import Path
from typing import NamedTuple

from ...model.ppmc312.stages import tables
from ...model.ppmc312.stages.tables import STAGES, SettingError
from ...textfile import NotTextError, read_text
from ..basis import units
from ..basis.errors import OutOfRange
from .errors import refused
from .profile import Setup, choose_clock

LEAST_TICKS = 256
"""Ticks that a stage lasts at least (pulses times rate), as the sheet asks for."""


class Stage(NamedTuple):
    """A stage of a free curve: speed in pps, pulses at this speed while the motor speeds up (up) and slows
    down (down). None: this side begins with a faster stage."""

    pps: float
    up: int | None
    down: int | None = None


def plan_curve(clock: units.BaseClock, stages: Iterable[Sequence[float | int | None]]) -> Setup:
    """A free curve from its stages, slowest first: (pps, pulses) or (pps, pulses up, pulses down).

    Without pulses down in any stage the deceleration is the acceleration backwards. OutOfRange.

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
        raise OutOfRange(f"free curve: {refused(0xF0, bytes([error.number]))}") from None
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
    """A free curve from a file; clocks as for `choose_clock`. OutOfRange."""
    return plan_stages(xtal_hz, read_stages(path), base_clock, external_clock)


def plan_stages(
    xtal_hz: int,
    stages: Iterable[Sequence[float | int | None]],
    base_clock: units.Number | None = None,
    external_clock: units.Number | None = None,
) -> Setup:
    """`plan_curve` with the base clock that the stages want."""
    rows = [tuple(row) for row in stages]
    slowest = min((float(row[0] or 0) for row in rows), default=0.0)
    return plan_curve(choose_clock(xtal_hz, slowest, base_clock, external_clock), rows)


def _side(values: Sequence[int | None], name: str) -> list[int]:
    """Pulses from the first stage on that has some."""
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
    """Stages from a CSV file: speed in pps, pulses up[, pulses down], slowest first. A first line of names
    and lines that begin with # are passed over. OutOfRange with file and line."""
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
    """A first line of names, no number in it."""
    return not any(cell[:1].isdigit() or cell[:1] in ".-+" for cell in cells if cell)
