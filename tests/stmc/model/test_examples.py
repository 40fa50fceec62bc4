"""Worked examples W1 to W23 and reference values of ramps of the STMC, on the golden model at its pins."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.stmc.commands import profile
from tests.stmc.model.host import Host, count, init

W1 = [20, 12, 9, 8, 7, 6, 6, 5, 5, 5, 5, 5, 6, 6, 7, 8, 9, 12, 20]
W2 = [20, 12, 9, 8, 7, 6, 7, 8, 9, 12, 20]
A = (20, 5, 8)

# (name, D1/D2/PA, number sent, gaps)
UNDISTURBED = (
    ("W1", A, 19, W1),
    ("W2", A, 11, W2),
    ("W3", A, 10, [20, 12, 9, 8, 7, 7, 8, 9, 12, 20]),
    ("W4", A, 16, [20, 12, 9, 8, 7, 6, 6, 5, 5, 6, 6, 7, 8, 9, 12, 20]),
    ("W5", A, 17, [20, 12, 9, 8, 7, 6, 6, 5, 5, 5, 6, 6, 7, 8, 9, 12, 20]),
    ("W6-0", A, 0, []),
    ("W6-1", A, 1, [20]),
    ("W6-2", A, 2, [20, 20]),
    ("W6-3", A, 3, [20, 12, 20]),
    ("W7", (10, 5, 4), 11, [10, 8, 6, 6, 5, 5, 5, 6, 6, 8, 10]),
    ("W8", (50, 25, 3), 8, [50, 35, 29, 25, 25, 29, 35, 50]),
    ("W11", (12, 6, 0), 5, [6] * 5),
    ("W12", (10, 10, 50), 5, [10] * 5),
)

# (name, ramp, number sent, gap of the request, steps, gaps, FIN, REM)
COMMAND_1 = (
    ("W14", A, 99, 3, [20, 12, 9, 8, 9, 12, 20], 0xC3, 91),
    ("W15", A, 99, 10, W1, 0xC3, 79),
    ("W16", A, 99, 1, [20, 12, 20], 0xC3, 95),
    ("W17", A, 99, 0, [], 0xC3, 98),
    ("W18-4", A, 11, 4, [20, 12, 9, 8, 7, 8, 9, 12, 20], 0xC3, 1),
    ("W18-5", A, 11, 5, W2, 0x83, 0),
    ("W18-6", A, 11, 6, W2, 0x83, 0),
    ("W22", (12, 6, 0), 5, 3, [6, 6, 6], 0xC3, 1),
    ("W23", (10, 6, 16), 99, 1, [10, 9, 10], 0xC3, 95),
)

X = {
    (20, 5, 8): [20, 12, 9, 8, 7, 6, 6, 5, 5],
    (10, 5, 4): [10, 8, 6, 6, 5],
    (40, 10, 6): [40, 21, 16, 14, 12, 11, 10],
    (200, 20, 10): [200, 61, 44, 36, 31, 28, 26, 24, 22, 21, 20],
    (10, 6, 16): [10, 9, 9, 9, 8, 8, 8, 8, 7, 7, 7, 7, 7, 6, 6, 6, 6],
    (255, 5, 4): [255, 10, 7, 6, 5],
    (50, 25, 1): [50, 25],
}


def divisor(d1: int, d2: int, pa: int, k: int) -> int:
    return profile(d1, d2, pa).rate(k) + 1


def threshold(d1: int, d2: int, pa: int, x: int) -> int:
    """Return E(x) of STMC-RMP-02."""
    top = pa * (4 * d1**2 - (2 * x - 1) ** 2) * d2**2
    return 1 + top // ((d1**2 - d2**2) * (2 * x - 1) ** 2)


@verifies("STMC-MOV-02", "STMC-MOV-03", "STMC-MOV-04", "STMC-RUN-01", "AC-06", "AC-07")
@pytest.mark.parametrize("name, ramp, number, gaps", UNDISTURBED, ids=[row[0] for row in UNDISTURBED])
@pytest.mark.parametrize("code", [0x0A, 0x1A])
def test_undisturbed(name, ramp, number, gaps, code):
    host = Host(init(code, *ramp))
    assert host.move("c 43 " + count(number)) == (0x83, 0)
    assert host.gaps(16 if code & 0x10 else 1280) == gaps
    assert len(host.pulses()) == number + 1


@verifies("STMC-RUN-01", "STMC-MOV-02", "AC-08")
def test_w9_and_w10_long_moves():
    host = Host(init(0x1A, 141, 59, 400))
    assert host.move("c 43 d 20 d 03 d 00") == (0x83, 0)
    gaps, falls = host.gaps(), host.pulses()
    assert len(falls) == 801 and falls[-1] - falls[0] == 1_066_144 and sum(gaps) == 66_634
    assert gaps[:12] == [141, 140, 139, 139, 138, 137, 136, 136, 135, 134, 133, 133]
    assert gaps[399:401] == [59, 59] and gaps == gaps[::-1]
    host.move("c 43 " + count(1999))
    gaps = host.gaps()
    assert sum(gaps) == 137_375 and gaps[400:1599] == [59] * 1199 and gaps == gaps[::-1]


@verifies("STMC-MOV-01")
def test_w13_constant_speed():
    host = Host()
    assert host.move("c 44 d 07 " + count(4)) == (0x84, 0)
    assert host.gaps() == [7] * 4


@verifies("STMC-DEC-01", "STMC-DEC-03", "STMC-DEC-04", "STMC-FIN-02", "AC-22")
@pytest.mark.parametrize("row", COMMAND_1, ids=[row[0] for row in COMMAND_1])
def test_command_1(row):
    _, ramp, number, gap, gaps, fin, rem = row
    host = Host(init(0x1A, *ramp))
    host.start("c 43 " + count(number))
    host.in_gap(gap)
    mark = host.mark
    status = host.command(0x41)
    assert (status & 0xF0 == 0xF0) == (row[0] == "W18-6")
    host.mark = mark
    assert host.finish() == (fin, rem)
    assert host.gaps() == gaps


@verifies("STMC-DEC-01", "STMC-DEC-05", "STMC-FIN-03")
@pytest.mark.parametrize("gap, gaps, result", [
    (13, [*W1[:7], *[5] * 8, *W1[12:]], (0x8B, 0)),
    (14, [*W1[:7], *[5] * 9, *W1[12:]], (0x83, 0)),
    (15, [*W1[:7], *[5] * 9, *W1[12:]], (0x83, 0)),
])  # fmt: skip
def test_w19_deceleration_limit_near_the_end(gap, gaps, result):
    host = Host()
    host.start("c 43 " + count(23))
    host.in_gap(gap, 20)
    host.blip(4, l3_n=0)
    assert host.finish() == result
    assert host.gaps() == gaps


@verifies("STMC-IN-02")
def test_w20_stop_limit():
    host = Host()
    host.start("c 43 " + count(99))
    host.in_gap(10)
    host.blip(4, l1_n=0)
    assert host.finish() == (0x93, 88)
    assert host.gaps() == [20, 12, 9, 8, 7, 6, 6, 5, 5, 5]


@verifies("STMC-DEC-03", "STMC-STP-03")
def test_w21_request_before_step_0():
    host = Host()
    host.pins(l3_n=0)
    host.pause(4)
    assert host.move("c 43 " + count(99)) == (0x8B, 98) and len(host.pulses()) == 1
    host.pins(l3_n=1)
    host.start("c 43 " + count(99) + "c 41")
    host.mark = host.t - 30
    assert host.finish() == (0xC3, 98) and len(host.pulses()) == 1


@verifies("STMC-RMP-01", "STMC-RMP-03")
def test_ramp_reference_values():
    for ramp, values in X.items():
        assert [divisor(*ramp, k) for k in range(ramp[2] + 1)] == values
    long = {100: 96, 200: 77, 300: 66, 390: 60, 395: 59, 400: 59, 0: 141}
    assert {k: divisor(141, 59, 400, k) for k in long} == long
    assert divisor(15, 5, 8, 3) == 8


@verifies("STMC-RMP-02")
def test_threshold_reference_values():
    short = dict.fromkeys(range(13, 21), 1) | dict.fromkeys((10, 11, 12), 2) | {9: 3, 8: 4, 7: 5, 6: 7}
    assert {x: threshold(20, 5, 8, x) for x in short} == short
    long = {141: 1, 140: 2, 139: 4, 130: 16, 100: 86, 80: 183, 61: 377, 60: 392}
    assert {x: threshold(141, 59, 400, x) for x in long} == long


@verifies("STMC-RMP-01", "STMC-RMP-02", "STMC-RMP-03")
@given(d1=st.integers(2, 255), below=st.integers(1, 254), pa=st.integers(1, 65535), data=st.data())
def test_both_forms_are_the_exact_value(d1, below, pa, data):
    d2 = max(1, d1 - below)
    k = data.draw(st.integers(0, pa))
    x = divisor(d1, d2, pa, k)
    square = 1 / (Fraction(1, d1**2) + (Fraction(1, d2**2) - Fraction(1, d1**2)) * k / pa)
    assert Fraction(2 * x - 1, 2) ** 2 <= square < Fraction(2 * x + 1, 2) ** 2
    assert x == d1 - sum(threshold(d1, d2, pa, y) <= k for y in range(d2 + 1, d1 + 1))
    assert divisor(d1, d2, pa, 0) == d1 and divisor(d1, d2, pa, pa) == d2


@verifies("STMC-MOV-04")
def test_flat_profiles():
    for d1, d2, pa in ((12, 6, 0), (10, 10, 50), (255, 255, 65535), (1, 1, 0)):
        ramp = profile(d1, d2, pa)
        assert (ramp.rl + 1, ramp.rh + 1, ramp.pa) == (d2, d2, 0) and ramp.rate(0) == d2 - 1
