"""Corner cases of the PPMC-312.

These are held and waiting operations, alarms during set-up and waits, resets, and pins whose levels must not
change.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, F16, directed
from cocotb_tests.harness.bus import CSR, MREF, MWEF
from cocotb_tests.ppmc312.blocks import T1, TF, TG
from cocotb_tests.ppmc312.builds import F8V
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP, SLOW_STOP = message(Code.STOP, "00"), message(Code.SLOW_STOP, "00")
FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


@directed("P312-CMD-80", "P312-OVR-03")
async def p312_position_stop_after_the_end(dut: Any) -> None:
    """A stop that is triggered at the last pulse of a fast motion is processed only after the end, and fails
    in state NOR.
    """
    host = await Host.start(
        dut, *FAST_CURVE, message(Code.STOP, "04 0000000A"), message(Code.STOP, "04 0000FFFF")
    )
    await host.ask(message(Code.CONSTANT, "00 0004 0000000A"))
    assert await host.response() == stopped(0x40, 10)
    assert await host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@directed("P312-CMD-20", "P312-BAD-09")
async def p312_reset_while_running_leaves_no_state(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.EVENT_SET, "00", message(Code.RESET)))
    await host.ask(message(Code.FOREVER_CONSTANT, "40 0064"))
    await host.pulse(10, 20)
    await host.blip("evt0_n")
    assert await host.response() == message(Code.RESET)
    assert (host.condition, host.out("pout"), host.out("dir"), host.bench.golden.position) == (0x01, 0, 0, 0)
    await host.pause(1000)
    assert host.bench.golden.next_event is None


@directed("P312-PRT-02", "P312-TIM-01", builds=(D16,))
async def p312_pins_keep_their_reset_levels_until_out_oe(dut: Any) -> None:
    host = await Host.start(dut)
    host.bench.set(alm_n=0)
    await host.bench.reset(40, settle=5)
    assert await host.read(CSR) == MWEF | MREF
    await host.pause(25_000)
    assert host.out("out_oe") == 0 and host.out("cd_n") == 1
    await host.pause(1_000)
    assert host.out("out_oe") == 1
    await host.pause(3_000)
    assert host.out("cd_n") == 0
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)


@directed("P312-INP-30")
async def p312_alarm_while_held_and_in_end_wait(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.pins(run=0)
    assert await host.ask(message(Code.STEP, "00")) == message(Code.STEP)
    assert host.condition == 0x20
    assert await host.ask(STOP) == message(Answer.STATUS, "00 20")
    await host.pins(alm_n=0)
    assert [await host.response(), await host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x80, 0),
    ]
    await host.pins(alm_n=1, run=1)
    await host.ask(message(Code.ALARM_CLEAR))
    await host.pause(20_000)
    assert host.condition == 0x02 and host.bench.golden.position == 0
    await host.ask(message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.STEP, "00"))
    await host.pause(20_000)
    assert host.condition == 0x08
    await host.pins(alm_n=0)
    assert [await host.response(), await host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x40, 1),
    ]


@directed("P312-INP-31", "P312-BLK-01", builds=(D16,))
async def p312_alarm_while_a_start_is_prepared(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.issue(message(Code.RAMP, "00 0096 00000014"))
    await host.pause(10_000)
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.response() == message(Answer.STATUS, "00 10")
    assert not host.pulses()


@directed("P312-INP-31", builds=(D16,))
async def p312_alarm_while_a_table_is_built(dut: Any) -> None:
    host = await Host.start(
        dut,
    )
    await host.issue(T1)
    await host.pause(100_000)
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.response() == message(Code.INITIAL)
    await host.pins(alm_n=1)
    assert await host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR)
    assert host.condition == 0x02


@directed("P312-RSP-20")
async def p312_second_hold_report_unread_is_an_alarm(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.pins(run=0)
    await host.issue(message(Code.STEP, "00"))
    await host.pause(200)
    await host.pins(run=1)
    await host.pause(20_000)
    assert await host.response() == message(Code.STEP)
    # The read window now contains report E2 and keeps it.
    await host.pause(100)
    await host.pins(run=0)
    await host.issue(message(Code.STEP, "00"))
    await host.pause(200)
    await host.pins(run=1)
    await host.pause(100)
    assert host.condition == 0x10
    assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert await host.response() == message(Answer.ALARM, "02", source=SPONTANEOUS)
    assert await host.response() == message(Code.STEP)
    assert host.bench.golden.position == 1


@cocotb.parametrize(case=[(0x81, 0x10), (0x80, 0x04)])
@directed("P312-MOT-30", "P312-MOT-34")
async def p312_stops_before_pulse_1(dut: Any, case: Any) -> None:
    code, cause = case
    host = await Host.start(dut, *TF, message(code, "05"))
    await host.pins(run=0)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0064")) == message(Code.FOREVER_CONSTANT, "01")
    await host.pins(run=1)
    await host.pins(evt0_n=0)
    assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert await host.response() == message(code, source=Source.OVERRIDE)
    assert await host.response() == stopped(cause, 0) and host.condition == 0x02
    assert await host.quiet() and not host.pulses()


@directed("P312-MOT-35")
async def p312_an_alarm_does_not_wait_for_the_positioning_end(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(3)
    await host.pins(alm_n=0)
    assert [await host.response(), await host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x80, 3),
    ]


@directed("P312-MOT-35", "P312-INP-30", "P312-MOT-34", "P312-MOT-06")
async def p312_an_alarm_after_the_last_pulse_does_not_wait_for_end(dut: Any) -> None:
    """After an alarm in the last interval or near its end, where the END wait starts, report E0 with cause
    NOS follows immediately.
    """
    for after in (20, 79, 80, 81, 2000, *range(6392, 6408)):
        host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
        await host.ask(message(Code.CONSTANT, "00 0190 00000003"))
        await host.pulse(3, after)
        since = host.t
        await host.pins(alm_n=0)
        assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        await host.wait(2000)
        assert host.t - since < 300 and await host.response() == stopped(0x40, 3)
        assert host.condition == 0x10 and await host.quiet()
    # A multiple occurrence is also an alarm.
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    await host.pulse(3, 200)
    await host.put(message(Code.VERSION))
    await host.pause(100)
    await host.put(message(Code.VERSION))
    assert [await host.response() for _ in range(3)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
        stopped(0x40, 3),
    ]


@directed("P312-PAR-06", builds=(D16,))
async def p312_writes_while_an_instruction_is_processed_are_ignored(dut: Any) -> None:
    host = await Host.start(
        dut,
    )
    await host.issue(T1)
    await host.put(message(Code.OUTPUT, "3F"))
    await host.put(message(Code.RESET))
    await host.write(CSR, 0x10)
    assert await host.read(CSR) == 0x10 | MWEF | MREF
    assert await host.response() == message(Code.INITIAL)
    assert await host.quiet() and host.out("auxo_n") == 0x3F and host.condition == 0x02


@directed("P312-INP-12")
async def p312_high_speed_limit_before_pulse_1_and_at_a_slow_rate(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "00C8"))
    await host.issue(message(Code.FOREVER_CONSTANT, "00 0064"))
    while not host.bench.golden.motion.active:
        await host.step()
    await host.pins(fhl_n=0)
    await host.pause(200)
    assert not host.pulses()
    assert [await host.response(), await host.response()] == [
        message(Code.FOREVER_CONSTANT, "00"),
        stopped(0x10, 0),
    ]
    await host.pins(fhl_n=1)
    await host.ask(message(Code.RAMP, "00 0000 0000001E"))
    await host.pins(fhl_n=0)
    assert await host.response() == stopped(0x02, 11)
    # The high-speed limit has no effect at rate 400. It takes effect in the first interval at rate 200, as a
    # deceleration from the stage with rate 200.
    assert host.gaps() == [400] * 3 + [200] * 5 + [400] * 2
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 00C8")) == message(Answer.LIMIT)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")


@directed("P312-MOT-31", "P312-MOT-33")
async def p312_change_on_a_late_deceleration_point(dut: Any) -> None:
    host = await Host.start(dut, *TG)
    await host.ask(message(Code.RAMP, "00 0000 0000001E"))
    mark = host.mark
    await host.pulse(25)
    assert await host.ask(message(Code.CHANGE, "00 012C")) == message(Code.CHANGE)
    assert await host.response() == stopped(0x40, 30)
    host.mark = mark
    assert host.gaps() == [400] * 3 + [200] * 4 + [100] * 18 + [300] * 4


@directed("P312-MON-06")
async def p312_clamp_by_the_end_signal(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.IN_POSITION, "07 0002"))
    await host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    await host.response()
    await host.response()
    assert host.out("zclmp_n") == 1
    await host.pins(end_n=0)
    await host.pause(5)
    assert host.out("zclmp_n") == 0


@directed("P312-MON-01", "P312-MON-02")
async def p312_distance_wraps(dut: Any) -> None:
    host = await Host.start(
        dut, *TF, message(Code.POSITION_SET, "00 00000003"), message(Code.POSITION_SET, "01 FFFFFFFE")
    )
    await host.ask(message(Code.ENCODE, "03 0005"))
    assert await host.quiet(100)
    await host.pins(epdir=1)
    await host.pins(epin=1)
    assert await host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert await host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 FF FF FF FD")
    await host.pins(epin=0, epdir=0)
    await host.pause(5)
    await host.pins(epin=1)
    assert await host.response() == message(Answer.ENCODE_CHANGE, "00", source=SPONTANEOUS)


@directed("P312-PAR-08")
async def p312_gap_between_responses(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.write(CSR, 0x10)
    await host.ask(message(Code.STEP, "00"))
    await host.issue(message(Code.INPUT))
    await host.pause(20_000)
    for answer in (message(Code.INPUT, "00"), stopped(0x40, 1)):
        assert await host.response() == answer
    levels = host.bench.edges("irq_n", host.mark)
    gaps = [b - a for (a, level), (b, _) in zip(levels, levels[1:], strict=False) if level]
    assert gaps and min(gaps) >= 8


@cocotb.parametrize(clk=[6, 7])
@directed("P312-MOT-06")
async def p312_external_clock_ends_with_its_last_interval(dut: Any, clk: int) -> None:
    host = await Host.start(dut, f"02 03 01 {clk:02X} 02", "00 04 0003 0064", "01 06 000005 000005")
    await host.ask(message(Code.CONSTANT, "00 0003 00000002"))
    await host.pause(100)
    for number in range(1, 9):
        await host.pins(extck=1)
        await host.pause(10)
        await host.pins(extck=0)
        await host.pause(10)
        assert (host.condition == 0x02) == (number >= 7), number
    assert len(host.pulses()) == 2


@directed("P312-CMD-40", builds=(F8V,))
async def p312_version_of_the_build(dut: Any) -> None:
    host = await Host.start(dut)
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "34")


@cocotb.parametrize(form=[message(Code.STEP, "00"), message(Code.RAMP, "00 0000 00000003")])
@directed("P312-INP-20", "P312-TIM-12", builds=(F16, D16), exact="a level of one cycle may not be sampled")
async def p312_run_is_sampled_in_one_cycle(dut: Any, form: str) -> None:
    """If RUN is low for one cycle, it holds the operation only if this is the cycle before t0."""
    host = await Host.start(dut, *TF)
    await host.issue(form)
    start = await host.pulse(1) - 80
    later = {}
    for edge in range(start - 8, start + 4):
        host = await Host.start(dut, *TF)
        await host.issue(form)
        await host.go(edge)
        await host.pins(run=0)
        await host.pins(run=1)
        reports = [await host.response()]
        later[edge] = await host.pulse(1) - 80 - start
        reports.append(await host.response())
        assert (message(Answer.HOLD_EXECUTED, source=SPONTANEOUS) in reports) == bool(later[edge])
    assert [edge for edge, clk in later.items() if clk] == [start - 2] and later[start - 2] == 1
