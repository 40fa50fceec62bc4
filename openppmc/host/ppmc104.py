"""Driver of a PPMC-104 on a UART bridge, and the capabilities of the part."""

from __future__ import annotations

from ..parts import part
from . import speeds
from .capabilities import AUX, CHOPPER, COILS_OFF, LONG, POSITIVE, PULSE_ONLY, RateCapabilities
from .errors import AxisBusy, OutOfRange
from .part import OneAxis
from .registers import Inputs
from .script import Result, Script

CAPABILITIES = RateCapabilities(
    part("ppmc104"), has=frozenset((POSITIVE, LONG, PULSE_ONLY, COILS_OFF, CHOPPER, AUX))
)


READ_AUXI, AUX_OUTPUT, AUX_ON, AUX_OFF = 0x85, 0x86, 0xC1, 0xC2
_OTHER_STRAPS = 0xFC
_START_XT = 1792
"""Largest number of crystal cycles from the last byte of an operation until BUSY rises.

This is 112 us at 16 MHz (P104-DS-03).
"""


class Ppmc104(OneAxis):
    """One PPMC-104; see `part.OneAxis`.

    Limits of `initialise` for a 16 MHz crystal: speeds 488.3 to 500 000 pps, ramp_pulses 4 to 11 220,
    base_clock 500 000 or 125 000 Hz. The arguments phases, half_step and positive_logic have no effect on a
    part that is already initialised; first call `excitation_off` or `reset`.
    """

    kind = CAPABILITIES

    def _strap_script(self, clock: speeds.BaseClock | None) -> Script:
        script = Script()
        return script if clock is None else script.straps(_OTHER_STRAPS | clock.vsel << 1 | clock.csel)

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self._pins())

    def _at_rest(self, script: Script) -> None:
        identity = self.link.identity
        if identity.datasheet:
            # The previous command may start a motion that has not begun yet, so wait until its latest start.
            # The bridge may wait 1 ms less than the limit.
            limit = 2 + _START_XT * 1000 // identity.xtal_hz
            answer = self.link.attempt(Script().timeout(limit).wait(1, self._busy_mask, self._busy_mask))
            if answer.result is not Result.TIMED_OUT:
                raise AxisBusy(self.link.check_answer(answer).byte(0))
        super()._at_rest(script)

    # ------------------------------------------------------------------ auxiliary

    def aux(self, on: bool) -> None:
        """Set the AUX output (on = pin low)."""
        self.link.execute(Script().call(AUX_ON if on else AUX_OFF))

    def auxo(self, value: int) -> None:
        """Set the four auxiliary outputs, 0 to 15; a 1 sets a pin low."""
        if not 0 <= value <= 15:
            raise OutOfRange(f"auxiliary outputs {value} are outside 0 to 15")
        self.link.execute(Script().call(AUX_OUTPUT, value))

    def auxi(self) -> int:
        """Return the four auxiliary inputs as pin levels. The call is not allowed during a motion."""
        return self.link.execute(Script().call(READ_AUXI).get(1)).byte(1)
