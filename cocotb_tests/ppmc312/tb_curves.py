"""The free curves of the PPMC-312: transfers, errors in transfers, disturbances."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb import Param

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.blocks import RATES, T1, TF, TG, TH
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from cocotb_tests.ppmc312.table_read import read_table
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@directed("P312-CMD-01", "P312-CMD-FC-1", "P312-CMD-FC-10", "P312-CMD-41")
async def p312_a_combined_curve_may_be_announced_with_four_bytes(dut: Any) -> None:
    """With LE = 0 and length 04, the last byte is ignored. The only legal lengths are 03 and 04."""
    for last in ("00", "01", "02", "7F", "80", "FF"):
        host = await Host.start(dut)
        assert await host.ask(f"02 04 01 01 03 {last}") == message(Code.FREE_CURVE, "00 03")
        assert [await host.ask(block) for block in TF[1:]] == [
            message(Code.FREE_CURVE, "01 03"),
            message(Code.FREE_CURVE, "0F 00 00 0C 00 00 0C"),
        ]
        head, (rates, up, down) = await read_table(host)
        assert head == [3, 3, 0, 0, 0, 12, 0, 0, 12]
        assert (rates, up, down) == ([100, 200, 400], [5, 4, 3], [])
    for block in ("02 02 01 01", "02 05 01 01 03 03 00"):
        assert (await (await Host.start(dut)).ask(block))[6:11] == "F0 11"


def curve(rates: list[int], up: list[int], down: list[int] | None, step: tuple[int, int]) -> list[str]:
    """Return the blocks of a transfer.

    Args:
        step: maximum number of rates, and of pulse numbers, in a block.
    """
    blocks = [
        bytes([2, 3 + (down is not None), 1, 0x11 if down else 1, len(up), *([len(down)] if down else [])])
    ]
    lists = [(rates, 2, step[0]), (up, 3, step[1]), *([(down, 3, step[1])] if down else [])]
    for values, width, most in lists:
        for k in range(0, len(values), most):
            data = b"".join(value.to_bytes(width, "big") for value in values[k : k + most])
            blocks.append(bytes([0, len(data)]) + data)
    blocks[-1] = b"\x01" + blocks[-1][1:]
    return [block.hex() for block in blocks]


CURVES = {
    # Longest curve in the longest blocks, separate tables, and blocks with one value each.
    "longest": ([300 + 3 * k for k in range(127)], [2 + k for k in range(127)], None, (15, 10)),
    "two-sides": (
        [50 * (k + 1) for k in range(9)],
        [0x10_0000 + k for k in range(4)],
        list(range(2, 11)),
        (4, 3),
    ),
    "one-a-block": ([2, 0xFFFF], [2, 0xFF_FFFD], [3, 4], (1, 1)),
    "not-monotonic": ([100, 300, 200], [5, 4, 3], [6, 7], (3, 3)),
}


@cocotb.parametrize(case=[Param(case, name) for name, case in CURVES.items()])
@directed(
    "P312-CMD-01",
    "P312-CMD-FC-1",
    "P312-CMD-FC-2",
    "P312-CMD-FC-3",
    "P312-CMD-FC-8",
    "P312-CMD-FC-10",
    "P312-CHK-12",
    "P312-BAD-15",
)
async def p312_free_curves(dut: Any, case: tuple) -> None:
    rates, up, down, step = case
    host = await Host.start(dut)
    lists = [rates, up, *([down] if down else [])]
    done, item = 0, 0
    blocks = curve(*case)
    assert await host.ask(blocks[0]) == clean(message(Code.FREE_CURVE, f"00 {len(rates):02X}"))
    for block in blocks[1:-1]:
        done += (len(block) // 2 - 2) // (2 if item == 0 else 3)
        if done == len(lists[item]):
            done, item = 0, item + 1
        assert await host.ask(block) == clean(
            message(Code.FREE_CURVE, f"{item:02X} {len(lists[item]) - done:02X}")
        )
    total, rest = sum(up), sum(down or up)
    assert await host.ask(blocks[-1]) == clean(message(Code.FREE_CURVE, f"0F {total:06X} {rest:06X}"))
    assert host.condition == 0x02
    head, got = await read_table(host)
    assert head[:3] == [len(rates), len(up), len(down) if down else 0]
    assert got == [rates, up, down or []]
    # The highest rate that an instruction may request is that of stage 126; the lowest is that of the first
    # stage in use.
    assert (await host.ask(message(Code.CONSTANT, f"00 {rates[0] - 1:04X} 00000001")))[6:11] == "F0 20"
    if rates[-1] < 0xFFFF:
        assert (await host.ask(message(Code.CONSTANT, f"00 {rates[-1] + 1:04X} 00000001")))[6:11] == "F0 20"
    assert await host.ask(message(Code.CONSTANT, f"00 {rates[-1]:04X} 00000001")) == message(
        Code.CONSTANT, "00"
    )


FC_ERRORS = [
    # Errors of the code block, which begins a transfer.
    ("11", ("02 04 01 11 01 03",)),
    ("11", ("02 04 01 11 03 01",)),
    ("11", ("02 04 01 11 80 03",)),
    ("11", ("02 04 01 11 03 80",)),
    ("11", ("02 03 01 11 03",)),
    ("11", ("02 05 01 11 03 03 00",)),
    ("11", ("02 01 01",)),
    ("10", (message(Code.FREE_CURVE, "11 80 03"),)),  # the size is checked before error 11
    # Errors of data blocks: the sizes 15 and 16, also for a block with the header of an instruction; then, in
    # this order, 16, 18 or 19, 1A and 17.
    ("15", (TF[0], "00 1F" + "0064" * 15)),
    ("16", (TF[0], "00 07 0064 00C8 0190")),
    ("16", (TF[0], "00 00 64")),
    ("16", (TF[0], "03 03 40")),
    ("16", (TF[0], "01 05 0001 0001 00")),
    ("16", (TF[0], "00 08 0001 0002 0003 0004")),
    ("18", (TF[0], "01 06 0064 0001 0190")),
    ("18", (TF[0], "00 02 0000")),
    ("17", (TF[0], "01 06 0064 00C8 0190")),
    ("17", (TF[0], RATES, "01 03 000005")),
    ("19", (TF[0], RATES, "00 09 FFFFFF 000001 FFFFFF")),
    ("1A", (TF[0], RATES, "00 09 FFFFFF 000002 000002")),
    ("1A", (TF[0], RATES, "00 03 FFFFFF", "00 03 000002")),
    ("17", (TG[0], RATES, "01 09 000005 000004 000003")),
    ("1A", (*TG[:3], "00 06 FFFFFF 000002")),
    ("19", (*TG[:3], "01 06 000006 000000")),
    ("16", (*TG[:3], "01 09 000006 000004 000002")),
    ("17", (*TG[:3], "00 06 000006 000004")),
]


@cocotb.parametrize(case=FC_ERRORS)
@directed("P312-CMD-FC-4", "P312-CMD-FC-9", "P312-CHK-13", "P312-BAD-11", "P312-BLK-01")
async def p312_errors_of_each_free_curve_block(dut: Any, case: Any) -> None:
    number, blocks = case
    host = await Host.start(dut, *TF, message(Code.CHANGE, "07 00C8"), *blocks[:-1])
    echo = bytes.fromhex(blocks[-1])[2:]
    assert (
        await host.ask(blocks[-1])
        == f"03 {len(echo[:28]) + 2:02X} F0 {number} {echo[:28].hex(' ').upper()}".strip()
    )
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert await host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")
    assert await host.ask(RATES) == message(Answer.STATUS, "01 01")


@directed("P312-CMD-FC-8", "P312-RSP-20", "P312-BAD-11", "P312-INP-31", "P312-CMD-FF")
async def p312_a_transfer_that_is_disturbed(dut: Any) -> None:
    # If the answer to a block is not read, an alarm occurs, and the transfer is aborted.
    host = await Host.start(dut, T1, TF[0])
    await host.issue(TF[1])
    await host.pause(200)
    await host.issue(TF[2])
    assert [await host.response() for _ in range(2)] == [
        message(Code.FREE_CURVE, "01 03"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert await host.ask(TF[2]) == message(Answer.STATUS, "01 10")
    await host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x01
    # Other instructions do not begin a transfer, and a curve can be completed only once.
    for block in (TF[2], "00 02 0064", "07 01 40"):
        assert await host.ask(block) == message(Answer.STATUS, "01 01")
    for block in TH:
        await host.ask(block)
    assert await host.ask(TH[-1]) == message(Answer.STATUS, "01 02")
    head, (rates, up, down) = await read_table(host)
    assert (rates, up, down) == ([100, 200, 400], [6, 4], [5, 4, 3]) and head[:3] == [3, 2, 3]
    for block in ("02 01 40", "02 02 80 00", "02 09 00 01 03E8 00C8 0007D0"):
        assert await host.ask(block) == message(Answer.STATUS, "01 02")
    # A block is sent while an answer is unread, then instruction FF: the part executes FF immediately.
    await host.ask(TF[0])
    await host.issue(TF[1])
    await host.pause(200)
    await host.issue(message(Code.RESET))
    await host.pause(200)
    assert await host.response() == message(Code.RESET) and await host.quiet() and host.condition == 0x01
