"""The polynomials of ppmc_lfsr_pkg: the period of a counter of n bits is exactly 2**n - 1 steps."""

from __future__ import annotations

import re

import pytest

from cocotb_tests.harness.project import ROOT

SOURCE = (ROOT / "rtl/common/ppmc_lfsr_pkg.sv").read_text(encoding="utf-8")
TOP, LOWEST = map(int, re.search(r"\[(\d+):(\d+)\]\[7:0\] TAPS", SOURCE).groups())  # type: ignore[union-attr]
TAPS = [int(word, 16) for word in re.findall(r"8'h([0-9A-F]{2})", SOURCE)]


def primes(number: int) -> set[int]:
    """Return the prime factors of a number."""
    found, divisor = set(), 2
    while divisor * divisor <= number:
        while number % divisor == 0:
            found.add(divisor)
            number //= divisor
        divisor += 1
    return found | ({number} if number > 1 else set())


def after(steps: int, bits: int, taps: int) -> int:
    """Return the power x**steps modulo x**bits + taps, a polynomial over GF(2) (one bit per coefficient)."""
    state = 1
    for bit in f"{steps:b}":
        square = 0
        for at in reversed(range(bits)):
            square = square << 1 ^ (taps | 1 << bits if square >> bits - 1 else 0) ^ state * (state >> at & 1)
        state = square
        if bit == "1":
            state = state << 1 ^ (taps | 1 << bits if state >> bits - 1 else 0)
    return state


def test_one_polynomial_a_width():
    assert (TOP, LOWEST, len(TAPS)) == (31, 2, 30)


@pytest.mark.parametrize("bits, taps", list(zip(range(TOP, LOWEST - 1, -1), TAPS, strict=True)))
def test_longest_count(bits, taps):
    whole = 2**bits - 1
    assert after(whole, bits, taps) == 1
    assert all(after(whole // prime, bits, taps) != 1 for prime in primes(whole))
