"""Driver of an STMC on a UART bridge, with capabilities, errors and registers of the part."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..model.single.codes import Error
from ..model.stmc.codes import BOARD_CLOCK_HZ, TICK_XT
from ..parts import part
from . import speeds
from .capabilities import POSITIVE, Capabilities, RateCapabilities, SetupRequest
from .errors import BY_NUMBER, CommandRefused, OutOfRange
from .link import Link
from .part import OneAxis
from .registers import FAMILY, ReadCodes, Switches
from .script import Result, Script
from .speeds import BaseClock, Number, pin_period

# Errors of an STMC. The meaning of two numbers differs from that in the PPMC family.

_TEXTS = {
    Error.NOT_INITIALISED: "the part is not initialised (power-up or reset): initialise it first",
    Error.BAD_RAMP: "the part rejects a divisor: it is 0, or the one of the high speed exceeds the other",
}


def command_error(status: int) -> CommandRefused:
    """Return the exception for a status byte with ERR = 1."""
    number = status >> 4 & 7
    return BY_NUMBER[number](status, _TEXTS.get(Error(number), ""))


# ---------------------------------------------------------------------- registers


@dataclass(frozen=True)
class Inputs(Switches):
    """Switches of an STMC.

    Attributes:
        motor_off: True if MON is low.
    """

    motor_off: bool


# ---------------------------------------------------------------------- step clocks

LEAST_DIVISOR = 5
"""Lowest divisor that the driver uses.

The part accepts lower divisors as well, but the data sheet advises against them.
"""


def divided_clock(hertz: Number, external: bool = True) -> BaseClock:
    """Return a step clock. A speed is its frequency / divisor, with divisors up to 255 (STMC-INI-01).

    Args:
        hertz: frequency, 0 < hertz <= 1e6.
        external: True for the clock of the board, or a clock at the `ext_clk` pin.

    Raises:
        OutOfRange: the frequency is out of range.

    The examples of the data sheet, with the external clock of its board:

    >>> clock = divided_clock(48_675)
    >>> clock.choose(345).rate, clock.choose(825).rate
    (141, 59)
    >>> clock.speed(59)
    Fraction(825, 1)

    Divisors below 5 are not used, as the data sheet advises:

    >>> float(clock.slowest), float(clock.fastest)
    (190.88235294117646, 9735.0)
    >>> float(divided_clock(12_500, external=False).fastest)
    2500.0
    """
    return BaseClock(pin_period(hertz), external=external, least_rate=LEAST_DIVISOR, beyond=0)


# ---------------------------------------------------------------------- capabilities on the J105 board

BOARD_CLOCK = BOARD_CLOCK_HZ
"""Second step clock of the J105 board."""


class StmcCapabilities(RateCapabilities):
    """Capabilities of an STMC.

    A speed is step clock / divisor, and the initialisation selects the clock.
    """

    def constant_clock(
        self, xtal_hz: int, ramp: speeds.BaseClock | None, pps: speeds.Number
    ) -> speeds.BaseClock:
        return Capabilities.constant_clock(self, xtal_hz, ramp, pps)

    def ramp_clock(self, xtal_hz: int, request: SetupRequest) -> speeds.BaseClock:
        if request.external_clock is not None:
            return divided_clock(request.external_clock)
        internal = divided_clock(Fraction(xtal_hz, TICK_XT), external=False)
        board = divided_clock(BOARD_CLOCK)
        if request.base_clock is None:
            return board if board.slowest <= speeds.exact(request.start_pps, "start speed") else internal
        for clock in (internal, board):
            if clock.hertz == speeds.exact(request.base_clock, "base clock"):
                return clock
        raise OutOfRange(
            f"base clock {speeds.nearby(request.base_clock)} Hz: this board has "
            f"{speeds.nearby(internal.hertz)} and {BOARD_CLOCK} Hz"
        )


CAPABILITIES = StmcCapabilities(
    part("stmc"),
    has=frozenset((POSITIVE,)),
    outputs=0,
    lengths=(0, 65_535),
    alarm=("MON input", "switch the motor on (MON high)"),
    origin_between=True,
)


READ_MAPS = {"FAMILY": FAMILY, "SHEET": ReadCodes(outputs=0x83, remaining=0x84)}
"""Sets of codes of the read commands, by name; the default is first (ruling R-01)."""


class Stmc(OneAxis):
    """One STMC; see `part.OneAxis`.

    The part has no pulse output, so the board counts the steps of the phases.

    Arguments of `initialise`: a speed is step clock / divisor, with divisors 5 to 255. base_clock: 12 500 Hz
    (internal, at a 16 MHz crystal: 49.02 to 2500 steps/s) or 48 675 Hz (of the board: 190.9 to 9735 steps/s);
    `None`: 48 675 Hz if this clock reaches start_pps, otherwise 12 500 Hz. external_clock: frequency in Hz if
    another clock is connected. ramp_pulses: steps from start to high speed, 0 to 65 535; with 0, there is no
    ramp, and the motor starts at high_pps. long_intervals is not supported. phases, half_step and
    positive_logic do not change until `reset` (STMC-INI-04). Constant speeds also use the step clock of the
    last initialisation.

    A search (command 7) also ends at the deceleration limit of its direction (ruling R-19).
    """

    kind = CAPABILITIES

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        link.refusal = lambda answer: command_error(answer.last)
        self._read_map = ""

    @property
    def read_map(self) -> str:
        """Name of the read codes that the part has, a key of READ_MAPS.

        The first use of this property determines it with a read, which is possible in any state.
        """
        if not self._read_map:
            # Code 81h is either the read of the inputs or undefined (error 0). Any other error shows that it
            # is defined.
            answer = self.link.attempt(Script().call(0x81).get(1))
            if answer.result is Result.REFUSED:
                self._read_map = "FAMILY" if answer.last >> 4 & 7 else "SHEET"
            else:
                self.link.check_answer(answer)
                self._read_map = "FAMILY"
        return self._read_map

    @property
    def _read_codes(self) -> ReadCodes:
        return READ_MAPS[self.read_map]

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self._pins())
