"""Acceptance checks of errors, rejected instructions and handshake on the golden model of the PPMC-2104."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from tests.ppmc2104.model.host import B1, B2, LONG, Host

RUNNING = B1 + " c 44 d FF d FF d 00 d 00 "


@verifies("P2104-ERR-06", "P2104-ERR-01")
def test_ac_22_23_error_bit_and_registers():
    host = Host("c 87 c A7")
    assert host.status() == 0x80
    for script, value, status in (("e1", 1, 0x80), ("e2", 1, 0), ("e2", 0, 0)):
        assert host.run(script) == [value] and host.status() == status
    assert Host("d 55").run("e2 e1") == [0, 2]


@verifies("P2104-ERR-02", "P2104-ERR-01", "P2104-BAD-04", "P2104-BAD-06")
def test_ac_24_26_code_while_data_are_awaited():
    host = Host(B1 + " ready " + B2 + " ready c 43 d 05 c 62")
    assert host.status() == 0x80
    host.pause(5000)
    assert host.model.pulses(1) == host.model.pulses(2) == []
    assert host.run("e1 e2") == [0, 3]
    host.run("c 62 idle")
    assert len(host.model.pulses(2)) == 1
    host = Host(B1 + " ready c 43 c C2")
    assert host.status() & 1 == 0 and host.run("e1") == [3]
    assert Host(B1 + " ready c 63 d 01").run("e2 e1") == [4, 2]


@verifies("P2104-FSM-01", "P2104-RD-08", "P2104-ERR-03")
def test_ac_27_busy_axis_refuses():
    host = Host(RUNNING)
    host.fall(2, after=30)
    mark = host.mark
    for code in ("02", "42", "80", "81", "82", "83", "84", "85", "C0"):
        assert host.command(int(code, 16)) & 1 == 0
        assert host.run("e1") == [5], code
    assert host.run("c C2 r") == [0]
    host.run("c D1")
    assert host.out("auxo") == 0b10 and host.status() & 0x80 == 0
    host.mark = mark
    host.fall(6)
    assert set(host.intervals()) == {8192}


@verifies("P2104-STP-04")
def test_ac_28_stop_without_motion():
    assert Host(B1 + " ready c 40").run("e1 c 41 e1 c 60 e2") == [6, 6, 4]


@verifies("P2104-LIM-06")
def test_ac_29_start_on_an_active_limit():
    host = Host(B1 + " ready")
    host.pin("fl_n", 0)
    host.pause(5)
    assert host.run("c 42 e1") == [7]
    assert host.statuses("c 43 d 09 d 00") == [0x10] * 3
    assert host.data(0) == 0x80 and host.run("e1 c 83 rrr") == [7, 0, 0, 0]
    assert host.model.log.of("hold") == []
    host.run("c 4A idle")
    assert len(host.pulses()) == 1 and host.bit("dir") == 1


@verifies("P2104-LIM-06", "P2104-LIM-02")
@pytest.mark.parametrize(
    "pin, axis, script, error",
    [
        ("alm_n", 1, "c 42", 7),
        ("org_n", 1, "c 47 d 31", 7),
        ("org_n", 1, "c 44 d 31 d 00 d 00 d 00", 0),
        ("bl_n", 1, "c 42", 0),
        ("fhl_n", 1, "c 42", 0),
        ("fl_n", 2, "c 42", 0),
    ],
)
def test_ac_30_what_refuses_a_start(pin, axis, script, error):
    host = Host(B1 + " ready")
    host.pin(pin, 0, axis)
    host.pause(5)
    host.run(script + " idle")
    assert host.run("e1") == [error] and len(host.pulses()) == (0 if error else 1)


@verifies("P2104-INI-03", "P2104-INI-02", "P2104-BAD-16")
def test_ac_32_values_of_a_setting():
    host = Host(B1 + " ready")
    wrong = [(5, 4, 100), (5, 6, 100), (5, 0, 100), (9, 4, 3), (5, 4, 3), (9, 4, 0x2BD5), (5, 4, 0x2BD5)]
    got = []
    for rl, rh, pa in wrong:
        got += host.run(f"c 02 d {rl:02X} d {rh:02X} d {pa & 255:02X} d {pa >> 8:02X} e1")
    assert got == [9, 9, 9, 9, 9, 10, 9]
    host.run("c 43 d 18 d 00 d 00 idle")
    assert sum(host.intervals()) == 27_008
    for rl, rh, pa in ((6, 4, 4), (255, 1, 0x2BD4)):
        assert host.run(f"c 02 d {rl:02X} d {rh:02X} d {pa & 255:02X} d {pa >> 8:02X} e1 ready") == [0]


@verifies("P2104-OPR-07", "P2104-INI-03")
def test_ac_33_rate_zero_needs_the_external_clock():
    host = Host(B1 + " ready c 45 d 00")
    assert host.run("e1 c C0 c 0A d 63 d 13 d 0A d 00 ready c 45 d 00 e1") == [9, 0]
    for _ in range(20):
        host.pin("extck", 1)
        host.pause(20)
        host.pin("extck", 0)
        host.pause(20)
    host.sync()
    assert len(host.model.pulses(1)) > 5
    # A second initial setting is checked with the active clock source.
    host.run("c 40")
    assert host.run("c 02 d 05 d 00 d 04 d 00 e1 ready") == [0]


@verifies("P2104-AUX-04")
def test_ac_34_switching_values():
    assert Host().run("c 84 d 3F d 80 e1 c 84 d 80 d 3F e1 c 84 d 40 d FF e1") == [11, 11, 0]


@verifies("P2104-HSK-07", "P2104-HSK-06")
def test_ac_61_unread_answer():
    host = Host(B1 + " ready" + LONG)
    host.fall(7, after=100)
    host.run("c 40 idle")
    assert host.run("c 83 r c 42 idle r") == [0xE0, 0x03]
    host.run("c 83")
    assert host.run("c 80 r") == [0x82]
    assert host.status() & 1 == 0


@verifies("P2104-HSK-04", "P2104-HSK-02")
def test_ac_62_63_code_that_waits_for_the_table():
    host = Host(B2 + " ready " + B1)
    setting = host.t
    host.run("c F1")
    assert host.out("auxo") == 0 and host.status() & 0x10
    host.run("c 72")
    host.write(1, 0x42)
    host.axis = 2
    assert host.fall(1) - setting < 400
    assert host.status() & 0x12 == 0x12
    host.poll(0x12, 0)
    host.idle()
    assert len(host.model.pulses(1)) == 1

    host = Host(B1)
    host.write(1, 0x42)
    host.pause(50)
    host.write(1, 0x52)
    host.poll(0x12, 0)
    host.idle()
    assert len(host.model.pulses(1)) == 1 and host.out("int_n") == 1


@verifies("P2104-STP-07", "P2104-ERR-02")
def test_ac_82_stop_while_the_other_axis_collects():
    host = Host(B1 + " ready " + B2 + " ready c 45 d 31")
    host.run("c 63 d 05")
    host.mark = 0
    host.fall(20, after=400)
    host.command(0x40)
    host.idle()
    assert len(host.pulses()) == 20 and host.status() == 0x80
    assert host.run("c 80 r e2 e1") == [0xC5, 0, 3]
    host.run("d 00")
    assert host.model.pulses(2) == [] and host.run("e1") == [2]


@verifies("P2104-STP-07")
def test_ac_83_deceleration_stop_while_the_other_axis_collects():
    host = Host(B1 + " ready " + B2 + " ready " + LONG)
    mark = host.mark
    host.fall(5, after=100)
    host.run("c 63 c 41 e1")
    host.mark = mark
    host.idle()
    assert host.intervals() == [32 * (r + 1) for r in (99, 53, 41, 34, 30, 34, 41, 53, 99)]
    assert host.run("c 80 r c 83 rrr") == [0xC3, 0xDD, 3, 0]


@verifies("P2104-FSM-05", "P2104-ERR-02")
def test_ac_84_refused_stop_reports_8():
    host = Host(B1 + " ready " + B2 + " ready c 45 d 31 c 64 d 31 c 41")
    assert host.status() == 0x84
    assert host.run("e1") == [8] and host.model.busy(1)
    host.run("c 40 idle c 43 c 40")
    assert host.run("e1") == [3]


@verifies("P2104-HSK-04", "P2104-STP-04")
def test_ac_85_stops_never_wait_for_a_table():
    host = Host(B2 + " ready c 65 d 31 c 02 d FF d 01 d 04 d 00")
    taken = []
    for code in (0x40, 0x60):
        event = host.write(1, code, gap=12)
        host.model.run_until(event + 8)
        assert host.model.status & 2 == 0
        taken.append(event + 8)
    assert host.model.status & 0x10
    host.pause(5000)
    host.sync()
    assert all(t <= taken[1] for t in host.model.pulses(2)) and host.run("e1") == [6]


@verifies("P2104-HSK-04", "P2104-HSK-08")
@pytest.mark.parametrize("collecting", ["c 84 d 40", "c 63 d 00"])
def test_no_code_waits_for_a_table_while_data_are_awaited(collecting):
    host = Host(B2 + " ready " + B1 + " " + collecting)
    for code in (0x42, 0x02, 0xC0):
        event = host.write(1, code, gap=12)
        host.model.run_until(event + 2)
        assert host.model.status & 0x92 == 0x90
        assert host.run("e1") == [3]
        host.run("c 85")
    assert host.model.status & 0x10 and host.model.pulses(1) == []
