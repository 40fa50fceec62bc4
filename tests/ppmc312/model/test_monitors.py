"""Acceptance checks of the PPMC-312: in-position, encode and generalized input monitors."""

from __future__ import annotations

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import TF, Host
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@verifies("P312-CHK-46", "P312-CHK-47", "P312-MON-03", "P312-MON-05", "P312-MON-06", "P312-RSP-22")
def test_in_position() -> None:
    host = Host(*TF)
    host.ask(message(Code.IN_POSITION, "07 000A"))
    assert host.out("zclmp_n") == 0
    host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert host.out("zclmp_n") == 1
    # Both come with the end of pulse output; their order is open.
    assert {host.response(), host.response()} == {
        message(Answer.STOPPED, "40 00 00 00 14", source=SPONTANEOUS),
        message(Answer.POSITION_CHANGE, "01", source=SPONTANEOUS),
    }
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "09 02 00")
    for edge in range(10):
        host.pins(epin=1)
        host.pause(3)
        host.pins(epin=0)
        host.pause(3)
        assert host.out("zclmp_n") == (0 if edge == 9 else 1)
    assert host.response() == message(Answer.POSITION_CHANGE, "00", source=SPONTANEOUS)
    host.ask(message(Code.STEP, "00"))
    host.pause(4)
    assert host.out("zclmp_n") == 1


@verifies("P312-CHK-48", "P312-MON-04")
def test_encode_once() -> None:
    host = Host(*TF)
    host.ask(message(Code.ENCODE, "01 0005"))
    host.ask(message(Code.CONSTANT, "00 0190 00000014"))
    assert host.response() == message(Answer.ENCODE_CHANGE, "01", source=SPONTANEOUS)
    assert len(host.pulses()) == 6
    assert host.response() == message(Answer.STOPPED, "40 00 00 00 14", source=SPONTANEOUS)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    assert host.quiet()


@verifies("P312-RSP-22")
def test_a_report_that_is_not_true_any_more_vanishes() -> None:
    host = Host(*TF)
    host.ask(message(Code.ENCODE, "03 0002"))
    host.issue(message(Code.VERSION))
    host.wait()
    for epdir in (0, 0, 0, 1):
        host.pins(epin=1, epdir=epdir)
        host.pause(4)
        host.pins(epin=0)
        host.pause(4)
    assert host.response() == message(Code.VERSION, "12")
    assert host.quiet()


@verifies("P312-MON-10")
def test_one_input_change_is_reported() -> None:
    host = Host(message(Code.MASK, "00 FF"))
    host.pins(auxi=0x0F)
    assert host.response() == message(Answer.INPUT_CHANGE, "00 0F", source=SPONTANEOUS)
    host.pins(auxi=0xFF)
    assert host.quiet()
    host.ask(message(Code.MASK, "01 F0"))
    host.pins(auxi=0x00)
    host.pause(1000)
    # A report that is in the window already is not taken back.
    host.issue(message(Code.MASK, "01 01"))
    assert host.response() == message(Answer.INPUT_CHANGE, "00 F0", source=SPONTANEOUS)
    assert host.response() == message(Code.MASK)
    host.issue(message(Code.VERSION))
    host.pins(auxi=0x01)
    host.pause(1000)
    assert host.response() == message(Code.VERSION, "12")
    assert host.response() == message(Answer.INPUT_CHANGE, "00 01", source=SPONTANEOUS)
    assert host.quiet()
