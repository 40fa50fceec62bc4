"""Emergency stops, port word, and events in the same cycle.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import cocotb

from .builds import directed
from .host import EXECUTE, Host
from .moves import (
    DECAY,
    EXT1,
    EXT2,
    SPEED_MODE,
    after_steps,
    constant_speed_host,
    is_stopped,
    move,
    run,
    start,
    wait_stopped,
)

STOP = 5
FLAGS = {"ext1": EXT1, "ext2": EXT2}
CLEAR = {"ext1": "b", "ext2": "l"}


@cocotb.parametrize(pin=["ext1", "ext2"])
@cocotb.parametrize(rising=[0, 1])
@directed(
    "P006-EXT-01", "P006-EXT-02", "P006-EXT-05", "P006-EXT-06", "P006-EXT-08", "P006-STA-10", "P006-STA-18"
)
async def p006_emergency_stop(dut: Any, pin: str, rising: int) -> None:
    """The selected edge stops any motion within 5 cycles; the opposite edge and the other EXT pin have no
    effect.
    """
    other = "ext2" if pin == "ext1" else "ext1"
    host = await constant_speed_host(dut, levels={"sda_i": 0, pin: 1 - rising})
    mask = 1 if pin == "ext1" else 2
    await host.ok(f=mask, J=mask if rising else 3 - mask)
    assert await host.out(f"{pin}_pu") == 1 - rising
    for begin in (partial(start, count=5_000), run):
        await begin(host)
        mark = host.mark
        await after_steps(host, 4)
        await host.pins(**{other: 0})
        await host.pause(50)
        await host.pins(**{other: 1})
        assert await host.busy()
        await host.pins(**{pin: rising})
        edge = host.t - 1
        await host.pause(STOP)
        assert not await host.out("mon_busy") and not host.steps(edge + STOP + 1)
        assert await host.status() == DECAY | FLAGS[pin] and not await host.ask("O") & SPEED_MODE
        assert await host.ask("s", 1) == 0 and await host.ask("N", 1) == 0
        await host.pins(**{pin: 1 - rising})
        assert await host.ask(CLEAR[other]) == 0 and await host.status() == DECAY | FLAGS[pin]
        assert await host.ask(CLEAR[pin]) == 0 and await host.status() == DECAY
        assert (
            await host.position() == host.step_count(0)
            and await is_stopped(host, 2_000)
            and host.step_count(mark) > 3
        )


@directed("P006-EXT-02", "P006-EXT-03", "P006-EXT-04", "P006-EXT-07", "P006-EXT-09", "P006-BAD-26")
async def p006_levels_never_stop(dut: Any) -> None:
    """If a switch is already active when it is enabled or when the mode changes, no flag is set and no motion
    stops.
    """
    for level in (0, 1):
        host = await constant_speed_host(dut, levels={"sda_i": 0, "ext1": level, "ext2": level})
        await start(host, 2_000)
        for mode in (3, 1, 0):
            await host.ok(J=mode, f=3)
            await host.ok(f=0)
            await host.ok(f=3, J=mode)
        assert await host.busy() and await host.status() == DECAY | 1
        await host.ask("I")


@directed("P006-EXT-04", "P006-EXT-09")
async def p006_edges_with_the_enable_off_are_forgotten(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.pins(ext1=0)
    await host.pause(10)
    await host.ok(f=1)
    assert await host.status() == DECAY
    await host.pins(ext1=1)
    await host.pause(10)
    await host.pins(ext1=0)
    assert await host.status() == DECAY | EXT1
    # Instruction f 0 does not clear the flag; instruction b clears it.
    await host.ok(f=0)
    assert await host.status() == DECAY | EXT1 and await host.ask("s", 1) == 0
    assert await host.ask("b") == 0 and len(await move(host, 2)) == 1


@directed("P006-EXT-05", "P006-EXT-02", "P006-BAD-21", "P006-STA-17")
async def p006_both_inputs_and_chatter(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(f=3)
    await start(host, 3_000)
    await after_steps(host, 3)
    for level in (0, 1, 0, 1, 1, 0, 1):
        await host.pins(ext1=level, ext2=level)
        await host.pause(2)
    assert not await host.busy() and await host.status() == DECAY | EXT1 | EXT2
    assert await host.ask("b") == 0 and await host.status() == DECAY | EXT2 and await host.ask("s", 1) == 0
    assert await host.ask("l") == 0 and await host.ask("l") == 0 and await host.status() == DECAY
    assert len(await move(host, 2)) == 1


@directed("P006-EXT-11", "P006-STA-11", "P006-EXT-10")
async def p006_locked_part_answers_everything_else(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(f=1)
    await host.pins(ext1=0)
    await host.ok(m=32, d=0, u=2, y=0x50, e=1500, i=-9, T=3, Y=1, Z=40, F=1)
    assert await host.status() == DECAY | EXT1 and await host.ask("x") == 0xB57
    assert [await host.ask(code) for code in "kruA"] == [32, 2, 0, 0]
    await host.ok(g=1, F=0)
    assert await host.ask("b") == 0 and await host.ask("s", 1) == 0
    await host.ok(g=0)
    assert len(await move(host, 2)) == 1 and await host.position() == -11


@directed("P006-EXT-10", "P006-EXT-08", "P006-EXT-07")
async def p006_homing(dut: Any) -> None:
    """After the motor has run onto the switch and has then moved a fixed number of steps off it, the position
    is exact and the speed settings are unchanged.
    """
    host = await constant_speed_host(dut)
    await host.ok(f=1, d=0)
    await start(host, 0x7FFFFFFF)
    await after_steps(host, 12)
    await host.pins(ext1=0)
    await host.pause(20)
    made = host.step_count()
    assert await host.position() == -made and await host.ask("b") == 0
    await host.ok(d=1)
    await start(host, 20)
    await after_steps(host, 6)
    await host.pins(ext1=1)
    await wait_stopped(host)
    assert host.step_count() == 20 and await host.position() == 20 - made and await host.status() == DECAY
    assert [await host.ask(code) for code in "qLS"] == [3000] * 3


@directed("P006-STA-14", "P006-EXT-02", "P006-STA-18")
async def p006_ext_around_the_last_step(dut: Any) -> None:
    """An edge of EXT near the last step always sets the flag; the position is the number of steps made."""
    for offset in range(-5, 4):
        host = await constant_speed_host(dut)
        await host.ok(f=1)
        await start(host, 3)
        edge = await after_steps(host, 2) + host.us(1000) // 3 + offset
        await host.go(max(host.t, edge))
        await host.pins(ext1=0)
        await host.pause(host.us(400))
        assert not await host.busy() and 2 <= host.step_count() <= 3
        assert await host.status() == DECAY | EXT1 and await host.position() == host.step_count()


@directed("P006-STA-14", "P006-STA-17", "P006-EXT-02")
async def p006_flag_set_and_cleared_in_one_clk(dut: Any) -> None:
    """If the flag is set and cleared in the same cycle, it is set afterwards; a later instruction b clears
    it.
    """
    host = await constant_speed_host(dut)
    await host.ok(f=1)
    outcomes = set()
    for offset in range(-4, 8):
        await host.pins(ext1=1)
        await host.pause(20)
        await host.send_frame("b")
        answer_end = host.e
        await host.go(answer_end + offset)
        await host.pins(ext1=0)
        assert await host.receive_reply() == 0
        flag = await host.status() & EXT1
        outcomes.add((offset, bool(flag)))
        assert await host.ask("b") == 0
    flags = [flag for _, flag in sorted(outcomes)]
    assert flags == sorted(flags) and True in flags


@directed("P006-IO-01", "P006-IO-02", "P006-IO-03", "P006-IO-04", "P006-PORT-03")
async def p006_port_word(dut: Any) -> None:
    host = await Host.start(dut)
    await host.ok(J=3, f=3)
    for number, gpi in enumerate((0, 1, 2, 4, 8, 16, 21, 31)):
        for ext in (number % 4, 3 - number % 4):
            await host.pins(gpi=gpi, ext1=ext & 1, ext2=ext >> 1)
            value = (gpi * 9) & 0xF8
            await host.ok(y=value)
            assert await host.ask("x") == ext << 10 | gpi >> 3 << 8 | value | gpi & 7
            assert await host.out("gpo") == value >> 3
    await host.ok(g=1)
    assert await host.ask("I") == 0 and await host.out("gpo") == value >> 3
    change = host.t
    await host.reset()
    assert await host.out("gpo") == 0 and host.edges("gpo", change)
    await host.boot()
    assert not host.edges("gpo", change + 20)


@directed("P006-STA-14", "P006-STA-15", "P006-STA-10")
async def p006_frames_executed_around_a_step(dut: Any) -> None:
    """Instructions i, I and g near a step neither lose nor repeat a step, and no step follows a stop."""
    for code, data in (("i", 500), ("I", 0), ("g", 1)):
        for offset in range(-2, 5):
            host = await constant_speed_host(dut)
            await start(host, 12)
            mark = host.mark
            first = await after_steps(host, 1)
            target = first + host.us(1000) * 3 + offset
            await host.go(target - int(79.5 * host.bit) - 2)
            assert await host.ask(code, data) == data
            if code == "i":
                await wait_stopped(host)
                left = sum(t > target - 2 for t in host.steps(mark))
                assert host.step_count(mark) == 12 and 0 <= left - (await host.position() - 500) <= 1
            else:
                assert not await host.busy() and not host.steps(host.e + EXECUTE + STOP)
                assert await host.position() == host.step_count(mark)
