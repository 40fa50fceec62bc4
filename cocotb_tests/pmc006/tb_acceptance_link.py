"""Acceptance checks of the link and of the registers."""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .frames import command, signed
from .host import Host
from .line import Line
from .moves import is_stopped, ready, run, wait_stopped


@directed("P006-AC-01", "P006-EXC-30", "P006-EXC-31", "P006-PORT-04")
async def p006_ac_01(dut: Any) -> None:
    host = await Host.start(dut, levels={"sda_i": 1}, boot=False)
    up = await host.boot()
    assert up <= host.us(15_000) and await host.out("bridge_b_en") and host.edges("bridge_b_en")[0][0] == up
    await host.pause(64)
    assert await host.refs() == (38, 0, 38, 0)
    await host.go(up + host.us(100_002) + 64)
    assert await host.refs() == (19, 0, 19, 0)
    decayed = host.edges("phase_a_ref")[-1][0]
    assert host.us(99_998) <= decayed - up <= host.us(100_002) + 64
    assert [await host.out(name) for name in ("ext1_pu", "ext2_pu", "gpo", "txd", "de")] == [1, 1, 0, 1, 0]


@directed("P006-AC-02", "P006-CMD-44")
async def p006_ac_02(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 77 01 00 00 00 1C") == "A5 7A 01 01 00 00 00 21"


@directed("P006-AC-04", "P006-FRM-09", "P006-IO-02")
async def p006_ac_04(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("w", 2) == 2
    assert await host.exchange("A5 02 6D 04 00 00 00 18") == "A5 7A 02 04 00 00 00 25"
    assert await host.exchange("A5 02 79 08 00 00 00 28") == "A5 7A 02 08 00 00 00 29"
    assert await host.ask("k") == 4 and await host.out("gpo") == 0b00001


@directed("P006-AC-05", "P006-BAD-02")
async def p006_ac_05(dut: Any) -> None:
    host = await ready(dut)
    await host.raw("A5 FF 6A 00 00 00 00 0F")
    assert await host.is_silent(host.us(host.pick(100_000, 10_000)))
    assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"


@directed("P006-AC-06", "P006-BAD-03", "P006-FRM-06")
async def p006_ac_06(dut: Any) -> None:
    host = await ready(dut)
    await host.raw("A5 05 6A 00 00 00 00 14")
    await host.raw("A5 7A 05 00 00 00 00 24")
    assert await host.next_de_rise() is None
    assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"


@directed("P006-AC-07", "P006-CMD-48")
async def p006_ac_07(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 40 78 56 34 12 F8") == "A5 7A FF 00 00 00 00 1E"


@directed("P006-AC-08", "P006-BAD-04", "P006-FRM-04")
async def p006_ac_08(dut: Any) -> None:
    host = await ready(dut)
    await host.raw("A5 FF 73")
    await host.pause(int(240 * host.bit))  # 25 ms at 9600 baud
    assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"
    assert await host.is_silent(host.us(10_000)) and not host.steps()
    await host.raw("A5 FF 73")
    await host.pause(int(144 * host.bit))  # 15 ms
    await host.raw("01 00 00 00 18")
    assert await host.receive_reply() == host.accepted(1)
    await wait_stopped(host)
    assert len(host.steps(0)) == 1


@directed("P006-AC-09", "P006-BAD-01")
async def p006_ac_09(dut: Any) -> None:
    host = await ready(dut)
    await host.raw("00 5A FF")
    assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"


@directed("P006-AC-10", "P006-UART-05")
async def p006_ac_10(dut: Any) -> None:
    """Each edge of de and txd belongs to a reply; `receive_reply` checks all of them."""
    host = await ready(dut)
    assert await host.ask("j") == 8
    (up, _), (down, _) = host.edges("de", host.frame_start)
    bits = host.edges("txd", up)
    assert abs(up - host.e - host.bit) <= 8 and abs(down - host.e - 82 * host.bit) <= 8
    assert abs(bits[0][0] - host.e - 2 * host.bit) <= 8 and down - up - 81 * host.bit <= 2


@directed("P006-AC-11", "P006-UART-04")
async def p006_ac_11(dut: Any) -> None:
    for error in (0.025, -0.025):
        host = await Host.start(dut, error=error)
        assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"
        assert await host.ask("i", 0x5AA5FF01) == 0x5AA5FF01


@directed("P006-AC-12", "P006-CMD-15")
async def p006_ac_12(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 52 00 00 00 00 F6") == "A5 7A FF 23 01 00 00 42"


@directed("P006-AC-26", "P006-BAD-09")
async def p006_ac_26(dut: Any) -> None:
    host = await ready(dut)
    assert [await host.ask("m", value) for value in (3, 1, 256, 128)] == [16, 16, 16, 128]


@directed("P006-AC-47", "P006-CMD-44")
async def p006_ac_47(dut: Any) -> None:
    host = await ready(dut)
    assert [await host.ask("w", value) for value in (121, 0, 255, 120)] == [255, 255, 255, 120]
    assert host.address == 120 and await host.status() == 8


@directed("P006-AC-49", "P006-CMD-50", "P006-CMD-57")
async def p006_ac_49(dut: Any) -> None:
    host = await Host.start(dut)
    codes: tuple[str | int, ...] = ("k", "n", "q", "r", "h", 0x55, "K", "c", "j", "O", "x")
    assert [await host.ask(code) for code in codes] == [16, 800, 1000, 0, 0, 1, 0, 0, 0x08, 0x10, 0xF07]
    assert [await host.ask(code) for code in "LSMPQ"] == [600, 600, 300, 1250, 1]
    assert [await host.ask("T", 0x4F), await host.ask("Y", 9), await host.ask("Z", 0x300)] == [64, 0, 0]
    assert await host.exchange("A5 FF 6E 00 00 00 00 12") == "A5 7A FF 20 03 00 00 41"
    assert await host.exchange("A5 FF 50 00 00 00 00 F4") == "A5 7A FF E2 04 00 00 04"


@directed("P006-AC-51", "P006-CMD-56", "P006-EXC-20")
async def p006_ac_51(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(a=0, v=2600, L=700, S=650, P=900, M=250, u=4, o=2)
    assert await host.exchange("A5 FF 65 A4 06 00 00 B3") == "A5 7A FF A4 06 00 00 C8"
    await host.ok(f=2, J=1, Q=3, g=0, d=0, m=32, Y=6, Z=0x80, T=0x21, i=77)
    codes: tuple[str | int, ...] = ("n", "r", "h", 0x55, "q", "k", "K", "c")
    assert [await host.ask(code) for code in codes] == [1700, 4, 2, 3, 2600, 32, 1, 77]
    assert [await host.ask(code) for code in "LSMP"] == [700, 650, 250, 900]
    assert await host.refs() == (79, 0, 79, 0)


@directed("P006-AC-52", "P006-CMD-16", "P006-CMD-17", "P006-CMD-19", "P006-CMD-20", "P006-CMD-51")
async def p006_ac_52(dut: Any) -> None:
    host = await Host.start(dut)
    assert (await host.exchange("A5 FF 54 40 00 00 00 38"))[9:20] == "40 00 00 00"
    assert [await host.ask("T", value) for value in (5, 0x40, -1)] == [5, 5, 5]
    assert [
        await host.ask("Y", 7),
        await host.ask("Y", 8),
        await host.ask("Z", 0x1FF),
        await host.ask("Z", 0x200),
    ] == [
        7,
        7,
        511,
        511,
    ]


@directed("P006-AC-54", "P006-CMD-06", "P006-STA-11")
async def p006_ac_54(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 49 EF BE 00 00 9A") == "A5 7A FF EF BE 00 00 CB"
    assert await host.status() == 8 and await host.position() == 0
    assert await host.ask("s", 10_000) == host.accepted(10_000)
    await host.ms(host.pick(100, 20))
    assert await host.ask("I") == 0 and not await host.busy()
    assert await is_stopped(host) and await host.ask("I") == 0
    assert await host.ask("s", 1) == host.accepted(1)
    await wait_stopped(host)
    assert len(host.steps()) == 1


@cocotb.parametrize(first=[True, False])
@directed("P006-AC-61", "P006-FRM-10", "P006-FRM-06")
async def p006_ac_61(dut: Any, first: bool) -> None:
    """Of two parts on one bus, each answers only its own frames; the part under test is the first or the
    second.
    """
    ten, twenty = await Line.start(dut, first)
    for host in (ten, twenty):
        await host.boot()
    # The addresses are set one after the other, because both are FF at first. During the first setting, the
    # second part is in reset.
    await twenty.pins(rst_n=0)
    assert await ten.ask("w", 10) == 10
    await twenty.pins(rst_n=1)
    twenty.address = 0xFF
    await twenty.boot()
    await ten.pause(100)
    assert await twenty.ask("w", 20) == 20
    for host in (ten, twenty):
        await host.ok(e=1000, u=3, o=3, v=3200)
    mark = ten.t
    assert await ten.exchange("A5 0A 4E 01 00 00 00 FE") == "A5 7A 0A 01 00 00 00 2A"
    assert await ten.ask_other(twenty, "j") == 8
    await ten.ms(10)
    assert ten.steps(mark) and not twenty.steps(mark) and await ten.busy() and not await twenty.busy()
    await run(twenty)
    await ten.ms(10)
    assert ten.steps(mark) and twenty.steps(mark)
    assert await ten.ask("I") == 0 and not await ten.busy() and await twenty.busy()
    assert await ten.ask_other(twenty, "j") & 1
    assert await twenty.exchange("A5 14 49 00 00 00 00 02") == "A5 7A 14 00 00 00 00 33"
    await ten.send(command(15, "j"))
    assert await ten.is_silent(ten.us(20_000)) and await twenty.next_de_rise() is None
    drives = [(t, level, node) for node in (ten, twenty) for t, level in node.edges("de")]
    driving: set[int] = set()
    for _, level, node in sorted(drives, key=lambda drive: (drive[0], drive[1])):
        (driving.add if level else driving.discard)(id(node))
        assert len(driving) <= 1, "both drive the bus"


@directed("P006-AC-62", "P006-FRM-05")
async def p006_ac_62(dut: Any) -> None:
    host = await Host.start(dut)
    for address in range(0, 255, host.pick(1, 6)):
        await host.send_frame("j", address=address)
        assert await host.next_de_rise() is None
    await host.pause(int(90 * host.bit))
    assert not host.edges("de") and not host.edges("txd")
    assert await host.exchange("A5 FF 6A 00 00 00 00 0E") == "A5 7A FF 08 00 00 00 26"
    assert signed(await host.ask("i", -1)) == -1
