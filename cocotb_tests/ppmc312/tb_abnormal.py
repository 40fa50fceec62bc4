"""Alarms, multiple occurrences and failed triggers of the PPMC-312, and hosts that do not read
(docs/ppmc312/README.md, 2.3 and 10).
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import CSR, MREF, MWEF
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, register, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP = message(Code.STOP, "00")


@directed(
    "P312-INP-30", "P312-INP-31", "P312-INP-32", "P312-INP-33", "P312-CMD-24", "P312-STA-01", "P312-OVR-05"
)
async def p312_alarm_by_its_pin(dut: Any) -> None:
    host = await Host.start(dut, *TF, register(0, message(Code.INPUT)), message(Code.CHANGE, "07 00C8"))
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.out("cd_n") == 0 and host.condition == 0x10
    # A second edge of alm_n has no effect.
    await host.blip("alm_n", 50, 50)
    assert await host.quiet(500)
    for block, answer in (
        (STOP, message(Answer.STATUS, "00 10")),
        (T1, message(Answer.STATUS, "00 10")),
        (message(Code.OUTPUT, "01"), message(Code.OUTPUT)),
        (message(Code.STATUS), message(Code.STATUS, "00 10 61")),
        (message(Code.ALARM_CLEAR), message(Code.ALARM_CLEAR)),
    ):
        assert await host.ask(block) == answer
    # The event buffer still works: its entries are rejected or executed as in the table of states.
    await host.pins(evt0_n=0)
    assert await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert host.condition == 0x02 and host.out("aclr_n") == 0
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")


@directed(
    "P312-RSP-20", "P312-INP-30", "P312-INP-32", "P312-CHK-39", "P312-CHK-40", "P312-BAD-09", "P312-RSP-11"
)
async def p312_multiple_occurrence_of_each_kind(dut: Any) -> None:
    # The host sends instruction 01 during a motion; the instruction is not executed.
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    await host.pulse(2, 20)
    await host.issue(message(Code.VERSION))
    await host.pause(200)
    await host.issue(message(Code.OUTPUT, "3F"))
    await host.pause(200)
    assert host.condition == 0x10 and host.out("auxo_n") == 0x3F and len(host.pulses()) == 0
    assert not await host.read(CSR) & MWEF
    # The host sends instruction 01 again in state ABN: the alarm is reported once.
    await host.issue(message(Code.OUTPUT, "3F"))
    await host.pause(200)
    assert [await host.response() for _ in range(3)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
        stopped(0x80, 2),
    ]
    assert await host.quiet() and host.out("auxo_n") == 0x3F
    # After class 1 has been read, another instruction 01 in state ABN is reported again.
    await host.issue(message(Code.VERSION))
    await host.pause(200)
    await host.issue(message(Code.VERSION))
    assert [await host.response() for _ in range(2)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert await host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR) and host.condition == 0x02
    # Overrides by position and by pin contain instruction 01: the whole FIFO is emptied.
    for trigger in ("04 00C8 00000003", "05 00C8"):
        host = await Host.start(dut, *TF, message(Code.CHANGE, trigger), message(Code.CHANGE, "07 0190"))
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        await host.pulse(2, 20)
        await host.issue(message(Code.INPUT))
        await host.pause(300)
        await host.pins(evt0_n=0)
        await host.pause(14_000)
        assert host.condition == 0x10
        answers = [await host.response() for _ in range(3)]
        assert answers == [
            message(Code.INPUT, "00"),
            message(Answer.ALARM, "01", source=SPONTANEOUS),
            stopped(0x80, 3 if trigger[1] == "4" else 2),
        ]
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 10 00")
    # An event executes instruction 01: its buffer is emptied, but the other buffer is not.
    host = await Host.start(dut, *TF, register(0, message(Code.INPUT)), register(1, message(Code.TERMINALS)))
    await host.issue(message(Code.VERSION))
    await host.pause(200)
    await host.blip("evt1_n")
    assert [await host.response() for _ in range(2)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    ]
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 10 40")


@directed("P312-RSP-20", "P312-RSP-11", "P312-CHK-40")
async def p312_second_stop_report_while_the_first_is_half_read(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.STEP, "00"))
    await host.wait()
    await host.read(7)
    await host.issue(message(Code.STEP, "00"))
    await host.pause(20_000)
    assert host.condition == 0x10
    await host.read(2)
    assert [await host.response() for _ in range(3)] == [
        stopped(0x40, 1),
        message(Answer.ALARM, "03", source=SPONTANEOUS),
        message(Code.STEP),
    ]
    assert await host.quiet()


@directed("P312-RSP-11", "P312-RSP-10", "P312-PAR-08", "P312-BAD-08", "P312-RSP-22")
async def p312_reports_are_in_the_order_of_their_classes(dut: Any) -> None:
    """If reports of all classes wait while a report is being read, they are read afterwards from the lowest
    class to the highest.

    The test creates the reports from the last class to the first.
    """
    host = await Host.start(
        dut,
        *TF,
        message(Code.INTERLOCK_POSITION, "00000003"),
        message(Code.INTERLOCK),
        message(Code.IN_POSITION, "03 0001"),
        message(Code.ENCODE, "03 0001"),
    )
    await host.ask(message(Code.MASK, "01 FF"))
    await host.issue(message(Code.VERSION))
    await host.wait()
    await host.read(7)
    await host.pins(auxi=1)
    await host.pause(1000)
    await host.read(2)
    assert await host.response() == message(Code.VERSION, "12")
    # The read window now contains report E9.
    await host.wait()
    for level in (3, 7, 15):
        await host.pins(auxi=level)
        await host.pause(1000)
    await host.pins(run=0)
    await host.issue(message(Code.CONSTANT, "00 0190 00000003"))
    await host.pause(500)
    await host.pins(run=1)
    await host.pause(25_000)
    await host.pins(alm_n=0)
    await host.pause(500)
    assert [await host.response() for _ in range(8)] == [
        message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS),
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        message(Code.CONSTANT, "01"),
        message(Answer.INTERLOCK_END, source=SPONTANEOUS),
        message(Answer.HOLD_EXECUTED, source=SPONTANEOUS),
        stopped(0x40, 3),
        message(Answer.INPUT_CHANGE, "01 08", source=SPONTANEOUS),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    ]
    assert (
        await host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
        and await host.quiet()
    )


@directed("P312-EVT-02", "P312-EVT-03", "P312-OVR-03", "P312-OVR-04", "P312-CMD-8V", "P312-RSP-10")
async def p312_interruptions(dut: Any) -> None:
    for block, levels, status in (
        (message(Code.FOREVER_CONSTANT, "00 0063"), {}, "00"),
        (message(Code.CONSTANT, "00 0190 00000000"), {}, "00"),
        (message(Code.STEP, "05"), {}, None),  # instruction 84 has no OV bit
        (message(Code.STOP, "05"), {}, "00"),
        (message(Code.INPUT, "00"), {}, "00"),
        (STOP, {}, "01"),
        (message(Code.STEP, "00"), {"fl_n": 0}, "02"),
        (message(Code.FOREVER_CONSTANT, "00 0190"), {"fl_n": 0}, "02"),
        ("03 01 12", {}, "05"),
    ):
        host = await Host.start(
            dut, *TF, register(1, block), register(1, message(Code.INPUT)), register(0, message(Code.INPUT))
        )
        await host.pins(**levels)
        await host.blip("evt1_n")
        if status is None:
            assert await host.response() == message(Code.STEP, source=Source.EVENT)
            continue
        assert await host.response() == message(Answer.EVENT_FAILED, status, source=Source.EVENT), block
        assert await host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "00 00 00 00 00 00")
        assert (await host.ask(message(Code.EVENT_READ, "00")))[9:11] == "01"
    for block, levels, status in (
        (message(Code.CHANGE, "05 0063"), {}, "00"),
        (message(Code.CONSTANT, "05 0190 00000000"), {}, "01"),
        (message(Code.RAMP, "05 0000 0000001E"), {}, "01"),
        (message(Code.RAMP_CHANGE, "05 0191"), {}, "00"),
    ):
        host = await Host.start(dut, *TF, block, message(Code.CHANGE, "07 00C8"))
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        await host.pins(**levels)
        await host.blip("evt0_n")
        assert await host.response() == message(Answer.OVERRIDE_FAILED, status, source=Source.OVERRIDE), block
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    for block, levels, status in (
        (message(Code.RAMP, "05 0000 00000000"), {}, "00"),
        (message(Code.CONSTANT, "05 0190 00000001"), {"fl_n": 0}, "02"),
        (message(Code.FOREVER_RAMP, "05 0000"), {"fl_n": 0}, "02"),
        (message(Code.SLOW_STOP, "05"), {}, "01"),
        (message(Code.FOREVER_CONSTANT, "05 0064"), {"alm_n": 0}, "01"),
    ):
        host = await Host.start(dut, *TF, block, message(Code.STOP, "04 00000001"))
        await host.pins(**levels)
        if "alm_n" in levels:
            assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        await host.blip("evt0_n")
        assert await host.response() == message(Answer.OVERRIDE_FAILED, status, source=Source.OVERRIDE), block
        assert (await host.ask(message(Code.STATUS))).endswith(" 00")


@directed("P312-OVR-03", "P312-OVR-05", "P312-OVR-02", "P312-INP-20")
async def p312_overrides_that_start_motions(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.RAMP, "05 0000 00000007"),
        message(Code.CONSTANT, "47 0190 00000002"),
        message(Code.FOREVER_RAMP, "05 0000"),
        message(Code.FOREVER_CONSTANT, "07 0190"),
    )
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 34")
    for pin, answer, end in (
        ("evt0_n", message(Code.RAMP, "10", source=Source.OVERRIDE), 7),
        ("evt1_n", message(Code.CONSTANT, "00", source=Source.OVERRIDE), 5),
    ):
        await host.blip(pin)
        assert await host.response() == answer
        assert await host.response() == stopped(0x40, end)
    await host.pins(run=0)
    await host.blip("evt0_n")
    assert (
        await host.response() == message(Code.FOREVER_RAMP, "01", source=Source.OVERRIDE)
        and host.condition == 0x20
    )
    await host.pins(run=1)
    assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    await host.blip("evt1_n")
    assert await host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 04 00")


@cocotb.parametrize(order=[(0, 1, 2), (2, 1, 0), (1, 0, 2)])
@directed(
    "P312-OVR-01", "P312-OVR-02", "P312-OVR-12", "P312-CMD-80", "P312-CMD-81", "P312-CMD-87", "P312-CMD-88"
)
async def p312_position_triggers_of_all_kinds(dut: Any, order: tuple[int, ...]) -> None:
    """Only the head of the FIFO is armed: positions in the wrong order wait until they are the head."""
    blocks = [
        message(Code.CHANGE, "04 00C8 00000004"),
        message(Code.RAMP_CHANGE, "06 0064 00000008"),
        message(Code.SLOW_STOP, "04 0000000E"),
    ]
    host = await Host.start(dut, *TF, *(blocks[n] for n in order))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    mark = host.mark
    done, pulses = {
        (0, 1, 2): (
            ["88", "87", "81"],
            [400] * 4 + [200] * 4 + [100] * 6 + [100] * 5 + [200] * 4 + [400] * 2,
        ),
        (2, 1, 0): (["81"], [400] * 13),
        (1, 0, 2): (["87"], [400] * 8 + [200] * 4 + [100] * 7),
    }[order]
    for code in done:
        assert await host.response() == f"1B 01 {code}"
    if order == (1, 0, 2):
        host.mark = mark
        await host.pulse(20, 20)
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 02")
    else:
        assert await host.response() == stopped(*((0x08, 26) if order == (0, 1, 2) else (0x10, 14)))
        assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, f"00 02 0{3 - len(done)}")
    host.mark = mark
    assert host.gaps() == pulses


@directed("P312-BAD-09", "P312-RSP-20", "P312-PAR-06", "P312-CHK-62", "P312-CMD-FF")
async def p312_hosts_that_never_read(dut: Any) -> None:
    """With any number of unread responses the part does not hang, stops still work, and instruction FF is
    accepted.
    """
    host = await Host.start(dut, *TF, register(0, message(Code.INPUT)))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    await host.blip("evt0_n", 20, 300)
    await host.issue(message(Code.STOP, "00"))
    await host.pause(2000)
    mark = host.t
    await host.pause(20_000)
    assert not host.bench.rises("pout", mark) and await host.read(CSR) & MWEF
    # The bus ignores writes now. After one answer is read, it accepts them, and instruction FF needs no
    # further read.
    await host.put(message(Code.RESET))
    assert (
        await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
        and await host.read(CSR) & MWEF == 0
    )
    await host.issue(message(Code.RESET))
    await host.pause(300)
    assert (
        await host.response() == message(Code.RESET)
        and await host.read(CSR) == MREF
        and host.condition == 0x01
    )
    # During a table read, MWEF is deasserted with the last block of the table; instruction FF is accepted
    # only then.
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.TABLE_READ))
    await host.pause(1000)
    assert await host.read(CSR) & MWEF
    await host.response()
    await host.pause(50)
    assert not await host.read(CSR) & MWEF
    await host.issue(message(Code.RESET))
    await host.pause(300)
    assert await host.response() == message(Code.RESET) and await host.quiet()
