"""Ramp arithmetic against exact fractions, threshold form, sequences of ramp indices.

Rules: P104-RMP, P104-PRO, P104-FDC.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.motion.ramp import (
    BaseClock,
    Ramp,
    index_profile,
    natural_deceleration,
    next_index,
    ramp_period,
    ramp_rate,
    traverse_ramp,
)

CORNERS = [
    (255, 0, 4),
    (255, 0, 11220),
    (255, 254, 11220),
    (1, 0, 4),
    (0, 0, 4),
    (255, 255, 4),
    (4, 0, 8),
    (199, 49, 100),
]


@st.composite
def legal(draw: st.DrawFn) -> tuple[int, int, int]:
    """Draw RL, RH, PA that an initialisation accepts."""
    rl = draw(st.integers(0, 255))
    return rl, draw(st.integers(0, rl)), draw(st.one_of(st.integers(4, 60), st.integers(4, 11220)))


def thresholds(rl: int, rh: int, pa: int) -> dict[int, int]:
    """Return the thresholds of a ramp by the table form of P104-RMP-02."""
    a, b = (rl + 1) ** 2, (rh + 1) ** 2
    return {
        r: pa * b * (4 * a - (2 * r + 1) ** 2) // ((a - b) * (2 * r + 1) ** 2) + 1
        for r in range(rh + 1, rl + 1)
    }


def checked_indices(pa: int) -> list[int]:
    """Return all indices of a short ramp, or a selection of the indices of a long one."""
    return (
        list(range(pa + 1)) if pa <= 200 else [*range(40), *range(40, pa - 40, 97), *range(pa - 40, pa + 1)]
    )


def assert_exact(rl: int, rh: int, pa: int, k: int, rate: int) -> None:
    a, b = Fraction((rl + 1) ** 2), Fraction((rh + 1) ** 2)
    inverse_square = 1 / a + (1 / b - 1 / a) * k / pa
    x_squared = 1 / inverse_square
    low, high = Fraction(2 * rate + 1, 2), Fraction(2 * rate + 3, 2)
    assert low * low <= x_squared < high * high, (rl, rh, pa, k, rate)


@verifies("P104-RMP-01", "P104-RMP-05")
@pytest.mark.parametrize("corner", CORNERS)
def test_rates_of_corner_ramps_are_exact(corner):
    rl, rh, pa = corner
    ramp = Ramp(*corner)
    for k in checked_indices(pa):
        assert_exact(rl, rh, pa, k, ramp.rate(k))
    assert (ramp.rate(0), ramp.rate(pa)) == (rl, rh)


@verifies("P104-RMP-01")
@given(legal())
def test_rates_are_exact_and_never_rise(values):
    rl, rh, pa = values
    previous = rl
    for k in checked_indices(pa):
        rate = ramp_rate(rl, rh, pa, k)
        assert_exact(rl, rh, pa, k, rate)
        assert rh <= rate <= previous
        previous = rate
    assert previous == rh


@verifies("P104-RMP-02", "P104-RMP-04", "P104-RMP-05")
@given(legal())
@example((255, 0, 11220))
@example((255, 254, 11220))
def test_threshold_form_gives_the_same_rates(values):
    rl, rh, pa = values
    table = thresholds(rl, rh, pa)
    for k in checked_indices(pa):
        assert rh + sum(k < t for t in table.values()) == ramp_rate(rl, rh, pa, k)
    falling = [table[r] for r in sorted(table)]
    assert falling == sorted(falling, reverse=True) and all(1 <= t <= pa for t in falling)


@verifies("P104-RMP-03")
def test_quotient_without_remainder_rounds_half_up():
    assert [ramp_rate(4, 0, 8, k) for k in range(9)] == [4, 2, 1, 1, 0, 0, 0, 0, 0]
    assert thresholds(4, 0, 8)[2] == 2


@verifies("P104-EX-01", "P104-EX-03", "P104-EX-04")
def test_worked_ramps():
    assert Ramp(9, 4, 4).rates() == [9, 7, 5, 5, 4]
    assert thresholds(9, 4, 4) == {9: 1, 8: 1, 7: 2, 6: 2, 5: 4}
    assert Ramp(19, 9, 10).rates() == [19, 17, 15, 14, 12, 12, 11, 10, 10, 9, 9]
    rates = Ramp(199, 49, 100).rates()
    assert rates[:12] == [199, 186, 174, 165, 157, 150, 144, 139, 134, 129, 125, 122]
    assert rates[89:] == [52, 52, 51, 51, 51, 50, 50, 50, 50, 49, 49, 49]
    table = thresholds(199, 49, 100)
    assert [table[r] for r in (199, 198, 197, 196, 195, 194)] == [1] * 6
    assert [table[r] for r in (55, 54, 53, 52, 51, 50)] == [80, 84, 87, 91, 94, 98]


@verifies("P104-PRO-01", "P104-PRO-04")
@given(n=st.integers(1, 400), pa=st.integers(4, 120))
def test_walk_gives_the_closed_profile(n, pa):
    indices = index_profile(n, pa)
    assert traverse_ramp(n, pa) == indices and len(indices) == n - 1
    assert indices == indices[::-1]
    assert all(abs(a - b) <= 1 for a, b in zip(indices, indices[1:], strict=False))


@verifies("P104-PRO-02", "P104-PRO-03", "P104-PRO-06")
@given(n=st.integers(1, 400), pa=st.integers(4, 120))
def test_shape_of_the_profile(n, pa):
    indices = index_profile(n, pa)
    if n >= 2 * pa + 2:
        flat = n - 1 - 2 * pa
        assert indices == [*range(pa), *[pa] * flat, *range(pa - 1, -1, -1)]
        return
    assert pa not in indices
    half = n // 2
    up = list(range(half))
    assert indices == (up + up[-2::-1] if n % 2 == 0 else up + up[::-1])


@verifies("P104-PRO-05")
@given(n=st.integers(2, 200), pa=st.integers(4, 60))
def test_natural_deceleration_starts_where_the_index_stops_rising(n, pa):
    indices = index_profile(n, pa)
    for j in range(1, n):
        kp = indices[j - 2] if j > 1 else -1
        wanted = min(kp + 1, pa)
        assert natural_deceleration(kp, n - j, pa) == (indices[j - 1] < wanted)


@verifies("P104-FDC-01", "P104-FDC-02", "P104-FDC-03", "P104-FDC-05")
@given(st.data())
def test_forced_deceleration(data):
    n, pa = data.draw(st.integers(1, 300)), data.draw(st.integers(4, 60))
    flagged_in = data.draw(st.integers(0, n - 1))
    indices = traverse_ramp(n, pa, lambda j: j > flagged_in)
    assert indices == index_profile(n, pa, flagged_in)
    if flagged_in == 0:
        assert indices == []
        return
    peak = index_profile(n, pa)[flagged_in - 1]
    assert indices[flagged_in:] == list(range(peak - 1, -1, -1))
    pulses = len(indices) + 1
    assert pulses == flagged_in + 1 + peak and pulses <= n


def test_flag_alternating_is_kept():
    assert traverse_ramp(50, 10, lambda j: j == 4) == [0, 1, 2, 1, 0]
    assert next_index(-1, 5, 10, True) is None and next_index(3, 0, 10, False) is None


@verifies("P104-INT-01", "P104-INT-02", "P104-BCK-01")
def test_interval_quanta():
    assert BaseClock.of_pins(1, 1).quanta(99) == 800
    assert BaseClock.of_pins(0, 1).quanta(99) == 3200
    assert BaseClock.of_pins(1, 0).quanta(99) == 830
    assert BaseClock.of_pins(0, 0).quanta(0) == 62


@pytest.mark.parametrize("values", [(1, 2, 4, 0), (3, 0, 4, 0), (3, 1, 0, 0), (3, 1, 4, 5), (3, 1, 4, -1)])
def test_impossible_ramps_are_refused(values):
    with pytest.raises(ValueError, match="ramp"):
        ramp_period(*values)


@given(start=st.integers(1, 65536), spread=st.integers(0, 65535), pa=st.integers(1, 127))
def test_wide_periods_of_the_sister_parts(start, spread, pa):
    high = max(1, start - spread)
    for k in (0, pa // 3, pa):
        period = ramp_period(start, high, pa, k)
        square = 1 / (Fraction(1, start**2) + (Fraction(1, high**2) - Fraction(1, start**2)) * k / pa)
        assert Fraction(2 * period - 1, 2) ** 2 <= square < Fraction(2 * period + 1, 2) ** 2
