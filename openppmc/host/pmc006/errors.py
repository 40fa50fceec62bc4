"""What a PMC006B4 refuses, as exceptions. `status` is the reply data."""

# ruff: noqa: N818

from __future__ import annotations

from ..basis.refusals import CommandRefused


class SettingRefused(CommandRefused):
    """The value in force stays; `status` is that value."""


class LockedByExt(CommandRefused):
    """An EXT stop has come; starts are refused until its flag is cleared."""


class MotorFree(CommandRefused):
    """The motor is switched off (FREE)."""

    text = "the motor is off-line (free): switch it on first (free = 0)"


class SpeedRefused(CommandRefused):
    """Start or stop speed lie above the maximum speed."""


class StorageBusy(CommandRefused):
    """The EEPROM is being written."""

    text = "the EEPROM is still being written: try again in half a second"


class StorageFailed(CommandRefused):
    """The EEPROM has not answered."""

    text = "the EEPROM did not answer, what was to be kept is not: is there one, are its wires right?"


class ProgramRuns(CommandRefused):
    """A user program runs."""

    text = "a user program runs: halt it first"


class ProgramDiffers(CommandRefused):
    """The program that was read back is not the one that was written."""


def locked(numbers: tuple[int, ...], who: str = "") -> LockedByExt:
    """The exception for these EXT flags.

    >>> str(locked((1,)))
    'EXT1 has stopped it: clear the flag (clear_stops, reset-flags), then move off the switch'
    """
    names, flags = " and ".join(f"EXT{number}" for number in numbers), "flags" if len(numbers) > 1 else "flag"
    have = "have" if len(numbers) > 1 else "has"
    return LockedByExt(
        sum(1 << number for number in numbers),
        f"{who}{names} {have} stopped it: clear the {flags} (clear_stops, reset-flags), then move off the "
        "switch",
    )
