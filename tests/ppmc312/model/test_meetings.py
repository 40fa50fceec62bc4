"""Things that meet on the PPMC-312: events, overrides, host blocks and pins while something is processed."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import DWR, RATES, T1, TF, WAR, WCR, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


def put_with(host: Host, text: str, **pins: int) -> None:
    """Write a block; the pins change just before its header is written."""
    block = bytes.fromhex(text)[::-1]
    host.write(WCR, 0x20)
    host.write(WAR, 0x20 - len(block))
    for byte in block[:-1]:
        host.write(DWR, byte)
    host.pins(**pins)
    host.write(DWR, block[-1])


@verifies("P312-OVR-10")
def test_host_goes_next_after_one_event() -> None:
    host = Host(
        *TF,
        message(Code.EVENT_SET, "00", message(Code.INPUT)),
        message(Code.EVENT_SET, "01", message(Code.TERMINALS)),
    )
    put_with(host, message(Code.SPEED_LIMIT, "0100"), evt0_n=0, evt1_n=0)
    host.pause(500)
    assert host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    # The event on the second pin finds the answer of the first one unread.
    assert host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.response() == message(Code.SPEED_LIMIT)


@verifies("P312-OVR-10", "P312-BLK-01")
@pytest.mark.parametrize("gap", range(20, 44))
def test_host_block_that_comes_as_a_triggered_one_ends(gap: int) -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    block = bytes([0x15, 0x26, 2, 3])
    host.write(WCR, 0x20)
    host.write(WAR, 0x20 - len(block))
    for byte in block[:-1]:
        host.write(DWR, byte)
    host.pins(evt0_n=0)
    host.pause(gap)
    host.write(DWR, block[-1])
    host.pause(100)
    assert host.out("auxo_n") == 0x2A
    assert host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert host.response() == message(Code.OUTPUT)


@verifies("P312-OVR-10")
def test_an_edge_for_a_buffer_that_is_emptied_is_dropped() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    host.issue(message(Code.EVENT_SET, "02"))
    host.pins(evt0_n=0)
    assert host.response() == message(Code.EVENT_SET, "04")
    assert host.quiet() and host.condition == 0x02
    host.pins(evt0_n=1)
    host.issue(message(Code.EVENT_SET, "00", message(Code.INPUT)))
    host.pins(evt0_n=0)
    assert host.response() == message(Code.EVENT_SET, "00")
    assert host.quiet() and host.condition == 0x02


@verifies("P312-OVR-04", "P312-OVR-12")
def test_pulses_stay_stopped_when_an_earlier_override_fails() -> None:
    host = Host(*FAST_CURVE, message(Code.CHANGE, "04 FFFF 0000000A"), message(Code.STOP, "04 0000000B"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0004"))
    assert host.response() == message(Answer.OVERRIDE_FAILED, "00", source=Source.OVERRIDE)
    assert host.response() == stopped(0x04, 11) and len(host.pulses()) == 11


@verifies("P312-MOT-34", "P312-OVR-12")
def test_a_limit_after_a_position_stop_changes_nothing() -> None:
    host = Host(*TF, message(Code.STOP, "04 0000000A"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(10, 4)
    host.pins(fl_n=0)
    assert host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert host.response() == stopped(0x04, 10)


@pytest.mark.parametrize(("code", "cause"), [(0x81, 0x10), (0x80, 0x04)])
@verifies("P312-MOT-43")
def test_stop_between_the_phases_of_a_zero_return(code: int, cause: int) -> None:
    host = Host(*TF, message(code, "05"))
    pace = host.model.pace
    host.ask(message(Code.ZERO_RETURN, "00 0000"))
    host.pulse(15)
    host.pins(org_n=0)
    last = host.pulse(27)
    done = last + 6400 + pace.turn_back
    host.go(done - pace.effect - pace.turn - host.model.latency.input_sync)
    host.pins(evt0_n=0)
    assert host.response() == message(code, source=Source.OVERRIDE)
    assert host.response() == stopped(cause, 27)
    assert host.out("dir") == 0 and host.quiet()


@verifies("P312-INP-31", "P312-INP-33")
def test_a_clear_given_before_the_alarm_does_not_leave_abn() -> None:
    host = Host(T1, message(Code.ALARM_CLEAR))
    host.blip("alm_n", 100, 100)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.condition == 0x10 and host.out("aclr_n") == 0
    host.pause(400_000)
    assert host.condition == 0x10
    host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x02


@verifies("P312-INP-30", "P312-INP-32")
def test_reset_with_the_alarm_still_there() -> None:
    host = Host(T1)
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    host.issue(message(Code.RESET))
    assert {host.response(), host.response()} == {
        message(Code.RESET),
        message(Answer.ALARM, "00", source=SPONTANEOUS),
    }
    assert host.condition == 0x10
    assert host.quiet()


@verifies("P312-BLK-02", "P312-OVR-05")
def test_what_a_refusal_leaves() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)), message(Code.CHANGE, "07 00C8"))
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")
    assert host.ask(message(Code.RAMP, "00 0000 00000000")).startswith("03 0A F0 23")
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 61")
    assert host.ask(message(Code.INITIAL, "01 03E8 03E8 0007D0")).startswith("03 0B F0 03")
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 01 00")


@verifies("P312-INP-11")
def test_high_speed_limit_rate_after_a_setting() -> None:
    host = Host(T1)
    host.pins(fhl_n=0)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 00C8")) == message(Answer.LIMIT)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 00C9")) == message(Code.FOREVER_CONSTANT, "00")


@verifies("P312-INP-01", "P312-TIM-14")
def test_datasheet_event_filter() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)), timing="DATASHEET")
    host.blip("evt0_n", 399_990)
    assert host.quiet()
    low = host.t
    host.pins(evt0_n=0)
    assert host.response() == message(Code.INPUT, "00", source=Source.EVENT)
    assert host.t - low in range(400_000, 400_500)


@verifies("P312-RSP-22")
def test_enabling_a_monitor_again_reports_again() -> None:
    host = Host(*TF, message(Code.POSITION_SET, "00 00000064"))
    host.ask(message(Code.ENCODE, "03 0005"))
    assert host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert host.ask(message(Code.ENCODE, "03 0006")) == message(Code.ENCODE)
    assert host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert host.ask(message(Code.ENCODE, "00 0006")) == message(Code.ENCODE)
    assert host.quiet() and host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


def test_echo_is_cut_at_28_bytes() -> None:
    host = Host("02 03 01 01 14")
    data = "0064 " * 14 + "0001"
    answer = host.ask("00 1E" + data)
    assert answer == clean("03 1E F0 18" + "0064" * 14)
    assert host.ask(RATES) == message(Answer.STATUS, "01 01")
