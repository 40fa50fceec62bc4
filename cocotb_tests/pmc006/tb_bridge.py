"""Choppers and bridges."""

from __future__ import annotations

import random
from itertools import pairwise
from math import ceil
from typing import Any

from .builds import BLANK, F8B, ODD, directed
from .host import Host
from .moves import after_steps, run, set_constant_speed, start, wait_stopped

BUILDS = (F8B, ODD, BLANK)


class Times:
    """TOFF, BL and TF of the chopper in cycles (P006-CHP-03)."""

    def __init__(self, host: Host) -> None:
        params = host.params
        hz = host.clk_hz
        self.off, self.blank = (
            ceil(int(str(params[name])) * hz / 1_000_000_000) for name in ("T_OFF_NS", "T_BLANK_NS")
        )
        self.fast = max(self.blank, self.off >> 1)


async def ready(dut: Any) -> tuple[Host, Times]:
    """Return a host of a part that holds its full current."""
    host = await Host.start(dut)
    await host.ok(a=0, e=4000)
    return host, Times(host)


def never_both(host: Host) -> bool:
    """Return whether the two half-bridges of a bridge are never high together."""
    for pair in (("m10", "m11"), ("m20", "m21")):
        times = sorted({t for name in pair for t, _ in host.edges(name)})
        if any(all(host.level_at(name, t) for name in pair) for t in times[:400]):
            return False
    return True


@directed("P006-CHP-02", "P006-CHP-03", "P006-CHP-05", "P006-CHP-06", "P006-BAD-20", builds=BUILDS)
async def p006_stuck_comparators(dut: Any) -> None:
    """With a comparator stuck at 1, the off state and fast decay alternate; with one stuck at 0, the on state
    lasts indefinitely.

    The phases are independent of each other.
    """
    host, times = await ready(dut)
    assert (await host.out("m10"), await host.out("m11"), await host.out("m20"), await host.out("m21")) == (
        1,
        0,
        1,
        0,
    )
    for cmp, plus, minus, other in (("cmp_a", "m10", "m11", "m20"), ("cmp_b", "m20", "m21", "m10")):
        await host.pins(**{cmp: 1})
        edge = host.t - 1
        await host.pause(6 * (times.off + times.fast))
        (down, _), *more = host.edges(plus, edge)
        assert 0 < down - edge <= 4 and not more and not host.edges(other, edge)
        changes = host.edges(minus, edge)[:8]
        assert changes[0][0] - down == times.off
        gaps = [b[0] - a[0] for a, b in zip(changes, changes[1:], strict=False)]
        assert gaps == ([times.fast, times.off] * 4)[: len(gaps)]
        await host.pins(**{cmp: 0})
        edge = host.t - 1
        await host.pause(2 * (times.off + times.fast))
        assert await host.out(plus) and not await host.out(minus)
        await host.pause(20 * times.off)
        assert host.edges(plus, edge)[-1][0] < edge + 2 * times.off + times.fast
    assert never_both(host)


@directed("P006-CHP-03", "P006-CHP-05", builds=BUILDS)
async def p006_lengths_of_the_pulses(dut: Any) -> None:
    """The on state lasts at least the blanking time, and after it until the comparator rises.

    Fast decay ends when the comparator falls, or after TF.
    """
    host, times = await ready(dut)

    async def cycle(rise: int, fall: int) -> tuple[int, int]:
        """Raise cmp_a `rise` cycles after an on state begins; lower it `fall` cycles after the next fast
        decay begins. Return the lengths of this on state and of this fast decay.
        """
        await host.pins(cmp_a=1)
        await host.pause(2 * times.off + 2 * times.fast)
        await host.pins(cmp_a=0)
        await host.pause(2 * times.off + times.fast)
        await host.pins(cmp_a=1)
        await host.pause(5)
        down = host.edges("m10", 0)[-1][0]
        await host.pins(cmp_a=0)
        up = down + times.off
        await host.go(up + rise)
        await host.pins(cmp_a=1)
        await host.pause(times.blank + 8)
        end = host.edges("m10", up + 1)[0][0]
        await host.go(end + times.off + fall)
        back = end + times.off
        await host.pins(cmp_a=0)
        await host.pause(times.fast + times.blank + 8)
        changes = host.edges("m11", back)
        assert changes[0] == (back, 1)
        return end - up, changes[1][0] - back

    for rise in (0, 1, times.blank - 3, times.blank, times.blank + 1, 5 * times.blank):
        for fall in (1, times.blank + 3, times.fast - 6):
            on, fast = await cycle(rise, fall)
            assert max(times.blank, rise + 2) <= on <= max(times.blank, rise + 2) + 2
            shortest, longest = (min(times.fast, max(times.blank, fall + late)) for late in (0, 4))
            assert shortest <= fast <= longest
    _, fast = await cycle(3, times.fast + 5)
    assert fast == times.fast


@directed("P006-CHP-04", "P006-CHP-02", "P006-CHP-06", builds=BUILDS)
async def p006_reversals(dut: Any) -> None:
    """A change of the sign causes an off state that lasts TOFF; no bridge reverses directly.

    With a reference of 0, no on state occurs.
    """
    host, times = await ready(dut)
    await set_constant_speed(host, 500, m=2, P=300)
    for direction in (1, 0):
        await host.ok(d=direction)
        await start(host, 9)
        mark = host.mark
        await wait_stopped(host)
        await host.pause(times.off + 64)
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


@directed("P006-CHP-04", "P006-CHP-03", builds=BUILDS)
async def p006_reference_of_0(dut: Any) -> None:
    """At a reference of 0, fast decay reduces the remaining current to 0.

    Then one off state follows another, exact to the cycle, until the reference is not 0.
    """
    host, times = await ready(dut)
    await set_constant_speed(host, 500, m=2)
    await start(host, 3)
    await wait_stopped(host)
    await host.pause(64)
    assert not await host.out("phase_b_ref") and not await host.out("phase_b_sign")
    # The previous on state ends because the comparator is high. The comparator falls during the second fast
    # decay.
    await host.pins(cmp_b=1)
    since = host.t
    await host.pause(2 * times.off + times.fast + times.blank)
    await host.pins(cmp_b=0)
    await host.pause(8 * times.off)
    (first, _), (over, _), (second, _), (fall, _) = host.edges("m21", since)
    assert (over - first, second - over) == (times.fast, times.off)
    assert times.blank <= fall - second <= times.fast
    # With cmp_b = 1 again, fast decay begins at the next end of an off state.
    await host.pins(cmp_b=1)
    await host.pause(times.off + 4)
    await host.pins(cmp_b=0)
    again = host.edges("m21", fall + 1)[0][0]
    assert (again - fall) % times.off == 0
    assert [level for _, level in host.edges("m20", since)] == [0], "on without a reference"
    # The next step changes the sign and therefore causes another off state.
    await start(host, 1)
    await host.pause(2 * times.off + 64)
    turned = host.edges("phase_b_sign", again)[0][0]
    assert host.edges("m21", turned)[0] == (turned + 1 + times.off, 1)


@directed("P006-CHP-01", "P006-CHP-04", "P006-STA-12", builds=BUILDS)
async def p006_bridges_off(dut: Any) -> None:
    host, times = await ready(dut)
    await host.pins(cmp_a=1)
    await host.pause(times.off + 9)
    await host.ok(g=1)
    assert [await host.out(name) for name in ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21")] == [
        0
    ] * 6
    mark = host.t
    await host.pause(5 * times.off)
    assert not any(host.edges(name, mark) for name in ("m10", "m11", "m20", "m21"))
    await host.ok(g=0)
    up = host.edges("bridge_b_en", host.frame_start)[0][0]
    rise = next(t for t, level in host.edges("m20", up) if level)
    assert (rise - up) % times.off == 0


@directed("P006-CHP-03", "P006-CHP-04", "P006-CHP-05", "P006-CHP-06", "P006-BAD-20", builds=BUILDS)
async def p006_restless_comparators(dut: Any) -> None:
    """If comparators change at any time during a motion, the outputs equal those of the model, and the two
    half-bridges of a bridge are never high together.
    """
    host, times = await ready(dut)
    await set_constant_speed(host, 2500, m=4)
    await run(host)
    rng = random.Random(6)
    for _ in range(250):
        await host.pins(**{rng.choice(("cmp_a", "cmp_b")): rng.getrandbits(1)})
        await host.pause(rng.choice((1, 2, 5, times.blank, times.fast, times.off, 3 * times.off)))
    await after_steps(host, 3)
    assert await host.ask("I") == 0 and never_both(host)
