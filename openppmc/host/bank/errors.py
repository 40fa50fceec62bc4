"""What a bank refuses, by axis."""

# ruff: noqa: N818

from __future__ import annotations

from collections.abc import Mapping

from ..basis.errors import PpmcError
from ..basis.refusals import BY_NUMBER, CommandRefused, NothingToStop

NOTHING_HELD = "GO found no motion that it holds: start one while it is in the group"


def refused(status: int, number: int) -> CommandRefused:
    """The exception for a status byte with ERR = 1 of the axis with this number."""
    kind = BY_NUMBER[status >> 4 & 7]
    return kind(status, f"axis {number}: {kind.text}")


def go_refused(status: int, number: int) -> CommandRefused:
    """The same after GO (BANK-GRP-02)."""
    error = refused(status, number)
    return NothingToStop(status, f"axis {number}: {NOTHING_HELD}") if type(error) is NothingToStop else error


class GroupRefused(PpmcError):
    """Axes of a group did not begin with the others, which run. refusals: the reason of each, by number."""

    def __init__(self, refusals: Mapping[int, CommandRefused]) -> None:
        super().__init__("; ".join(str(one) for one in refusals.values()))
        self.refusals = dict(refusals)
