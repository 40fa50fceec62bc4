"""At a clock that is not a multiple of 1 MHz, each time deviates by at most one cycle."""

from __future__ import annotations

from typing import Any

from .builds import ODD, directed
from .host import Host
from .moves import after_steps, constant_speed_host, load, run, start, wait_stopped
from .programs import Op
from .reference import HOME, code, sines

BUILDS = (ODD,)


@directed("P006-PAR-01", "P006-MOT-03", "P006-MOT-20", "P006-MOT-05", "P006-AC-45", builds=BUILDS)
async def p006_intervals(dut: Any) -> None:
    """The worked example M13 is exact: `intervals` checks each interval, and their sum shows that there is no
    drift.
    """
    host = await Host.start(dut)
    await host.ok(u=3, o=3, v=3200)
    await start(host, 256)
    await wait_stopped(host)
    gaps = host.intervals()
    assert gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1667, 1667, 1666]
    steps = host.steps()
    assert host.in_us(steps[-1] - steps[0]) == 122_842 - 1659


@directed("P006-PAR-01", "P006-MOT-40", "P006-PRG-30", "P006-PRG-31", builds=BUILDS)
async def p006_speed_mode_and_keys(dut: Any) -> None:
    host = await constant_speed_host(dut, 2500)
    await run(host)
    await after_steps(host, 30)
    steps = host.steps()
    assert host.in_us(steps[-1] - steps[0]) == 29 * 400 and await host.ask("I") == 0
    await load(host, Op(0x13, 1, 1), Op(0x01, 0, 10_000), Op(0x0D, 0, 2))
    await after_steps(host, 3)
    await host.pins(gpi=0b11110)
    edge = host.t - 1
    halt = await host.until("mon_busy", 0, 2_000)
    assert host.us(1_000) <= halt - edge <= host.us(1_002) + 8
    await host.ok(F=0)


@directed("P006-PAR-01", "P006-EXC-31", "P006-EXC-30", builds=BUILDS)
async def p006_idle_time(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await start(host, 1)
    fall = await wait_stopped(host)
    await host.go(fall + host.us(99_998))
    assert await host.refs() == sines(HOME + 8, code(800))
    await host.go(fall + host.us(100_002) + 64)
    assert await host.refs() == sines(HOME + 8, code(800) >> 1)
