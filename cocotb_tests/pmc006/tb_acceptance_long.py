"""Acceptance checks that last seconds, on the golden model only.

Other modules check the same rules with shorter times.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F16, F25, Config, directed

from .frames import reply, signed
from .host import EXECUTE, Host
from .moves import (
    EXT1,
    FORWARD,
    SPEED_MODE,
    after_steps,
    cruise,
    is_stopped,
    load,
    move,
    ready,
    run,
    set_constant_speed,
    start,
    wait_stopped,
)
from .programs import END, P1, Op, rot
from .reference import sines

F12 = Config("f12m", clk_hz=12_000_000)


def hexed(frame: bytes) -> str:
    """Return the text of a frame in the format of `Host.exchange`."""
    return frame.hex(" ").upper()


@directed("P006-AC-14", "P006-MOT-23", builds=(F16,))
async def p006_ac_14(dut: Any) -> None:
    host = await ready(dut)
    assert set(await move(host, 255)) == {1666, 1667}
    assert await host.exchange("A5 FF 73 00 01 00 00 18") == hexed(reply(0xFF, host.accepted(256)))
    await wait_stopped(host)
    gaps = host.intervals()
    assert len(gaps) == 255 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1667, 1667, 1666]
    assert await host.position() == 511


@directed("P006-AC-17", "P006-MOT-17", builds=(F16,))
async def p006_ac_17(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 76 80 3E 00 00 D8") == "A5 7A FF 80 3E 00 00 DC"
    gaps = await move(host, 4000)
    assert sum(gaps) == 523_965 - 1666 and gaps[-1] == 1666 and min(gaps) in (67, 68)


@directed("P006-AC-18", "P006-CMD-30", "P006-CMD-54", "P006-STA-15", "P006-EXC-01", builds=(F16,))
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
    await wait_stopped(host)
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


@directed("P006-AC-19", "P006-STA-13", "P006-MOT-41", "P006-CMD-11", "P006-CMD-12", builds=(F16,))
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
    fall = await wait_stopped(host)
    assert host.us(191_200) <= fall - off <= host.us(191_400) + EXECUTE
    late = [b for a, b in zip(host.steps(mark), host.intervals(mark), strict=False) if a > off]
    assert all(b >= a - 1 for a, b in zip(late, late[1:], strict=False)) and 1600 <= late[-1] <= 1667
    assert await host.position() == len(host.steps(mark))


@directed("P006-AC-45", "P006-PAR-01", builds=(F12, F25))
async def p006_ac_45(dut: Any) -> None:
    host = await ready(dut)
    gaps = await move(host, 300)
    assert gaps[:11] == [1613, 1534, 1439, 1341, 1247, 1162, 1086, 1019, 959, 907, 860]
    assert gaps[-12:] == [998, 1062, 1133, 1215, 1304, 1400, 1496, 1583, 1644, 1666, 1667, 1667]
    assert sum(gaps) == 136_376 - 1659


@directed("P006-AC-46", "P006-EXC-24", "P006-EXC-21", "P006-EXC-22", "P006-EXC-23", builds=(F16,))
async def p006_ac_46(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(m=0, v=3000)
    await run(host)
    await cruise(host, 1_000_000 / 3000)
    await host.ms(10)
    mark = host.mark
    while len(host.steps(mark)) % 4:
        await host.next_steps(host.t + host.us(10_000))
    await host.pause(64)
    assert await host.refs() == (7, 0, 77, 0)


@directed("P006-AC-50", "P006-MOT-20", builds=(F16,))
async def p006_ac_50(dut: Any) -> None:
    host = await Host.start(dut)
    assert await host.exchange("A5 FF 73 1F 01 00 00 37") == hexed(reply(0xFF, host.accepted(287)))
    await wait_stopped(host)
    gaps = host.intervals()
    assert gaps[:7] == [1665, 1663, 1659, 1654, 1648, 1641, 1633] and sum(gaps) == 336_484 - 1667
    assert gaps[-7:] == [1659, 1663, 1664, 1667, 1667, 1666, 1667] and await host.position() == 287


@directed("P006-AC-63", "P006-STL-01", "P006-PORT-04", builds=(F16,))
async def p006_ac_63(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(Y=3, Z=0xFF)
    gaps = await move(host, 1000)
    assert gaps[:3] == [1663, 1657, 1647] and sum(gaps) == 471_687 - 1667
    assert await host.status() & 0x10 == 0 and await host.ask("X") == 0


@directed("P006-AC-18", "P006-BAD-10", builds=(F16,))
async def p006_signed_position_after_a_long_run(dut: Any) -> None:
    host = await set_constant_speed(await ready(dut), 2500, d=0, f=1)
    await start(host, 300)
    await wait_stopped(host)
    assert signed(await host.ask("c")) == -300 and not await host.status() & EXT1


@directed("P006-AC-39", "P006-PRG-02", "P006-PRG-12", "P006-PRG-20", "P006-CMD-47", builds=(F16,))
async def p006_ac_39(dut: Any) -> None:
    host = await ready(dut)
    await load(host, *P1)
    mark = host.mark
    await host.ms(200)
    assert await host.ask("E") == 0 and await host.ask("z") == 0
    await host.until("gpo", 1)
    assert not await host.busy()
    steps = host.steps(mark)
    assert len(steps) == 600
    for first in range(0, 600, 200):
        group = steps[first : first + 200]
        assert host.in_us(group[-1] - group[0]) == 333_334 - 1667
        gaps = {host.in_us(b - a) for a, b in zip(group, group[1:], strict=False)}
        assert gaps == {1666, 1667}
    assert await host.position() == 600 and await host.out("gpo") == 1


@directed("P006-AC-43", "P006-MOT-31", "P006-MOT-51", "P006-MOT-52", builds=(F16,))
async def p006_ac_43(dut: Any) -> None:
    host = await ready(dut)
    await host.strobe(adc_data=512)
    await load(host, Op(0x08, 1, 8000), rot(100_000), END)
    mark = host.mark
    await cruise(host, 1_000_000 / 4007, 3_000_000)
    first = len(host.steps(mark))
    await after_steps(host, first + 4007)
    steps = host.steps(mark)
    assert abs(host.in_us(steps[-1] - steps[first - 1]) - 1_000_000) <= 250
    await host.strobe(adc_data=0)
    await host.ms(1_000)
    assert await is_stopped(host, host.us(100_000)) and await host.busy()
    await host.strobe(adc_data=1023)
    await cruise(host, 125, 3_000_000)
    await wait_stopped(host, 20_000_000)
    assert len(host.steps(mark)) == 100_000
