"""Expected values of the STMC tests: formulas written from the rules, independent of the model. Gaps are in
ticks.
"""

from __future__ import annotations

from itertools import accumulate
from math import isqrt

from cocotb_tests.harness import Config

Ramp = tuple[int, int, int]
Init = tuple[int, int, int, int]

A: Ramp = (20, 5, 8)
# Setting of the acceptance table, with the external clock; INTERNAL is the same setting with the internal
# clock.
STANDARD: Init = (0x1A, *A)
INTERNAL: Init = (0x0A, *A)
# Crystal periods: per tick of the internal clock (TICK), and from the start of a motion to step 0 (T0).
TICK, T0 = 1280, 80
ALL = 1 << 24
MOST = ALL - 1
# Period of the external clock of most tests, in cycles.
EXT = 16

OBF, IBF, BUSY, ERR = 0x01, 0x02, 0x04, 0x80
SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon")

# Builds for this part only. Each build takes time, so a test uses as few builds as possible.
F10 = Config("f10m", clk_hz=10_000_000)
F12 = Config("f12m", clk_hz=12_345_678)
F8X20 = Config("f8x20", clk_hz=8_000_000, xtal_hz=20_000_000)
F200 = Config("f200m", clk_hz=200_000_000)
SHEET = Config("sheet", extra=(("READ_MAP", "SHEET"), ("PHASE_IDLE", 1), ("HOLD_XT", 1_600)))
ODD = Config(
    "odd25m",
    clk_hz=25_000_000,
    xtal_hz=20_000_000,
    extra=(("HOLD_XT", 1_601), ("CHOP_ON_XT", 42), ("CHOP_OFF_XT", 99)),
)

# Bits 2..0 of the initialisation code -> energised phases s[5:1] of the successive steps, clockwise.
STEPS = {
    0b001: "00011 00110 00101",
    0b101: "00011 00010 00110 00100 00101 00001",
    0b010: "00011 00110 01100 01001",
    0b110: "00011 00010 00110 00100 01100 01000 01001 00001",
    0b011: "00011 00110 01100 11000 10001",
    0b111: "00011 00111 00110 01110 01100 11100 11000 11001 10001 10011",
}


def steps(code: int) -> list[int]:
    """Return the pin vectors of the excitation table that an initialisation code selects, with its
    polarity.
    """
    mask = 0 if code & 8 else 0x1F
    return [int(word, 2) ^ mask for word in STEPS[code & 7].split()]


def divisor(ramp: Ramp, k: int) -> int:
    """Return x(k) of STMC-RMP-01: the smallest integer r with 4*Y < (2r+1)^2, where Y is the square of the
    exact x(k).
    """
    d1, d2, pa = ramp
    if pa == 0 or d1 == d2:
        return d2
    four_y = 4 * pa * d1**2 * d2**2 // (pa * d2**2 + (d1**2 - d2**2) * k)
    root = isqrt(four_y)
    # 2r + 1 is the smallest odd number above the root.
    return (root + 1) // 2


def levels(n: int, ramp: Ramp) -> list[int]:
    """Return the level v(i) of each gap of an undisturbed move of n steps (STMC-MOV-02)."""
    d1, d2, pa = ramp
    top = 0 if d1 == d2 else pa
    return [min(i, n - 2 - i, top) for i in range(n - 1)]


def gaps(n: int, ramp: Ramp = A) -> list[int]:
    """Return the gaps of an undisturbed move of n steps with acceleration and deceleration."""
    return [divisor(ramp, v) for v in levels(n, ramp)]


def slowed(n: int, i: int, ramp: Ramp = A) -> list[int]:
    """Return the gaps of a move of n steps with a deceleration request in gap i (STMC-DEC-01, -03, -04)."""
    d1, d2, pa = ramp
    v = min(i, 0 if d1 == d2 else pa)
    if n - 1 - i <= v:
        return gaps(n, ramp)
    if v == 0 or divisor(ramp, v) == d1:
        return gaps(n, ramp)[:i]
    return (gaps(n, ramp)[: i + 1] + [divisor(ramp, w) for w in range(v - 1, -1, -1)])[: n - 1]


def internal_offsets(config: Config, ticks: list[int]) -> list[int]:
    """Return the cycles from step 0 to each step with the internal clock (STMC-CLK-01)."""
    return [config.cyc(TICK * n) for n in accumulate(ticks, initial=0)]
