"""A short test of the part, which also runs on netlists and on the build with default parameters."""

from __future__ import annotations

from math import ceil
from typing import Any

from cocotb_tests.harness import F16

from .builds import D8E, F8B, directed
from .frames import command
from .host import Host
from .moves import DECAY, EXT1, after_steps, load, set_constant_speed, start, wait_stopped
from .programs import END, Op, out, rot

BUILDS = (F8B, F16, D8E)


@directed(
    "P006-UART-01", "P006-FRM-02", "P006-FRM-03", "P006-MOT-03", "P006-MOT-05", "P006-EXC-12", builds=BUILDS
)
async def p006_sequence(dut: Any) -> None:
    """All kinds of blocks of the part work in one sequence: a register, a frame with an error, a move, a stop
    by EXT1, and a program.
    """
    host = await Host.start(dut)
    assert await host.ask("R") == 0x123 and await host.ask("n") == 800
    await host.raw("A5 FF 6A 00 00 00 00 0F")
    assert await host.is_silent(ceil(4 * host.bit))
    await set_constant_speed(host, 3000, m=4, f=1)
    await start(host, 7)
    await wait_stopped(host)
    assert len(host.steps()) == 7 and set(host.intervals()) <= {333, 334}
    await host.ok(d=0, e=2000)
    await start(host, 0x7FFFFFFF)
    await after_steps(host, 4)
    await host.pins(ext1=0)
    await host.pause(10)
    assert not await host.busy() and await host.status() == DECAY | EXT1 and await host.ask("b") == 0
    await load(host, Op(0x08, 0, 3000), rot(2), Op(0x10, 8, 0), out(2, 1), END)
    await host.until("gpo", 2, 10_000)
    assert await host.position() == 7 - len(host.steps(0)[7:])


@directed("P006-FRM-10", "P006-CMD-44", builds=BUILDS)
async def p006_sequence_at_another_address(dut: Any) -> None:
    host = await Host.start(dut, error=0.01)
    assert await host.ask("w", 17) == 17
    await host.send(command(16, "y", 0xF8))
    assert await host.ask("x") == 0xF07
