"""Acceptance checks of the PPMC-312: in-position, encode and generalized input monitors."""

from __future__ import annotations

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import TF, Host


@verifies("P312-CHK-46", "P312-CHK-47", "P312-MON-03", "P312-MON-05", "P312-MON-06", "P312-RSP-22")
def test_in_position() -> None:
    host = Host(*TF)
    host.ask("03 04 02 07 000A")
    assert host.out("zclmp_n") == 0
    host.ask("03 08 83 00 0190 00000014")
    assert host.out("zclmp_n") == 1
    # Both come with the end of pulse output; their order is open.
    assert {host.response(), host.response()} == {"23 06 E0 40 00 00 00 14", "23 02 E4 01"}
    assert host.ask("03 01 4D") == "03 04 4D 09 02 00"
    for edge in range(10):
        host.pins(epin=1)
        host.pause(3)
        host.pins(epin=0)
        host.pause(3)
        assert host.out("zclmp_n") == (0 if edge == 9 else 1)
    assert host.response() == "23 02 E4 00"
    host.ask("03 02 84 00")
    host.pause(4)
    assert host.out("zclmp_n") == 1


@verifies("P312-CHK-48", "P312-MON-04")
def test_encode_once() -> None:
    host = Host(*TF)
    host.ask("03 04 03 01 0005")
    host.ask("03 08 83 00 0190 00000014")
    assert host.response() == "23 02 E3 01"
    assert len(host.pulses()) == 6
    assert host.response() == "23 06 E0 40 00 00 00 14"
    assert host.ask("03 01 4D") == "03 04 4D 00 02 00"
    assert host.quiet()


@verifies("P312-RSP-22")
def test_a_report_that_is_not_true_any_more_vanishes() -> None:
    host = Host(*TF)
    host.ask("03 04 03 03 0002")
    host.issue("03 01 40")
    host.wait()
    for epdir in (0, 0, 0, 1):
        host.pins(epin=1, epdir=epdir)
        host.pause(4)
        host.pins(epin=0)
        host.pause(4)
    assert host.response() == "03 02 40 12"
    assert host.quiet()


@verifies("P312-MON-10")
def test_one_input_change_is_reported() -> None:
    host = Host("03 03 28 00 FF")
    host.pins(auxi=0x0F)
    assert host.response() == "23 03 E9 00 0F"
    host.pins(auxi=0xFF)
    assert host.quiet()
    host.ask("03 03 28 01 F0")
    host.pins(auxi=0x00)
    host.pause(1000)
    # A report that is in the window already is not taken back.
    host.issue("03 03 28 01 01")
    assert host.response() == "23 03 E9 00 F0"
    assert host.response() == "03 01 28"
    host.issue("03 01 40")
    host.pins(auxi=0x01)
    host.pause(1000)
    assert host.response() == "03 02 40 12"
    assert host.response() == "23 03 E9 00 01"
    assert host.quiet()
