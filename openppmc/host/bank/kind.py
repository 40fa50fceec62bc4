"""What a bank of PPMC-104 axes allows. Pure."""

from __future__ import annotations

from ...parts import part
from ..axis.kind import RateKind
from ..basis import units
from ..basis.kind import COILS_OFF, LONG, POSITIVE, PULSE_ONLY, Wanted

SIZES = (4, 8, 16, 32, 64)
"""Numbers of axes that there are (BANK-GEN-01)."""


class BankKind(RateKind):
    """As a PPMC-104, but for what BANK-GEN-03 leaves out."""

    def ramp_clock(self, xtal_hz: int, wanted: Wanted) -> units.BaseClock:
        if wanted.external_clock is not None:
            self.need("external clock")
        return super().ramp_clock(xtal_hz, wanted)


KIND = BankKind(
    part("bank"),
    axes=SIZES[-1],
    has=frozenset((POSITIVE, LONG, PULSE_ONLY, COILS_OFF)),
    outputs=0,
)
"""Of the largest one; a driver has that of its bank."""
