"""Corners of the PPMC-312: held and waiting operations, alarms at odd times, resets, pins that keep still."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MREF, MWEF, T1, TF, TG, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP, SLOW_STOP = message(Code.STOP, "00"), message(Code.SLOW_STOP, "00")
FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


@verifies("P312-CMD-80", "P312-OVR-03")
def test_position_stop_that_comes_after_the_end() -> None:
    """On the last pulse of a fast motion the stop finds state NOR when its turn comes."""
    host = Host(*FAST_CURVE, message(Code.STOP, "04 0000000A"), message(Code.STOP, "04 0000FFFF"))
    host.ask(message(Code.CONSTANT, "00 0004 0000000A"))
    assert host.response() == stopped(0x40, 10)
    assert host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@verifies("P312-CMD-20", "P312-BAD-09")
def test_reset_while_running_leaves_nothing_behind() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.RESET)))
    host.ask(message(Code.FOREVER_CONSTANT, "40 0064"))
    host.pulse(10, 20)
    host.blip("evt0_n")
    assert host.response() == message(Code.RESET)
    assert (host.condition, host.out("pout"), host.out("dir"), host.model.position) == (0x01, 0, 0, 0)
    host.pause(1000)
    assert host.model.next_event is None


@verifies("P312-PRT-02", "P312-TIM-01")
def test_pins_keep_their_reset_levels_until_out_oe() -> None:
    host = Host(timing="DATASHEET")
    model = host.model
    model.pins(host.t, rst_n=0, alm_n=0)
    model.pins(host.t + 40, rst_n=1)
    host.t += 45
    assert host.read(CSR) == MWEF | MREF
    host.pause(25_000)
    assert host.out("out_oe") == 0 and host.out("cd_n") == 1
    host.pause(1_000)
    assert host.out("out_oe") == 1
    host.pause(3_000)
    assert host.out("cd_n") == 0
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)


@verifies("P312-INP-30")
def test_alarm_while_held_and_in_end_wait() -> None:
    host = Host(*TF)
    host.pins(run=0)
    assert host.ask(message(Code.STEP, "00")) == message(Code.STEP)
    assert host.condition == 0x20
    assert host.ask(STOP) == message(Answer.STATUS, "00 20")
    host.pins(alm_n=0)
    assert [host.response(), host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x80, 0),
    ]
    host.pins(alm_n=1, run=1)
    host.ask(message(Code.ALARM_CLEAR))
    host.pause(20_000)
    assert host.condition == 0x02 and host.model.position == 0
    host.ask(message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.STEP, "00"))
    host.pause(20_000)
    assert host.condition == 0x08
    host.pins(alm_n=0)
    assert [host.response(), host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x40, 1),
    ]


@verifies("P312-INP-31", "P312-BLK-01")
def test_alarm_while_a_start_is_prepared() -> None:
    host = Host(*TF, timing="DATASHEET")
    host.issue(message(Code.RAMP, "00 0096 00000014"))
    host.pause(10_000)
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.response() == message(Answer.STATUS, "00 10")
    assert not host.pulses()


@verifies("P312-INP-31")
def test_alarm_while_a_table_is_built() -> None:
    host = Host(timing="DATASHEET")
    host.issue(T1)
    host.pause(100_000)
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.response() == message(Code.INITIAL)
    host.pins(alm_n=1)
    assert host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR)
    assert host.condition == 0x02


@verifies("P312-RSP-20")
def test_second_hold_report_unread_is_an_alarm() -> None:
    host = Host(*TF)
    host.pins(run=0)
    host.issue(message(Code.STEP, "00"))
    host.pause(200)
    host.pins(run=1)
    host.pause(20_000)
    assert host.response() == message(Code.STEP)
    # E2 is in the window now and stays there.
    host.pause(100)
    host.pins(run=0)
    host.issue(message(Code.STEP, "00"))
    host.pause(200)
    host.pins(run=1)
    host.pause(100)
    assert host.condition == 0x10
    assert host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert host.response() == message(Answer.ALARM, "02", source=SPONTANEOUS)
    assert host.response() == message(Code.STEP)
    assert host.model.position == 1


@pytest.mark.parametrize(("code", "cause"), [(0x81, 0x10), (0x80, 0x04)])
@verifies("P312-MOT-30", "P312-MOT-34")
def test_stops_before_pulse_1(code: int, cause: int) -> None:
    host = Host(*TF, message(code, "05"))
    host.pins(run=0)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 0064")) == message(Code.FOREVER_CONSTANT, "01")
    host.pins(run=1)
    host.pins(evt0_n=0)
    assert host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert host.response() == message(code, source=Source.OVERRIDE)
    assert host.response() == stopped(cause, 0) and host.condition == 0x02
    assert host.quiet() and not host.pulses()


@verifies("P312-MOT-35")
def test_an_alarm_does_not_wait_for_the_positioning_end() -> None:
    host = Host(*TF, message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(3)
    host.pins(alm_n=0)
    assert [host.response(), host.response()] == [
        message(Answer.ALARM, "00", source=SPONTANEOUS),
        stopped(0x80, 3),
    ]


@verifies("P312-MOT-35", "P312-INP-30", "P312-MOT-34", "P312-MOT-06")
def test_an_alarm_after_the_last_pulse_does_not_wait_for_end() -> None:
    """In the last interval, and around its end, where the END wait begins: E0 at once, cause NOS."""
    for after in (20, 79, 80, 81, 2000, *range(6392, 6408)):
        host = Host(*TF, message(Code.END_TERMINAL, "01"))
        host.ask(message(Code.CONSTANT, "00 0190 00000003"))
        host.pulse(3, after)
        since = host.t
        host.pins(alm_n=0)
        assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        host.wait(2000)
        assert host.t - since < 300 and host.response() == stopped(0x40, 3)
        assert host.condition == 0x10 and host.quiet()
    # A multiple occurrence is an alarm, too.
    host = Host(*TF, message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    host.pulse(3, 200)
    host.put(message(Code.VERSION))
    host.pause(100)
    host.put(message(Code.VERSION))
    assert [host.response() for _ in range(3)] == [
        message(Code.VERSION, "12"),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
        stopped(0x40, 3),
    ]


@verifies("P312-PAR-06")
def test_writes_while_an_instruction_is_processed_are_ignored() -> None:
    host = Host(timing="DATASHEET")
    host.issue(T1)
    host.put(message(Code.OUTPUT, "3F"))
    host.put(message(Code.RESET))
    host.write(CSR, 0x10)
    assert host.read(CSR) == 0x10 | MWEF | MREF
    assert host.response() == message(Code.INITIAL)
    assert host.quiet() and host.out("auxo_n") == 0x3F and host.condition == 0x02


@verifies("P312-INP-12")
def test_high_speed_limit_before_pulse_1_and_at_a_slow_rate() -> None:
    host = Host(*TF, message(Code.SPEED_LIMIT, "00C8"))
    host.issue(message(Code.FOREVER_CONSTANT, "00 0064"))
    while not host.model.motion.active:
        host.step()
    host.pins(fhl_n=0)
    host.pause(200)
    assert not host.pulses()
    assert [host.response(), host.response()] == [message(Code.FOREVER_CONSTANT, "00"), stopped(0x10, 0)]
    host.pins(fhl_n=1)
    host.ask(message(Code.RAMP, "00 0000 0000001E"))
    host.pins(fhl_n=0)
    assert host.response() == stopped(0x02, 11)
    # Ignored at 400; the first interval at 200 asks, and the walk runs from its own stage.
    assert host.gaps() == [400] * 3 + [200] * 5 + [400] * 2
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 00C8")) == message(Answer.LIMIT)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")


@verifies("P312-MOT-31", "P312-MOT-33")
def test_change_on_a_late_deceleration_point() -> None:
    host = Host(*TG)
    host.ask(message(Code.RAMP, "00 0000 0000001E"))
    mark = host.mark
    host.pulse(25)
    assert host.ask(message(Code.CHANGE, "00 012C")) == message(Code.CHANGE)
    assert host.response() == stopped(0x40, 30)
    host.mark = mark
    assert host.gaps() == [400] * 3 + [200] * 4 + [100] * 18 + [300] * 4


@verifies("P312-MON-06")
def test_clamp_by_the_end_signal() -> None:
    host = Host(*TF, message(Code.IN_POSITION, "07 0002"))
    host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    host.response()
    host.response()
    assert host.out("zclmp_n") == 1
    host.pins(end_n=0)
    host.pause(5)
    assert host.out("zclmp_n") == 0


@verifies("P312-MON-01", "P312-MON-02")
def test_distance_wraps() -> None:
    host = Host(*TF, message(Code.POSITION_SET, "00 00000003"), message(Code.POSITION_SET, "01 FFFFFFFE"))
    host.ask(message(Code.ENCODE, "03 0005"))
    assert host.quiet(100)
    host.pins(epin=1, epdir=1)
    assert host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert host.ask(message(Code.POSITION_READ, "01")) == message(Code.POSITION_READ, "01 FF FF FF FD")
    host.pins(epin=0, epdir=0)
    host.pause(5)
    host.pins(epin=1)
    assert host.response() == message(Answer.ENCODE_CHANGE, "00", source=SPONTANEOUS)


@verifies("P312-PAR-08")
def test_gap_between_responses() -> None:
    host = Host(*TF)
    host.write(CSR, 0x10)
    host.ask(message(Code.STEP, "00"))
    host.issue(message(Code.INPUT))
    host.pause(20_000)
    for answer in (message(Code.INPUT, "00"), stopped(0x40, 1)):
        assert host.response() == answer
    levels = host.model.log.of("irq_n", host.mark)
    gaps = [b - a for (a, level), (b, _) in zip(levels, levels[1:], strict=False) if level]
    assert gaps and min(gaps) >= 8


@pytest.mark.parametrize("clk", [6, 7])
@verifies("P312-MOT-06")
def test_external_clock_ends_with_its_last_interval(clk: int) -> None:
    host = Host(f"02 03 01 {clk:02X} 02", "00 04 0003 0064", "01 06 000005 000005")
    host.ask(message(Code.CONSTANT, "00 0003 00000002"))
    host.pause(100)
    for number in range(1, 9):
        host.pins(extck=1)
        host.pause(10)
        host.pins(extck=0)
        host.pause(10)
        assert (host.condition == 0x02) == (number >= 7), number
    assert len(host.pulses()) == 2


def test_parameters_of_the_model() -> None:
    for bad in ({"timing": "SLOW"}, {"clk_hz": 1}, {"version": 256}, {"xtal_hz": 17_000_000}):
        with pytest.raises(ValueError):
            Host(**bad)
    assert Host(version=0x34, clk_hz=8_000_000).ask(message(Code.VERSION)) == message(Code.VERSION, "34")


@verifies("P312-INP-20", "P312-TIM-12")
@pytest.mark.parametrize("timing", ["FAST", "DATASHEET"])
@pytest.mark.parametrize("form", [message(Code.STEP, "00"), message(Code.RAMP, "00 0000 00000003")])
def test_run_is_judged_on_one_clk(form: str, timing: str) -> None:
    """Low for a single clk: one clk before t0, and no other, makes the operation a held one."""
    host = Host(*TF, timing=timing)
    host.issue(form)
    start = host.pulse(1) - 80
    later = {}
    for edge in range(start - 8, start + 4):
        host = Host(*TF, timing=timing)
        host.issue(form)
        host.go(edge)
        host.pins(run=0)
        host.pins(run=1)
        reports = [host.response()]
        later[edge] = host.pulse(1) - 80 - start
        reports.append(host.response())
        assert (message(Answer.HOLD_EXECUTED, source=SPONTANEOUS) in reports) == bool(later[edge])
    assert [edge for edge, clk in later.items() if clk] == [start - 2] and later[start - 2] == 1
