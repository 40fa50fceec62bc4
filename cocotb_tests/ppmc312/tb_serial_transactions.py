"""Example transactions of the PPMC-312, byte for byte on its serial line.

A transaction has the same number here and in tb_transactions.py, which uses the parallel bus.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import cocotb

from cocotb_tests.harness import directed

from .serial_frames import T_INIT, TS
from .serial_host import SerialHost

ACK = "91 6E"
SET_POSITION = "43 12345678"
REGISTERED = "59 03 08 82 00 0000 00000064"


class Row(NamedTuple):
    """A transaction: number, bytes sent, reply, settings before it, polls after it, levels of pins."""

    number: int
    sent: str
    reply: str
    setting: tuple[str, ...] = ()
    polls: tuple[str, ...] = ()
    pins: dict[str, int] = {}  # noqa: RUF012 - never changed


ROWS = [
    Row(1, "91 30 30 30 31 30 33 65 38 30 30 63 38 30 30 30 37 64 30 63", ACK),
    Row(3, "91 30 32 30 31 30 30 30 61 61", ACK),
    Row(4, "91 30 33 30 31 30 30 31 34 56", ACK),
    Row(5, "91 30 34 30 30 30 30 31 33 38 38 4F", ACK),
    Row(6, "91 30 35 30 31 32 63 3C", ACK, (TS,)),
    Row(7, "91 30 36 30 31 67", ACK),
    Row(8, "91 38 30 6E", ACK, (TS, "86 0000"), ("A1 33 37 27", ACK)),
    Row(
        9,
        "91 39 30 30 30 30 30 31 30 30 30 4E",
        ACK,
        (TS, "43 00000FF8"),
        ("B1 32 38 26", "A1 33 37 27", ACK),
    ),
    Row(10, "91 61 31 4D", ACK, (TS,)),
    Row(11, "91 38 33 30 30 30 30 30 30 30 30 31 33 38 38 50", ACK, (TS,), ("A1 33 38 26", ACK)),
    Row(12, "91 61 34 30 31 66 34 30 30 30 30 30 30 36 34 71", ACK, (TS,), ("A1 33 38 26",)),
    Row(13, "91 61 32 4C", ACK, (TS,), ("A1 33 38 26",)),
    Row(14, "91 38 36 30 30 30 30 68", ACK, (TS,)),
    Row(15, "91 61 35 30 31 39 30 38", ACK, (TS,)),
    Row(16, "91 38 39 30 31 39 30 54", ACK, (TS, "85 01F4")),
    Row(
        17,
        "91 39 61 30 31 32 63 30 30 30 30 30 38 30 30 1F",
        ACK,
        (TS, "43 000007F0"),
        ("B1 32 38 26",),
    ),
    Row(18, "91 62 37 30 31 66 34 42", ACK, (TS,)),
    Row(19, "91 38 38 30 30 30 30 66", ACK, (TS,)),
    Row(20, "91 32 35 49", "A1 61 35 39", pins={"auxi": 0xA5}),
    Row(21, "91 32 36 31 35 33", ACK),
    Row(22, "91 32 37 47", "A1 66 66 65 30 7F"),
    Row(23, "91 32 38 32 34 22", ACK, (), ("B1 32 61 30 30 30 34 20", ACK), {"auxi": 0x32}),
    Row(24, "91 34 32 2C", "A1 31 32 33 34 35 36 37 38 4A", (SET_POSITION,)),
    Row(25, "91 36 33 66 66 66 66 66 66 66 66 0F", ACK),
    Row(26, "91 34 34 2A", ACK, (TS,)),
    Row(27, "91 34 35 29", ACK, (TS,)),
    Row(28, "91 34 31 2D", "A1 31 32 4C"),
    Row(
        29,
        "91 35 39 30 33 30 38 38 32 30 30 30 30 30 30 30 30 30 30 30 30 36 34 24",
        ACK,
        (TS,),
    ),
    Row(30, "91 37 39 75", ACK, (TS, REGISTERED)),
    Row(32, "91 34 64 21", "A1 30 30 30 32 30 30 5C", (TS,)),
    Row(38, "91 38 33 30 30 30 30 30 30 30 30 30 30 30 30 6B", "B1 34 32 0C", (TS,)),
    Row(40, "91 32 30 4E", ACK),
    Row(40, "91 32 34 4A", ACK),
    Row(42, "81 7E", ACK),
    Row(42, "81 7E", "81 7E", (TS, "85 0190")),
]
# Number of a row -> instruction that is sent between the row and its polls.
_THEN = {9: "86 0000", 17: "86 0000"}
BY_NAME = {f"row{row.number}_{place}": row for place, row in enumerate(ROWS)}


@cocotb.parametrize(name=list(BY_NAME))
@directed("P312-SER-02", "P312-SER-11", "P312-SER-13", "P312-SER-20", "P312-SER-30", "P312-SER-40")
async def p312_serial_row(dut: Any, name: str) -> None:
    host, row = await SerialHost.start(dut), BY_NAME[name]
    if row.pins:
        await host.pins(**row.pins)
        await host.pause(10)
    for instruction in row.setting:
        assert await host.ask(instruction) == "90"
    await host.raw(row.sent)
    await host.hear(T_INIT)
    assert host.wire == row.reply
    if row.number in _THEN:
        assert await host.ask(_THEN[row.number]) == "90"
    if row.number == 23:
        await host.pins(auxi=0x66)
        await host.pause(1_000)
    for expected in row.polls:
        wire = "81 7E"
        while wire == "81 7E":
            if row.number == 11:
                await host.pause(100_000)
            await host.raw("81 7E")
            await host.hear()
            wire = host.wire
        assert wire == expected


@directed("P312-SER-45", "P312-SER-46")
async def p312_serial_read_outs(dut: Any) -> None:
    """The reads of transaction 39 and the alarm of transaction 42 have the expected replies."""
    host = await SerialHost.start(dut, TS)
    assert await host.ask("84 01F4 00000002") == "90" and await host.settle() == ["A0 38"]
    await host.ask("83 0000 00000000")
    await host.raw("81 00")
    await host.hear()
    for sent, reply in (
        ("91 34 30 2E", "A1 33 38 26"),
        ("91 34 65 20", "A1 34 32 1C"),
        ("91 34 66 1F", "A1 30 30 30 30 30 31 5D"),
    ):
        await host.raw(sent)
        await host.hear()
        assert host.wire == reply
    await host.pins(alm_n=0)
    await host.pause(20)
    await host.raw("81 7E")
    await host.hear()
    assert host.wire == "B1 34 36 08"


@directed("P312-CMD-FF", "P312-SER-19")
async def p312_serial_reset_is_not_answered(dut: Any) -> None:
    """Instruction FF (transaction 41) has no reply."""
    host = await SerialHost.start(dut)
    await host.raw("91 66 66 6F")
    assert await host.quiet(6_000)


@directed("P312-CMD-26", "P312-CMD-06", "P312-MOT-30")
async def p312_serial_what_the_rows_do(dut: Any) -> None:
    """Transactions 4, 7, 10, 21 and 26 have their effects after their replies."""
    host = await SerialHost.start(dut, TS)
    for line, output, level in (
        ("91 32 36 31 35 33", "auxo_n", 0x2A),
        ("91 34 34 2A", "intlk_n", 0),
        ("91 32 30 4E", "exon_n", 0),
    ):
        await host.raw(line)
        assert await host.hear() == "90" and host.out(output) == level
    for line, place, byte in (
        ("91 30 36 30 31 67", 1, "44"),
        ("91 30 33 30 31 30 30 31 34 56", 1, "54"),
        ("91 61 31 4D", 3, "11"),
    ):
        await host.raw(line)
        assert await host.hear() == "90" and (await host.ask("4D")).split()[place] == byte
