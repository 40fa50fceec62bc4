"""Acceptance checks of moves and speed mode."""

from __future__ import annotations

from typing import Any

from .builds import directed
from .frames import reply
from .host import EXECUTE, START
from .moves import (
    DECAY,
    SPEED_MODE,
    after_steps,
    cruise,
    is_stopped,
    move,
    ready,
    run,
    set_constant_speed,
    start,
    wait_stopped,
)
from .reference import sines


def hexed(frame: bytes) -> str:
    """Return the text of a frame in the format of `Host.exchange`."""
    return frame.hex(" ").upper()


@directed("P006-AC-03", "P006-FRM-09", "P006-CMD-40", "P006-CMD-55", "P006-MOT-20")
async def p006_ac_03(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("w", 1) == 1
    assert await host.exchange("A5 01 73 1F 01 00 00 39") == hexed(reply(1, host.accepted(287)))
    await wait_stopped(host)
    steps = host.steps()
    gaps = host.intervals()
    assert len(steps) == 287 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1666, 1667, 1667]
    assert host.in_us(steps[-1] - steps[0]) == 132_476 - 1659
    assert await host.exchange("A5 01 63 00 00 00 00 09") == "A5 7A 01 1F 01 00 00 40"


@directed("P006-AC-13", "P006-MOT-03", "P006-MOT-04", "P006-MOT-05", "P006-STA-18")
async def p006_ac_13(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 73 01 00 00 00 18") == hexed(reply(0xFF, host.accepted(1)))
    e = host.e
    assert e <= host.edges("mon_busy")[0][0] <= e + EXECUTE
    assert host.baud < 100_000 or await host.status() == DECAY | 1
    await wait_stopped(host)
    (step,) = host.steps(e)
    assert 0 <= step - e - host.us(1667) <= EXECUTE + START + host.us(1)
    assert 0 <= host.edges("mon_busy")[-1][0] - step <= 2
    assert await host.position() == 1 and await host.status() == DECAY


@directed("P006-AC-15", "P006-BAD-10", "P006-STA-01")
async def p006_ac_15(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("s", 0) == 0 and await host.ask("s", -1) == 0
    assert await is_stopped(host) and not host.steps(0) and await host.status() == DECAY


@directed("P006-AC-16", "P006-STA-02", "P006-MOT-40")
async def p006_ac_16(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 76 64 00 00 00 7E") == "A5 7A FF 64 00 00 00 82"
    assert await host.ask("s", 10) == 0 and await is_stopped(host)
    await run(host)
    await after_steps(host, host.pick(6, 3))
    assert set(host.intervals()) == {10_000}


@directed("P006-AC-20", "P006-STA-10", "P006-STA-16")
async def p006_ac_20(dut: Any) -> None:
    host = await ready(dut)
    await run(host)
    await host.ms(20)
    assert await host.exchange("A5 FF 49 00 00 00 00 ED") == "A5 7A FF 00 00 00 00 1E"
    assert not host.steps(host.e + EXECUTE + 6) and not await host.busy()
    await start(host, 1)
    await wait_stopped(host)
    assert len(host.steps()) == 1


@directed("P006-AC-21", "P006-STA-12", "P006-CMD-28", "P006-CHP-01")
async def p006_ac_21(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(a=0)
    await start(host, 10_000)
    await after_steps(host, 37)
    await host.ok(g=1)
    names = ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21", "mon_busy")
    assert [await host.out(name) for name in names] == [0] * 7 and await host.refs() == (0, 0, 0, 0)
    count = len(host.steps(0))
    assert await host.ask("s", 1) == 0
    await host.ok(g=0)
    assert await host.out("bridge_a_en") and await host.out("bridge_b_en")
    held = await host.refs()
    assert await host.ask("s", 1) == host.accepted(1)
    await wait_stopped(host)
    assert len(host.steps()) == 1 and len(host.steps(0)) == count + 1
    assert held == sines(64 + 8 * count, 64)


@directed("P006-AC-25", "P006-EXC-15", "P006-EXC-02", "P006-CMD-34", "P006-CMD-25")
async def p006_ac_25(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(m=0)
    seen = []
    for _ in range(4):
        await move(host, 1)
        await host.pause(64)
        seen.append(await host.refs())
    await host.ok(d=0)
    await move(host, 1)
    await host.pause(64)
    seen.append(await host.refs())
    assert seen == [(45, 1, 45, 0), (45, 1, 45, 1), (45, 0, 45, 1), (45, 0, 45, 0), (45, 0, 45, 1)]
    assert await host.position() == 3


@directed("P006-AC-27", "P006-CMD-26", "P006-CMD-35", "P006-EXC-20", "P006-CMD-22")
async def p006_ac_27(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(a=0)
    assert await host.ask("e", 1074) == 1074 and await host.refs() == (45, 0, 45, 0)
    assert await host.exchange("A5 FF 65 33 04 00 00 40") == "A5 7A FF 33 04 00 00 55"
    assert await host.refs() == (52, 0, 52, 0) and await host.ask("n") == 1075
    assert await host.ask("e", 399) == 1075 and await host.ask("e", 4001) == 1075
    assert await host.ask("e", 400) == 400 and await host.refs() == (18, 0, 18, 0)
    assert await host.ask("e", 4000) == 4000 and await host.refs() == (180, 0, 180, 0)
    await host.ms(101)
    await host.ok(a=1)
    assert await host.refs() == (90, 0, 90, 0)


@directed("P006-AC-28", "P006-EXC-32", "P006-CMD-14")
async def p006_ac_28(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(Q=4)
    await host.ms(101)
    assert await host.refs() == (3, 0, 3, 0)
    await host.ok(a=0)
    assert await host.refs() == (45, 0, 45, 0)


@directed("P006-AC-59", "P006-STA-16", "P006-BAD-25")
async def p006_ac_59(dut: Any) -> None:
    host = await ready(dut)
    await run(host)
    mark = host.mark
    await host.ms(10)
    assert host.steps(mark) and await host.ask("O") & SPEED_MODE
    assert await host.ask("s", 100) == 0
    await host.ms(5)
    count = len(host.steps(mark))
    assert count > 5 and await host.busy()
    assert await host.ask("I") == 0
    assert not host.steps(host.e + EXECUTE + 6) and not await host.ask("O") & SPEED_MODE
    assert await host.ask("N", 0) == 0
    await start(host, 1)
    await wait_stopped(host)
    assert len(host.steps()) == 1


@directed("P006-AC-60", "P006-MOT-41")
async def p006_ac_60(dut: Any) -> None:
    host = await ready(dut)
    await set_constant_speed(host, 2500, d=0)
    await run(host)
    mark = host.mark
    await host.ms(host.pick(510, 40))
    assert await host.ask("N", 0) == 0
    off = host.e
    fall = await wait_stopped(host)
    assert 0 <= fall - off <= host.us(200) + EXECUTE
    assert set(host.intervals(mark)) == {400} and await host.position() == -len(host.steps(mark))


@directed("P006-AC-67", "P006-MOT-42")
async def p006_ac_67(dut: Any) -> None:
    for late in (False, True):
        host = await ready(dut)
        if not host.literal:
            await host.ok(L=2800, S=2800, u=5, o=5)
        await run(host)
        mark = host.mark
        await host.ms(host.pick(400, 40))
        assert await host.ask("N", 0) == 0
        low = 600 if host.literal else 2800
        slope = 13_600 if host.literal else 54_400
        length = (3200 - low) * 1_000_000 // slope
        off = host.e
        if late:
            # The frame ends about 60 us before the STOP ramp.
            frame = int(80 * host.bit)
            await host.go(off + host.us(length + 40) - frame)
        else:
            await host.go(off + host.us(host.pick(50_000, 2_000)))
        assert await host.ask("N", 1) == 1 and await host.ask("O") & SPEED_MODE and await host.busy()
        await cruise(host, 312.5)
        gaps = host.intervals(mark)
        assert max(gaps) <= 1_000_000 / low + 2
        if late:
            assert max(gaps[len(gaps) // 4 :]) >= 1_000_000 / low - 12
        await host.ask("I")
