"""Chopper and reference bit streams of the PMC006B4 (P006-CHP, P006-EXC-40)."""

from __future__ import annotations

import random
from math import exp

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.chip import Phase
from openppmc.model.clock import Scheduler
from openppmc.model.pmc006.drive.chopper import Chopper, Times
from openppmc.model.pmc006.drive.drive import Stream
from tests.pmc006.model.bench import SETUP, Bench


class Phases:
    """One chopper.

    Attributes:
        changes: changes of the outputs as (edge, plus, minus).
    """

    def __init__(self, times: Times | None = None) -> None:
        self.queue = Scheduler()
        self.changes: list[tuple[int, int, int]] = []
        self.shown = (-1, 0, 0)
        times = times or Times.of(16_000_000, 20_000, 1_000)
        self.chopper = Chopper(self.queue, times, lambda *change: self.changes.append(change))

    def at(self, t: int, what: str, *levels: int) -> None:
        """Schedule a cause at edge t: `compare`, `reference` or `enable`."""
        phase = Phase.LEVELS if what == "compare" else Phase.PIN
        self.queue.at(t, phase, lambda now: getattr(self.chopper, what)(now, *levels))

    def run(self, t: int) -> list[tuple[int, int, int]]:
        """Run all edges up to t; return the changes of the outputs since the last call, one per edge."""
        while (edge := self.queue.next_edge()) is not None and edge <= t:
            self.queue.now = edge - 1
            self.queue.run_edge(edge)
        self.queue.now = t
        last = {change[0]: change for change in self.changes}
        found, self.changes = [self.shown, *last.values()], []
        self.shown = found[-1]
        return [b for a, b in zip(found, found[1:], strict=False) if a[1:] != b[1:]]


@verifies("P006-CHP-02")
@pytest.mark.parametrize(
    ("clk_hz", "off", "blank", "wanted"),
    [
        (16_000_000, 20_000, 1_000, (320, 16, 160)),
        (8_000_000, 20_000, 1_000, (160, 8, 80)),
        (12_345_678, 1_000, 10_000, (13, 124, 124)),
        (200_000_000, 100_000, 100, (20_000, 20, 10_000)),
        (25_000_000, 20_020, 1_010, (501, 26, 250)),
    ],
)
def test_times(clk_hz: int, off: int, blank: int, wanted: tuple[int, int, int]) -> None:
    times = Times.of(clk_hz, off, blank)
    assert (times.off, times.blank, times.fast) == wanted


@verifies("P006-CHP-02", "P006-CHP-03", "P006-CHP-05", "P006-BAD-20")
def test_stuck_comparator() -> None:
    phases = Phases()
    phases.at(0, "enable", True)
    phases.at(0, "compare", 1)
    phases.at(0, "reference", 100, 0)
    assert phases.run(1500) == [
        (320, 0, 1),
        (480, 0, 0),
        (800, 0, 1),
        (960, 0, 0),
        (1280, 0, 1),
        (1440, 0, 0),
    ]
    phases.at(1501, "compare", 0)
    assert phases.run(100_000) == [(1760, 1, 0)]


@verifies("P006-CHP-03", "P006-CHP-05")
def test_comparator_ends_the_pulse_after_blanking() -> None:
    phases = Phases()
    phases.at(0, "enable", True)
    phases.at(0, "reference", 100, 1)
    # The new sign takes effect one cycle later. If the comparator is already high during blanking, the pulse
    # ends at the end of blanking; if it becomes high later, the pulse ends immediately.
    phases.at(325, "compare", 1)
    phases.at(338, "compare", 0)
    assert phases.run(656) == [(321, 0, 1), (337, 0, 0)]
    assert phases.run(657) == [(657, 0, 1)]
    phases.at(700, "compare", 1)
    phases.at(1021, "compare", 0)
    # At 1020 the comparator is still 1, so fast decay follows, until the comparator is 0.
    assert phases.run(1200) == [(700, 0, 0), (1020, 1, 0), (1036, 0, 0)]
    phases.at(1356, "compare", 1)
    phases.at(1400, "compare", 0)
    assert phases.run(1700) == [(1356, 1, 0), (1400, 0, 0)]


@verifies("P006-CHP-04")
def test_changes_of_the_reference() -> None:
    phases = Phases()
    phases.at(0, "enable", True)
    phases.at(10, "reference", 100, 0)
    assert phases.run(400) == [(320, 1, 0)]
    # A new magnitude of the reference has no effect. A new sign turns the bridge off and restarts the
    # off-time.
    phases.at(401, "reference", 101, 0)
    phases.at(500, "reference", 101, 1)
    assert phases.run(900) == [(501, 0, 0), (821, 0, 1)]
    # A new sign also restarts the off-time in the off state.
    phases.at(1000, "compare", 1)
    phases.at(1100, "reference", 5, 0)
    phases.at(1101, "compare", 0)
    assert phases.run(1420) == [(1000, 0, 0)]
    assert phases.run(1421) == [(1421, 1, 0)]


@verifies("P006-CHP-04", "P006-CHP-03")
def test_a_reference_of_0_lets_the_current_fall() -> None:
    """A reference of 0 does not end a pulse, and the comparator still takes effect; but an off state is
    followed by another off state, not by an on state.
    """
    phases = Phases()
    phases.at(0, "enable", True)
    phases.at(10, "reference", 100, 0)
    phases.at(400, "reference", 0, 0)
    phases.at(500, "compare", 1)
    assert phases.run(819) == [(320, 1, 0), (500, 0, 0)]
    phases.at(900, "compare", 0)
    assert phases.run(900) == [(820, 0, 1), (900, 0, 0)]
    # At 1220, 1540 and 1860 the off-time ends without a change; then the comparator reports a current again.
    phases.at(2000, "compare", 1)
    assert phases.run(2179) == []
    assert phases.run(2340) == [(2180, 0, 1), (2340, 0, 0)]
    phases.at(2341, "compare", 0)
    # A reference that is set on the edge of a decision is one cycle too late for this decision.
    phases.at(2660, "reference", 7, 0)
    assert phases.run(2979) == []
    assert phases.run(2980) == [(2980, 1, 0)]


@verifies("P006-CHP-01", "P006-CHP-04")
def test_disabled() -> None:
    phases = Phases()
    phases.at(0, "reference", 100, 0)
    phases.at(1000, "enable", True)
    phases.at(1400, "enable", False)
    phases.at(2000, "reference", 100, 1)
    phases.at(2500, "enable", True)
    assert phases.run(5000) == [(1320, 1, 0), (1400, 0, 0), (2820, 0, 1)]


@pytest.mark.parametrize("seed", range(8))
@verifies("P006-CHP-02", "P006-CHP-03", "P006-CHP-04", "P006-CHP-06")
def test_against_a_chopper_that_looks_at_every_clk(seed: int) -> None:
    rng = random.Random(seed)
    print(f"seed {seed}")
    phases = Phases(times=Times(40, 5, 20))
    cmp, ref, sign, on, t = 0, 0, 0, True, 1
    phases.at(0, "enable", True)
    causes: dict[int, list[tuple[str, tuple[int, ...]]]] = {0: [("enable", (1,))]}
    while t < 20_000:
        what = rng.choice(["compare"] * 30 + ["reference"] * 3 + ["enable"])
        if what == "compare":
            cmp ^= 1
            levels: tuple[int, ...] = (cmp,)
        elif what == "reference":
            ref, sign = rng.choice(((0, 0), (9, sign), (200, 1 - sign)))
            levels = (ref, sign)
        else:
            on = not on
            levels = (int(on),)
        phases.at(t, what, *levels)
        causes.setdefault(t, []).append((what, levels))
        t += rng.choice((1, 5, 6, 20, rng.randint(1, 45), rng.randint(1, 150)))

    # Registers of an equivalent synchronous circuit: state and counter of the chopper, and the registers of
    # the drive around it.
    state, count, pins = "OFF", 0, (0, 0)
    level = reference = sign_now = sign_before = enabled = 0
    wanted = []
    for edge in range(20_200):
        for what, levels in causes.get(edge, ()):
            level = levels[0] if what == "compare" else level
        count += 1
        if not enabled or sign_now != sign_before:
            state, count = "OFF", 0
        elif state == "OFF" and count == 40:
            state, count = ("FAST" if level else "ON" if reference else "OFF"), 0
        elif state == "ON" and count >= 5 and level:
            state, count = "OFF", 0
        elif state == "FAST" and ((count >= 5 and not level) or count == 20):
            state, count = "OFF", 0
        sign_before = sign_now
        for what, levels in causes.get(edge, ()):
            if what == "enable":
                enabled = levels[0]
            elif what == "reference":
                reference, sign_now = levels
        if not enabled:
            state, count = "OFF", 0
        plus = int(state != "OFF" and (state == "ON") != bool(sign_before))
        now = (plus, int(state != "OFF") - plus)
        if now != pins:
            wanted.append((edge, *now))
            pins = now
    assert phases.run(20_199) == wanted and len(wanted) > 100


@verifies("P006-EXC-40")
def test_stream_has_as_many_ones_as_the_reference_says() -> None:
    rng = random.Random(6)
    stream, sum_, t = Stream(0), 0, 0
    old = 0
    for _ in range(40):
        until = t + rng.choice((1, 2, 300, rng.randint(1, 400)))
        ones = []
        for edge in range(t + 1, until):
            carry, sum_ = divmod(sum_ + old, 256)
            assert stream.level(edge) == carry
            ones.append(carry)
        if len(ones) >= 256:
            assert sum(ones[:256]) == old
        carry, sum_ = divmod(sum_ + old, 256)
        old = rng.randrange(256)
        stream.change(until, old)
        assert stream.level(until) == carry
        t = until
    with pytest.raises(ValueError, match="has changed"):
        stream.level(t - 1)


@pytest.mark.parametrize("tau", [64, 128, 256])
@verifies("P006-EXC-40")
def test_ripple_behind_a_low_pass(tau: int) -> None:
    """After a low-pass filter, the ripple of a bit stream is at most 256 / tau codes (tau in cycles)."""
    keep = exp(-1 / tau)
    for ref in (1, 31, 85, 127, 128, 255):
        stream, level, seen = Stream(0), float(ref), []
        stream.change(1, ref)
        for edge in range(2, 12 * tau + 512):
            level = level * keep + 256 * stream.level(edge) * (1 - keep)
            seen.append(level)
        assert max(seen[-512:]) - min(seen[-512:]) < 256 / tau


@verifies("P006-CHP-05", "P006-EXC-40", "P006-CHP-01")
def test_pins() -> None:
    """Both outputs of a phase are low 2 cycles after the comparator pin rises; each phase has its own
    comparator.
    """
    bench = Bench(**SETUP)
    bench.wait(100)
    assert [bench.log.levels[pin] for pin in ("m10", "m11", "m20", "m21")] == [1, 0, 1, 0]
    t = bench.do(lambda t: bench.drive.compare(t, 1, 0), Phase.PINS)
    bench.wait(10)
    assert bench.log.of("m10", t) == [(t + 2, 0)] and not bench.log.of("m20", t)
    bench.do(lambda t: bench.drive.compare(t, 0, 0), Phase.PINS)
    bench.wait(100)
    assert bench.log.of("m10", t)[-1] == (t + 2 + 320, 1)
    now = bench.queue.now
    assert sum(bench.drive.level(t, "a") for t in range(now, now + 256)) == 45
