"""What many tests of the PMC006 begin with: SETUP of chapter 11, motions, programs."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from .host import Host
from .programs import Op, words

EXT1, EXT2, DECAY, STALL = 0x02, 0x04, 0x08, 0x10
"""Bits of status 1 beside BUSY."""
FREE_RUN, EXT1_EN, EXT2_EN, SPEED_MODE, FORWARD, OFFLINE = 0x01, 0x02, 0x04, 0x08, 0x10, 0x20
"""Bits of status 2."""


async def setup(host: Host) -> Host:
    """SETUP: e 1000, u 3, o 3, v 3200."""
    await host.ok(e=1000, u=3, o=3, v=3200)
    return host


async def ready(dut: Any, **given: Any) -> Host:
    """A host behind SETUP."""
    return await setup(await Host.start(dut, **given))


async def brisk(host: Host, speed: int = 3000, **settings: int) -> Host:
    """Constant speed from the first step to the last."""
    await host.ok(v=speed, L=speed, S=speed, **settings)
    return host


async def quick(dut: Any, speed: int = 3000, **given: Any) -> Host:
    """A host whose motions are `brisk`."""
    return await brisk(await Host.start(dut, **given), speed)


async def start(host: Host, count: int) -> None:
    """An accepted s."""
    assert await host.ask("s", count) == host.accepted(count)


async def run(host: Host, on: int = 1) -> None:
    """N 1 or N 0 with the reply that says so."""
    assert await host.ask("N", on) == on


async def rest(host: Host, limit_us: float = 10_000_000) -> int:
    """Run to the end of motion; returns its edge."""
    return await host.until("mon_busy", 0, limit_us)


async def move(host: Host, count: int) -> list[int]:
    """A whole move; returns its intervals in us. The number of steps is checked."""
    await start(host, count)
    await rest(host)
    assert len(host.steps()) == count, f"{len(host.steps())} steps instead of {count}"
    return host.intervals()


async def after_steps(host: Host, count: int, limit_us: float = 5_000_000) -> int:
    """Run until so many steps have been made since `mark`; returns the edge of that step."""
    end = host.t + host.us(limit_us)
    made = host.made()
    while made < count:
        made += len(await host.next_steps(end))
    return host.steps()[count - 1]


async def cruise(host: Host, interval: float, limit_us: float = 1_000_000) -> None:
    """Run until the last two intervals are this one, rounded up or down."""
    end = host.t + host.us(limit_us)
    steps = host.steps()[-2:]
    last: list[int] = []
    while len(last) < 2 or not all(abs(one - interval) < 1 for one in last):
        steps = [*steps, *await host.next_steps(end)][-3:]
        last = [host.in_us(b - a) for a, b in pairwise(steps)]


async def still(host: Host, clk: int | None = None) -> bool:
    """Whether no step is made for so long (10 ms)."""
    await host.sync()
    since = host.t
    await host.pause(host.us(10_000) if clk is None else clk)
    return not host.steps(since)


async def download(host: Host, program: Iterable[Op], first: int = 0) -> None:
    """Write a program from instruction `first` on and point to it."""
    assert await host.ask("A", 2 * first) == 2 * first
    for word in words(program):
        assert await host.ask("W", word) == word
    assert await host.ask("A", 2 * first) == 2 * first


async def load(host: Host, *program: Op) -> None:
    """Write a program and run it."""
    await download(host, program)
    assert await host.ask("z") == 1
