"""Expected figures of the motion core: small formulas of their own, written from the rules of the parts.

Nothing here reads the RTL or a golden model. Times are in clk unless a name says quanta. Rule IDs are those
of the PPMC-104; the sister parts have the same rules under their own prefix.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isqrt

from .config import Config

Ramp = tuple[int, int, int]

# Operations without a pulse count make up to so many pulses (P104-OPR-03).
NO_PULSES_DONE = 1 << 24

STEPS = {
    "3 full": "00011 00110 00101",
    "3 half": "00011 00010 00110 00100 00101 00001",
    "4 full": "00011 00110 01100 01001",
    "4 half": "00011 00010 00110 00100 01100 01000 01001 00001",
    "5 full": "00011 00110 01100 11000 10001",
    "5 half": "00011 00111 00110 01110 01100 11100 11000 11001 10001 10011",
}


def steps(name: str, positive: bool = True) -> list[int]:
    """Pin vectors [5:1] of a step list of P104-PHS-01, index 0 first."""
    mask = 0 if positive else 0x1F
    return [int(word, 2) ^ mask for word in STEPS[name].split()]


def rate(rl: int, rh: int, pa: int, k: int) -> int:
    """Rate of ramp index k, round half up, exact (P104-RMP-01).

    x(k)^2 = A·B·PA / (B·PA + (A - B)·k); the rate plus one is the largest n with n - 1/2 <= x.
    """
    a, b = (rl + 1) ** 2, (rh + 1) ** 2
    four_x2 = 4 * a * b * pa // (b * pa + (a - b) * k)
    return (isqrt(four_x2) + 1) // 2 - 1


def indices(n: int, pa: int) -> list[int]:
    """Ramp index of each interval of an undisturbed move of n pulses (P104-PRO-01)."""
    return [min(j - 1, n - 1 - j, pa) for j in range(1, n)]


def forced(n: int, pa: int, j: int) -> list[int]:
    """Interval indices when deceleration is forced while pulse j is the last one out (P104-FDC-02/03)."""
    done = indices(n, pa)[:j]
    return done + list(range(done[-1] - 1, -1, -1)) if done else []


def rates(ramp: Ramp, which: Iterable[int]) -> list[int]:
    """Rates of ramp (RL, RH, PA) at the given indices."""
    return [rate(*ramp, k) for k in which]


def quanta(r: int, csel: int = 1, vsel: int = 1) -> int:
    """Interval at rate r on the internal base clock in quanta (P104-INT-01/02); no vsel pin counts as H."""
    return (r + 1) * (8 if csel else 32) + (0 if vsel else 30)


def offsets(config: Config, rate_list: Iterable[int], csel: int = 1, vsel: int = 1) -> list[int]:
    """clk from pulse 1 to each pulse, cumulative rounding (P104-BCK-03)."""
    out, total = [0], 0
    for r in rate_list:
        total += quanta(r, csel, vsel)
        out.append(config.quanta(total))
    return out


def low_times(config: Config, rate_list: Sequence[int], csel: int = 1, vsel: int = 1) -> list[int]:
    """Low time of every pulse of a complete move on the internal clock (P104-TIM-05)."""
    fast = csel and vsel
    return [config.cyc(16 * (r + 1)) if fast and r <= 2 else config.w for r in rate_list] + [config.w]


def differences(values: Sequence[int]) -> list[int]:
    """Distances of neighbours."""
    return [b - a for a, b in zip(values, values[1:], strict=False)]


def bytes_of(value: int) -> list[int]:
    """Three bytes of a 24-bit value, low first."""
    return [value & 0xFF, value >> 8 & 0xFF, value >> 16 & 0xFF]
