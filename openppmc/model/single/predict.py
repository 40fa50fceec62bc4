"""Prediction of one move from its initialisation bytes: pulse times and speeds, for plots and tables.

`predict_move` asks the part's own `predict.py`, which the table of parts names; what those of parts with four
initialisation bytes have in common is here.
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
    """A predicted move. `clk[j]` is pulse j+1 in clk after pulse 1; `indices` (of the ramp; None, or no
    indices at all, at constant speed) and `rates` belong to the intervals that follow the pulses."""

    timebase: Timebase
    clk: tuple[int, ...]
    indices: tuple[int | None, ...]
    rates: tuple[int, ...]

    @property
    def seconds(self) -> list[float]:
        """Pulse times in s after pulse 1."""
        return [self.timebase.seconds(t) for t in self.clk]

    @property
    @abstractmethod
    def speeds(self) -> list[float]:
        """Speed of each interval in pulses per second."""

    @property
    def intervals(self) -> list[int]:
        """Length of each interval between two pulses in clk."""
        return [b - a for a, b in zip(self.clk, self.clk[1:], strict=False)]


@dataclass(frozen=True)
class RampMove(Move):
    """One with rates or divisors of a byte. `quanta`: length of each interval."""

    quanta: tuple[int, ...]

    @property
    def speeds(self) -> list[float]:
        return [self.timebase.xtal_hz / (self.timebase.quantum * q) for q in self.quanta]


class Predict(Protocol):
    """What a part's `predict.py` has; the arguments are those of `predict_move`."""

    def __call__(
        self, init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
    ) -> Move:
        """The move. Raises ValueError for what the part refuses."""


def predict_move(
    init: bytes,
    n: int,
    rate: int | None = None,
    csel: int = 1,
    vsel: int = 1,
    timebase: Timebase | None = None,
    part: str = "ppmc104",
) -> Move:
    """Undisturbed move of n pulses with the internal clock.

    init: the four initialisation bytes RL, RH, PA low, PA high. rate: None for an acceleration /
    deceleration move, else the rate of a constant-speed move. part: "ppmc104", "ppmc2104" (which has no
    vsel: leave it 1), "stmc" (neither csel nor vsel; rates are divisors) or "ppmc312" (init: the parameters
    of an initial setting, see `ppmc312.predict`, which also has free curves). Raises ValueError for bytes
    that the part refuses and for n outside 1..2^24.
    """
    predict: Predict = parts.part(part).load("predict")
    return predict(init, n, rate, csel, vsel, timebase)


@dataclass(frozen=True)
class Limits:
    """What a part takes. slower: least RL - RH. least: smallest rate with the internal clock. shortest,
    longest: range of PA."""

    slower: int
    least: int
    shortest: int
    longest: int

    def check(self, init: bytes, n: int, rate: int | None) -> tuple[int, int, int]:
        """RL, RH and PA. Raises ValueError for what the part refuses, and for n outside 1..2^24."""
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
    """The pulses of a checked move. beyond: base clocks of an interval that a rate leaves out, and which
    `rates` of the outcome have."""
    indices = tuple(profile_index(n, ramp.pa, j) for j in range(1, n)) if rate is None else ()
    rates = tuple(ramp.rate(k) + beyond for k in indices) if rate is None else (rate,) * (n - 1)
    quanta = tuple(clock.quanta(r - beyond) for r in rates)
    ticks, clk = 0, [0]
    for q in quanta:
        ticks += q
        clk.append(timebase.tick(ticks))
    return RampMove(timebase, tuple(clk), indices, rates, quanta)
