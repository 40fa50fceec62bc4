"""Stall detector: conditions of a stall, and its effects.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .host import START, Host
from .moves import (
    DECAY,
    SPEED_MODE,
    STALL,
    constant_speed_host,
    cruise,
    run,
    samples,
    start,
    wait_stopped,
)

STOP = 5
"""Maximum number of cycles from a cause to the last step."""


async def cruising(dut: Any, level: int = 256, length: int = 5, y: int = 1) -> Host:
    """Return a host of a part in speed mode at constant speed, with the stall detector on."""
    host = await constant_speed_host(dut)
    await host.ok(Z=level, T=length, Y=y)
    await run(host)
    await cruise(host, 1_000_000 / 3000)
    return host


@cocotb.parametrize(case=[(0, 1), (1, 1), (2, 2), (63, 63)])
@directed("P006-STL-02", "P006-CMD-16")
async def p006_stall_length(dut: Any, case: Any) -> None:
    length, needed = case
    host = await cruising(dut, level=10, length=length)
    await samples(host, *[9] * (needed - 1), 10, *[9] * (needed - 1))
    assert not await host.status() & STALL
    await samples(host, *[0] * needed)
    assert await host.status() == DECAY | STALL | 1 and 0 < await host.ask("X") <= host.step_count()
    await host.ask("I")


@directed("P006-STL-06", "P006-STL-05", "P006-STL-01", "P006-CMD-20", "P006-CMD-21")
async def p006_stall_after_reset_and_level_0(dut: Any) -> None:
    """The number of low samples for a stall is 64 after reset. With level 0, no sample is below the level. If
    bit 0 of the configuration Y is 0, samples are ignored.
    """
    host = await constant_speed_host(dut)
    await host.ok(Z=511, Y=1)
    await run(host)
    await cruise(host, 1_000_000 / 3000)
    await samples(host, *[510] * 63)
    assert not await host.status() & STALL
    await samples(host, 510)
    assert await host.status() & STALL and await host.ask("p") == 0
    await host.ok(Z=0)
    await samples(host, *[0] * 80)
    assert not await host.status() & STALL
    await host.ok(Z=511, Y=0, T=1)
    await samples(host, *[0] * 4)
    assert not await host.status() & STALL
    await host.ask("I")
    await host.ok(Y=1)
    await samples(host, *[0] * 4)
    assert not await host.status() & STALL


@directed("P006-STL-01", "P006-STL-02", "P006-BAD-20")
async def p006_samples_off_constant_speed(dut: Any) -> None:
    """During a ramp no sample counts, and the count of low samples restarts.

    If a strobe stays asserted, each cycle is a sample.
    """
    host = await Host.start(dut)
    await host.ok(L=1000, S=1000, v=1500, u=5, o=5, Z=100, T=3, Y=1)
    await run(host)
    await samples(host, *[50] * 20)
    assert not await host.status() & STALL
    await cruise(host, 667)
    await host.ms(3)
    await samples(host, 50, 50)
    await host.ok(v=1600)
    await samples(host, *[50] * 10)
    await cruise(host, 625)
    await host.ms(3)
    await samples(host, 50, 50)
    assert not await host.status() & STALL
    await host.pins(bemf_level=50, bemf_valid=1)
    await host.pause(4)
    await host.pins(bemf_valid=0)
    assert await host.status() & STALL
    await host.ask("I")


@directed("P006-STL-01", "P006-STL-03", "P006-MOT-04")
async def p006_samples_before_the_first_interval(dut: Any) -> None:
    """After a motion that ended at constant speed, no sample counts from the next start to t = 0."""
    host = await cruising(dut, y=5)
    assert await host.ask("I") == 0
    await host.pins(bemf_level=0, bemf_valid=1)
    await run(host)
    await host.pins(bemf_valid=0)
    begun, stalled = host.edges("mon_busy", host.mark)[-1][0], host.edges("gpo", host.mark)[0][0]
    assert 800 <= stalled - begun <= START
    assert await host.ask("I") == 0


@directed("P006-STL-04", "P006-STL-02", "P006-STL-01")
async def p006_the_count_of_low_samples_restarts(dut: Any) -> None:
    """The count of low samples restarts at each start (also without a sample in between) and with any sample
    at standstill.
    """
    host = await constant_speed_host(dut, 2500)
    await host.ok(L=2500, S=2500, Z=256, T=3, Y=1)
    for between in ((), (1,)):
        await run(host)
        await cruise(host, 400)
        await samples(host, 1, 1)
        assert await host.ask("I") == 0
        await samples(host, *between)
        await run(host)
        await cruise(host, 400)
        await samples(host, 1, 1)
        assert not await host.status() & STALL
        await samples(host, 1)
        assert await host.status() & STALL and await host.ask("I") == 0
    stalled_at = await host.ask("X")
    await run(host)
    assert not await host.status() & STALL and await host.ask("I") == 0 and await host.ask("X") == stalled_at


@directed("P006-STL-02", "P006-CMD-37")
async def p006_low_samples_after_a_cleared_stall(dut: Any) -> None:
    """If the host clears each stall before the next sample, each further low sample is again a stall.

    The number of samples exceeds the range of a counter of 7 bits.
    """
    host = await constant_speed_host(dut)
    await host.ok(Z=256, Y=1)
    await run(host)
    await cruise(host, 1_000_000 / 3000)
    await samples(host, *[0] * 63)
    for number in range(64, 140):
        await samples(host, 0)
        assert await host.status() & STALL, f"no stall at low sample {number}"
        await host.ask("p")
    await samples(host, 256)
    await samples(host, *[0] * 63)
    assert not await host.status() & STALL
    await samples(host, 0)
    assert await host.status() & STALL and await host.ask("I") == 0


@directed("P006-STL-03", "P006-STL-04", "P006-STA-03", "P006-STA-10", "P006-CMD-37", "P006-IO-01")
async def p006_what_a_stall_does(dut: Any) -> None:
    host = await cruising(dut, y=5, length=2)
    await host.ok(y=0x08)
    await samples(host, 1, 1)
    edge = host.edges("gpo")[-1][0]
    assert await host.out("gpo") == 0x11 and await host.busy() and host.t - edge < 100
    assert await host.ask("x") & 0xF8 == 0x88
    assert await host.ask("y", 0x10) == 0x10
    assert await host.out("gpo") == 0x12
    stalled_at = await host.ask("X")
    # If bit 1 of Y is set after the stall, the stall also stops the motion.
    await host.ok(Y=7)
    assert not await host.busy() and await host.out("gpo") == 0x12
    await host.ok(Y=3)
    assert await host.out("gpo") == 2
    await host.ok(Y=4)
    assert await host.out("gpo") == 0x12
    assert await host.ask("s", 0) == 0 and await host.status() == DECAY | STALL
    await start(host, 1)
    assert not await host.status() & STALL
    assert await host.out("gpo") == 2
    assert await host.ask("X") == stalled_at
    await wait_stopped(host)
    await host.reset()
    await host.boot()
    assert await host.ask("X") == 0 and await host.ask("T", 64) == 64


@directed("P006-STL-03", "P006-STL-02", "P006-STA-14", "P006-STA-18")
async def p006_stall_stops_at_once(dut: Any) -> None:
    host = await cruising(dut, y=3, length=1)
    mark = host.mark
    await host.strobe(bemf_level=0)
    edge = host.t - 2
    await host.pause(STOP + 1)
    assert not await host.out("mon_busy") and not host.steps(edge + STOP + 1)
    assert await host.status() == DECAY | STALL
    assert await host.ask("X") == await host.position() == host.step_count(mark)
    assert not await host.ask("O") & SPEED_MODE
    await run(host)
    assert not await host.status() & STALL and await host.ask("I") == 0
