"""Pulses per second, rates and ramps, compared with exact fractions (P104-INT-01, -02, P104-SW-04)."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from openppmc.cli.common.presenter import Trajectory, key_figures
from openppmc.host import units
from openppmc.host.axis import chop_byte
from openppmc.host.capabilities import SetupRequest
from openppmc.host.errors import OutOfRange, PpmcError
from openppmc.host.ppmc104 import CAPABILITIES as PPMC104
from openppmc.host.ppmc2104.registers import CAPABILITIES as PPMC2104
from openppmc.host.ppmc2104.registers import half_us_byte, hold_byte
from openppmc.host.stmc import CAPABILITIES as STMC
from openppmc.model.single.predict import predict_move

XTAL = 16_000_000


@pytest.mark.parametrize(
    ("csel", "vsel", "rate", "pps"),
    [
        (1, 1, 0, Fraction(500_000)),
        (1, 1, 255, Fraction(500_000, 256)),
        (0, 1, 0, Fraction(125_000)),
        (0, 1, 255, Fraction(125_000, 256)),
        (1, 1, 99, Fraction(5000)),
        (1, 0, 99, Fraction(10_000_000, 2075)),
        (0, 0, 99, Fraction(10_000_000, 8075)),
    ],
)
def test_speeds_of_rates(csel: int, vsel: int, rate: int, pps: Fraction) -> None:
    """The rates correspond to 1953 … 500 000 pps with the fast base clock and 488 … 125 000 pps with the slow
    one.

    With vsel low, an interval of 200 µs becomes 207.5 µs (P104-EX-06).
    """
    assert units.BaseClock.internal(XTAL, csel, vsel).speed(rate) == pps


@given(st.fractions(1, 600_000), st.integers(0, 1), st.integers(0, 1), st.sampled_from([XTAL, 11_059_200]))
def test_the_nearest_interval_is_chosen(pps: Fraction, csel: int, vsel: int, xtal: int) -> None:
    clock = units.BaseClock.internal(xtal, csel, vsel)
    intervals = [
        (r + 1) * Fraction(128 if not csel else 32, xtal) + (0 if vsel else Fraction(120, xtal))
        for r in range(256)
    ]
    if not 1 / intervals[255] <= pps <= 1 / intervals[0]:
        with pytest.raises(OutOfRange, match=r"is outside .* to .* pps"):
            clock.choose(pps)
        return
    speed = clock.choose(pps)
    assert speed.reached == 1 / intervals[speed.rate]
    assert abs(intervals[speed.rate] - 1 / pps) == min(abs(i - 1 / pps) for i in intervals)


def test_error_of_a_speed() -> None:
    speed = units.BaseClock.internal(XTAL).choose(3333)
    assert speed.rate == 149
    assert speed.reached == Fraction(500_000, 150)
    assert speed.error == pytest.approx(1.0e-4, rel=0.01)


@pytest.mark.parametrize("bad", [0, -5, 1e9, float("nan"), float("inf"), float("-inf")])
def test_no_speed(bad: float) -> None:
    with pytest.raises(OutOfRange) as caught:
        units.BaseClock.internal(XTAL).choose(bad)
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, PpmcError)
    with pytest.raises(OutOfRange):
        units.any_clock(XTAL, bad)


def test_the_fast_base_clock_is_preferred() -> None:
    assert units.choose_clock(XTAL, 1954, None).csel == 1
    assert units.choose_clock(XTAL, Fraction(500_000, 256), None).csel == 1
    assert units.choose_clock(XTAL, 1953, None).csel == 0
    assert units.choose_clock(XTAL, 1954, 125_000).csel == 0
    assert units.any_clock(XTAL, 1000).csel == 0
    assert units.any_clock(XTAL, 300_000, first=0).csel == 1
    with pytest.raises(OutOfRange, match="500000 and 125000 Hz"):
        units.choose_clock(XTAL, 1954, 250_000)


def test_external_clock() -> None:
    clock = units.BaseClock.external_pin(1000)
    assert clock.choose(100).rate == 9
    assert clock.slowest == Fraction(1000, 256)
    with pytest.raises(OutOfRange):
        units.BaseClock.external_pin(0)
    with pytest.raises(OutOfRange):
        units.BaseClock.external_pin(1_000_001)


def test_setup_bytes() -> None:
    """The bytes of the set-up are those of example A of the manual."""
    clock = units.BaseClock.internal(XTAL)
    setup = units.plan_setup(clock, 50_000, 100_000, 4, 0x0A)
    assert bytes([setup.code]) + setup.data == bytes.fromhex("0A 09 04 04 00")
    assert PPMC104.plan(XTAL, SetupRequest(50_000, 100_000, 4)) == setup
    external = {"external_clock": 100_000, "start_pps": 1000, "high_pps": 5000}
    assert (
        PPMC104.plan(
            XTAL, SetupRequest(phases=5, half_step=True, positive_logic=False, chop=True, **external)
        ).code
        == 0x37
    )


def test_setup_bytes_of_the_ppmc2104() -> None:
    """P2104-INI-01, -INI-02: the code is 00ASCEMM; RL is at least RH + 2; RH = 0 requires an external
    clock.
    """
    setup = PPMC2104.plan(XTAL, SetupRequest(5000, 25_000, 10))
    assert bytes([setup.code]) + setup.data == bytes.fromhex("02 63 13 0A 00")
    external = {"external_clock": 100_000, "start_pps": 1000, "high_pps": 100_000}
    setup = PPMC2104.plan(XTAL, SetupRequest(phases=5, half_step=True, chop=True, axis=2, **external))
    assert (setup.code, setup.data) == (0x3F, bytes([99, 0, 200, 0]))
    assert PPMC2104.plan(XTAL, SetupRequest(50_000, 250_000, 4, phases=3)).data[1] == 1
    for arguments, text in (
        (
            {"start_pps": 50_000, "high_pps": 500_000},
            "high speed 500000 pps is outside 1953.12 to 250000 pps",
        ),
        ({"start_pps": 50_000, "high_pps": 50_000}, "needs 2 steps of its rate between them .rates 9 and 9"),
        ({"start_pps": 50_000, "high_pps": 55_000}, r"50000 pps and high speed 55555.6 pps .*rates 9 and 8"),
        ({"positive_logic": True}, "positive logic: a PPMC-2104"),
        ({"long_intervals": True}, "long intervals: a PPMC-2104"),
        ({"axis": 3}, "axis 3: a PPMC-2104 has axes 1 to 2"),
    ):
        with pytest.raises(OutOfRange, match=text):
            PPMC2104.plan(XTAL, SetupRequest(**arguments))  # type: ignore[arg-type]
    with pytest.raises(OutOfRange, match="axis 2: a PPMC-104 has one axis"):
        PPMC104.check_axis(2)


@given(st.floats(0, 200))
def test_half_us_bytes(asked: float) -> None:
    """P2104-AUX-04: the unit of a time is 0.5 µs, and its byte is 40h to FFh."""
    if not 32 <= asked <= 127.5:
        with pytest.raises(OutOfRange, match="32 to 127.5 us"):
            half_us_byte(XTAL, asked, "on")
        return
    byte, reached = half_us_byte(XTAL, asked, "on")
    assert 0x40 <= byte <= 0xFF and reached == Fraction(byte, 2) and abs(reached - Fraction(asked)) <= 0.25


@given(st.floats(0, 40_000))
def test_hold_bytes(asked: float) -> None:
    """P2104-AUX-05: the unit of a time is 128 µs, and its range is 1 to 256 units."""
    if not 128 <= asked <= 32_768:
        with pytest.raises(OutOfRange, match="128 to 32768 us"):
            hold_byte(XTAL, asked)
        return
    byte, reached = hold_byte(XTAL, asked)
    assert 0 <= byte <= 0xFF and reached == 128 * (byte + 1) and abs(reached - Fraction(asked)) <= 64


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((50_000, 40_000, 4), "above high speed"),
        ((50_000, 60_000, 3), "4 to 11220 pulses"),
        ((50_000, 60_000, 11_221), "4 to 11220 pulses"),
        ((1000, 60_000, 100), "start speed 1000 pps is outside 1953.12 to 500000 pps"),
        ((50_000, 600_000, 100), "high speed 600000 pps is outside"),
    ],
)
def test_impossible_setups(arguments: tuple[int, int, int], text: str) -> None:
    with pytest.raises(OutOfRange, match=text):
        units.plan_setup(units.BaseClock.internal(XTAL), *arguments, 0x0A)


def test_phases() -> None:
    for phases in (2, 6):
        with pytest.raises(OutOfRange, match="3, 4 or 5"):
            units.motor_bits(phases, False)


@given(st.integers(0, 1), st.sampled_from(["on", "off"]), st.floats(0, 1000))
def test_chopper_times(vsel: int, phase: str, asked: float) -> None:
    offset = {("on", 1): 27, ("on", 0): 25, ("off", 1): 33, ("off", 0): Fraction(115, 4)}[phase, vsel]
    times = [offset + 3 * n for n in range(256)]
    if not times[0] <= Fraction(asked) <= times[-1]:
        with pytest.raises(OutOfRange, match="us is outside"):
            chop_byte(XTAL, asked, phase, vsel)
        return
    byte, reached = chop_byte(XTAL, asked, phase, vsel)
    assert reached == times[byte]
    assert abs(reached - Fraction(asked)) <= Fraction(3, 2)


@given(st.integers(1, 900), st.integers(4, 120), st.integers(0, 255), st.integers(0, 255), st.integers(0, 3))
def test_key_figures_match_the_prediction(n: int, pa: int, a: int, b: int, straps: int) -> None:
    """The key figures of `plan` equal those of the predictor, which computes each pulse."""
    clock = units.BaseClock.internal(XTAL, straps & 1, straps >> 1)
    low, high = sorted((clock.speed(a), clock.speed(b)))
    setup = units.plan_setup(clock, low, high, pa, 0x0A)
    figures = key_figures(setup, -n, None)
    move = predict_move(setup.data, n, csel=straps & 1, vsel=straps >> 1)
    assert figures["seconds"] == pytest.approx(move.seconds[-1], abs=1e-12)
    if n > 1:
        assert figures["top_pps"] == pytest.approx(max(move.speeds))
    rates = predict_move(setup.data, n, rate=a, csel=straps & 1, vsel=straps >> 1)
    constant = key_figures(setup, n, clock.choose(clock.speed(a)))
    assert constant["seconds"] == pytest.approx(rates.seconds[-1], abs=1e-12)


@given(st.integers(1, 300), st.integers(0, 90), st.integers(5, 255), st.integers(5, 255))
def test_key_figures_and_course_of_the_stmc(n: int, pa: int, a: int, b: int) -> None:
    """Key figures and trajectory of an STMC equal the predictor's; with PA = 0 the speed is constant."""
    slow, fast = max(a, b), min(a, b)
    setup = STMC.plan(
        XTAL, SetupRequest(12_500 / Fraction(slow), 12_500 / Fraction(fast), pa, base_clock=12_500)
    )
    assert setup.data == bytes([slow, fast, pa, 0])
    move = predict_move(setup.data, n, part="stmc")
    figures, course = key_figures(setup, n, None), Trajectory.of(setup, n, None)
    assert figures["seconds"] == pytest.approx(move.seconds[-1], abs=1e-12)
    assert course.seconds == pytest.approx(move.seconds) and course.speeds == pytest.approx(move.speeds)
    assert figures["top_pps"] == pytest.approx(max(move.speeds, default=12_500 / (slow if pa else fast)))
    constant = Trajectory.of(setup, n, setup.clock.choose(12_500 / Fraction(b)))
    assert constant.seconds[-1] == pytest.approx((n - 1) * b / 12_500)
