"""Prediction of one move from its initialisation bytes: pulse times and speeds, for plots and tables."""

from __future__ import annotations

from dataclasses import dataclass

from ..common.timebase import Timebase
from ..motion.codes import PA_MAX, PA_MIN
from ..motion.ramp import BaseClock, Ramp, profile_index
from ..ppmc312.predict import TableMove, predict_setting
from ..stmc.codes import TICK_XT
from ..stmc.commands import profile

# By part: least RL - RH, smallest rate with the internal clock, range of PA (P104-INI-05, P2104-INI-02,
# P2104-OPR-07, STMC-INI-02).
_LIMITS = {"ppmc104": (0, 0, PA_MIN, PA_MAX), "ppmc2104": (2, 1, PA_MIN, PA_MAX), "stmc": (0, 1, 0, 65_535)}


@dataclass(frozen=True)
class Move:
    """A predicted move. `clk[j]` is pulse j+1 in clk after pulse 1; `indices`, `rates` (bytes: rates or
    divisors), `quanta` belong to its intervals (indices is empty for constant speed)."""

    timebase: Timebase
    clk: tuple[int, ...]
    indices: tuple[int, ...]
    rates: tuple[int, ...]
    quanta: tuple[int, ...]

    @property
    def seconds(self) -> list[float]:
        """Pulse times in s after pulse 1."""
        return [self.timebase.seconds(t) for t in self.clk]

    @property
    def speeds(self) -> list[float]:
        """Speed of each interval in pulses per second."""
        return [self.timebase.xtal_hz / (self.timebase.quantum * q) for q in self.quanta]

    @property
    def intervals(self) -> list[int]:
        """Length of each interval in clk."""
        return [b - a for a, b in zip(self.clk, self.clk[1:], strict=False)]


def predict_move(
    init: bytes,
    n: int,
    rate: int | None = None,
    csel: int = 1,
    vsel: int = 1,
    timebase: Timebase | None = None,
    part: str = "ppmc104",
) -> Move | TableMove:
    """Undisturbed move of n pulses with the internal clock.

    init: the four initialisation bytes RL, RH, PA low, PA high. rate: None for an acceleration /
    deceleration move, else the rate of a constant-speed move. part: "ppmc104", "ppmc2104" (which has no
    vsel: leave it 1), "stmc" (neither csel nor vsel; rates are divisors) or "ppmc312" (init: the parameters
    of an initial setting, see `predict312`, which also has free curves). Raises ValueError for bytes that
    the part refuses and for n outside 1..2^24.
    """
    if part == "ppmc312":
        return predict_setting(init, n, rate, timebase)
    if len(init) != 4:
        raise ValueError(f"an initialisation has 4 data bytes, not {len(init)}")
    rl, rh, pa = init[0], init[1], init[2] | init[3] << 8
    slowest, least, shortest, longest = _LIMITS[part]
    if rh < least or rl < rh + slowest or not shortest <= pa <= longest:
        raise ValueError(f"refused initialisation: RL {rl}, RH {rh}, PA {pa}")
    if not 1 <= n <= 1 << 24:
        raise ValueError(f"{n} pulses")
    if rate is not None and not least <= rate <= 255:
        raise ValueError(f"rate {rate}")
    timebase = timebase or Timebase()
    if part == "stmc":
        # A divisor counts its base clocks, a rate those beyond the first.
        clock, ramp, beyond = BaseClock(TICK_XT // timebase.quantum), profile(rl, rh, pa), 1
    else:
        clock, ramp, beyond = BaseClock.of_pins(csel, vsel), Ramp(rl, rh, pa), 0
    indices = tuple(profile_index(n, ramp.pa, j) for j in range(1, n)) if rate is None else ()
    rates = tuple(ramp.rate(k) + beyond for k in indices) if rate is None else (rate,) * (n - 1)
    quanta = tuple(clock.quanta(r - beyond) for r in rates)
    ticks, clk = 0, [0]
    for q in quanta:
        ticks += q
        clk.append(timebase.tick(ticks))
    return Move(timebase, tuple(clk), indices, rates, quanta)
