"""Parallel bus of the PPMC-312 at its limits: strobes, windows, order of accesses, interrupts."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import D16, F16, directed
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, RCR, WAR, WCR
from cocotb_tests.ppmc312.blocks import T1
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Answer, Code

ADDRESSES = range(8)


@directed("P312-PAR-10", "P312-GEN-01", exact="the data change with the end of the strobe")
async def p312_write_takes_the_last_sample(dut: Any) -> None:
    host = await Host.start(dut)
    # Register address and data change during the strobe; the last level before its end is used.
    for end, levels in ((2, {"cs_n": 1}), (2, {"we_n": 1}), (1, {"cs_n": 1, "we_n": 1})):
        await host.pins(cs_n=0, we_n=0, rs=WCR, d_i=0x00)
        host.bench.set(rs=CSR, d_i=0x70)
        await host.pause(end)
        await host.pins(**levels)
        host.bench.set(cs_n=1, we_n=1, rs=7, d_i=0x8F)
        await host.pause(3)
        assert await host.read(CSR) == 0x74
        await host.write(CSR, 0x00)


@directed("P312-PAR-10", "P312-PAR-05", "P312-GEN-04")
async def p312_shortest_strobes_back_to_back(dut: Any) -> None:
    host = await Host.start(dut)
    for _ in range(3):
        for reg, byte in ((WCR, 0x20), (WAR, 0x1C), (DWR, 0x2A), (DWR, 0x26), (DWR, 0x02), (DWR, 0x03)):
            await host.strobe(3, 3, cs_n=0, we_n=0, rs=reg, d_i=byte)
        assert await host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x15
        await host.ask(message(Code.OUTPUT, "00"))


@directed("P312-PAR-11", "P312-PAR-09")
async def p312_reads_drive_the_bus(dut: Any) -> None:
    host = await Host.start(dut, message(Code.EXCITATION_ON))
    await host.issue(message(Code.VERSION))
    await host.wait()
    for reg, value in zip(ADDRESSES, (0x00, 0, 0, 0x3C, 0, 0, 0, 0x12), strict=True):
        await host.pause(1)  # the previous strobe may end one cycle later
        mark = host.t
        await host.strobe(9, 6, cs_n=0, oe_n=0, rs=reg)
        (rise,), (fall,) = host.bench.rises("d_oe", mark), host.bench.falls("d_oe", mark)
        assert rise - mark in range(0, 5) and fall - mark - 9 in range(0, 5)
        assert host.out("d_o") == value, reg
        assert len([edge for edge in host.bench.edges("d_o", mark) if edge[0] > mark + 4]) == 0
    # After one byte was read, a read of RCR rewinds to this byte.
    assert await host.read(RAR) == 0x3D and await host.read(RCR) == 0 and await host.read(RAR) == 0x3C
    assert await host.response() == message(Code.VERSION, "12")


@directed("P312-PAR-11", "P312-PAR-08")
async def p312_one_value_a_strobe(dut: Any) -> None:
    """If a response is loaded or discarded during a read of CSR, the value on the bus does not change during
    this read.
    """
    host = await Host.start(dut, T1)
    await host.issue(message(Code.VERSION))
    mark = host.t
    await host.strobe(400, 6, cs_n=0, oe_n=0, rs=CSR)
    assert len(host.bench.edges("d_o", mark)) <= 1 and await host.read(CSR) == 0x00
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.read(RAR) == 0x40 and await host.read(DRR) == 0


@directed("P312-PAR-09", "P312-BAD-01", "P312-BAD-10", exact="both strobes must be sampled at the same edges")
async def p312_no_access(dut: Any) -> None:
    host = await Host.start(dut)
    mark = host.t
    for levels in (
        {"cs_n": 1, "we_n": 0},
        {"cs_n": 1, "oe_n": 0},
        {"cs_n": 0, "we_n": 0, "oe_n": 0},
        {"cs_n": 0},
    ):
        for reg in (CSR, WCR, DWR, DRR):
            await host.strobe(5, 4, rs=reg, d_i=0x70, **levels)
    assert not host.bench.rises("d_oe", mark)
    for reg in (1, 4, 6, 7):
        await host.write(reg, 0x70)
    assert [await host.read(reg) for reg in ADDRESSES] == [0x04, 0, 0, 0x40, 0, 0, 0, 0]


@directed("P312-PAR-01", "P312-GEN-05", "P312-PAR-06")
async def p312_control_bits(dut: Any) -> None:
    host = await Host.start(dut)
    for byte in (0xFF, 0x8F, 0x40, 0x20, 0x10, 0x00, 0x70):
        await host.write(CSR, byte)
        assert await host.read(CSR) == 0x04 | byte & 0x70
    await host.write(CSR, 0x30)
    await host.issue(message(Code.OUTPUT, "FF"))
    await host.write(CSR, 0x50)
    assert await host.read(CSR) & 0x70 == 0x50
    assert await host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x00
    # The data sheet prints these bits as crosses (undefined).
    assert await host.ask(message(Code.IN_POSITION, "FA 0001")) == message(Code.IN_POSITION)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")


@directed("P312-PAR-03", "P312-PAR-04", "P312-PAR-05", "P312-BAD-02", "P312-BAD-03")
async def p312_write_window_in_any_order(dut: Any) -> None:
    host = await Host.start(dut)

    async def data(*block: int) -> None:
        for byte in block:
            await host.write(DWR, byte)

    # Once armed, the write window stays open; WAR may be written first.
    await host.write(WAR, 0x1D)
    await host.write(WCR, 0x20)
    await data(0x40, 0x01, 0x03)
    assert await host.response() == message(Code.VERSION, "12")
    await host.write(WAR, 0x1D)
    await data(0x40, 0x01, 0x03)
    assert await host.response() == message(Code.VERSION, "12")
    # The window is disarmed in the middle of a block and armed again; the bytes written in between are
    # discarded.
    await host.write(WAR, 0x1D)
    await data(0x40)
    await host.write(WCR, 0x21)
    await data(0x55, 0x56)
    await host.write(WCR, 0x20)
    await data(0x01, 0x03)
    assert await host.response() == message(Code.VERSION, "12")
    # A new address discards the bytes that were written before.
    await host.write(WAR, 0x1C)
    await data(0x01, 0x26, 0x02)
    await host.write(WAR, 0x1D)
    await data(0x40, 0x01, 0x03)
    assert await host.response() == message(Code.VERSION, "12") and host.out("auxo_n") == 0x3F
    # Outside the window, no byte is stored and the pointer does not move; it does not wrap around to the top.
    for war in (0x20, 0x21, 0x3D, 0x80, 0xBD, 0xFF):
        await host.write(WAR, war)
        await data(*(0x40, 0x01, 0x03) * 13)
        assert await host.quiet(200) and not await host.read(CSR) & MWEF
    # The test writes the whole window, then its first and its last valid address.
    await host.put("03 1E" + " 40" * 30)
    assert await host.response() == "03 1E F0 23" + " 40" * 28
    await host.put("03", war=0x1F)
    assert await host.response() == message(Answer.SIZE, "00")


@directed("P312-PAR-06", "P312-BAD-02")
async def p312_writes_while_an_instruction_is_processed(dut: Any) -> None:
    host = await Host.start(dut)
    await host.issue(T1)
    # All these writes are ignored: the window stays armed, and the pointer stays at its end.
    await host.write(WCR, 0x00)
    await host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        await host.write(DWR, byte)
    assert await host.read(CSR) == MWEF | MREF
    assert await host.response() == message(Code.INITIAL)
    for byte in (0x40, 0x01, 0x03):
        await host.write(DWR, byte)
    assert await host.quiet(300)
    await host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        await host.write(DWR, byte)
    assert await host.response() == message(Code.VERSION, "12")


@directed("P312-PAR-07", "P312-BAD-08")
async def p312_reads_in_any_order(dut: Any) -> None:
    host = await Host.start(dut, message(Code.POSITION_SET, "00 12345678"))
    await host.issue(message(Code.POSITION_READ, "00"))
    await host.wait()
    want = [0x78, 0x56, 0x34, 0x12, 0x00, 0x42, 0x06, 0x03]
    for count in (0, 3, 7, 1):
        await host.read(RCR)
        assert await host.read(RAR) == 0x38
        assert [await host.read(DRR) for _ in range(count)] == want[:count]
        assert await host.read(RAR) == 0x38 + count and not await host.read(CSR) & MREF
    # Write accesses to the same addresses do not disturb the read, which continues.
    await host.write(RCR, 0x00)
    await host.write(DRR, 0x00)
    await host.write(RAR, 0x00)
    assert await host.read(RAR) == 0x39
    assert [await host.read(DRR) for _ in range(7)] == want[1:]
    assert await host.read(RAR) == 0x40 and await host.read(CSR) & MREF
    assert await host.read(RCR) == 0 and await host.read(DRR) == 0 and await host.read(RAR) == 0x40
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@directed("P312-PAR-02", "P312-PAR-08")
async def p312_interrupt_of_both_kinds(dut: Any) -> None:
    host = await Host.start(dut, T1)
    for enables, before, busy, waiting in (
        (0x20, 0, 1, 0),
        (0x10, 1, 1, 0),
        (0x30, 0, 1, 0),
        (0x00, 1, 1, 1),
    ):
        await host.write(CSR, enables)
        await host.pause(8)
        assert host.out("irq_n") == before
        await host.issue(message(Code.VERSION))
        await host.pause(8)
        assert host.out("irq_n") == busy, "while it is processed"
        await host.wait()
        await host.pause(8)
        assert host.out("irq_n") == waiting
        await host.response()
        await host.pause(9)
        assert host.out("irq_n") == before


@directed("P312-PAR-12", "P312-TIM-15", builds=(F16, D16))
async def p312_wait_request_of_reads_and_writes(dut: Any) -> None:
    host = await Host.start(dut, message(Code.VERSION))
    slow = host.bench.config.datasheet
    window = 10 if slow else 6
    for enabled in (0x40, 0x00):
        await host.write(CSR, enabled)
        await host.issue(message(Code.VERSION))
        await host.wait()
        for gap in (window - 3, window + 3, 1, window, window - 1):
            mark = host.t
            await host.strobe(14, max(gap, 3), cs_n=0, oe_n=0, rs=DRR)
            lows = host.bench.falls("wrq_n", mark)
            if not enabled:
                assert not lows
            await host.read(RCR)
        for _ in range(4):
            await host.read(DRR)
    await host.write(CSR, 0x40)
    await host.issue(message(Code.OUTPUT, "11"))
    mark = host.mark
    await host.pause(40)
    # Three of the four strobes follow the previous strobe too soon. With DATASHEET timing, wrq_n stays low
    # between them.
    assert len(host.bench.falls("wrq_n", mark)) == (1 if slow else 3)
    assert await host.response() == message(Code.OUTPUT) and host.out("auxo_n") == 0x2E
