"""Acceptance checks of the PPMC-312: overrides, event buffers, multiple occurrence, interlock."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, MWEF, T1, TF, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP = message(Code.STOP, "00")
FAST_CURVE = ("02 03 01 00 02", "00 04 0004 0190", "01 06 000005 000005")


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


def at(position: int, code: int = 0x80) -> str:
    """80 or 81 at a position."""
    return message(code, f"04 {position:08X}")


@pytest.mark.parametrize("setting", [TF, FAST_CURVE])
@verifies("P312-CHK-23", "P312-CHK-24", "P312-OVR-12")
def test_stop_at_a_position(setting: tuple[str, ...]) -> None:
    for timing in ("FAST", "DATASHEET"):
        host = Host(*setting, timing=timing)
        assert host.ask(at(20)) == message(Answer.REGISTERED)
        assert host.ask(message(Code.FOREVER_CONSTANT, "00 0000")) == message(Code.FOREVER_CONSTANT, "00")
        assert host.response() == message(Code.STOP, source=Source.OVERRIDE)
        assert host.response() == stopped(0x04, 20)
        assert len(host.pulses()) == 20


@verifies("P312-OVR-12", "P312-MOT-34")
def test_stop_at_the_last_pulse_changes_nothing() -> None:
    host = Host(*TF, at(10))
    host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    assert host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert host.response() == stopped(0x40, 10)


@verifies("P312-CHK-25", "P312-OVR-01")
def test_nine_registrations() -> None:
    host = Host(*TF)
    assert [host.ask(at(20)) for _ in range(9)] == [message(Answer.REGISTERED)] * 8 + [
        message(Answer.REGISTRATION, "00")
    ]
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 08")


@verifies("P312-CHK-26", "P312-CMD-82")
def test_trigger_not_possible() -> None:
    host = Host(*TF)
    for code, tail in ((0x82, "0000 0000001E"), (0x83, "0190 0000001E"), (0x85, "0000"), (0x86, "0190")):
        for flags in ("04", "06"):
            data = bytes.fromhex(flags + tail)
            answer = host.ask(message(code, f"{data.hex()}"))
            assert answer.split()[2:5] == ["F0", "21", f"{code:02X}"]
    for block in (
        message(Code.STOP, "04"),
        message(Code.SLOW_STOP, "06"),
        message(Code.RAMP_CHANGE, "04 0064"),
        message(Code.CHANGE, "04 0064"),
    ):
        assert host.ask(block).split()[2:4] == ["F0", "23"]
    assert host.ask(message(Code.RAMP, "05 0000 0000001E")) == message(Answer.REGISTERED)
    assert host.ask(message(Code.CHANGE, "07 FFFF")) == message(Answer.REGISTERED)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 32")


@verifies("P312-CHK-27")
def test_evt_in_use() -> None:
    host = Host(*TF, message(Code.CHANGE, "05 00C8"))
    assert host.ask(message(Code.EVENT_SET, "00", message(Code.STEP, "00"))) == message(Code.EVENT_SET, "01")
    assert host.ask(message(Code.EVENT_SET, "01", message(Code.STEP, "00"))) == message(Code.EVENT_SET, "00")
    assert host.ask(message(Code.CHANGE, "07 00C8")) == message(Answer.REGISTRATION, "01")
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.STEP, "00")))
    assert host.ask(message(Code.CHANGE, "05 00C8")) == message(Answer.REGISTRATION, "01")


@verifies("P312-CHK-28", "P312-EVT-01", "P312-EVT-02")
def test_event_buffer_goes_round() -> None:
    host = Host(
        *TF,
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02")),
    )
    for level in (0x3E, 0x3D, 0x3E):
        host.blip("evt0_n")
        assert host.response() == message(Code.OUTPUT, source=Source.EVENT)
        assert host.out("auxo_n") == level
    assert host.ask(message(Code.EVENT_READ, "00")) == message(Code.EVENT_READ, "02 01 26 26 00 00")
    assert host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "02 01 26 26 00 00")


@verifies("P312-CHK-29", "P312-EVT-02")
def test_event_interruption() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "01", message(Code.STEP, "00")))
    host.pins(fl_n=0)
    host.blip("evt1_n")
    assert host.response() == message(Answer.EVENT_FAILED, "02", source=Source.EVENT)
    assert host.ask(message(Code.EVENT_READ, "01")) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@pytest.mark.parametrize(
    ("block", "number"),
    [
        (message(Code.EVENT_SET, "00 03 00"), "00"),
        (message(Code.STOP, "05"), "00"),
        (message(Code.FREE_CURVE, "01 03"), "00"),
        (message(Code.TABLE_READ), "00"),
        (message(Code.EVENT_SET, "02"), "00"),
        ("03 01 46", "05"),
        (message(Code.STOP, "00"), "01"),
        (message(Code.STEP), "00"),
        (message(Code.ORIGIN_SEARCH, "00 0001"), "00"),
    ],
)
@verifies("P312-EVT-02", "P312-EVT-03")
def test_event_failures(block: str, number: str) -> None:
    host = Host(*TF)
    assert host.ask(message(Code.EVENT_SET, "00", block)) == message(Code.EVENT_SET, "00")
    host.blip("evt0_n")
    assert host.response() == message(Answer.EVENT_FAILED, number, source=Source.EVENT)
    assert host.ask(message(Code.EVENT_READ, "00")) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@verifies("P312-EVT-03")
def test_reset_and_setting_from_events() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.RESET)))
    host.blip("evt0_n")
    assert host.response() == message(Code.RESET) and host.condition == 0x01
    host = Host(*TF, "03 0D 49 00" + T1)
    host.blip("evt0_n", gap=50_000)
    assert host.response() == message(Code.INITIAL, source=Source.EVENT)
    assert host.model.core.table is not None and host.model.core.table.na == 2000
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")


@verifies("P312-CHK-30")
def test_registration_and_deletion() -> None:
    host = Host(*TF)
    assert host.ask(message(Code.EVENT_SET, "02")) == message(Code.EVENT_SET, "05")
    answers = [host.ask(message(Code.EVENT_SET, "00", message(Code.STEP, "00"))) for _ in range(5)]
    assert answers == [message(Code.EVENT_SET, "00")] * 4 + [message(Code.EVENT_SET, "02")]
    assert [host.ask(message(Code.EVENT_SET, "02")) for _ in range(5)] == [
        message(Code.EVENT_SET, f"0{s}") for s in (3, 3, 3, 4, 5)
    ]


@pytest.mark.parametrize(
    "block", [message(Code.EVENT_SET, "02"), message(Code.EVENT_SET, "00", message(Code.OUTPUT, "04"))]
)
@verifies("P312-EVT-01")
def test_registration_and_deletion_start_with_the_first_again(block: str) -> None:
    host = Host(*TF, *(message(Code.EVENT_SET, "00", message(Code.OUTPUT, f"0{n}")) for n in (1, 2, 3)))
    host.blip("evt0_n")
    host.response()
    assert host.ask(message(Code.EVENT_READ)).split()[4] == "01"
    host.ask(block)
    assert host.ask(message(Code.EVENT_READ)).split()[4] == "00"
    host.blip("evt0_n")
    assert host.response() == message(Code.OUTPUT, source=Source.EVENT) and host.out("auxo_n") == 0x3E


@verifies("P312-EVT-04")
def test_edges_without_a_taker() -> None:
    host = Host(*TF, message(Code.CHANGE, "07 00C8"), message(Code.RAMP_CHANGE, "05 0190"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.blip("evt0_n")
    assert host.quiet() and host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 32")
    host.blip("evt1_n")
    assert host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    host.blip("evt0_n")
    assert host.response() == message(Code.RAMP_CHANGE, source=Source.OVERRIDE)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 04 00")


@verifies("P312-CHK-31", "P312-OVR-04")
def test_override_interruption() -> None:
    host = Host(*TF, message(Code.RAMP, "05 0000 0000001E"), at(5000))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    host.pulse(10)
    host.blip("evt0_n")
    assert host.response() == message(Answer.OVERRIDE_FAILED, "01", source=Source.OVERRIDE)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    host.ask(STOP)
    position = host.model.position
    assert host.response() == stopped(0x04, position)
    host.mark = mark
    assert len(host.pulses()) == position


@verifies("P312-OVR-02", "P312-OVR-11")
def test_a_position_passed_one_pulse_later_is_not_missed() -> None:
    host = Host(
        *TF, message(Code.CHANGE, "04 00C8 0000000A"), message(Code.CHANGE, "04 0190 0000000B"), at(14)
    )
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    for answer in (
        message(Code.CHANGE, source=Source.OVERRIDE),
        message(Code.CHANGE, source=Source.OVERRIDE),
        message(Code.STOP, source=Source.OVERRIDE),
    ):
        assert host.response() == answer
    assert host.response() == stopped(0x04, 14)
    assert host.gaps() == [100] * 10 + [200] + [400] * 2


@verifies("P312-OVR-02")
def test_equality_that_stands_is_no_trigger() -> None:
    host = Host(*TF, at(0))
    host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    assert host.response() == stopped(0x40, 2)
    host.ask(message(Code.CONSTANT, "40 0190 00000005"))
    assert host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert host.response() == stopped(0x04, 0)


@verifies("P312-CHK-49", "P312-OUT-03")
def test_interlock() -> None:
    host = Host(*TF, message(Code.INTERLOCK_POSITION, "0000000A"))
    assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert host.out("intlk_n") == 0
    host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert host.response() == message(Answer.INTERLOCK_END, source=SPONTANEOUS)
    assert len(host.pulses()) == 10 and host.out("intlk_n") == 1
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 08 00")
    assert host.response() == stopped(0x40, 20)
    assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "01")
    assert host.ask(message(Code.INTERLOCK)) == message(Code.INTERLOCK, "00") and host.out("intlk_n") == 1


@verifies("P312-CHK-70", "P312-RSP-20")
def test_a_stop_does_not_wait_for_a_read() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    host.pins(auxi=0xFF)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    host.pulse(10)
    host.blip("evt0_n")
    host.issue(STOP)
    header = host.header
    host.pause(20_000)
    assert host.read(CSR) & MWEF
    assert host.response() == message(Code.INPUT, "FF", source=Source.EVENT)
    assert host.response() == message(Code.STOP)
    assert not host.read(CSR) & MWEF
    assert host.response() == stopped(0x04, host.model.position)
    host.mark = mark
    assert host.pulses()[-1] <= header + 64
    assert host.quiet()


@verifies("P312-RSP-20")
def test_an_event_behind_an_unread_answer_is_an_alarm() -> None:
    host = Host(*TF, message(Code.EVENT_SET, "00", message(Code.INPUT)))
    host.issue(message(Code.VERSION))
    host.pause(200)
    host.blip("evt0_n")
    assert host.response() == message(Code.VERSION, "12")
    assert host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.condition == 0x10
    host.ask(message(Code.ALARM_CLEAR))
    assert host.ask(message(Code.EVENT_READ)) == message(Code.EVENT_READ, "00 00 00 00 00 00")


@verifies("P312-CHK-72")
def test_position_stop_behind_an_unread_answer() -> None:
    host = Host(*TF, message(Code.CHANGE, "04 00C8 00000012"), at(19))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(19)
    host.pause(20_000)
    assert len(host.pulses()) == 19
    assert host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    assert host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.response() == stopped(0x80, 19)
    assert host.quiet() and host.condition == 0x10


@verifies("P312-OVR-05", "P312-INP-31")
def test_buffers_survive_an_alarm() -> None:
    host = Host(*TF, at(5), message(Code.EVENT_SET, "00", message(Code.STEP, "00")))
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    host.pins(alm_n=1)
    host.ask(message(Code.ALARM_CLEAR))
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 41")
    host.blip("evt0_n")
    assert host.response() == message(Code.STEP, source=Source.EVENT)
    assert host.response() == stopped(0x40, 1)


@verifies("P312-INP-31")
def test_alarm_aborts_a_transfer() -> None:
    host = Host(*TF[:2])
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.ask(TF[2]) == message(Answer.STATUS, "01 10")


@verifies("P312-OVR-10", "P312-BAD-13")
def test_one_edge_is_remembered() -> None:
    host = Host(
        *TF,
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "01")),
        message(Code.EVENT_SET, "00", message(Code.OUTPUT, "02")),
        message(Code.EVENT_SET, "01", message(Code.OUTPUT, "04")),
    )
    host.pins(evt0_n=0, evt1_n=0)
    host.pins(evt0_n=1, evt1_n=1)
    host.pause(4)
    host.pins(evt0_n=0)
    host.pause(4)
    host.pins(evt0_n=1)
    host.pause(500)
    # The second edge of evt0 and the one of evt1 were worked on before the first answer was read.
    assert {host.response(), host.response()} == {
        message(Code.OUTPUT, source=Source.EVENT),
        message(Answer.ALARM, "01", source=SPONTANEOUS),
    }
    assert host.out("auxo_n") == 0x3E
