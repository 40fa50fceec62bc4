"""Acceptance checks of the PPMC-312: in-position, encode and generalized input monitors."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@directed("P312-CHK-46", "P312-CHK-47", "P312-MON-03", "P312-MON-05", "P312-MON-06", "P312-RSP-22")
async def p312_in_position(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.IN_POSITION, "07 000A"))
    assert host.out("zclmp_n") == 0
    await host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert host.out("zclmp_n") == 1
    # Both reports follow the end of the pulse output; their order is not specified.
    assert {await host.response(), await host.response()} == {
        message(Answer.STOPPED, "40 00 00 00 14", source=SPONTANEOUS),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    }
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "09 02 00")
    for edge in range(10):
        await host.pins(epin=1)
        await host.pause(3)
        await host.pins(epin=0)
        await host.pause(3)
        assert host.out("zclmp_n") == (0 if edge == 9 else 1)
    assert await host.response() == message(Answer.POSITION_CHANGE, "00", source=SPONTANEOUS)
    await host.ask(message(Code.STEP, "00"))
    await host.pause(4)
    assert host.out("zclmp_n") == 1


@directed("P312-CHK-48", "P312-MON-04")
async def p312_encode_once(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.ENCODE, "01 0005"))
    await host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert await host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert len(host.pulses()) == 6
    assert await host.response() == message(Answer.STOPPED, "40 00 00 00 14", source=SPONTANEOUS)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    assert await host.quiet()


@directed("P312-RSP-22")
async def p312_a_report_that_is_not_true_any_more_vanishes(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.ENCODE, "03 0002"))
    await host.issue(message(Code.VERSION))
    await host.wait()
    for epdir in (0, 0, 0, 1):
        await host.pins(epdir=epdir)
        await host.pins(epin=1)
        await host.pause(4)
        await host.pins(epin=0)
        await host.pause(4)
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.quiet()


@directed("P312-MON-10")
async def p312_one_input_change_is_reported(dut: Any) -> None:
    host = await Host.start(dut, message(Code.MASK, "00 FF"))
    await host.pins(auxi=0x0F)
    assert await host.response() == message(Answer.INPUT_CHANGE, "00 0F", source=SPONTANEOUS)
    await host.pins(auxi=0xFF)
    assert await host.quiet()
    await host.ask(message(Code.MASK, "01 F0"))
    await host.pins(auxi=0x00)
    await host.pause(1000)
    # A report that is already in the read window is not discarded.
    await host.issue(message(Code.MASK, "01 01"))
    assert await host.response() == message(Answer.INPUT_CHANGE, "00 F0", source=SPONTANEOUS)
    assert await host.response() == message(Code.MASK)
    await host.issue(message(Code.VERSION))
    await host.pins(auxi=0x01)
    await host.pause(1000)
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.response() == message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS)
    assert await host.quiet()
