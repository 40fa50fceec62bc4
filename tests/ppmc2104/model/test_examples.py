"""Worked examples (P2104-EX) on the golden model of the PPMC-2104."""

from __future__ import annotations

from math import ceil

import pytest

from cocotb_tests.harness import verifies
from openppmc.model import predict_move
from openppmc.model.motion.ramp import Ramp
from tests.ppmc2104.model.host import B1, LONG, RAMP, Host, clk

EX_02 = {
    1: [],
    2: [99],
    3: [99, 99],
    4: [99, 53, 99],
    10: [99, 53, 41, 34, 30, 34, 41, 53, 99],
    11: [99, 53, 41, 34, 30, 30, 34, 41, 53, 99],
    20: [99, 53, 41, 34, 30, 27, 24, 23, 21, 20, 21, 23, 24, 27, 30, 34, 41, 53, 99],
    21: [99, 53, 41, 34, 30, 27, 24, 23, 21, 20, 20, 21, 23, 24, 27, 30, 34, 41, 53, 99],
    22: [99, 53, 41, 34, 30, 27, 24, 23, 21, 20, 19, 20, 21, 23, 24, 27, 30, 34, 41, 53, 99],
    25: [*RAMP, 19, 19, 19, *RAMP[-2::-1]],
}
SUMS = {2: 3200, 3: 6400, 4: 8128, 10: 15776, 11: 16768, 20: 23776, 21: 24448, 22: 25088, 25: 27008}


def stopped(during: int, script: str = LONG, code: str = "41", setup: str = B1) -> Host:
    """Return a host whose move was stopped by a command in the interval `during`."""
    host = Host(setup + script)
    host.fall(during, after=100)
    mark = host.mark
    host.write(1, int(code, 16))
    host.mark = mark
    return host


@verifies("P2104-RMP-01", "P2104-RMP-02")
@verifies("P2104-EX-01")
def test_ex_01_ramp_values():
    assert Ramp(99, 19, 10).rates() == RAMP
    host = Host(B1 + " c 43 d 18 d 00 d 00")
    assert host.end() == (0x83, 0)
    expected = [3200, 1728, 1344, 1120, 992, 896, 800, 768, 704, 672]
    assert host.intervals() == [*expected, *[640] * 4, *expected[::-1]]
    assert sum(host.intervals()) == 27_008


@verifies("P2104-PRO-01", "P2104-PRO-02", "P2104-PRO-03", "P2104-OPR-03")
@pytest.mark.parametrize("n", EX_02)
@pytest.mark.parametrize("axis", [1, 2])
@verifies("P2104-EX-02")
def test_ex_02_short_moves(n, axis):
    base = 0x20 * (axis - 1)
    host = Host(f"c {2 + base:02X} d 63 d 13 d 0A d 00 c {0x43 + base:02X} d {n - 1:02X} d 00 d 00")
    host.axis = axis
    assert host.end() == (0x83, 0)
    assert len(host.pulses()) == n and host.intervals() == clk(EX_02[n])
    assert sum(host.intervals()) == SUMS.get(n, 0)


@verifies("P2104-EX-02")
def test_ex_02_long_move():
    host = Host(B1 + LONG + " idle")
    assert len(host.pulses()) == 1000 and host.intervals().count(640) == 979
    assert sum(host.intervals()) == 651_008


@verifies("P2104-FDC-02", "P2104-FDC-03", "P2104-END-06")
@pytest.mark.parametrize(
    "during, rates, remaining",
    [(5, [99, 53, 41, 34, 30, 34, 41, 53, 99], 989), (2, [99, 53, 99], 995), (1, [], 998)],
)
@verifies("P2104-EX-03")
def test_ex_03_deceleration_stop(during, rates, remaining):
    host = stopped(during)
    assert host.end() == (0xC3, remaining)
    assert host.intervals() == clk(rates) and len(host.pulses()) == len(rates) + 1


@verifies("P2104-FDC-03", "P2104-LIM-05", "P2104-END-04")
@pytest.mark.parametrize("code, end", [(LONG, (0x8B, 968)), (" c 46", (0x8E, 0xFFFFE0))])
@verifies("P2104-EX-04")
def test_ex_04_slow_down_limit(code, end):
    host = Host(B1 + code)
    host.fall(20, after=100)
    host.pin("fhl_n", 0)
    host.pause(10)
    host.pin("fhl_n", 1)
    assert host.end() == end
    rates = [*RAMP, *[19] * 9, *RAMP[-2::-1]]
    assert len(host.pulses()) == 31 and host.intervals() == clk(rates)
    if code == LONG:
        assert sum(host.intervals()) == 30_848


@verifies("P2104-STP-02", "P2104-STP-03", "P2104-FDC-05", "P2104-PRO-05")
@pytest.mark.parametrize(
    "n, during, pulses, end, error",
    [
        (11, 4, 8, (0xC3, 2), 0),
        (11, 5, 10, (0xC3, 0), 0),
        (11, 6, 11, (0x83, 0), 8),
        (10, 4, 8, (0xC3, 1), 0),
        (10, 5, 10, (0x83, 0), 0),
        (10, 6, 10, (0x83, 0), 8),
        (25, 13, 24, (0xC3, 0), 0),
        (25, 14, 25, (0x83, 0), 0),
        (25, 15, 25, (0x83, 0), 8),
    ],
)
@verifies("P2104-EX-05")
def test_ex_05_requests_around_the_peak(n, during, pulses, end, error):
    host = stopped(during, f" c 43 d {n - 1:02X} d 00 d 00")
    assert host.end() == end
    assert len(host.pulses()) == pulses
    assert host.run("e1") == [error]


@verifies("P2104-FDC-02")
@pytest.mark.parametrize(
    "during, rates, remaining",
    [(3, [14, 14], 996), (5, [14, 14, 14, 14, 13, 14, 14, 14, 14], 989)],
)
@verifies("P2104-EX-06")
def test_ex_06_flat_start(during, rates, remaining):
    assert Ramp(14, 12, 16).rates() == [14] * 4 + [13] * 8 + [12] * 5
    host = stopped(during, setup="c 02 d 0E d 0C d 10 d 00")
    assert host.end() == (0xC3, remaining)
    assert host.intervals() == clk(rates)
    undisturbed = Host("c 02 d 0E d 0C d 10 d 00 c 43 d 63 d 00 d 00 idle")
    assert sum(undisturbed.intervals()) == 42_208


@verifies("P2104-RMP-03")
@verifies("P2104-EX-07")
def test_ex_07_rounding_tie():
    assert Ramp(3, 1, 25).rates() == [3] * 3 + [2] * 11 + [1] * 12
    host = Host("c 02 d 03 d 01 d 19 d 00 c 43 d 3B d 00 d 00 idle")
    assert host.intervals() == clk([3] * 3 + [2] * 11 + [1] * 31 + [2] * 11 + [3] * 3)
    assert sum(host.intervals()) == 4864


@verifies("P2104-BCK-01", "P2104-BCK-02", "P2104-INTV-01")
@pytest.mark.parametrize("csel, expected", [(1, 1600), (0, 6400)])
@verifies("P2104-EX-08")
def test_ex_08_constant_speed(csel, expected):
    host = Host(B1 + " ready")
    host.pin("csel", csel)
    host.pause(6)
    host.run("c 44 d 31 d 04 d 00 d 00")
    host.fall(2, after=50)
    host.pin("csel", 1 - csel)
    assert host.end() == (0x84, 0)
    assert host.intervals() == [expected] * 4


@verifies("P2104-STP-01", "P2104-END-02")
@verifies("P2104-EX-09")
def test_ex_09_immediate_stop():
    host = stopped(7, code="40")
    assert host.end() == (0xC3, 992)
    assert host.intervals() == [3200, 1728, 1344, 1120, 992, 896]


@verifies("P2104-LIM-03", "P2104-OPR-06")
@verifies("P2104-EX-10")
def test_ex_10_limit_ends_continuous_move():
    host = Host(B1 + " c 45 d 04")
    host.fall(1000, after=20)
    host.pin("fl_n", 0)
    assert host.end() == (0x95, 0xFFFC17)
    assert len(host.pulses()) == 1000


@verifies("P2104-PHS-01", "P2104-PHS-04")
@verifies("P2104-EX-11")
def test_ex_11_phases():
    host = Host(B1)
    assert f"{host.out('s1_n'):05b}" == "11100" and f"{host.out('s2_n'):05b}" == "11111"
    host.run("ready c 4A idle")
    assert host.phases() == ["10110"]
    host.run("c 42 idle")
    start = host.mark
    for _ in range(4):
        host.run("c 42 idle")
    host.mark = start
    assert host.phases() == ["11100", "11001", "10011", "10110", "11100"]
    half = Host("c 06 d 63 d 13 d 0A d 00 c 44 d 01 d 07 d 00 d 00 idle")
    assert half.phases() == "11101 11001 11011 10011 10111 10110 11110 11100".split()


@verifies("P2104-BCK-03", "P2104-GEN-04")
@verifies("P2104-EX-12")
def test_ex_12_fractional_clock():
    host = Host(B1 + " ready c 44 d 01 d E8 d 03 d 00 idle", clk_hz=11_059_200)
    falls = host.pulses()
    assert [t - falls[0] for t in falls] == [ceil(442368 * j / 10000) for j in range(1001)]
    assert falls[1] - falls[0] == 45 and falls[-1] - falls[0] == 44_237
    assert host.lows()[-1] == 56


@verifies("P2104-TIM-05")
@pytest.mark.parametrize("rate, interval, low", [(1, 64, 32), (2, 96, 48), (3, 128, 80)])
@verifies("P2104-EX-13")
def test_ex_13_pulse_width(rate, interval, low):
    host = Host(B1 + f" ready c 44 d {rate:02X} d 03 d 00 d 00 idle")
    host.pause(100)
    host.sync()
    assert host.intervals() == [interval] * 3 and host.lows() == [low] * 3 + [80]


def external(host: Host, script: str, period: int, axis: int = 1) -> None:
    """Run a script; then output `extck` with 50 % duty cycle until the axis is at standstill."""
    host.run(script)
    while host.model.busy(axis):
        host.pin("extck", 1, axis)
        host.pause(period // 2 - 1)
        host.pin("extck", 0, axis)
        host.pause(period - period // 2 - 1)
        host.sync()
    host.pause(100)
    host.sync()


@verifies("P2104-BCK-04", "P2104-TIM-03", "P2104-TIM-05")
@verifies("P2104-EX-14")
def test_ex_14_external_clock():
    host = Host("c 0A d 63 d 13 d 0A d 00 ready")
    external(host, "c 44 d 09 d 09 d 00 d 00", 64)
    assert host.intervals() == [640] * 9 and host.lows() == [80] * 10
    external(host, "c 44 d 00 d 09 d 00 d 00", 16)
    assert host.intervals() == [16] * 9 and host.lows() == [8] * 9 + [80]


@verifies("P2104-RMP-01", "P2104-RMP-02")
@verifies("P2104-EX-15")
def test_ex_15_largest_ramp():
    ramp = Ramp(255, 18, 11220)
    assert [ramp.rate(k) for k in (0, 1, 2, 10, 100, 1000, 5000, 11219)] == [
        255,
        253,
        251,
        237,
        157,
        61,
        27,
        18,
    ]
    for rate, threshold in ((200, 40), (100, 342), (50, 1535), (20, 9630), (19, 10649)):
        assert ramp.rate(threshold - 1) >= rate > ramp.rate(threshold)
    host = Host("c 02 d FF d 12 d D4 d 2B ready c 43 d 2F d 75 d 00 idle")
    assert host.intervals()[:4] == [8192, 8128, 8064, 8000]
    assert len(host.pulses()) == 30_000 and sum(host.intervals()) == 30_002_080


@pytest.mark.parametrize("n", EX_02)
def test_predictor_agrees_with_the_part(n):
    move = predict_move(bytes((99, 19, 10, 0)), n, part="ppmc2104")
    assert list(move.rates) == EX_02[n] and sum(move.intervals) == SUMS.get(n, 0)


@pytest.mark.parametrize("init, rate", [((9, 8, 4, 0), None), ((9, 0, 4, 0), None), ((9, 4, 4, 0), 0)])
def test_predictor_refuses_what_the_part_refuses(init, rate):
    with pytest.raises(ValueError):
        predict_move(bytes(init), 5, rate, part="ppmc2104")
    assert predict_move(bytes(init), 5, rate).clk[0] == 0
