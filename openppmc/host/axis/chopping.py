"""The chopper at rest of the parts that have that of the PPMC-104 (P104-SW-04)."""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

from ..basis.arguments import Checked
from ..basis.errors import OutOfRange
from ..basis.units import Number, Setup, exact, nearby
from ..bridge.link import Talk
from ..bridge.script import Script

SWITCHING = 0x84


def chop_byte(xtal_hz: int, microseconds: Number, phase: str, vsel: int) -> tuple[int, Fraction]:
    """Parameter byte of the chopper nearest to a time, and the time it makes in us (P104-SW-04).

    phase: "on" or "off". Raises OutOfRange with the possible range.
    """
    quantum = Fraction(4_000_000, xtal_hz)
    offset = {("on", 1): 108, ("on", 0): 100, ("off", 1): 132, ("off", 0): 115}[phase, vsel] * quantum
    unit = 12 * quantum
    low, high = offset, offset + 255 * unit
    asked = exact(microseconds, f"{phase} time")
    if not low <= asked <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = min(255, int((asked - offset) / unit + Fraction(1, 2)))
    return byte, offset + byte * unit


class Chopped(Protocol):
    """What `Chopping` needs of its axis. setup: its initialisation, if known."""

    setup: Setup | None

    @property
    def link(self) -> Talk: ...


class Chopping(Checked):
    """For an axis that is `Chopped`."""

    def switching(self: Chopped, on_us: Number, off_us: Number) -> tuple[Fraction, Fraction]:
        """Times of the chopper at rest in us (16 MHz: on 27 to 792, off 33 to 798); returns those reached."""
        vsel = self.setup.clock.vsel if self.setup else 1
        on = chop_byte(self.link.identity.xtal_hz, on_us, "on", vsel)
        off = chop_byte(self.link.identity.xtal_hz, off_us, "off", vsel)
        self.link.execute(Script().call(SWITCHING, on[0], off[0]))
        return on[1], off[1]
