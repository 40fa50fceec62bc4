"""Resets of the PPMC-312, by the pin and by instruction FF, that coincide with accesses, blocks and motions.
The tests also change the mode pin, which is sampled at the end of a reset.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, WAR, WCR
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@directed(
    "P312-PAR-11",
    "P312-CMD-FF",
    "P312-PAR-06",
    exact="a strobe must be sampled once in each cycle around the reset",
)
async def p312_a_read_during_the_software_reset(dut: Any) -> None:
    """If a read strobe coincides with a software reset, the bus has one value from the specified time to the
    end of the strobe.

    The strobes begin up to 40 cycles after the header of FF.
    """
    # With a later strobe of DRR, the answer is already loaded and would be read.
    for reg, most in ((CSR, 40), (DRR, 34)):
        seen = []
        for after in range(1, most + 1):
            host = await Host.start(dut)
            if reg == DRR:
                await host.ask(message(Code.EXCITATION_ON))
                await host.issue(message(Code.VERSION))
                await host.wait()
            await host.put(message(Code.RESET), gap=0)
            await host.go(host.header + after)
            mark = host.t
            await host.strobe(12, 6, cs_n=0, oe_n=0, rs=reg)
            (rise,), (fall,) = host.bench.rises("d_oe", mark), host.bench.falls("d_oe", mark)
            assert rise - mark in range(0, 5) and fall - mark - 12 in range(0, 5), after
            assert not [edge for edge in host.bench.edges("d_o", mark) if edge[0] > rise], after
            seen.append(host.out("d_o"))
            await host.pause(40)
            # The strobe has no effect after the reset.
            assert await host.response() == message(Code.RESET) and await host.read(CSR) == MREF
        if reg == CSR:
            # A strobe that begins during the reset reads as busy, a later strobe as ready.
            assert seen[:24] == [MWEF | MREF] * 24 and MREF in seen and seen == sorted(seen, reverse=True)
        else:
            # A read returns the byte of the old response while this response exists, and 0 afterwards.
            assert seen[:18] == [0x12] * 18 and seen[-1] == 0 and seen == sorted(seen, reverse=True)


@directed("P312-PAR-11", "P312-PAR-10", "P312-PAR-12", "P312-CMD-FF")
async def p312_a_write_during_the_software_reset(dut: Any) -> None:
    """A software reset clears a value that was written to CSR before the reset, and keeps a value that is
    written after it, however close to the reset the write is.
    """
    seen = []
    for after in range(1, 41):
        host = await Host.start(dut)
        await host.put(message(Code.RESET), gap=0)
        await host.go(host.header + after)
        await host.write(CSR, 0x70)
        assert await host.response() == message(Code.RESET)
        seen.append(await host.read(CSR) >> 4)
    assert seen[0] == 0 and seen[-1] == 7 and seen == sorted(seen)
    # At the end of the reset, the wait request of an access during the reset ends because EWRQ is cleared.
    for after in range(8, 32):
        host = await Host.start(dut)
        await host.write(CSR, 0x40)
        await host.put(message(Code.RESET), gap=0)
        await host.go(host.header + after)
        await host.strobe(4, 3, cs_n=0, we_n=0, rs=DWR)
        await host.strobe(4, 3, cs_n=0, we_n=0, rs=DWR)
        await host.write(CSR, 0x40)
        await host.strobe(12, 6, cs_n=0, we_n=0, rs=DWR)
        assert await host.response() == message(Code.RESET) and host.out("wrq_n") == 1


@directed("P312-GEN-12", "P312-GEN-01", "P312-PRT-02")
async def p312_reset_in_the_middle_of_a_block(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.OUTPUT, "3F"),
        message(Code.EXCITATION_ON),
        message(Code.ZERO_CLAMP),
        message(Code.POSITION_SET, "00 00000009"),
        message(Code.END_TERMINAL, "01"),
    )
    await host.ask(message(Code.MASK, "01 FF"))
    await host.ask(message(Code.IN_POSITION, "01 0001"))
    await host.pause(500)
    await host.write(CSR, 0x30)
    await host.ask(message(Code.CONSTANT, "40 0190 00000009"))
    await host.pulse(4, 30)
    await host.write(WCR, 0x20)
    await host.write(WAR, 0x1D)
    await host.write(DWR, 0x40)
    host.bench.set(rst_n=0, cs_n=0, oe_n=0, rs=CSR)
    await host.pause(12)
    await host.pins(rst_n=1)
    host.bench.set(cs_n=1, oe_n=1)
    await host.pause(17)
    assert (await host.read(CSR), await host.read(RAR), host.condition) == (0x04, 0x40, 0x01)
    levels = {"auxo_n": 0x3F, "exon_n": 1, "zclmp_n": 1, "irq_n": 1, "dir": 0, "pout": 0, "out_oe": 1}
    assert {name: host.out(name) for name in levels} == levels
    # The reset clears both the pointer and the arming of the window.
    await host.write(DWR, 0x01)
    await host.write(DWR, 0x03)
    assert await host.quiet(200)
    await host.pins(auxi=0xFF)
    assert await host.quiet(3000)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert await host.ask(message(Code.POSITION_READ, "00")) == message(Code.POSITION_READ, "00 00 00 00 00")
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 00")


@directed("P312-CMD-FF", "P312-GEN-12", "P312-CHK-62")
async def p312_software_reset_clears_all(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.OUTPUT, "3F"),
        message(Code.EXCITATION_ON),
        message(Code.ZERO_CLAMP),
        message(Code.COUNTER_CLEAR),
        message(Code.ALARM_CLEAR),
        message(Code.INTERLOCK_POSITION, "00000009"),
    )
    for block in (
        message(Code.POSITION_SET, "01 00000009"),
        message(Code.END_TERMINAL, "01"),
        message(Code.RUN_MONITOR),
        message(Code.INTERLOCK),
        message(Code.ENCODE, "03 0001"),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.CHANGE, "07 00C8"),
    ):
        await host.issue(block)
        while (await host.response())[:2] == "23":
            pass
    await host.pause(3000)
    while not await host.read(CSR) & MREF:
        await host.response()
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "D6 02 61")
    await host.write(CSR, 0x70)
    assert await host.ask(message(Code.RESET)) == message(Code.RESET)
    assert await host.read(CSR) == 0x04
    levels = {"auxo_n": 0x3F, "exon_n": 1, "zclmp_n": 1, "irq_n": 1, "cclr_n": 1, "aclr_n": 1, "intlk_n": 1}
    assert {name: host.out(name) for name in levels} == levels
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 00 00 00 00")
    # The interlock position is 0 again after the reset.
    for block in (*TF, message(Code.INTERLOCK)):
        await host.ask(block)
    await host.ask(message(Code.STEP, "00"))
    assert (
        await host.response() == message(Answer.STOPPED, "40 00 00 00 01", source=SPONTANEOUS)
        and host.out("intlk_n") == 0
    )
    await host.ask(message(Code.STEP, "40"))
    assert await host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
    await host.response()
    assert await host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@directed("P312-PRT-03", "P312-PRT-01")
async def p312_mode_is_sampled_at_the_end_of_a_reset(dut: Any) -> None:
    host = await Host.start(dut)
    await host.pins(mode=0, mod=5, adr=9)
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    await host.bench.reset(12, settle=18)
    host.bench.set(mode=1)
    await host.pause(30)
    mark = host.t
    await host.write(CSR, 0x70)
    await host.put(message(Code.VERSION))
    assert await host.read(CSR) == 0 and await host.quiet(500) is False
    assert not host.bench.rises("d_oe", mark) and host.out("irq_n") == host.out("wrq_n") == 1
    assert (host.out("txd"), host.out("snd")) == (1, 0)
    await host.bench.reset(12, settle=28)
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@directed("P312-PRT-01")
async def p312_the_serial_line_does_nothing_in_parallel_mode(dut: Any) -> None:
    host = await Host.start(dut)
    for level in (0, 1, 0, 0, 1):
        await host.pins(rxd=level, hsp=level, mod=7 * level, adr=15 * level)
        await host.pause(40)
    assert (host.out("txd"), host.out("snd")) == (1, 0)
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
