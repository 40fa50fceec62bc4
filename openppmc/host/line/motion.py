"""Motions of stations on a line: their ends show only when somebody asks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from ..axis.motion import PROGRESS_POLL, AnyMotion, Progress
from ..basis.ending import End, EndUnknown
from ..basis.errors import Timeout
from .master import Master

POLL_EVERY = 0.02
"""Seconds between two rounds of polls."""


class LineMotion(AnyMotion, Protocol):
    """A motion under way."""

    @property
    def unknown(self) -> EndUnknown | None:
        """Why the part does not confirm its end, None if it does or the motion is not over."""

    @property
    def line(self) -> Master[Any]:
        """Where its station is."""

    @property
    def station(self) -> int:
        """Its number."""

    def look(self) -> None:
        """Ask the station; sets `end`, or `unknown`, when the motion is over."""

    def now(self) -> Progress:
        """Where the motor is, or where the motion has ended."""


def wait_all(
    motions: Sequence[LineMotion],
    timeout: float | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> list[End]:
    """Ask the stations until their motions are over; ends in the same order, not judged.

    timeout: s for all of them, None for ever; Timeout leaves the rest running. progress: called about ten
    times a second, with pulses summed up if there are several motions. Raises EndUnknown as soon as one
    motion is over without a confirmed end; the rest run on.
    """
    if not motions:
        return []
    line = motions[0].line
    limit = None if timeout is None else line.clock() + timeout
    due = line.clock() + PROGRESS_POLL
    while True:
        for motion in motions:
            if not motion.over:
                motion.look()
        running = [motion for motion in motions if not motion.over]
        for motion in motions:
            if motion.unknown is not None:
                raise motion.unknown
        if not running:
            return [motion.end for motion in motions if motion.end is not None]
        if limit is not None and line.clock() >= limit:
            who = ", ".join(str(motion.station) for motion in running)
            raise Timeout(f"station {who}: not over after {timeout:g} s: wait longer or stop it")
        if progress is not None and line.clock() >= due:
            progress(_sum(motions))
            due = line.clock() + PROGRESS_POLL
        line.pause(POLL_EVERY)


def _sum(motions: Sequence[LineMotion]) -> Progress:
    """Progress of several motions together; position is the first one's that still runs."""
    known = [(motion, motion.now()) for motion in motions]
    asked = [motion.asked for motion in motions]
    first = next(now for motion, now in known if motion.end is None)
    return Progress(
        first.position,
        sum(now.made for _, now in known),
        None if None in asked else sum(filter(None, asked)),
        max(now.seconds for _, now in known),
    )
