"""Driver of an STMC, the controller of the J105 board, behind a UART bridge."""

from __future__ import annotations

from ..axis.registers import FAMILY, ReadCodes
from ..axis.single import OneAxis
from ..bridge.answer import Result
from ..bridge.link import Link
from ..bridge.script import Script
from .errors import refused
from .kind import KIND
from .registers import Inputs

READ_MAPS = {"FAMILY": FAMILY, "SHEET": ReadCodes(outputs=0x83, remaining=0x84)}
"""What the codes of its read commands may be, the default first (ruling R-01)."""


class Stmc(OneAxis):
    """One STMC; see `axis.single.OneAxis`. It has no pulse output: the board counts the steps of the phases.

    `initialise`: a speed is step clock / divisor, divisors 5 to 255. base_clock: 12 500 Hz (internal, at a
    16 MHz crystal: 49.02 to 2500 steps/s) or 48 675 Hz (of the board: 190.9 to 9735 steps/s), None to take
    the second one if it reaches start_pps. external_clock: frequency in Hz if another clock is wired.
    ramp_pulses: steps from start to high speed, 0 to 65 535; with 0 there is no ramp, and high_pps at once.
    No long_intervals. phases, half_step and positive_logic stay as they are until `reset` (STMC-INI-04); the
    step clock is that of the last initialisation for constant speeds, too.

    A search (command 7) also ends at the deceleration limit of its direction (ruling R-19).
    """

    kind = KIND

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        link.refusal = lambda answer: refused(answer.last)
        self._read_map = ""

    @property
    def read_map(self) -> str:
        """Which read codes the part knows, a key of READ_MAPS. It is asked the first time, in any state."""
        if not self._read_map:
            # 81h reads the inputs or is undefined: error 0. Any other error is that of a defined command.
            answer = self.link.attempt(Script().call(0x81).get(1))
            if answer.result is Result.REFUSED:
                self._read_map = "FAMILY" if answer.last >> 4 & 7 else "SHEET"
            else:
                self.link.judge(answer)
                self._read_map = "FAMILY"
        return self._read_map

    @property
    def codes(self) -> ReadCodes:
        return READ_MAPS[self.read_map]

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self.pins())
