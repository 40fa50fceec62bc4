"""Motions of the PMC006B4 compared with a model in steps of one microsecond; properties of every move."""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import groupby

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.pmc006.motion.engine import LiveRegisters, MotionStart, Plan, Stage, acceleration, plan
from tests.pmc006.model.bench import Made, make
from tests.pmc006.model.reference import Reference

ENDLESS_US = 250_000
SPEED_RANGE = st.integers(65, 3000)
COEFFICIENT = st.integers(0, 5)


def compare(order: MotionStart, changes: dict[int, tuple[int, bool]], straight: bool, last_us: int) -> None:
    """Check that engine and reference make the same steps and end at the same time.

    Args:
        changes: us -> (target, speed mode off) from that time on.
    """

    def at(t: int) -> tuple[int, bool]:
        return next((what for since, what in reversed(changes.items()) if since <= t), (order.target, False))

    slow = Reference(*order, lambda t: at(t)[0], lambda t: at(t)[1], straight).run(last_us)
    made = make(order, lambda t: LiveRegisters(at(t)[0], straight, at(t)[1]), last_us // 100 + 1)
    steps = [(t, speed) for t, speed, _ in made.steps if t <= last_us]
    assert steps == slow.steps
    if slow.done:
        assert made.end == slow.t


def random_order(rng: random.Random) -> MotionStart:
    kind = rng.choice("LSV")
    vs, ve = (int(65 * 46 ** rng.random()) for _ in range(2))
    low = max(vs, ve) if kind != "V" else 1
    target = int(low * (16_000 / low) ** rng.random())
    count = {"L": rng.randint(1, 255), "S": rng.randint(256, 900), "V": None}[kind]
    return MotionStart(count, vs, ve, target, rng.randint(0, 5), rng.randint(0, 5))


@pytest.mark.parametrize("seed", range(24))
@verifies("P006-MOT-03", "P006-MOT-13", "P006-MOT-14", "P006-MOT-15", "P006-MOT-30", "P006-MOT-42")
def test_same_as_the_reference(seed: int) -> None:
    rng = random.Random(seed)
    order = random_order(rng)
    changes: dict[int, tuple[int, bool]] = {}
    target, off = order.target, False
    for _ in range(rng.randint(0, 5) if order.n is None or order.n >= 256 else 0):
        target = rng.choice((target, rng.randint(0, 16_000), rng.randint(0, 1000), order.ve, order.vs))
        off = order.n is None and rng.random() < 0.4
        changes[max([0, *changes]) + rng.randint(1, 60_000)] = (target, off)
    print(f"seed {seed}: {order} {changes}")
    compare(order, changes, rng.random() < 0.3, ENDLESS_US)


@verifies("P006-MOT-42")
def test_back_to_speed_between_the_ramp_and_the_end() -> None:
    """In worked move W10, N = 1 after the STOP ramp, in the last 100 us before the end, returns the motor to
    the target speed.
    """
    changes = {100_000: (3200, True), 202_150: (3200, False)}
    compare(MotionStart(None, 600, 600, 3200, 3, 3), changes, False, 500_000)
    made = make(
        MotionStart(None, 600, 600, 3200, 3, 3),
        lambda t: LiveRegisters(3200, stop=100_000 <= t < 202_150),
        5000,
    )
    assert max(made.intervals) <= 1667 and made.steps[-1][1] == 3200


@verifies("P006-MOT-31")
def test_target_zero_and_back() -> None:
    def live(t: int) -> LiveRegisters:
        return LiveRegisters(0 if 200_000 <= t < 700_000 else 2000)

    made = make(MotionStart(3000, 600, 600, 2000, 5, 5), live)
    assert len(made.steps) == 3000
    assert max(made.intervals) > 400_000 and made.steps[-1][1] == 600


@verifies("P006-MOT-21", "P006-MOT-52")
def test_target_below_the_start_speed() -> None:
    """A target below the start speed, which only the analog input can set, is planned without a ramp; if it
    is also below the stop speed, there is no deceleration.
    """
    assert plan(1000, 600, 400, 500, 2, 3) == Plan(500, 2, 3)
    made = make(MotionStart(1000, 600, 400, 350, 2, 3))
    assert {speed for _, speed in made.updates} == {350} and made.engine.decel_start is None
    made = make(MotionStart(1000, 600, 400, 500, 2, 3))
    assert made.engine.decel_start is not None and made.steps[-1][1] == 400


@verifies("P006-MOT-23")
@pytest.mark.parametrize("target", [600, 16_000])
def test_short_moves_know_no_maximum_speed(target: int) -> None:
    made = make(
        MotionStart(255, 600, 600, target, 0, 0), lambda t: LiveRegisters(target if t < 1000 else 100)
    )
    assert {speed for _, speed in made.updates} == {600}


def check_move(made: Made, order: MotionStart) -> None:
    """Check the properties that the rules P006-MOT require of a move with constant parameters."""
    n, steps = order.n, made.steps
    assert n is not None and len(steps) == n
    speeds = [speed for _, speed in made.updates]
    if n >= 5:
        assert steps[-1][1] == order.ve
    else:
        assert min(order.vs, order.ve) <= steps[-1][1] <= max(order.vs, order.ve)
    if n < 256:
        return
    assert max(speeds) <= order.target
    runs = [speed for speed, _ in groupby(speeds)]
    top = runs.index(max(runs))
    assert runs[: top + 1] == sorted(runs[: top + 1]) and runs[top:] == sorted(runs[top:], reverse=True)
    if made.engine.decel_start:
        assert 2 <= sum(stage is Stage.CREEP for *_, stage in steps) <= 4
    engine = made.engine
    for first, later in zip(speeds, speeds[10:], strict=False):
        # These ten updates may belong to two ramps.
        n_of = engine.acc if later >= first else engine.dec
        assert abs(later - first) <= 1.5 * acceleration(n_of) * 1.02 / 1000 + 2 or engine.decel_start


@given(
    n=st.integers(256, 3000),
    vs=SPEED_RANGE,
    ve=SPEED_RANGE,
    over=st.integers(0, 13_000),
    acc=COEFFICIENT,
    dec=COEFFICIENT,
)
@settings(max_examples=25)
@verifies("P006-MOT-20", "P006-MOT-22", "P006-MOT-15", "P006-MOT-12", "P006-MOT-17")
def test_s_moves(n: int, vs: int, ve: int, over: int, acc: int, dec: int) -> None:
    order = MotionStart(n, vs, ve, max(vs, ve) + over, acc, dec)
    check_move(make(order), order)


@given(vs=SPEED_RANGE, ve=SPEED_RANGE, acc=COEFFICIENT, dec=COEFFICIENT, n=st.integers(1, 300))
@settings(max_examples=60)
@verifies("P006-MOT-23", "P006-MOT-11")
def test_moves_around_the_shortest(vs: int, ve: int, acc: int, dec: int, n: int) -> None:
    order = MotionStart(n, vs, ve, max(vs, ve), acc, dec)
    check_move(make(order), order)


@given(vs=SPEED_RANGE, ve=SPEED_RANGE, target=st.integers(1, 16_000), acc=COEFFICIENT, dec=COEFFICIENT)
@settings(max_examples=25)
@verifies("P006-MOT-40", "P006-MOT-41")
def test_speed_mode(vs: int, ve: int, target: int, acc: int, dec: int) -> None:
    live: Callable[[int], LiveRegisters] = lambda t: LiveRegisters(target, stop=t >= 400_000)  # noqa: E731
    made = make(MotionStart(None, vs, ve, target, acc, dec), live)
    speeds = [speed for _, speed in made.updates]
    assert speeds[0] == min(vs, target) and max(speeds) <= target
    top = speeds.index(max(speeds))
    assert speeds[:top] == sorted(speeds[:top])
    # The duration of the deceleration follows from the coefficient `dec`; up to one more update passes until
    # the stop is detected.
    there = dict(made.updates)[400_000]
    down = max(0, there - ve) / acceleration(dec) * 1e6
    assert -1 <= made.end - 400_000 - down <= 201
