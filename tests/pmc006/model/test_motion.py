"""Motions of the PMC006B4, exact to the clock edge: start, steps, ends, stops, live registers (P006-MOT)."""

from __future__ import annotations

import random
from functools import partial

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.chip import Phase
from openppmc.model.pmc006.motion.engine import LiveRegisters, MotionStart
from openppmc.model.pmc006.motion.motion import base_code, compensation, drive_index
from tests.pmc006.model.bench import SETUP, Bench, make


@pytest.mark.parametrize("clk_hz", [8_000_000, 12_345_678, 16_000_000, 25_000_000])
@verifies("P006-MOT-03", "P006-MOT-04", "P006-MOT-05", "P006-PAR-01")
def test_steps_lie_on_us_ticks(clk_hz: int) -> None:
    bench = Bench(clk_hz, **SETUP)
    bench.wait(33)
    began = bench.t
    origin = bench.start(287)
    assert bench.motion.busy and began + 800 <= origin <= began + 1024
    bench.rest()
    made = make(MotionStart(287, 600, 600, 3200, 3, 3))
    first = bench.us.first(origin)
    assert bench.us.edge_of(first) == origin
    assert bench.steps == [bench.us.edge_of(first + t) + 2 for t, *_ in made.steps]
    assert bench.ends == [bench.steps[-1]] and bench.position == 287


@verifies("P006-MOT-05", "P006-EXC-02", "P006-STA-16")
def test_backwards_in_speed_mode() -> None:
    bench = Bench(vstart=2500, vstop=2500, vmax=2500, dir=0)
    bench.start(None)
    assert not bench.motion.forward
    bench.wait(100_000)
    steps = len(bench.steps)
    bench.do(lambda t: bench.motion.speed_mode(t, 0))
    off = bench.t
    bench.rest()
    gaps = {b - a for a, b in zip(bench.steps, bench.steps[1:], strict=False)}
    assert gaps == {400 * 16} and bench.position == -len(bench.steps)
    assert bench.ends[0] - off <= 200 * 16 and len(bench.steps) - steps <= 1
    assert bench.drive.angle == (64 - 8 * len(bench.steps)) % 512


@verifies("P006-MOT-42", "P006-STA-14")
@pytest.mark.parametrize(("early", "ends"), [(0, False), (1, False), (-1, True)])
def test_withdrawn_on_the_last_edge(early: int, ends: bool) -> None:
    """N = 1 on the edge that would end the motion still continues it; one cycle later, the motion has
    ended.
    """
    probe = Bench(**SETUP)
    bench = Bench(**SETUP)
    for one in (probe, bench):
        one.start(None)
        one.wait(100_000)
        one.do(lambda t, one=one: one.motion.speed_mode(t, 0))
    probe.rest()
    bench.run(probe.ends[0] - early - 1)
    if bench.motion.busy:
        bench.do(lambda t: bench.motion.speed_mode(t, 1), Phase.COMMAND)
    bench.wait(300_000)
    assert bool(bench.ends) == ends and bench.motion.busy != ends


@verifies("P006-STA-10", "P006-STA-14", "P006-STA-11")
def test_stop_suppresses_the_step_of_its_clk() -> None:
    for early, made in ((0, 9), (1, 9), (-1, 10)):
        probe, bench = Bench(**SETUP), Bench(**SETUP)
        for one in (probe, bench):
            one.start(300)
        probe.wait(30_000)
        bench.run(probe.steps[9] - early - 1)
        bench.halt()
        assert not bench.motion.busy and len(bench.steps) == made
        bench.wait(10_000)
        assert len(bench.steps) == made and not bench.ends
        bench.start(1)
        bench.rest()
        assert len(bench.steps) == made + 1


@verifies("P006-STA-14", "P006-MOT-04")
def test_stop_before_t_0_cancels() -> None:
    bench = Bench(**SETUP)
    origin = bench.start(1)
    bench.run(origin - 1)
    bench.halt()
    bench.wait(5000)
    assert not bench.steps and not bench.ends and bench.drive.angle == 64


@verifies("P006-CMD-54", "P006-MOT-30")
def test_latched_and_live_registers() -> None:
    changed = {"mstep": 4, "dir": 0, "vstart": 100, "vstop": 100, "acc": 5, "dec": 5}
    bench = Bench(**SETUP)
    bench.start(1000)
    bench.wait(50)
    bench.change(**changed)
    bench.rest()
    assert bench.position == 1000 and bench.drive.angle == (64 + 8000) % 512
    assert bench.ends[0] - bench.steps[0] == 16 * (471_687 - 1667)
    bench.start(256)
    assert bench.motion.increment == 32 and not bench.motion.forward


@pytest.mark.parametrize("seed", range(6))
@verifies("P006-MOT-30", "P006-MOT-50", "P006-MOT-51", "P006-MOT-52")
def test_live_targets(seed: int) -> None:
    """Registers and strobes that change at random edges take effect at the first update after the change."""
    rng = random.Random(seed)
    analog = seed % 2
    bench = Bench(8_000_000, **SETUP, analog=analog)
    bench.do(lambda t: bench.motion.adc(t, 500), Phase.PINS)
    origin = bench.start(None)
    history = [(origin - 1, 3200, 500)]
    while bench.queue.now < origin + 800_000:
        bench.wait(rng.randint(1, 9000))
        t, vmax, adc = history[-1]
        if analog and rng.random() < 0.5:
            adc = rng.choice((0, 1, 511, 512, 1023, rng.randrange(1024)))
            t = bench.do(lambda t, adc=adc: bench.motion.adc(t, adc), Phase.PINS)
        else:
            vmax = rng.randint(1, 16_000)
            t = bench.change(vmax=vmax)
        history.append((t, vmax, adc))
    print(f"seed {seed}: {history}")

    def before(us: int) -> tuple[int, int]:
        edge = origin + 8 * us
        return next((vmax, adc) for t, vmax, adc in reversed(history) if t < edge)

    def live(us: int) -> LiveRegisters:
        vmax = before(us)[0]
        if not analog:
            return LiveRegisters(vmax)
        sampled = before(us // 10_000 * 10_000)[1] if us >= 10_000 else 500
        return LiveRegisters((vmax * (sampled + (sampled >= 512))) // 1024, True)

    made = make(MotionStart(None, 600, 600, live(0).target, 3, 3), live, 1300)
    last = bench.queue.now - 3
    assert [t for t in bench.steps if t <= last] == [
        origin + 8 * us + 2 for us, *_ in made.steps if origin + 8 * us + 2 <= last
    ]


def _strobe(bench: Bench, value: int, t: int) -> None:
    bench.motion.adc(t, value)


@verifies("P006-MOT-51")
def test_analog_full_scale() -> None:
    for value, speed in ((0, 0), (1, 7), (511, 3992), (512, 4007), (1023, 8000)):
        bench = Bench(vmax=8000, analog=1)
        bench.do(partial(_strobe, bench, value), Phase.PINS)
        bench.start(None)
        bench.wait(100)
        assert bench.motion.engine and bench.motion.engine.request.target == speed


@pytest.mark.parametrize("late", [0, 1])
@verifies("P006-MOT-51")
def test_a_strobe_on_the_edge_of_the_copy_is_too_late(late: int) -> None:
    """A strobe on the edge at which update 100 copies the analog value is too late for this copy."""
    bench = Bench(vmax=8000, analog=1, vstart=100)
    bench.do(partial(_strobe, bench, 1023), Phase.PINS)
    origin = bench.start(None)
    bench.run(origin + 10_000 * 16 - 2 + late)
    bench.do(partial(_strobe, bench, 1), Phase.PINS)
    bench.wait(250)
    # If the strobe was too late, the target remains 8000; otherwise the target is 7.
    engine = bench.motion.engine
    assert engine and engine.goal == (8000 if late else 7)


@verifies("P006-EXC-20")
def test_drive_index_and_base_code() -> None:
    codes = [26, 35, 45, 54, 64, 73, 83, 92, 102, 112, 121, 131, 140, 150, 159, 169, 179, 188, 198, 207]
    codes += [217, 226, 236, 245, 255]
    assert [base_code(400 + 150 * k) for k in range(25)] == codes
    for cur in range(400, 4001):
        nearest = min(range(25), key=lambda k: (abs(400 + 150 * k - cur), -k))
        assert drive_index(cur) == nearest
    assert [drive_index(cur) for cur in (474, 475, 800, 1500, 2000, 3924, 3925)] == [0, 1, 3, 7, 11, 23, 24]


@verifies("P006-EXC-21", "P006-EXC-22", "P006-EXC-23")
def test_compensation() -> None:
    assert compensation(3000, 0, 1000, 300, 1250) == (13, 57)
    assert compensation(3200, 16, 1000, 300, 1250) == (0, 3)
    assert compensation(16_000, 0, 4000, 1200, 2000) == (1167, 64)
    # About 7 % and 13 degrees at 1000 full steps/s with the factory values of both factors.
    b, w = compensation(16_000, 16, 4000, 300, 1250)
    assert abs(b / 255 - 0.07) < 0.002 and w == 19


@verifies("P006-EXC-24")
def test_compensation_follows_the_updates() -> None:
    bench = Bench(cur=1000, vmax=3000, vstart=3000, vstop=3000, mstep=0)
    origin = bench.start(None)
    bench.run(origin + 1599)
    assert (bench.motion.current_comp, bench.motion.lead_angle) == (0, 0)
    bench.run(origin + 1600)
    assert (bench.motion.current_comp, bench.motion.lead_angle) == (13, 57)
    bench.change(ccomp=1200, scomp=300)
    bench.run(origin + 3 * 1600 - 1)
    assert (bench.motion.current_comp, bench.motion.lead_angle) == (13, 57)
    bench.run(origin + 3 * 1600)
    assert (bench.motion.current_comp, bench.motion.lead_angle) == (54, 13)
    bench.halt()
    assert (bench.motion.current_comp, bench.motion.lead_angle) == (0, 0)


@verifies("P006-EXC-24", "P006-EXC-21")
def test_compensation_in_a_ramp_is_one_update_old() -> None:
    bench = Bench(vmax=16_000, acc=5, mstep=2, cur=4000)
    origin = bench.start(None)
    made = make(MotionStart(None, 600, 600, 16_000, 5, 0), updates=2000)
    both = [compensation(speed, 2, 4000, 300, 1250) for _, speed in made.updates]
    changes = [number for number in range(1, 2000) if both[number] != both[number - 1]]
    for number in changes[:30]:
        bench.run(origin + 1600 * number)
        assert (bench.motion.current_comp, bench.motion.lead_angle) == both[number - 1]
        bench.run(origin + 1600 * (number + 1))
        assert (bench.motion.current_comp, bench.motion.lead_angle) == both[number]
    assert len(changes) > 100


@verifies("P006-STL-01")
def test_steady_speed() -> None:
    """`at_constant_speed` changes one update (100 us) after the end or the beginning of a ramp, so it does
    not depend on the duration of the calculation.
    """
    bench = Bench(**SETUP)
    origin = bench.start(2000)
    made = make(MotionStart(2000, 600, 600, 3200, 3, 3))
    there = 191_200
    bench.run(origin + 16 * there - 1)
    assert not bench.motion.at_constant_speed
    bench.run(origin + 16 * there)
    assert bench.motion.at_constant_speed
    bench.run(origin + 16 * (made.braked_at or 0) + 16 * 100 - 1)
    assert bench.motion.at_constant_speed
    bench.run(origin + 16 * (made.braked_at or 0) + 16 * 100)
    assert not bench.motion.at_constant_speed
