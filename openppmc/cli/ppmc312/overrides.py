"""`--at POSITION:WHAT`, and the same words in scripts: what a PPMC-312 does when it comes by a position."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ...host import AnyPart, OutOfRange, Ppmc312

MOST = 8
FARTHEST = 1 << 31


@dataclass(frozen=True)
class Override:
    """At a position: another speed in pps (with a ramp), or a stop, `now` at once."""

    at: int
    speed: float | None = None
    now: bool = False


def parse_override(text: str) -> Override:
    """`2000:stop`, `2000:halt` or `2000:3500`. Raises ValueError."""
    place, colon, what = (piece.strip() for piece in text.partition(":"))
    try:
        at = int(place)
        if not (colon and -FARTHEST <= at < FARTHEST):
            raise ValueError
        if what in ("stop", "halt"):
            return Override(at, now=what == "halt")
        speed = float(what)
        if not 0 < speed < float("inf"):
            raise ValueError
    except ValueError:
        raise ValueError(f"{text!r} is not POSITION:stop, POSITION:halt or POSITION:PPS") from None
    return Override(at, speed)


def register(part: AnyPart, overrides: Iterable[Override]) -> None:
    """Tell the part, in this order. OutOfRange for other parts, and for what it cannot do."""
    wanted = list(overrides)
    if not wanted:
        return
    if not isinstance(part, Ppmc312):
        raise OutOfRange(f"overrides: a {part.kind} does not have that")
    if len(wanted) > MOST:
        raise OutOfRange(f"{len(wanted)} overrides: a {part.kind} keeps {MOST}")
    for one in wanted:
        if one.speed is None:
            part.override_stop(at=one.at, slow=not one.now)
        else:
            part.override_speed(one.speed, at=one.at)


def watch(part: AnyPart, distance: int | None) -> None:
    """Look after the encoder. OutOfRange for other parts."""
    if distance is None:
        return
    if not isinstance(part, Ppmc312):
        raise OutOfRange(f"encoder: a {part.kind} does not have one")
    part.watch_encoder(distance)
