"""`--at POSITION:WHAT`, and the same words in scripts: what a part does when it comes by a position."""

from __future__ import annotations

from dataclasses import dataclass

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
