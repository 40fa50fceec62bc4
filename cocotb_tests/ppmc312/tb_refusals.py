"""Blocks that the PPMC-312 rejects because of parameters, sizes, headers or codes, and the order of the
checks.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, register
from openppmc.model.ppmc312.codes import Answer, Code


def refused(block: str, number: str) -> str:
    """Return the answer F0, which rejects a block."""
    data = bytes.fromhex(block)[2:30]
    return f"03 {len(data) + 2:02X} F0 {number} " + data.hex(" ").upper()


PARAMETERS = [
    # A row contains the error number and the block. The state is NOR with table TF. Invalid lengths come
    # first, then invalid values.
    ("23", message(Code.IN_POSITION, "00")),
    ("23", message(Code.ENCODE, "01 00")),
    ("23", message(Code.IN_POSITION, "01 0001 00")),
    ("23", message(Code.INTERLOCK_POSITION, "000000")),
    ("23", message(Code.INTERLOCK_POSITION, "00000000 00")),
    ("23", message(Code.SPEED_LIMIT, "01")),
    ("23", message(Code.SPEED_LIMIT, "0100 00")),
    ("23", message(Code.END_TERMINAL)),
    ("23", message(Code.END_TERMINAL, "00 00")),
    ("23", message(Code.ORIGIN_SEARCH, "00 00")),
    ("23", message(Code.ZERO_RETURN, "00 0000 00")),
    *(
        ("23", f"03 02 {code} 00")
        for code in ("20", "21", "22", "23", "24", "25", "27", "40", "41", "44", "45", "4D")
    ),
    ("23", message(Code.RESET, "00")),
    ("23", message(Code.OUTPUT)),
    ("23", message(Code.OUTPUT, "00 00")),
    ("23", message(Code.MASK, "00")),
    ("23", message(Code.MASK, "00 00 00")),
    ("23", message(Code.POSITION_READ)),
    ("23", message(Code.POSITION_READ, "00 00")),
    ("23", message(Code.POSITION_SET, "00 000000")),
    ("23", message(Code.EVENT_READ, "00 00")),
    ("23", message(Code.RAMP, "00 000000")),
    ("23", message(Code.RAMP, "00 0000 000000")),
    ("23", message(Code.RAMP, "00 0000 00000001 00")),
    ("23", message(Code.CONSTANT, "00 00000001")),
    ("23", message(Code.STEP, "00 00")),
    ("23", message(Code.FOREVER_RAMP, "00 00")),
    ("23", message(Code.FOREVER_CONSTANT, "00 0064 00")),
    ("23", message(Code.CHANGE, "04 0064 000000")),
    ("23", message(Code.STOP, "05 00")),
    ("23", message(Code.SLOW_STOP, "05 00000000 00")),
    ("23", message(Code.RAMP, "00 0000 00000000")),
    ("23", message(Code.RAMP, "00 00000000")),
    ("23", message(Code.CONSTANT, "00 0190 00000000")),
    ("23", message(Code.END_TERMINAL, "02")),
    ("23", message(Code.END_TERMINAL, "80")),
    ("23", message(Code.POSITION_READ, "02")),
    ("23", message(Code.POSITION_SET, "80 00000000")),
    ("20", message(Code.SPEED_LIMIT, "0000")),
    ("20", message(Code.SPEED_LIMIT, "0001")),
    ("21", message(Code.RAMP, "04 0000 00000001")),
    ("21", message(Code.FOREVER_RAMP, "06 0000")),
    ("24", message(Code.EVENT_READ, "02")),
    ("24", message(Code.EVENT_READ, "FF")),
    ("25", message(Code.EVENT_SET)),
    ("25", message(Code.EVENT_SET, "02 00")),
    ("25", message(Code.EVENT_SET, "00 03 01")),
    ("25", message(Code.EVENT_SET, "00 02 02 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 01 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 03 84 00")),
    ("25", message(Code.EVENT_SET, "00 03 00")),
    ("25", "03 13 49 00 03 0F" + " 82" * 15),
    ("26", message(Code.IN_POSITION, "01 0000")),
    ("26", message(Code.IN_POSITION, "07 0000")),
    ("27", message(Code.ENCODE, "03 0000")),
    ("23", "03 1E 84" + " 00" * 29),  # the echo has at most 28 bytes
]


@directed(
    "P312-BLK-01",
    "P312-BLK-02",
    "P312-CMD-49",
    "P312-CMD-47",
    "P312-CMD-02",
    "P312-CMD-03",
    "P312-CMD-05",
    "P312-CMD-06",
    "P312-CMD-42",
    "P312-CMD-43",
    "P312-OVR-01",
    "P312-CHK-18",
    "P312-CHK-26",
)
async def p312_parameter_abnormality(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    for number, block in PARAMETERS:
        assert await host.ask(block) == refused(block, number), block
    # No block has changed any state.
    assert (
        await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
        and host.bench.golden.position == 0
    )
    assert await host.quiet() and not host.bench.rises("pout", 0)


@directed("P312-BLK-01", "P312-CMD-49", "P312-GEN-05")
async def p312_lengths_that_are_just_right(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    assert await host.ask("03 12 49 FC 03 0E" + " 82" * 14) == message(Code.EVENT_SET, "00")
    assert await host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "01 00 82 00 00 00")
    assert await host.ask(message(Code.EVENT_SET, "FE")) == message(Code.EVENT_SET, "04")
    assert await host.ask(register(1, message(Code.INPUT))) == message(Code.EVENT_SET, "00")
    assert await host.ask(message(Code.OUTPUT, "C0")) == message(Code.OUTPUT) and host.out("auxo_n") == 0x3F
    assert await host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "01 00 25 00 00 00")
    assert await host.ask(message(Code.SPEED_LIMIT, "0002")) == message(Code.SPEED_LIMIT)
    assert await host.ask(message(Code.IN_POSITION, "01 0001")) == message(Code.IN_POSITION)


@directed(
    "P312-CHK-51", "P312-BLK-01", "P312-BAD-04", "P312-BAD-05", "P312-BAD-06", "P312-RSP-10", "P312-CMD-FF"
)
async def p312_size_header_and_command_abnormality(dut: Any) -> None:
    host = await Host.start(dut, T1)
    for block, answer in (
        ("03", message(Answer.SIZE, "00")),
        ("01", message(Answer.SIZE, "00")),
        ("03 01", message(Answer.SIZE, "01")),
        ("03 00", message(Answer.SIZE, "00")),
        ("FF FF", message(Answer.SIZE, "FF")),
        ("03 02 40", message(Answer.SIZE, "02")),
        ("03 01 40 00", message(Answer.SIZE, "01")),
        ("03 1F" + " 40" * 30, message(Answer.SIZE, "1F")),
        ("03 20 40", message(Answer.SIZE, "20")),
        ("07 02 40", message(Answer.SIZE, "02")),
        ("00 01 40", message(Answer.STATUS, "01 02")),
        ("01 01 40", message(Answer.STATUS, "01 02")),
        ("04 01 40", message(Answer.STATUS, "01 02")),
        ("83 01 40", message(Answer.STATUS, "01 02")),
        ("FF 01 46", message(Answer.STATUS, "01 02")),
        ("02 01 46", message(Answer.COMMAND, "46")),
        ("02 02 84 00", message(Answer.STATUS, "01 02")),
        ("02 01 FF", message(Answer.STATUS, "01 02")),
        ("03 01 FF 00", message(Answer.SIZE, "01")),
        ("03 02 FF", message(Answer.SIZE, "02")),
        (message(Code.RESET, "00 00"), refused(message(Code.RESET, "00 00"), "23")),
    ):
        if len(bytes.fromhex(block)) == 1:
            host.mark = host.t
            await host.put(block)
            assert await host.response() == answer
        else:
            assert await host.ask(block) == answer, block
    known = {*range(0x07), 0x10, 0x11, *range(0x20, 0x29), *range(0x40, 0x46), 0x47, 0x49, 0x4D}
    known |= {*range(0x80, 0x89), 0xFF}
    for code in range(256):
        if code not in known:
            assert await host.ask(message(code)) == message(Answer.COMMAND, f"{code:02X}")
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@directed("P312-BLK-01", "P312-STA-01", "P312-STA-03")
async def p312_order_of_checks(dut: Any) -> None:
    """The order of the checks is: state, length, value, limit, RUN. If the byte with OV is missing, OV counts
    as 0.
    """
    host = await Host.start(dut, T1)
    assert await host.ask(message(Code.STOP)) == message(Answer.STATUS, "00 02")
    assert await host.ask(message(Code.CHANGE, "00 00")) == message(Answer.STATUS, "00 02")
    assert (await host.ask(message(Code.RAMP)))[6:11] == "F0 23"
    await host.pins(fl_n=0, run=0)
    assert (await host.ask(message(Code.CONSTANT, "00 03E9 00000001")))[6:11] == "F0 20"
    assert (await host.ask(message(Code.CONSTANT, "00 03E9 00000000")))[6:11] == "F0 23"
    assert (await host.ask(message(Code.RAMP, "00 03E9 00000000")))[6:11] == "F0 23"
    assert await host.ask(message(Code.CONSTANT, "00 03E8 00000001")) == message(Answer.LIMIT)
    assert await host.ask(message(Code.CONSTANT, "40 03E8 00000001")) == message(Code.CONSTANT, "01")
    assert await host.ask(message(Code.INTERLOCK)) == message(Answer.STATUS, "00 20")
    assert await host.ask(message(Code.INTERLOCK, "00")) == message(Answer.STATUS, "00 20")
    assert await host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 20")
