"""Worked moves of the PMC006B4 with times in us: the 47 moves of MOVES, and W1 to W14."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.pmc006.motion.engine import (
    LiveRegisters,
    MotionStart,
    Stage,
    by_coefficient,
    by_distance,
    plan,
    ramp_steps,
    stopping_distance,
)
from tests.pmc006.model.bench import Made, make

# Columns: N, VSTART, VSTOP, VMAX, coefficients set, coefficients used, target, highest speed; time and
# remaining steps at the final deceleration; steps in CREEP; time of the end, last speed, first intervals,
# last intervals.
MOVES = """
M01 1 600 600 3200 3/3 3/3 600 600 - - - 1667 600 1667 1667
M02 2 600 600 3200 3/3 3/3 600 600 - - - 3334 600 1667,1667 1667,1667
M03 3 600 600 3200 3/3 3/3 600 600 - - - 5000 600 1667,1667,1666 1667,1667,1666
M04 10 600 600 3200 3/3 3/3 600 600 - - - 16667 600 1667,1667,1666,1667 1667,1666,1667
M05 100 600 600 3200 3/3 3/3 600 600 - - - 166667 600 1667,1667,1666,1667 1667,1666,1667
M06 255 600 600 3200 3/3 3/3 600 600 - - - 425000 600 1667,1667,1666,1667 1667,1667,1666
M07 1 3000 65 3200 3/3 3/3 65 3000 - - - 460 1201 460 460
M08 4 3000 65 3200 3/3 3/3 65 3000 - - - 44509 65 460,13279,15385,15385 13279,15385,15385
M09 50 3000 600 5000 3/5 3/5 600 3000 - - - 30915 600 335,338,342,345 1662,1667,1667
M10 255 3000 65 16000 3/3 3/3 65 3000 - - - 208333 65 334,334,335,336 14919,15385,15384
M11 255 65 3000 16000 5/3 5/3 3000 3000 - - - 111441 3000 5026,2480,1913,1617 333,333,334
M12 200 65 65 65 0/0 0/0 65 65 - - - 3076924 65 15385,15385,15384,15385 15384,15385,15385
M13 256 600 600 3200 3/3 5/5 3200 3200 69800 95 3 122842 600 1659,1613,1534,1439 1667,1667,1666
M14 257 600 600 3200 3/3 5/5 3200 3200 70100 95 3 123209 600 1659,1613,1534,1439 1667,1666,1667
M15 287 600 600 3200 3/3 5/5 3200 3200 79500 95 3 132476 600 1659,1613,1534,1439 1666,1667,1667
M16 300 600 600 3200 3/3 5/5 3200 3200 83600 95 3 136376 600 1659,1613,1534,1439 1666,1667,1667
M17 400 600 600 3200 3/3 4/4 3200 3200 105800 186 3 206622 600 1665,1653,1628,1596 1666,1667,1667
M18 512 600 600 3200 3/3 4/4 3200 3200 140800 186 3 241622 600 1665,1653,1628,1596 1666,1667,1667
M19 1000 600 600 3200 3/3 3/3 3200 3200 275300 368 3 471687 600 1667,1663,1657,1647 1666,1667,1667
M20 2000 600 600 3200 3/3 3/3 3200 3200 587800 368 3 784187 600 1667,1663,1657,1647 1666,1667,1667
M21 3200 600 600 3200 3/3 3/3 3200 3200 962800 368 3 1159187 600 1667,1663,1657,1647 1666,1667,1667
M22 10000 600 600 3200 3/3 3/3 3200 3200 3087800 368 3 3284187 600 1667,1663,1657,1647 1666,1667,1667
M23 256 600 600 16000 3/3 5/5 3699 3699 58800 127 3 121101 600 1661,1621,1551,1467 1667,1667,1666
M24 1000 600 600 16000 3/3 5/5 7359 7359 125100 500 3 253792 600 1664,1645,1609,1560 1665,1667,1666
M25 4000 600 600 16000 5/5 5/5 14743 14743 260300 2002 2 523965 600 1666,1656,1638,1612 1664,1667,1666
M26 4723 600 600 16000 0/0 5/5 16000 16000 284200 2357 2 570451 600 1666,1657,1640,1616 1663,1666,1667
M27 4724 600 600 16000 0/0 5/5 16000 16000 284300 2356 3 571099 600 1666,1657,1640,1616 1665,1667,1667
M28 10000 600 600 16000 0/0 4/4 16000 16000 603400 4706 3 1173640 600 1667,1664,1660,1654 1667,1666,1667
M29 200000 600 600 16000 0/0 0/0 16000 16000 12160100 75195 2 21221639 600 1667,1667,1666,1667 1667,1666,1667
M30 200000 600 600 16000 5/0 5/0 16000 16000 7936600 75195 2 16998766 600 1666,1657,1640,1616 1667,1667,1666
M31 200000 600 600 16000 0/5 0/5 16000 16000 16712500 2357 2 16998457 600 1667,1667,1666,1667 1661,1667,1666
M32 20000 65 65 16000 5/5 5/5 16000 16000 1248500 2359 2 1570531 65 11351,5730,3884,3020 10226,15361,15384
M33 256 65 3000 3000 3/3 4/4 3000 3000 - - 0 138166 3000 10802,5252,3587,2813 333,334,333
M34 256 3000 65 3000 3/3 4/4 3000 3000 28700 170 3 180024 65 334,333,333,334 15202,15384,15385
M35 300 65 65 65 3/3 3/3 65 65 - - 0 4615385 65 15385,15385,15384,15385 15385,15384,15385
M36 300 600 600 600 3/3 3/3 600 600 - - 0 500000 600 1667,1667,1666,1667 1667,1667,1666
M37 300 600 600 601 3/3 3/3 601 601 490900 5 3 499180 600 1665,1663,1664,1664 1666,1667,1667
M38 300 600 600 605 0/0 0/0 605 605 486000 6 4 495942 600 1664,1655,1653,1652 1666,1667,1667
M39 5000 600 65 8000 5/1 5/3 8000 8000 393300 2358 2 1005756 65 1665,1646,1614,1568 13874,15385,15384
M40 3000 600 600 3000 0/0 1/1 3000 3000 857400 1275 3 1568831 600 1667,1667,1666,1666 1666,1667,1667
M41 255 600 600 1000 0/0 0/0 600 600 - - - 425000 600 1667,1667,1666,1667 1667,1667,1666
M42 256 600 600 1000 0/0 1/1 1000 1000 180600 99 3 305484 600 1667,1665,1663,1659 1667,1666,1667
M43 287 600 600 1000 0/0 1/1 1000 1000 211600 99 3 336484 600 1667,1665,1663,1659 1667,1666,1667
M44 1000 600 600 1000 0/0 0/0 1000 1000 854100 193 4 1096531 600 1667,1667,1666,1664 1666,1667,1667
M45 5000 600 600 1000 0/0 0/0 1000 1000 4854100 193 4 5096531 600 1667,1667,1666,1664 1666,1667,1667
M46 6000 2500 2500 2500 0/0 0/0 2500 2500 - - 0 2400000 2500 400,400,400,400 400,400,400
M47 4000 300 300 2000 4/4 4/4 2000 2000 1988700 76 3 2061263 300 3286,3041,2699,2377 3332,3333,3334
"""
ROWS = [line.split() for line in MOVES.strip().splitlines()]


def row_of(cells: list[str]) -> list[str]:
    """Return the cells of a row, computed from the move that the model makes."""
    n, vs, ve, vmax = map(int, cells[1:5])
    acc, dec = map(int, cells[5].split("/"))
    made = make(MotionStart(n, vs, ve, vmax, acc, dec))
    assert len(made.steps) == n and made.steps[-1][0] == made.end
    engine, gaps = made.engine, made.intervals
    creep = sum(stage is Stage.CREEP for _, _, stage in made.steps)
    return [
        *cells[:6],
        f"{engine.acc}/{engine.dec}",
        str(made.goal),
        str(max(speed for _, speed in made.updates)),
        str(made.braked_at or "-"),
        str(engine.decel_start[0]) if engine.decel_start else "-",
        "-" if n < 256 else str(creep),
        str(made.end),
        str(made.steps[-1][1]),
        ",".join(map(str, gaps[:4])),
        ",".join(map(str, gaps[-3:])),
    ]


@pytest.mark.parametrize("cells", ROWS, ids=[row[0] for row in ROWS])
@verifies("P006-MOT-01", "P006-MOT-02", "P006-MOT-03", "P006-MOT-20", "P006-MOT-22", "P006-MOT-23")
def test_move(cells: list[str]) -> None:
    assert row_of(cells) == cells


def fits(gaps: list[int], pattern: str) -> bool:
    """Return whether the first and the last intervals are those of a pattern with `..`."""
    head, _, tail = pattern.partition("..")
    first, last = ([int(word) for word in part.split(",")] for part in (head, tail or head))
    return gaps[: len(first)] == first and gaps[-len(last) :] == last


@verifies("P006-MOT-23", "P006-MOT-11")
def test_w3_short_move_that_decelerates() -> None:
    made = make(MotionStart(50, 3000, 600, 5000, 3, 5))
    head = "335,338,342,345,349,354,357,361,366,371,375,381"
    assert fits(made.intervals, f"{head}..717,752,796,846,908,986,1088,1232,1451,1662,1667,1667")
    assert made.end == 30915


@verifies("P006-MOT-10", "P006-MOT-11", "P006-MOT-12", "P006-MOT-13", "P006-MOT-14", "P006-MOT-16")
def test_w4_300_steps() -> None:
    need = [ramp_steps(3200, 600, n) for n in (3, 4, 5)]
    assert [2 * steps + 8 for steps in need] == [736, 372, 190] and need[0] == 364
    assert plan(300, 600, 600, 3200, 3, 3) == (3200, 5, 5)
    assert plan(736, 600, 600, 3200, 3, 3) == (3200, 3, 3) and plan(735, 600, 600, 3200, 3, 3) == (3200, 4, 4)
    assert by_coefficient(2600, 5) == 8986393 and by_distance(3200, 600, 95) == 8870042
    made = make(MotionStart(300, 600, 600, 3200, 3, 3))
    assert [speed for _, speed in made.updates[:8]] == [600, 600, 600, 600, 601, 601, 601, 602]
    head = "1659,1613,1534,1439,1341,1247,1162,1086,1019,959,907,860"
    assert fits(made.intervals, f"{head}..998,1062,1133,1215,1304,1400,1496,1583,1644,1666,1667,1667")
    assert (made.braked_at, made.end) == (83_600, 136_376)


@verifies("P006-MOT-15", "P006-MOT-17", "P006-MOT-20")
def test_w5_the_peak_falls() -> None:
    assert plan(256, 600, 600, 16_000, 3, 3) == (3699, 5, 5)
    made = make(MotionStart(256, 600, 600, 16_000, 3, 3))
    assert fits(made.intervals, "1661,1621,1551,1467,1375,1287..1605,1652,1667,1667,1666")
    assert made.engine.decel_start and made.engine.decel_start[0] == 127
    # The deceleration begins when the remaining steps are no more than the stopping distance.
    assert made.engine.decel_start[0] <= stopping_distance(made.engine.decel_start[1], 600, 5)


@verifies("P006-MOT-02", "P006-MOT-14")
def test_w6_a_ramp_lasts_as_long_as_a_straight_one() -> None:
    made = make(MotionStart(2000, 600, 600, 3200, 3, 3))
    speeds = dict(made.updates)
    assert speeds[95_600] == 1900
    # The ramp lasts 2600 / 13600 s; its middle is at half of this time.
    assert next(t for t, speed in made.updates if speed == 3200) <= 191_200
    assert next(t for t, _, stage in made.steps if stage is Stage.CRUISE) > 191_100
    assert sum(t <= 191_100 for t, *_ in made.steps) == 2000 - 1638


def off_from(t: int, target: int) -> Made:
    """Run speed mode from 600 to `target` and switch it off at t us."""
    return make(MotionStart(None, 600, 600, target, 3, 3), lambda now: LiveRegisters(target, stop=now >= t))


@verifies("P006-MOT-40", "P006-MOT-41")
def test_w7_speed_mode() -> None:
    made = off_from(1_000_000, 3200)
    head = "1667,1663,1657,1647,1636,1621,1604,1586"
    assert (len(made.steps), made.end) == (3314, 1_191_200)
    assert fits(made.intervals, f"{head}..1608,1625,1638,1650,1659,1663")


@verifies("P006-MOT-41", "P006-STA-02")
def test_w8_below_the_stop_speed() -> None:
    made = off_from(200_000, 50)
    assert made.intervals == [20_000] * 10 and made.end == 200_100


@verifies("P006-MOT-30", "P006-MOT-50")
def test_w9_new_maximum_speed() -> None:
    def live(t: int) -> LiveRegisters:
        return LiveRegisters(1600 if t >= 500_000 else 3200, stop=t >= 1_000_000)

    made = make(MotionStart(None, 600, 600, 3200, 3, 3), live)
    assert (len(made.steps), made.end) == (2326, 1_073_600)


@verifies("P006-MOT-41")
def test_w10_off_in_the_middle_of_the_ramp() -> None:
    made = off_from(100_000, 3200)
    assert (len(made.steps), made.end) == (244, 202_300)
    assert max(speed for _, speed in made.updates) == dict(made.updates)[100_000] == 1990
    assert fits(made.intervals, "1667,1663,1657,1647,1636..1633,1649,1660")


@verifies("P006-MOT-40", "P006-MOT-20")
def test_w12_to_w14_factory_values() -> None:
    assert [ramp_steps(1000, 600, n) for n in (0, 1)] == [189, 95]
    made = make(MotionStart(287, 600, 600, 1000, 0, 0))
    assert fits(made.intervals, "1667,1665,1663,1659,1654,1648,1641,1633..1659,1663,1664,1667,1667,1666,1667")
    assert (made.braked_at, made.engine.decel_start, made.end) == (211_600, (99, 1000), 336_484)
    made = make(MotionStart(None, 600, 600, 1000, 0, 0), lambda t: LiveRegisters(1000, stop=t >= 1_000_000))
    assert (len(made.steps), made.end) == (1141, 1_235_300)
    assert fits(made.intervals, "1667,1667,1666,1664,1664,1662..1661,1663,1664,1666,1667,1666")
    made = make(MotionStart(None, 2500, 2500, 2500, 3, 3), lambda t: LiveRegisters(2500, stop=t >= 500_000))
    assert made.intervals == [400] * 1250 and made.end == 500_100
