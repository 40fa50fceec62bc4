"""Scripts: choppers and bridges."""

from __future__ import annotations

import random
from itertools import pairwise
from math import ceil

from cocotb_tests.harness.verifies import verifies

from .scenes import after_steps, brisk, rest, run, start
from .script_host import Host


class Times:
    """TOFF, BL, TF of chapter 6.6 in clk."""

    def __init__(self, host: Host) -> None:
        params = host.tape.params
        hz = host.clk_hz
        self.off, self.blank = (
            ceil(int(str(params[name])) * hz / 1_000_000_000) for name in ("T_OFF_NS", "T_BLANK_NS")
        )
        self.fast = max(self.blank, self.off >> 1)


def ready() -> tuple[Host, Times]:
    """A part that holds its full current."""
    host = Host()
    host.ok(a=0, e=4000)
    return host, Times(host)


def never_both(host: Host) -> bool:
    """Whether the two halves of a bridge are never high together."""
    for pair in (("m10", "m11"), ("m20", "m21")):
        times = sorted({t for name in pair for t, _ in host.edges(name)})
        if any(all(host.level_at(name, t) for name in pair) for t in times[:400]):
            return False
    return True


@verifies("P006-CHP-02", "P006-CHP-03", "P006-CHP-05", "P006-CHP-06", "P006-BAD-20")
def test_stuck_comparators() -> None:
    """At 1: OFF and FAST alternate; at 0: ON for ever; each phase by itself."""
    host, times = ready()
    assert (host.out("m10"), host.out("m11"), host.out("m20"), host.out("m21")) == (1, 0, 1, 0)
    for cmp, plus, minus, other in (("cmp_a", "m10", "m11", "m20"), ("cmp_b", "m20", "m21", "m10")):
        host.pins(**{cmp: 1})
        edge = host.t - 1
        host.pause(6 * (times.off + times.fast))
        (down, _), *more = host.edges(plus, edge)
        assert 0 < down - edge <= 4 and not more and not host.edges(other, edge)
        changes = host.edges(minus, edge)[:8]
        assert changes[0][0] - down == times.off
        gaps = [b[0] - a[0] for a, b in zip(changes, changes[1:], strict=False)]
        assert gaps == ([times.fast, times.off] * 4)[: len(gaps)]
        host.pins(**{cmp: 0})
        edge = host.t - 1
        host.pause(2 * (times.off + times.fast))
        assert host.out(plus) and not host.out(minus)
        host.pause(20 * times.off)
        assert host.edges(plus, edge)[-1][0] < edge + 2 * times.off + times.fast
    assert never_both(host)


@verifies("P006-CHP-03", "P006-CHP-05")
def test_lengths_of_the_pulses() -> None:
    """ON: the blanking at least, then until the comparator; FAST ends with it, or after TF."""
    host, times = ready()

    def cycle(rise: int, fall: int) -> tuple[int, int]:
        """cmp_a rises `rise` clk after an ON begins; it falls `fall` clk after the next pulse begins."""
        host.pins(cmp_a=1)
        host.pause(2 * times.off + 2 * times.fast)
        host.pins(cmp_a=0)
        host.pause(2 * times.off + times.fast)
        host.pins(cmp_a=1)
        host.pause(5)
        down = host.edges("m10", 0)[-1][0]
        host.pins(cmp_a=0)
        up = down + times.off
        host.go(up + rise)
        host.pins(cmp_a=1)
        host.pause(times.blank + 8)
        end = host.edges("m10", up + 1)[0][0]
        host.go(end + times.off + fall)
        back = end + times.off
        host.pins(cmp_a=0)
        host.pause(times.fast + times.blank + 8)
        changes = host.edges("m11", back)
        assert changes[0] == (back, 1)
        return end - up, changes[1][0] - back

    for rise in (0, 1, times.blank - 3, times.blank, times.blank + 1, 5 * times.blank):
        for fall in (1, times.blank + 3, times.fast - 6):
            on, fast = cycle(rise, fall)
            assert max(times.blank, rise + 2) <= on <= max(times.blank, rise + 2) + 2
            shortest, longest = (min(times.fast, max(times.blank, fall + late)) for late in (0, 4))
            assert shortest <= fast <= longest
    _, fast = cycle(3, times.fast + 5)
    assert fast == times.fast


@verifies("P006-CHP-04", "P006-CHP-02", "P006-CHP-06")
def test_reversals() -> None:
    """A new sign is an OFF of TOFF; with a reference of 0 nothing is switched on; never a direct reversal."""
    host, times = ready()
    brisk(host, 500, m=2, P=300)
    for direction in (1, 0):
        host.ok(d=direction)
        start(host, 9)
        mark = host.mark
        rest(host)
        host.pause(times.off + 64)
        for phase, pair in (("a", ("m10", "m11")), ("b", ("m20", "m21"))):
            turned = [edge for edge, _ in host.edges(f"phase_{phase}_sign", mark)]
            assert turned
            for edge in turned:
                assert not any(host.level_at(name, edge + 1) for name in pair)
                rises = [t for name in pair for t, level in host.edges(name, edge) if level]
                assert not rises or min(rises) >= edge + times.off
            refs = host.edges(f"phase_{phase}_ref", mark)
            for (gone, ref), (back, _) in pairwise(refs):
                rises = [t for name in pair for t, level in host.edges(name, gone) if level]
                assert ref or not [t for t in rises if gone < t <= back]
    assert never_both(host)


@verifies("P006-CHP-04", "P006-CHP-03")
def test_reference_of_0() -> None:
    """FAST takes what is left to 0; then OFF follows OFF, to the clk, until there is a reference again."""
    host, times = ready()
    brisk(host, 500, m=2)
    start(host, 3)
    rest(host)
    host.pause(64)
    assert not host.out("phase_b_ref") and not host.out("phase_b_sign")
    # The ON of before ends with the comparator; that falls in the middle of the second FAST.
    host.pins(cmp_b=1)
    since = host.t
    host.pause(2 * times.off + times.fast + times.blank)
    host.pins(cmp_b=0)
    host.pause(8 * times.off)
    (first, _), (over, _), (second, _), (fall, _) = host.edges("m21", since)
    assert (over - first, second - over) == (times.fast, times.off)
    assert times.blank <= fall - second <= times.fast
    # A current again: FAST at the next end of an OFF.
    host.pins(cmp_b=1)
    host.pause(times.off + 4)
    host.pins(cmp_b=0)
    again = host.edges("m21", fall + 1)[0][0]
    assert (again - fall) % times.off == 0
    assert [level for _, level in host.edges("m20", since)] == [0], "on without a reference"
    # The next step has a new sign, and so an OFF of its own.
    start(host, 1)
    host.pause(2 * times.off + 64)
    turned = host.edges("phase_b_sign", again)[0][0]
    assert host.edges("m21", turned)[0] == (turned + 1 + times.off, 1)


@verifies("P006-CHP-01", "P006-CHP-04", "P006-STA-12")
def test_bridges_off() -> None:
    host, times = ready()
    host.pins(cmp_a=1)
    host.pause(times.off + 9)
    host.ok(g=1)
    assert [host.out(name) for name in ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21")] == [0] * 6
    mark = host.t
    host.pause(5 * times.off)
    assert not any(host.edges(name, mark) for name in ("m10", "m11", "m20", "m21"))
    host.ok(g=0)
    up = host.edges("bridge_b_en", host.said)[0][0]
    rise = next(t for t, level in host.edges("m20", up) if level)
    assert (rise - up) % times.off == 0


@verifies("P006-CHP-03", "P006-CHP-04", "P006-CHP-05", "P006-CHP-06", "P006-BAD-20")
def test_restless_comparators() -> None:
    """Comparators at any moment while the motor turns."""
    host, times = ready()
    brisk(host, 2500, m=4)
    run(host)
    rng = random.Random(6)
    for _ in range(250):
        host.pins(**{rng.choice(("cmp_a", "cmp_b")): rng.getrandbits(1)})
        host.pause(rng.choice((1, 2, 5, times.blank, times.fast, times.off, 3 * times.off)))
    after_steps(host, 3)
    assert host.ask("I") == 0 and never_both(host)
