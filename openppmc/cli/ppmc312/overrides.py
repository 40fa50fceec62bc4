"""Overrides of a PPMC-312: `--at` and the script word `at`."""

from __future__ import annotations

from collections.abc import Sequence

from ...host import OutOfRange, Ppmc312
from ..common.override import Override

MOST = 8


def register(part: Ppmc312, overrides: Sequence[Override]) -> None:
    """Tell the part, in this order. OutOfRange for what it cannot do."""
    if len(overrides) > MOST:
        raise OutOfRange(f"{len(overrides)} overrides: a {part.kind} keeps {MOST}")
    for one in overrides:
        if one.speed is None:
            part.override_stop(at=one.at, slow=not one.now)
        else:
            part.override_speed(one.speed, at=one.at)
