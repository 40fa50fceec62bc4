"""Step clocks of an STMC: a speed is the clock over a divisor (STMC-INI-01). Pure."""

from __future__ import annotations

from ..basis.units import BaseClock, Number, pin_period

LEAST_DIVISOR = 5
"""The sheet advises against lower ones; the part would take them."""


def divided(hertz: Number, external: bool = True) -> BaseClock:
    """Step clock, 0 < hertz <= 1e6 (else OutOfRange); rate bytes are divisors, up to 255. external: it is the
    one that the board makes, or the `ext_clk` pin.

    The worked examples of the sheet, with the external clock of its board:

    >>> clock = divided(48_675)
    >>> clock.choose(345).rate, clock.choose(825).rate
    (141, 59)
    >>> clock.speed(59)
    Fraction(825, 1)

    Divisors below 5 are left out, as the sheet advises:

    >>> float(clock.slowest), float(clock.fastest)
    (190.88235294117646, 9735.0)
    >>> float(divided(12_500, external=False).fastest)
    2500.0
    """
    return BaseClock(pin_period(hertz), external=external, least_rate=LEAST_DIVISOR, beyond=0)
