"""Prediction of one move from its initialisation bytes, for plots and tables.

A prediction contains pulse times and speeds.

`predict_move` calls the `predict` function of the part, which the table of parts names. This module contains
the shared code of parts with four initialisation bytes.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Protocol

from ... import parts
from ..clock import Timebase
from ..motion.ramp import BaseClock, Ramp, profile_index


@dataclass(frozen=True)
class Move(ABC):
    """Predicted move.

    Attributes:
        clk: `clk[j]` is the time from pulse 1 to pulse j + 1 in cycles.
        indices: ramp index of the interval after each pulse; `None`, or an empty tuple, at constant speed.
        rates: rate of the interval after each pulse.
    """

    timebase: Timebase
    clk: tuple[int, ...]
    indices: tuple[int | None, ...]
    rates: tuple[int, ...]

    @property
    def seconds(self) -> list[float]:
        """Times of the pulses in s after pulse 1."""
        return [self.timebase.seconds(t) for t in self.clk]

    @property
    @abstractmethod
    def speeds(self) -> list[float]:
        """Speed of each interval in pulses per second."""

    @property
    def intervals(self) -> list[int]:
        """Length of each interval between two pulses in cycles."""
        return [b - a for a, b in zip(self.clk, self.clk[1:], strict=False)]


@dataclass(frozen=True)
class RampMove(Move):
    """Predicted move of a part with rates or divisors of one byte.

    Attributes:
        quanta: length of each interval in quanta.
    """

    quanta: tuple[int, ...]

    @property
    def speeds(self) -> list[float]:
        return [self.timebase.xtal_hz / (self.timebase.quantum * q) for q in self.quanta]


class Predict(Protocol):
    """Function `predict` of a part; the arguments are those of `predict_move`."""

    def __call__(
        self, init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
    ) -> Move:
        """Return the move. Raises ValueError for values that the part rejects."""


def predict_move(
    init: bytes,
    n: int,
    rate: int | None = None,
    csel: int = 1,
    vsel: int = 1,
    timebase: Timebase | None = None,
    part: str = "ppmc104",
) -> Move:
    """Return the prediction of an undisturbed move of n pulses with the internal clock.

    Args:
        init: the four initialisation bytes RL, RH, PA low, PA high; for "ppmc312", the parameters of an
            initial setting (for free curves, use `ppmc312.carrier`).
        n: number of pulses, 1..2^24.
        rate: `None` for a move with ramps, otherwise the rate of a constant-speed move.
        csel: level of the pin csel.
        vsel: level of the pin vsel.
        part: "ppmc104", "ppmc2104" (has no vsel, leave it 1), "stmc" (has neither csel nor vsel; rates are
            divisors) or "ppmc312".

    Raises:
        ValueError: the part would reject the bytes, or n is out of range.
    """
    predict: Predict = parts.part(part).load("predict")
    return predict(init, n, rate, csel, vsel, timebase)


@dataclass(frozen=True)
class Limits:
    """Limits of a part.

    Attributes:
        slower: smallest permitted difference RL - RH.
        least: smallest permitted rate byte with the internal clock.
        shortest, longest: range of the ramp pulses PA.
    """

    slower: int
    least: int
    shortest: int
    longest: int

    def check(self, init: bytes, n: int, rate: int | None) -> tuple[int, int, int]:
        """Return RL, RH and PA.

        Raises ValueError for values that the part rejects, and for n outside 1..2^24.
        """
        if len(init) != 4:
            raise ValueError(f"an initialisation has 4 data bytes, not {len(init)}")
        rl, rh, pa = init[0], init[1], init[2] | init[3] << 8
        if rh < self.least or rl < rh + self.slower or not self.shortest <= pa <= self.longest:
            raise ValueError(f"refused initialisation: RL {rl}, RH {rh}, PA {pa}")
        if not 1 <= n <= 1 << 24:
            raise ValueError(f"{n} pulses")
        if rate is not None and not self.least <= rate <= 255:
            raise ValueError(f"rate {rate}")
        return rl, rh, pa


def run(
    timebase: Timebase, clock: BaseClock, ramp: Ramp, n: int, rate: int | None, beyond: int = 0
) -> RampMove:
    """Return the prediction of a move whose arguments have been checked.

    Args:
        beyond: number of base clock periods of an interval minus its rate. In the result, this number is
            included in `rates`.
    """
    indices = tuple(profile_index(n, ramp.pa, j) for j in range(1, n)) if rate is None else ()
    rates = tuple(ramp.rate(k) + beyond for k in indices) if rate is None else (rate,) * (n - 1)
    quanta = tuple(clock.quanta(r - beyond) for r in rates)
    ticks, clk = 0, [0]
    for q in quanta:
        ticks += q
        clk.append(timebase.tick(ticks))
    return RampMove(timebase, tuple(clk), indices, rates, quanta)
