"""Angle, sine table, references, currents of the PMC006B4 (P006-EXC)."""

from __future__ import annotations

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.pmc006.drive.angle import WAVE, peak_code, references
from tests.pmc006.model.bench import SETUP, Bench

TABLE = """
  0   3   6   9  13  16  19  22  25  28  31  34  38  41  44  47
 50  53  56  59  62  65  68  71  74  77  80  83  86  89  92  95
 98 101 104 107 109 112 115 118 121 123 126 129 132 134 137 140
142 145 147 150 152 155 157 160 162 165 167 170 172 174 177 179
181 183 185 188 190 192 194 196 198 200 202 204 206 207 209 211
213 215 216 218 220 221 223 224 226 227 229 230 231 233 234 235
237 238 239 240 241 242 243 244 245 246 247 248 248 249 250 250
251 252 252 253 253 254 254 254 255 255 255 256 256 256 256 256
256
"""
EXAMPLES = {
    0: (64, 0, 0, 0, 255, 0, 0, 0),
    32: (59, 0, 25, 0, 236, 0, 98, 0),
    64: (45, 0, 45, 0, 180, 0, 180, 0),
    96: (25, 0, 59, 0, 98, 0, 236, 0),
    128: (0, 0, 64, 0, 0, 0, 255, 0),
    192: (45, 1, 45, 0, 180, 1, 180, 0),
    256: (64, 1, 0, 0, 255, 1, 0, 0),
    320: (45, 1, 45, 1, 180, 1, 180, 1),
    384: (0, 0, 64, 1, 0, 0, 255, 1),
    448: (45, 0, 45, 1, 180, 0, 180, 1),
}


def flat(angle: int, peak: int) -> tuple[int, ...]:
    a, b = references(angle, peak)
    return *a, *b


@verifies("P006-EXC-10")
def test_quarter_wave() -> None:
    assert list(WAVE) == [int(word) for word in TABLE.split()]


@verifies("P006-EXC-11", "P006-EXC-12", "P006-EXC-14")
def test_examples() -> None:
    for angle, wanted in EXAMPLES.items():
        assert flat(angle, 64) + flat(angle, 255) == wanted


@given(st.integers(-600, 1200), st.integers(0, 255))
@verifies("P006-EXC-11", "P006-EXC-12")
def test_references_are_cosine_and_sine(angle: int, peak: int) -> None:
    a, a_sign, b, b_sign = flat(angle, peak)
    turn = 2 * pi * angle / 512
    # Tolerance: half a unit of the sine table, scaled by the peak, plus half a unit of the reference.
    assert abs((-a if a_sign else a) - peak * cos(turn)) <= 0.5 + peak / 512 + 1e-9
    assert abs((-b if b_sign else b) - peak * sin(turn)) <= 0.5 + peak / 512 + 1e-9
    assert a_sign == (cos(turn) < -1e-9) and b_sign == (sin(turn) < -1e-9)


@verifies("P006-EXC-01", "P006-EXC-02", "P006-EXC-03", "P006-EXC-15")
@pytest.mark.parametrize(
    ("mstep", "forward", "wanted"),
    [
        (0, 1, [(-45, 45), (-45, -45), (45, -45), (45, 45)]),
        (0, 0, [(45, -45), (-45, -45), (-45, 45), (45, 45)]),
        (2, 1, [(0, 64), (-45, 45), (-64, 0), (-45, -45), (0, -64), (45, -45), (64, 0), (45, 45)]),
    ],
)
def test_step_lists(mstep: int, forward: int, wanted: list[tuple[int, int]]) -> None:
    bench = Bench(**SETUP, mstep=mstep, dir=forward)
    found = []
    for _ in wanted:
        bench.start(1)
        bench.rest()
        bench.wait(10)
        a, a_sign, b, b_sign = bench.references()
        found.append((-a if a_sign else a, -b if b_sign else b))
    assert found == wanted


@verifies("P006-EXC-01", "P006-EXC-03")
def test_increments_and_the_kept_angle() -> None:
    bench, angle = Bench(**SETUP), 64
    units = {0: 128, 2: 64, 4: 32, 8: 16, 16: 8, 32: 4, 64: 2, 128: 1}
    for mstep in (128, 16, 0, 64, 2, 4, 8, 32):
        bench.change(mstep=mstep, cur=400 + mstep, free=1)
        bench.change(free=0, dir=mstep % 3 % 2)
        assert bench.drive.angle == angle
        bench.start(3)
        bench.wait(50)
        bench.change(mstep=4)
        bench.rest()
        angle = (angle + (3 if mstep % 3 % 2 else -3) * units[mstep]) % 512
        assert bench.drive.angle == angle


@verifies("P006-EXC-30", "P006-EXC-32", "P006-EXC-22")
def test_peak_code() -> None:
    assert peak_code(64, 13, True, True, 1) == 77
    assert peak_code(255, 1167, True, False, 1) == 255
    assert [peak_code(255, 9, False, True, att) for att in (1, 2, 3, 4)] == [127, 63, 31, 15]
    assert peak_code(255, 9, False, False, 4) == 255


@verifies("P006-EXC-13", "P006-EXC-24", "P006-EXC-22")
def test_references_within_64_clk() -> None:
    """All four reference outputs change together after each step, each update, and each change of a
    register.
    """
    bench = Bench(cur=1000, vmax=3000, vstart=3000, vstop=3000, mstep=0)
    bench.wait(10)
    bench.start(40)
    bench.rest()
    bench.wait(10)
    bench.change(cur=2000)
    causes = [*bench.steps, bench.t - 1]
    bench.wait(10)
    names = {f"phase_{x}_{y}" for x in "ab" for y in ("ref", "sign")}
    changes = sorted({edge.t for edge in bench.log.edges if edge.signal in names})
    for cause in causes:
        assert any(cause < t <= cause + 64 for t in changes)
    # At constant speed, angle 64 + 4 * 128: the current is increased by 13, the angle is advanced by 57
    # units.
    levels = [bench.log.of(f"phase_{x}_ref", bench.steps[7]) for x in "ab"]
    assert (levels[0][0][1], levels[1][0][1]) == (7, 77)


@verifies("P006-EXC-23", "P006-EXC-12")
def test_the_advance_has_the_sense_of_the_motion() -> None:
    """The angle is advanced in the direction of the motion: 57 units from 64 give 121 forward, 7 backward."""
    for direction, b, a in ((1, 77, 7), (0, 7, 77)):
        bench = Bench(cur=1000, vmax=3000, vstart=3000, vstop=3000, mstep=0, dir=direction)
        bench.start(None)
        while len(bench.steps) < 8:
            bench.wait(10)
        bench.wait(10)
        assert bench.drive.angle == 64 and bench.references()[::2] == (a, b)


@verifies("P006-EXC-30", "P006-EXC-31", "P006-EXC-32")
def test_idle_current() -> None:
    bench = Bench(**SETUP, vstart=3000)
    bench.wait(99_990)
    assert bench.references() == (45, 0, 45, 0)
    bench.wait(20)
    assert bench.references() == (23, 0, 23, 0) and bench.drive.decayed
    bench.change(att=4)
    bench.wait(5)
    assert bench.references() == (3, 0, 3, 0)
    bench.change(autodec=0)
    bench.wait(5)
    assert bench.references() == (45, 0, 45, 0)
    bench.change(autodec=1)
    bench.wait(5)
    assert bench.references() == (3, 0, 3, 0)
    # An accepted start restores the current before the first step.
    bench.start(16)
    bench.wait(5)
    assert bench.references() == (45, 0, 45, 0)
    bench.rest()
    fell = bench.ends[-1]
    bench.wait(200_000)
    decay = [t for t, ref in bench.log.of("phase_a_ref", fell) if ref == 3][0]
    assert 100_000 - 2 <= (decay - fell) / 16 <= 100_000 + 2 + 64 / 16


@verifies("P006-EXC-31")
def test_a_stop_starts_the_idle_time() -> None:
    bench = Bench(**SETUP)
    bench.wait(120_000)
    bench.start(300)
    bench.wait(20_000)
    stopped = bench.halt()
    bench.run(stopped + 99_990 * 16)
    assert not bench.drive.decayed
    bench.wait(20)
    assert bench.drive.decayed


@verifies("P006-STA-12", "P006-CHP-01")
def test_free() -> None:
    bench = Bench(**SETUP)
    bench.start(300)
    bench.wait(20_000)
    angle = bench.drive.angle
    t = bench.do(bench.motion.halt)
    bench.change(free=1)
    bench.wait(10)
    levels = bench.log.levels
    assert bench.references() == (0, 0, 0, 0) and bench.drive.angle == angle
    assert not any(levels[pin] for pin in ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21"))
    bench.run(t + 50_000 * 16)
    bench.change(free=0)
    bench.wait(10)
    a, b = references(angle, 64)
    assert bench.references() == (*a, *b)
    assert bench.log.levels["bridge_a_en"] == bench.log.levels["bridge_b_en"] == 1
    # FREE has not restarted the idle time.
    bench.run(t + 100_010 * 16)
    assert bench.drive.decayed
