"""Collisions on the PPMC-312: events, overrides, host blocks and pins during an instruction."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, directed
from cocotb_tests.harness.bus import CSR, DRR, DWR, MWEF, RAR, WAR, WCR, clean
from cocotb_tests.ppmc312.blocks import RATES, T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


async def put_with(host: Host, text: str, **pins: int) -> None:
    """Write a block; change the pins just before its header is written."""
    block = bytes.fromhex(text)[::-1]
    await host.write(WCR, 0x20)
    await host.write(WAR, 0x20 - len(block))
    for byte in block[:-1]:
        await host.write(DWR, byte)
    await host.pins(**pins)
    await host.write(DWR, block[-1])


@directed("P312-OVR-10")
async def p312_host_is_next_after_one_event(dut: Any) -> None:
    host = await Host.start(
        dut,
        *TF,
        message(Code.EVENT_SET, "00", message(Code.INPUT)),
        message(Code.EVENT_SET, "01", message(Code.TERMINALS)),
    )
    await put_with(host, message(Code.SPEED_LIMIT, "0100"), evt0_n=0, evt1_n=0)
    await host.pause(500)
    assert await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    # The event on the second pin occurs while the answer to the first event is unread.
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert await host.response() == message(Code.SPEED_LIMIT)


@cocotb.parametrize(gap=range(20, 44))
@directed("P312-OVR-10", "P312-BLK-01")
async def p312_host_block_that_arrives_as_a_triggered_one_ends(dut: Any, gap: int) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    block = bytes([0x15, 0x26, 2, 3])
    await host.write(WCR, 0x20)
    await host.write(WAR, 0x20 - len(block))
    for byte in block[:-1]:
        await host.write(DWR, byte)
    await host.pins(evt0_n=0)
    await host.pause(gap)
    await host.write(DWR, block[-1])
    await host.pause(100)
    assert host.out("auxo_n") == 0x2A
    assert await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert await host.response() == message(Code.OUTPUT)


@directed("P312-OVR-10")
async def p312_an_edge_for_a_buffer_that_is_emptied_is_dropped(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    await host.issue(message(Code.EVENT_SET, "02"))
    await host.pins(evt0_n=0)
    assert await host.response() == message(Code.EVENT_SET, "04")
    assert await host.quiet() and host.condition == 0x02
    await host.pins(evt0_n=1)
    await host.issue(message(Code.EVENT_SET, "00", message(Code.INPUT)))
    await host.pins(evt0_n=0)
    assert await host.response() == message(Code.EVENT_SET, "00")
    assert await host.quiet() and host.condition == 0x02


@directed("P312-OVR-04", "P312-OVR-12")
async def p312_pulses_stay_stopped_when_an_earlier_override_fails(dut: Any) -> None:
    host = await Host.start(
        dut, *FAST_CURVE, message(Code.CHANGE, "04 FFFF 0000000A"), message(Code.STOP, "04 0000000B")
    )
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
    assert await host.response() == message(Answer.OVERRIDE_FAILED, "00", source=Source.OVERRIDE)
    assert await host.response() == stopped(0x04, 11) and len(host.pulses()) == 11


@directed("P312-MOT-34", "P312-OVR-12")
async def p312_a_limit_after_a_position_stop_changes_nothing(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.STOP, "04 0000000A"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(10, 4)
    await host.pins(fl_n=0)
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert await host.response() == stopped(0x04, 10)


@cocotb.parametrize(case=[(0x81, 0x10), (0x80, 0x04)])
@directed("P312-MOT-43", exact="an event must be sampled at a given edge")
async def p312_stop_between_the_phases_of_a_zero_return(dut: Any, case: Any) -> None:
    code, cause = case
    host = await Host.start(dut, *TF, message(code, "05"))
    timing = host.bench.golden.core_timing
    await host.ask(message(Code.ZERO_RETURN, "00 0000"))
    await host.pulse(15)
    await host.pins(org_n=0)
    last = await host.pulse(27)
    done = last + 6400 + timing.turn_back
    acts = timing.arbitration + timing.effect + (timing.halt if code == 0x80 else 0)
    await host.go(done - acts - host.bench.golden.latency.input_sync)
    await host.pins(evt0_n=0)
    assert await host.response() == message(code, source=Source.OVERRIDE)
    assert await host.response() == stopped(cause, 27)
    assert host.out("dir") == 0 and await host.quiet()


@cocotb.parametrize(gap=range(20, 44))
@directed("P312-INP-30", "P312-INP-31")
async def p312_alarm_as_a_held_start_begins(dut: Any, gap: int) -> None:
    """An alarm in the cycle in which RUN begins to hold a start ends the operation, as one cycle later."""
    host = await Host.start(dut, *TF, run=0)
    await host.ready()
    await host.put(message(Code.STEP, "00"), gap=gap)
    await host.pins(alm_n=0)
    while not await host.quiet(300):
        await host.response()
    await host.pins(alm_n=1)
    assert await host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR)
    assert host.condition == 0x02
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    await host.pins(run=1)
    assert await host.quiet() and not host.pulses()


@directed("P312-INP-31", "P312-INP-33")
async def p312_a_clear_given_before_the_alarm_does_not_leave_abn(dut: Any) -> None:
    host = await Host.start(dut, T1, message(Code.ALARM_CLEAR))
    await host.blip("alm_n", 100, 100)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.condition == 0x10 and host.out("aclr_n") == 0
    await host.pause(400_000)
    assert host.condition == 0x10
    await host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x02


@directed("P312-INP-30", "P312-INP-32")
async def p312_reset_with_the_alarm_still_there(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    await host.issue(message(Code.RESET))
    assert {await host.response(), await host.response()} == {
        message(Code.RESET),
        message(Answer.ALARM, "00", source=SPONTANEOUS),
    }
    assert host.condition == 0x10
    assert await host.quiet()


@directed("P312-BLK-02", "P312-OVR-05")
async def p312_what_a_refusal_leaves(dut: Any) -> None:
    host = await Host.start(
        dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)), message(Code.CHANGE, "07 00C8")
    )
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")
    assert (await host.ask(message(Code.RAMP, "00 0000 00000000"))).startswith("03 0A F0 23")
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")
    assert (await host.ask(message(Code.INITIAL, "01 03E8 03E8 0007D0"))).startswith("03 0B F0 03")
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")


@directed("P312-INP-11")
async def p312_high_speed_limit_rate_after_a_setting(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.pins(fhl_n=0)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 00C8")) == message(Answer.LIMIT)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")


@directed("P312-INP-01", "P312-TIM-14", builds=(D16,))
async def p312_datasheet_event_filter(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    await host.blip("evt0_n", 399_990)
    assert await host.quiet()
    low = host.t
    await host.pins(evt0_n=0)
    assert await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert host.t - low in range(400_000, 400_500)


@directed("P312-RSP-22")
async def p312_enabling_a_monitor_again_reports_again(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.POSITION_SET, "00 00000064"))
    await host.ask(message(Code.ENCODE, "03 0005"))
    assert await host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert await host.ask(message(Code.ENCODE, "03 0006")) == message(Code.ENCODE)
    assert await host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert await host.ask(message(Code.ENCODE, "00 0006")) == message(Code.ENCODE)
    assert await host.quiet() and await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@directed("P312-CMD-FC-4", "P312-CMD-FC-9")
async def p312_echo_is_cut_at_28_bytes(dut: Any) -> None:
    host = await Host.start(dut, "02 03 01 01 14")
    data = "0064 " * 14 + "0001"
    answer = await host.ask("00 1E" + data)
    assert answer == clean("03 1E F0 18" + "0064" * 14)
    assert await host.ask(RATES) == message(Answer.STATUS, "01 01")


@directed("P312-OVR-10", "P312-RSP-20", exact="the event pins must be sampled at the same edge")
async def p312_event_buffer_before_an_override_on_the_same_edge(dut: Any) -> None:
    host = await Host.start(
        dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)), message(Code.STOP, "07")
    )
    await host.pins(evt0_n=0, evt1_n=0)
    await host.pause(500)
    assert await host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 10 40")  # no override is pending


@directed("P312-RSP-20", "P312-PAR-06")
async def p312_an_answer_pending_while_the_one_before_it_is_read(dut: Any) -> None:
    """An answer is delivered regardless of whether it is ready before, when or after the previous one is
    read.

    The read of the last byte ends some cycles before, at and after the end of the host's instruction.
    """
    for shift in range(18, 38):
        host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
        await host.write(CSR, 0x30)
        await host.blip("evt0_n")
        await host.wait()
        left = 0x40 - await host.read(RAR)
        for _ in range(left - 1):
            await host.read(DRR)
        await host.put(message(Code.VERSION), gap=0)
        await host.go(host.header + shift)
        await host.read(DRR)
        assert await host.response() == message(Code.VERSION, "12")
        assert not await host.read(CSR) & MWEF


@cocotb.parametrize(pin=["fl_n", "bhl_n"])
@directed("P312-INP-11", exact="the limit must be sampled once in each cycle around the check")
async def p312_a_limit_about_the_check_of_a_start(dut: Any, pin: str) -> None:
    """A start is rejected if a limit is asserted in the cycle of the check or before, and accepted
    otherwise.
    """
    refused = []
    for shift in range(16, 40):
        host = await Host.start(dut, *TF)
        option = "40" if pin[0] == "b" else "00"
        await host.put(message(Code.RAMP, option + "0000 00000001"), gap=0)
        await host.go(host.header + shift)
        await host.pins(**{pin: 0})
        refused.append(await host.response() == message(Answer.LIMIT))
        await host.pause(2000)
    assert refused == sorted(refused, reverse=True) and set(refused) == {True, False}


@cocotb.parametrize(code=[Code.FOREVER_CONSTANT, Code.VERSION])
@directed("P312-RSP-11", "P312-MON-04")
async def p312_a_report_about_the_effect_of_an_instruction(dut: Any, code: Code) -> None:
    """The order of the responses depends on the cycle in which the encoder leaves its window.

    This happens some cycles before, at and after the effect of an instruction.
    """
    first = []
    for shift in range(8, 40):
        host = await Host.start(dut, *TF)
        await host.write(CSR, 0x30)
        await host.ask(message(Code.ENCODE, "03 0002"))
        for _ in range(2):
            await host.pins(epin=1)
            await host.pause(4)
            await host.pins(epin=0)
            await host.pause(4)
        await host.put(message(code, "00 0190" if code is Code.FOREVER_CONSTANT else ""), gap=0)
        await host.go(host.header + shift)
        await host.pins(epin=1)
        responses = [await host.response() for _ in range(2)]
        first.append(responses.index(message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)))
    assert 0 in first and (1 in first or code is not Code.VERSION)


@cocotb.parametrize(gap=range(38, 56, 3))
@directed("P312-OVR-10", "P312-RSP-20", "P312-EVT-04")
async def p312_second_edge_as_its_buffer_gets_an_entry(dut: Any, gap: int) -> None:
    """A second edge of the event pin during a registration causes an alarm, because the first edge has
    released the only override.
    """
    host = await Host.start(dut, *TF, message(Code.STOP, "07"))
    await host.put(message(Code.EVENT_SET, "01", message(Code.INPUT)), gap=0)
    await host.go(host.header + 6)
    await host.pins(evt1_n=0)
    await host.go(host.header + 16)
    await host.pins(evt1_n=1)
    await host.go(host.header + gap)
    await host.pins(evt1_n=0)
    await host.pause(500)
    assert await host.response() == message(Code.EVENT_SET, "00")
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)


@cocotb.parametrize(shift=range(-3, 5))
@directed("P312-OVR-12", "P312-MOT-34", "P312-RSP-20")
async def p312_stop_as_a_position_stops(dut: Any, shift: int) -> None:
    """An event triggers instruction 80 near the pulse at which a position triggers another instruction 80:
    the motion stops at pulse 9 or 10.
    """
    setting = (message(Code.STOP, "04 0000000A"), message(Code.EVENT_SET, "00", message(Code.STOP, "00")))
    host = await Host.start(dut, *TF, *setting)
    timing = host.bench.golden.core_timing
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
    before = await host.pulse(8)
    last = await host.pulse(9)
    acts = timing.arbitration + timing.effect + timing.halt + host.bench.golden.latency.input_sync
    await host.go(2 * last - before - acts + shift)
    edge = host.t
    await host.pins(evt0_n=0)
    await host.pause(7000)
    late = host.bench.pin_edges("evt0_n", 0, edge)[0] - edge
    assert len(host.pulses()) == (9 if shift + late < 1 else 10)


@directed("P312-OVR-10", "P312-CMD-41")
async def p312_an_event_about_the_next_block_of_a_table(dut: Any) -> None:
    """An event while an answer of the table read is unread causes an alarm.

    The report of the alarm is read either before or after the next block of the table.
    """
    report, first = message(Answer.ALARM, "01", source=SPONTANEOUS), set()
    for gap in range(12):
        host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
        await host.ask(message(Code.TABLE_READ))
        await host.wait()
        for _ in range(0x40 - await host.read(RAR) - 1):
            await host.read(DRR)
        host.bench.drive([(host.t + gap, {"evt0_n": 0})])
        await host.read(DRR)
        await host.pause(60)
        answers = [await host.response(), await host.response()]
        first.add(answers.index(report))
        assert answers[1 - answers.index(report)][:8] == "01 0A 02" and await host.quiet(300), gap
    assert first == {0, 1}
