"""What an STMC refuses: the numbers of the family, two of them with another meaning."""

from __future__ import annotations

from ...model.single.codes import Error
from ..basis.refusals import BY_NUMBER, CommandRefused

_TEXTS = {
    Error.NOT_INITIALISED: "the part is not initialised (power-up or reset): initialise it first",
    Error.BAD_RAMP: "the part refuses a divisor: 1 or more, and that of the high speed not above the other",
}


def refused(status: int) -> CommandRefused:
    """The exception for a status byte of an STMC with ERR = 1."""
    number = status >> 4 & 7
    return BY_NUMBER[number](status, _TEXTS.get(Error(number), ""))
