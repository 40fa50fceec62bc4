"""Worked examples E1 to E32 of the PPMC-312 without time: plans of moves, and speed changes and stops at
given pulses.
"""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.ppmc312.codes import Cause
from openppmc.model.ppmc312.motion.sequence import Change, Sequence
from openppmc.model.ppmc312.stages import Plan, Step, Table, constant, curve, ramped
from tests.ppmc312.model.reference import T1, T2, T3, T4, TF, TG, TH, runs, ticks

PLANS = [
    ("E1", TF, 30, 0, (0x00, 12, 6, 12), "400x3 200x4 100x16 200x4 400x3", 5600),
    ("E2", TF, 24, 0, (0x00, 12, 0, 12), "400x3 200x4 100x10 200x4 400x3", 5000),
    ("E3", TF, 23, 0, (0x10, 11, 0, 12), "400x3 200x4 100x9 200x4 400x3", 4900),
    ("E4", TF, 7, 0, (0x10, 3, 0, 4), "400x3 200x1 400x3", 2600),
    ("E5", TF, 2, 0, (0x10, 1, 0, 1), "400x2", 800),
    ("E5b", TF, 1, 0, (0x10, 0, 0, 1), "400x1", 400),
    ("E6", TF, 20, 150, (0x00, 7, 6, 7), "400x3 200x4 150x6 200x4 400x3", 4900),
    ("E7", TF, 10, 300, (0x20, 0, 7, 3), "300x7 400x3", 3300),
    ("E8", TG, 30, 0, (0x00, 12, 8, 10), "400x3 200x4 100x19 200x4", 4700),
    ("E9", TG, 10, 0, (0x10, 6, 0, 4), "400x3 200x7", 2600),
    ("E10", TG, 3, 0, (0x40, 3, 0, 0), "400x3", 1200),
    ("E10b", TG, 4, 0, (0x10, 3, 0, 1), "400x3 200x1", 1400),
    ("E11", TH, 7, 0, (0x10, 2, 0, 5), "200x4 400x3", 2000),
    ("E12", TH, 2, 0, (0x20, 0, 0, 2), "400x2", 800),
    ("E13", T1, 5000, 0, (0x00, 2000, 1000, 2000), "1000x5 969x5 940x6 ... 940x6 969x5 1000x5", 1_532_294),
    ("E14", T1, 101, 0, (0x10, 50, 0, 51), "1000x5 969x5 940x6 913x5 ... 913x5 940x6 969x5 1000x5", 89_849),
    ("E15", T2, 3999, 0, (0x10, 1999, 0, 2000), "1000x5 999x5 998x5 994x6 ...", 1_332_196),
    ("E16", T3, 3000, 0, (0x10, 1730, 0, 1270), "1000x5 969x5 ... 488x10 496x9 504x8", 992_384),
    ("E17", T3, 100, 0, (0x40, 100, 0, 0), "1000x5 969x5 940x6 913x5 ... 692x8 677x4", 81_077),
    ("E18", T1, 5000, 500, (0x00, 250, 4500, 250), "...", 2_584_654),
    ("E19", T3, 5000, 993, (0x20, 0, 5000, 0), "993x5000", 4_965_000),
    ("E20", T4, 700, 0, (0x10, 211, 0, 489), "504x8 496x9 488x10 481x9 ... 969x5 1000x5", 362_582),
]


def fits(text: str, pattern: str) -> bool:
    """Return whether a list of pulses has the beginning and the end of a pattern with `...`."""
    head, dots, tail = (piece.strip() for piece in pattern.partition("..."))
    if not dots:
        return text == head
    return text.startswith(head) and text.endswith(tail)


@pytest.mark.parametrize(
    ("name", "table", "n", "rate", "shape", "pulses", "total"), PLANS, ids=[p[0] for p in PLANS]
)
@verifies("P312-MOT-10", "P312-MOT-11", "P312-MOT-12")
def test_plan(
    name: str, table: Table, n: int, rate: int, shape: tuple[int, ...], pulses: str, total: int
) -> None:
    plan = ramped(table, rate or table.high, n)
    assert (plan.kind, plan.up, n - plan.up - plan.down, plan.down) == shape
    steps = plan.steps()
    assert len(steps) == n and ticks(steps) == total
    assert fits(runs(steps), pulses)
    assert walk(plan)[0] == steps


@verifies("P312-BAD-15", "P312-CMD-01")
def test_a_curve_that_is_not_monotonic_is_executed_as_given() -> None:
    table = curve([100, 300, 200], [5, 4, 3])
    assert [table.stage(rate) for rate in (301, 300, 201, 200, 100)] == [123, 125, 125, 125, 126]
    assert runs(ramped(table, 100, 30).steps()) == "200x3 300x4 100x16 300x4 200x3"
    assert not table.contains(201)


Act = tuple[int, object]


def walk(plan: Plan, *acts: Act, limit: int = 10_000) -> tuple[list[Step], Cause]:
    """Run the sequence of pulses of a plan; return its pulses and the reason of its end.

    Each action takes place in the interval of its number; interval 0 is before pulse 1.
    """
    sequence, steps = Sequence(plan), []
    for number in range(limit):
        for when, act in acts:
            if when == number:
                if isinstance(act, Change):
                    sequence.change(act)
                else:
                    assert isinstance(act, Cause)
                    sequence.request(act)
        step = sequence.boundary()
        if isinstance(step, Cause):
            return steps, step
        steps.append(step)
    return steps, Cause.NORMAL


SLOW = Cause.SLOW
F30 = ramped(TF, 100, 30)


def jump(rate: int) -> Change:
    return Change(rate, False)


CHANGES = [
    ("E21", F30, [(15, SLOW)], "400x3 200x4 100x13 200x4 400x3", Cause.SLOW),
    ("E22", F30, [(5, SLOW)], "400x3 200x6 400x3", Cause.SLOW),
    ("E23", F30, [(2, SLOW)], "400x2", Cause.LOW),
    ("E24", F30, [(15, jump(200))], "400x3 200x4 100x8 200x7 400x8", Cause.NORMAL),
    ("E25", ramped(TF, 200, 30), [(11, jump(100))], "400x3 200x8 100x17 200x2", Cause.NORMAL),
    ("E26", F30, [(15, jump(400))], "400x3 200x4 100x8 400x15", Cause.NORMAL),
    ("E27", constant(TF, 400, 30), [(10, Change(100, True))], "400x10 200x4 100x16", Cause.NORMAL),
    ("E30", F30, [(24, SLOW)], "400x3 200x4 100x16 200x4 400x3", Cause.NORMAL),
    ("E30b", F30, [(28, SLOW)], "400x3 200x4 100x16 200x4 400x1", Cause.LOW),
    ("E31", F30, [(15, SLOW), (15, jump(150))], "400x3 200x4 100x13 200x4 400x3", Cause.SLOW),
    ("E31b", F30, [(15, jump(150)), (15, SLOW)], "400x3 200x4 100x13 200x4 400x3", Cause.SLOW),
    ("87 waits", F30, [(5, Change(200, True))], "400x3 200x4 100x6 200x9 400x8", Cause.NORMAL),
    ("no walk", ramped(TG, 100, 30), [(15, jump(300))], "400x3 200x4 100x8 300x15", Cause.NORMAL),
    ("E32", F30, [(18, jump(200))], "400x3 200x4 100x11 200x4 400x8", Cause.NORMAL),
]


@pytest.mark.parametrize(("name", "plan", "acts", "pulses", "cause"), CHANGES, ids=[c[0] for c in CHANGES])
@verifies("P312-MOT-20", "P312-MOT-30", "P312-MOT-31", "P312-MOT-32", "P312-MOT-33")
def test_change(name: str, plan: Plan, acts: list[Act], pulses: str, cause: Cause) -> None:
    steps, end = walk(plan, *acts)
    assert (runs(steps), end) == (pulses, cause)


@verifies("P312-MOT-32")
def test_ramp_down_goes_on_at_the_new_rate() -> None:
    """After a ramp to a lower speed, the motion continues at the new rate (E28)."""
    steps, _ = walk(constant(TF, 100), (10, Change(400, True)), limit=30)
    assert runs(steps) == "100x10 200x4 400x16"
    assert [step.stage for step in steps[9:18]] == [None, 125, 125, 125, 125, 124, 124, 124, None]


@verifies("P312-MOT-20")
def test_walk_from_a_constant_rate() -> None:
    """A deceleration from a constant rate begins at the stage of this rate (E29)."""
    steps, end = walk(constant(T1, 500), (7, SLOW))
    assert (len(steps), end) == (257, Cause.SLOW)
    assert fits(runs(steps), "500x7 504x10 512x11 521x10 529x10 ... 969x5 1000x5")


@verifies("P312-MOT-31")
def test_change_cancels_a_walk() -> None:
    steps, end = walk(F30, (15, SLOW), (18, jump(150)))
    assert (runs(steps), end) == ("400x3 200x4 100x11 200x4 400x8", Cause.NORMAL)
    steps, end = walk(constant(TF, 100), (15, SLOW), (17, jump(150)), (30, SLOW))
    assert (runs(steps), end) == ("100x17 150x13 200x4 400x3", Cause.SLOW)


@verifies("P312-MOT-30", "P312-MOT-42", "P312-MOT-43")
def test_requests_during_a_walk() -> None:
    origin = Cause.RETURN
    plan = ramped(TF, 100, None)
    assert walk(plan, (15, origin))[1] is Cause.RETURN
    assert len(walk(plan, (15, origin))[0]) == 27
    assert walk(plan, (1, origin)) == (walk(plan, (1, origin))[0], Cause.RETURN)
    assert walk(plan, (15, origin), (18, SLOW))[1] is Cause.SLOW
    assert walk(plan, (15, origin), (27, SLOW))[1] is Cause.SLOW
    assert walk(plan, (15, origin), (15, SLOW))[1] is Cause.SLOW
    assert walk(plan, (15, SLOW), (18, Cause.LIMIT_SLOW), (19, origin))[1] is Cause.SLOW
    assert walk(plan, (15, SLOW), (15, Cause.LIMIT_SLOW))[1] is Cause.LIMIT_SLOW
    assert walk(plan, (0, SLOW)) == ([], Cause.LOW)


@given(st.sampled_from([TF, TG, TH, T1, T3, T4]), st.integers(1, 6000), st.data())
@verifies("P312-MOT-07", "P312-MOT-33")
def test_counts_are_exact(table: Table, n: int, data: st.DataObject) -> None:
    """A counted operation without a request to decelerate has n pulses, even if its speed is changed."""
    rate = data.draw(st.integers(table.high, table.slowest))
    plan = ramped(table, rate, n)
    assert plan.up + plan.down <= n and len(plan.steps()) == n
    random_acts = random.Random(data.draw(st.integers(0, 10_000)))
    acts: list[Act] = [
        (
            random_acts.randint(0, n),
            Change(random_acts.randint(table.high, table.slowest), random_acts.random() < 0.5),
        )
        for _ in range(random_acts.randint(0, 3))
    ]
    steps, end = walk(plan, *acts)
    assert (len(steps), end) == (n, Cause.NORMAL)
    assert all(table.high <= step.rate <= table.slowest for step in steps)
