"""PMC006 acceptance checks of moves and speed mode. Those that last long stay on the model."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness.directed import directed
from cocotb_tests.harness.scripts import model_only
from cocotb_tests.pmc006.frames import reply, signed
from cocotb_tests.pmc006.host import EXECUTE, START, Host
from cocotb_tests.pmc006.moves import (
    DECAY,
    EXT1,
    FORWARD,
    SPEED_MODE,
    after_steps,
    brisk,
    cruise,
    move,
    ready,
    rest,
    run,
    start,
    still,
)
from cocotb_tests.pmc006.reference import sines

LONG = "seconds of motion; script_motion has the same rules in short"


def hexed(frame: bytes) -> str:
    """Text of a frame, as `Host.swap` has it."""
    return frame.hex(" ").upper()


@directed("P006-AC-03", "P006-FRM-09", "P006-CMD-40", "P006-CMD-55", "P006-MOT-20")
async def p006_ac_03(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("w", 1) == 1
    assert await host.swap("A5 01 73 1F 01 00 00 39") == hexed(reply(1, host.accepted(287)))
    await rest(host)
    steps = host.steps()
    gaps = host.intervals()
    assert len(steps) == 287 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1666, 1667, 1667]
    assert host.in_us(steps[-1] - steps[0]) == 132_476 - 1659
    assert await host.swap("A5 01 63 00 00 00 00 09") == "A5 7A 01 1F 01 00 00 40"


@directed("P006-AC-13", "P006-MOT-03", "P006-MOT-04", "P006-MOT-05", "P006-STA-18")
async def p006_ac_13(dut: Any) -> None:
    host = await ready(dut)
    assert await host.swap("A5 FF 73 01 00 00 00 18") == hexed(reply(0xFF, host.accepted(1)))
    e = host.e
    assert e <= host.edges("mon_busy")[0][0] <= e + EXECUTE
    assert host.baud < 100_000 or await host.status() == DECAY | 1
    await rest(host)
    (step,) = host.steps(e)
    assert 0 <= step - e - host.us(1667) <= EXECUTE + START + host.us(1)
    assert 0 <= host.edges("mon_busy")[-1][0] - step <= 2
    assert await host.position() == 1 and await host.status() == DECAY


@model_only(LONG)
@directed("P006-AC-14", "P006-MOT-23")
async def p006_ac_14(dut: Any) -> None:
    host = await ready(dut)
    assert set(await move(host, 255)) == {1666, 1667}
    assert await host.swap("A5 FF 73 00 01 00 00 18") == hexed(reply(0xFF, host.accepted(256)))
    await rest(host)
    gaps = host.intervals()
    assert len(gaps) == 255 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1667, 1667, 1666]
    assert await host.position() == 511


@directed("P006-AC-15", "P006-BAD-10", "P006-STA-01")
async def p006_ac_15(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("s", 0) == 0 and await host.ask("s", -1) == 0
    assert await still(host) and not host.steps(0) and await host.status() == DECAY


@directed("P006-AC-16", "P006-STA-02", "P006-MOT-40")
async def p006_ac_16(dut: Any) -> None:
    host = await ready(dut)
    assert await host.swap("A5 FF 76 64 00 00 00 7E") == "A5 7A FF 64 00 00 00 82"
    assert await host.ask("s", 10) == 0 and await still(host)
    await run(host)
    await after_steps(host, host.pick(6, 3))
    assert set(host.intervals()) == {10_000}


@model_only(LONG)
@directed("P006-AC-17", "P006-MOT-17")
async def p006_ac_17(dut: Any) -> None:
    host = await ready(dut)
    assert await host.swap("A5 FF 76 80 3E 00 00 D8") == "A5 7A FF 80 3E 00 00 DC"
    gaps = await move(host, 4000)
    assert sum(gaps) == 523_965 - 1666 and gaps[-1] == 1666 and min(gaps) in (67, 68)


@model_only(LONG)
@directed("P006-AC-18", "P006-CMD-30", "P006-CMD-54", "P006-STA-15", "P006-EXC-01")
async def p006_ac_18(dut: Any) -> None:
    host = await ready(dut)
    await start(host, 10_000)
    mark = host.mark
    await after_steps(host, 500)
    assert await host.ask("s", 5) == 0
    await host.ok(m=4, d=0)
    before = host.t
    await host.ok(i=0x100)
    loaded = (before, host.e + EXECUTE)
    await rest(host)
    steps = host.steps(mark)
    assert len(steps) == 10_000 and await host.out("mon_dir") == 1
    least, most = (sum(t > at for t in steps) for at in reversed(loaded))
    assert least <= await host.position() - 0x100 <= most
    assert await host.ask("O") & FORWARD == 0
    await host.ok(a=0)
    angle = 64 + 8 * 10_000
    assert await host.refs() == sines(angle, 64)
    assert await move(host, 1) == []
    await host.pause(64)
    assert await host.refs() == sines(angle - 32, 64)


@model_only(LONG)
@directed("P006-AC-19", "P006-STA-13", "P006-MOT-41", "P006-CMD-11", "P006-CMD-12")
async def p006_ac_19(dut: Any) -> None:
    host = await ready(dut)
    await run(host)
    mark = host.mark
    await host.ms(300)
    assert await host.ask("O") & SPEED_MODE
    assert set(host.intervals(mark)[-100:]) == {312, 313}
    assert await host.ask("N", 0) == 0
    off = host.e
    assert await host.ask("O") & SPEED_MODE == 0 and await host.status() & 1
    fall = await rest(host)
    assert host.us(191_200) <= fall - off <= host.us(191_400) + EXECUTE
    late = [b for a, b in zip(host.steps(mark), host.intervals(mark), strict=False) if a > off]
    assert all(b >= a - 1 for a, b in zip(late, late[1:], strict=False)) and 1600 <= late[-1] <= 1667
    assert await host.position() == len(host.steps(mark))


@directed("P006-AC-20", "P006-STA-10", "P006-STA-16")
async def p006_ac_20(dut: Any) -> None:
    host = await ready(dut)
    await run(host)
    await host.ms(20)
    assert await host.swap("A5 FF 49 00 00 00 00 ED") == "A5 7A FF 00 00 00 00 1E"
    assert not host.steps(host.e + EXECUTE + 6) and not await host.busy()
    await start(host, 1)
    await rest(host)
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
    await rest(host)
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
    assert await host.swap("A5 FF 65 33 04 00 00 40") == "A5 7A FF 33 04 00 00 55"
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


@model_only("other clocks; script_clock has a third one")
@cocotb.parametrize(clk_hz=[25_000_000, 12_000_000])
@directed("P006-AC-45", "P006-PAR-01")
async def p006_ac_45(dut: Any, clk_hz: int) -> None:
    host = await ready(dut, clk_hz=clk_hz)
    gaps = await move(host, 300)
    assert gaps[:11] == [1613, 1534, 1439, 1341, 1247, 1162, 1086, 1019, 959, 907, 860]
    assert gaps[-12:] == [998, 1062, 1133, 1215, 1304, 1400, 1496, 1583, 1644, 1666, 1667, 1667]
    assert sum(gaps) == 136_376 - 1659


@model_only("a long ramp; script_angle has compensation at constant speeds")
@directed("P006-AC-46", "P006-EXC-24", "P006-EXC-21", "P006-EXC-22", "P006-EXC-23")
async def p006_ac_46(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(m=0, v=3000)
    await run(host)
    await cruise(host, 1_000_000 / 3000)
    await host.ms(10)
    mark = host.mark
    while len(host.steps(mark)) % 4:
        await host.step()
    await host.pause(64)
    assert await host.refs() == (7, 0, 77, 0)


@model_only(LONG)
@directed("P006-AC-50", "P006-MOT-20")
async def p006_ac_50(dut: Any) -> None:
    host = await Host.start(dut)
    assert await host.swap("A5 FF 73 1F 01 00 00 37") == hexed(reply(0xFF, host.accepted(287)))
    await rest(host)
    gaps = host.intervals()
    assert gaps[:7] == [1665, 1663, 1659, 1654, 1648, 1641, 1633] and sum(gaps) == 336_484 - 1667
    assert gaps[-7:] == [1659, 1663, 1664, 1667, 1667, 1666, 1667] and await host.position() == 287


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
    await rest(host)
    assert len(host.steps()) == 1


@directed("P006-AC-60", "P006-MOT-41")
async def p006_ac_60(dut: Any) -> None:
    host = await ready(dut)
    await brisk(host, 2500, d=0)
    await run(host)
    mark = host.mark
    await host.ms(host.pick(510, 40))
    assert await host.ask("N", 0) == 0
    off = host.e
    fall = await rest(host)
    assert 0 <= fall - off <= host.us(200) + EXECUTE
    assert set(host.intervals(mark)) == {400} and await host.position() == -len(host.steps(mark))


@model_only(LONG)
@directed("P006-AC-63", "P006-STL-01", "P006-PORT-04")
async def p006_ac_63(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(Y=3, Z=0xFF)
    gaps = await move(host, 1000)
    assert gaps[:3] == [1663, 1657, 1647] and sum(gaps) == 471_687 - 1667
    assert await host.status() & 0x10 == 0 and await host.ask("X") == 0


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
            # The frame ends some 60 us before the STOP ramp does.
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


@model_only(LONG)
@directed("P006-AC-18", "P006-BAD-10")
async def p006_signed_position_after_a_long_run(dut: Any) -> None:
    host = await brisk(await ready(dut), 2500, d=0, f=1)
    await start(host, 300)
    await rest(host)
    assert signed(await host.ask("c")) == -300 and not await host.status() & EXT1
