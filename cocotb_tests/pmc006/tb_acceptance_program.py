"""Acceptance checks of the user program."""

from __future__ import annotations

from typing import Any

from .builds import directed
from .moves import (
    after_steps,
    download,
    is_stopped,
    load,
    ready,
    set_constant_speed,
)
from .programs import END, P1, WAIT_REST, Op, out, page, rot, words

KEY_MS = 2
SAVED = page(a03=1, a04=4)


@directed("P006-AC-40", "P006-PRG-02", "P006-CMD-01", "P006-CMD-05", "P006-CMD-18")
async def p006_ac_40(dut: Any) -> None:
    host = await ready(dut)
    await download(host, P1)
    assert [await host.ask("G") for _ in range(20)] == words(P1)
    assert await host.ask("A", 200) == 20


@directed("P006-AC-42", "P006-PRG-30", "P006-PRG-31", "P006-PRG-32")
async def p006_ac_42(dut: Any) -> None:
    host = await ready(dut)
    await set_constant_speed(host, 2000)
    await load(host, Op(0x13, 1, 5), Op(0x14, 1), rot(100_000), WAIT_REST, END, out(1, 1), END)
    mark = host.mark
    await after_steps(host, 10)
    await host.pins(gpi=0b11101)
    await host.ms(KEY_MS)
    await host.pins(gpi=0b11111)
    await host.ms(KEY_MS)
    assert await host.busy()
    await host.pins(gpi=0b11110)
    edge = host.t - 1
    await host.ms(KEY_MS)
    halt = host.edges("mon_busy", edge)[0][0]
    assert host.us(1_000) <= halt - edge <= host.us(1_002) + 8
    assert not host.steps(halt + 1) and len(host.steps(mark)) > 10
    await host.pins(gpi=0b11111)
    edge = host.t - 1
    await host.ms(KEY_MS)
    assert host.us(999) <= host.edges("gpo", edge)[0][0] - edge <= host.us(1_002) + 200
    assert await host.out("gpo") == 1


@directed("P006-AC-44", "P006-CMD-21", "P006-CMD-47", "P006-PRG-12")
async def p006_ac_44(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 5A 00 01 00 00 FF") == "A5 7A FF 00 01 00 00 1F"
    assert await host.exchange("A5 FF 7A 00 00 00 00 1E") == "A5 7A FF 01 00 00 00 1F"
    assert await is_stopped(host) and not await host.busy()
    assert await host.ask("z") == 1


@directed("P006-AC-65", "P006-PRG-14", "P006-PRG-31")
async def p006_ac_65(dut: Any) -> None:
    program = (Op(0x13, 1, 0), rot(100_000), END)
    for disarmed in (False, True):
        host = await ready(dut)
        if not host.literal:
            await set_constant_speed(host, 2500)
        await load(host, *program)
        await after_steps(host, 10)
        if disarmed:
            await host.ok(F=0)
        await host.pins(gpi=0b11110)
        edge = host.t - 1
        await host.ms(KEY_MS)
        await host.pins(gpi=0b11111)
        await host.ms(KEY_MS)
        if disarmed:
            assert await host.busy() and await host.ask("I") == 0
        else:
            (halt, level), *more = host.edges("mon_busy", edge)
            assert not level and not more and host.us(1_000) <= halt - edge <= host.us(1_002) + 8
        assert not await host.busy() and await is_stopped(host)
