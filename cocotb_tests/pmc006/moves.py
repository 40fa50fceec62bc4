"""Common first steps of PMC006 tests: SETUP, motions, programs."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from .host import Host
from .programs import Op, words

EXT1, EXT2, DECAY, STALL = 0x02, 0x04, 0x08, 0x10
"""Bits of status 1 except BUSY."""
FREE_RUN, EXT1_EN, EXT2_EN, SPEED_MODE, FORWARD, OFFLINE = 0x01, 0x02, 0x04, 0x08, 0x10, 0x20
"""Bits of status 2."""


async def setup(host: Host) -> Host:
    """Apply SETUP: current (e) 1000, acceleration (u) 3, deceleration (o) 3, maximum speed (v) 3200."""
    await host.ok(e=1000, u=3, o=3, v=3200)
    return host


async def ready(dut: Any, **options: Any) -> Host:
    """Return a host after SETUP."""
    return await setup(await Host.start(dut, **options))


async def set_constant_speed(host: Host, speed: int = 3000, **settings: int) -> Host:
    """Set the same speed for the start, the constant speed and the end of motions."""
    await host.ok(v=speed, L=speed, S=speed, **settings)
    return host


async def constant_speed_host(dut: Any, speed: int = 3000, **options: Any) -> Host:
    """Return a host whose motions have a constant speed (`set_constant_speed`)."""
    return await set_constant_speed(await Host.start(dut, **options), speed)


async def start(host: Host, count: int) -> None:
    """Start a move of this number of steps (instruction s) and check that it is accepted."""
    assert await host.ask("s", count) == host.accepted(count)


async def run(host: Host, on: int = 1) -> None:
    """Start or stop the speed mode (instruction N 1 or N 0) and check the reply."""
    assert await host.ask("N", on) == on


async def wait_stopped(host: Host, limit_us: float = 10_000_000) -> int:
    """Run to the end of the motion; return the edge of this end."""
    return await host.until("mon_busy", 0, limit_us)


async def move(host: Host, count: int) -> list[int]:
    """Make a complete move and check its number of steps; return its intervals in us."""
    await start(host, count)
    await wait_stopped(host)
    assert len(host.steps()) == count, f"{len(host.steps())} steps instead of {count}"
    return host.intervals()


async def after_steps(host: Host, count: int, limit_us: float = 5_000_000) -> int:
    """Run until `count` steps have been made since `mark`; return the edge of the last of these steps."""
    end = host.t + host.us(limit_us)
    made = host.step_count()
    while made < count:
        made += len(await host.next_steps(end))
    return host.steps()[count - 1]


async def cruise(host: Host, interval: float, limit_us: float = 1_000_000) -> None:
    """Run until the last two intervals equal `interval`, rounded up or down."""
    end = host.t + host.us(limit_us)
    steps = host.steps()[-2:]
    last: list[int] = []
    while len(last) < 2 or not all(abs(one - interval) < 1 for one in last):
        steps = [*steps, *await host.next_steps(end)][-3:]
        last = [host.in_us(b - a) for a, b in pairwise(steps)]


async def samples(host: Host, *levels: int) -> None:
    """Apply samples of the back EMF."""
    for level in levels:
        await host.strobe(bemf_level=level)
        await host.pause(30)


async def is_stopped(host: Host, clk: int | None = None) -> bool:
    """Return whether no step is made for this number of cycles (default: 10 ms)."""
    await host.sync()
    since = host.t
    await host.pause(host.us(10_000) if clk is None else clk)
    return not host.steps(since)


async def download(host: Host, program: Iterable[Op], first: int = 0) -> None:
    """Write a program from instruction `first` on and set the pointer to this instruction."""
    assert await host.ask("A", 2 * first) == 2 * first
    for word in words(program):
        assert await host.ask("W", word) == word
    assert await host.ask("A", 2 * first) == 2 * first


async def load(host: Host, *program: Op) -> None:
    """Write a program and run it."""
    await download(host, program)
    assert await host.ask("z") == 1
