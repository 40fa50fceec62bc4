"""Choppers that regulate the currents of a motor model, whose currents set the levels of the comparators."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from openppmc.model.pmc006.bench.motor import Motor, Plant

from .builds import directed
from .moves import run, set_constant_speed, start
from .stepping import MotorHost


async def ready(dut: Any, motor: Motor | None = None, **settings: int) -> tuple[MotorHost, Plant]:
    """Return a host of a part that holds its full current in a motor."""
    host = await MotorHost.start(dut)
    await host.ok(a=0, **settings)
    return host, host.attach(motor)


async def off_by(host: MotorHost, plant: Plant, since: int, until: int | None = None) -> float:
    """Return the maximum difference between a current and its reference between two edges, in amperes."""
    await host.sync()
    times = [t / host.clk_hz for t in range(since, until or host.t, 40)]
    return max(abs(one.current(t) - one.reference(t)) for one in plant.windings.values() for t in times)


@directed("P006-CHP-02", "P006-CHP-03", "P006-CHP-04", "P006-CHP-06")
async def p006_regulated_at_rest_and_after_a_fall(dut: Any) -> None:
    """At standstill the currents stay at the reference; fast decay reduces them to a lower reference."""
    host, plant = await ready(dut, e=2000)
    await host.ms(1)
    since = host.t
    await host.ms(1)
    assert await off_by(host, plant, since) < 0.04
    await host.ok(e=500)
    await host.ms(0.3)
    since = host.t
    await host.ms(0.5)
    assert await off_by(host, plant, since) < 0.04
    pulses = {pin: len(host.edges(pin, since)) // 2 for pin in ("m10", "m11", "m20", "m21")}
    # Each phase has one pulse, an on state or fast decay, per period of slightly more than 20 us.
    assert all(15 < pulses[a] + pulses[b] < 26 for a, b in (("m10", "m11"), ("m20", "m21")))


@directed("P006-CHP-03", "P006-CHP-04", "P006-EXC-13")
async def p006_regulated_in_motion(dut: Any) -> None:
    """In half steps with back EMF, in both directions, the currents reach their references."""
    host, plant = await ready(dut, e=1000, m=2)
    await set_constant_speed(host, 2000)
    plant.spin(4.0, 250, 1.0)
    for direction in (1, 0):
        await host.ok(d=direction)
        await start(host, 10)
        since = host.t
        await host.until("mon_busy", 0)
        # The current reaches its reference before the next step, which occurs after 0.5 ms.
        for before, after in pairwise(host.steps(since)):
            assert after - before == host.us(500)
            assert await off_by(host, plant, after - host.us(50), after) < 0.1
    await host.ms(1)
    assert await off_by(host, plant, host.t - 2000) < 0.1


@directed("P006-CHP-04", "P006-CHP-03")
async def p006_nothing_is_left_at_a_reference_of_0(dut: Any) -> None:
    """If the reference falls from 71 % to 0 without a change of sign, fast decay removes the current."""
    host, plant = await ready(dut, e=2000, m=2, P=300)
    await set_constant_speed(host, 1000)
    await start(host, 3)
    await host.until("mon_busy", 0)
    await host.ms(0.7)
    winding = plant.windings["b"]
    assert not await host.out("phase_b_ref") and not await host.out("phase_b_sign")
    assert max(abs(winding.current(t / host.clk_hz)) for t in range(host.t - 2000, host.t, 40)) < 0.05


@directed("P006-CHP-01", "P006-STA-12")
async def p006_released_and_excited_again(dut: Any) -> None:
    """While the bridges are off, the currents decay to 0 through the diodes. 1 ms after the bridges are
    switched on again, the currents follow their references.
    """
    host, plant = await ready(dut, Motor(2.0, 1e-3, 12.0), e=3000)
    await set_constant_speed(host, 3000)
    await run(host)
    await host.ms(2)
    await host.ok(g=1)
    await host.ms(0.5)
    assert all(one.current(plant.seconds(host.t)) == 0 for one in plant.windings.values())
    await host.ok(g=0)
    await host.ms(1)
    assert await off_by(host, plant, host.t - 2000) < 0.15
