"""Acceptance checks of limits, alarm, origin, RUN and rejected stops on the golden model."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from tests.ppmc2104.model.host import B1, B2, LONG, Host


def ready(script: str = B1) -> Host:
    return Host(script + " ready ")


@verifies("P2104-STP-03", "P2104-ERR-03")
def test_ac_31_deceleration_stop_refused():
    host = ready()
    host.run("c 45 d 31 c 41")
    assert host.run("e1") == [8] and host.model.busy(1)
    host.run("c 40 idle")
    host.pins(run=0)
    host.pause(4)
    for operation in ("c 42", "c 43 d 09 d 00 d 00"):
        host.run(operation + " c 41")
        assert host.run("e1") == [8]
        host.pins(run=3)
        host.run("idle c 80 r")
        host.pins(run=0)
        host.pause(4)
    assert len(host.model.pulses(1)) > 10
    host.pins(run=3)
    host.run("c 43 d 18 d 00 d 00")
    mark = host.mark
    host.fall(18, after=30)
    host.run("c 41")
    host.mark = mark
    assert host.end() == (0x83, 0) and host.run("e1") == [8]


@verifies("P2104-FDC-01", "P2104-LIM-02")
def test_ac_38_slow_limit_of_the_other_direction():
    host = ready()
    host.pin("bhl_n", 0)
    host.run(LONG)
    assert host.end() == (0x83, 0) and len(host.pulses()) == 1000


@verifies("P2104-FDC-04", "P2104-OPR-09", "P2104-LIM-05")
@pytest.mark.parametrize(
    "script, end",
    [
        (LONG, (0x8B, 998)),
        (" c C3 d E7 d 03 d 00", (0x8B, 998)),
        (" c 46", (0x8E, 0xFFFFFE)),
        (" c C6", (0x8E, 0xFFFFFE)),
        (" c 43 d 00 d 00 d 00", (0x83, 0)),
    ],
)
def test_ac_39_40_start_on_a_slow_limit(script, end):
    host = ready()
    host.pin("fhl_n", 0)
    host.pause(5)
    host.run(script)
    assert host.end() == end and len(host.pulses()) == 1


@verifies("P2104-LIM-03", "P2104-END-02")
@pytest.mark.parametrize("axis", [1, 2])
def test_ac_42_limit(axis):
    host = ready(B1 if axis == 1 else B2)
    host.axis = axis
    host.run(f"c {0x25 + 0x20 * axis:02X} d 31")
    host.fall(5, after=400)
    host.pin("bl_n", 0, axis)
    host.pin("fl_n", 0, 3 - axis)
    host.pause(200)
    host.sync()
    assert host.model.busy(axis)
    seen = host.t
    host.pin("fl_n", 0, axis)
    host.model.run_until(seen + 8)
    assert not host.model.busy(axis)
    host.t = seen + 9
    assert host.end() == (0x95, 0xFFFFFA) and len(host.pulses()) == 5


@verifies("P2104-END-04", "P2104-LIM-09", "P2104-LIM-04")
@pytest.mark.parametrize("pins, end", [(("fl_n",), 0x9B), (("alm_n",), 0xAB), (("fl_n", "alm_n"), 0xB3)])
def test_ac_43_several_causes(pins, end):
    host = ready()
    host.run(LONG)
    host.fall(20, after=100)
    if len(pins) == 1:
        host.pin("fhl_n", 0)
        host.fall(25, after=100)
    host.model.pins(host.t, **{pin: 0b10 for pin in pins})
    host.t += 1
    assert host.end()[0] == end


@verifies("P2104-LIM-09", "P2104-STP-02")
def test_slow_limit_and_deceleration_stop_on_one_edge():
    for during, pulses in ((5, 10), (1, 1)):
        host = ready()
        host.run(LONG)
        host.fall(during, after=200)
        event = host.write(1, 0x41)
        # The byte is consumed (C-event) 2 edges after the write event; a level is detected 2 cycles after the
        # edge that samples it.
        host.model.pins(event, fhl_n=0b10)
        assert host.end()[0] == 0xCB and len(host.pulses()) == pulses
        assert host.run("e1") == [0]


@verifies("P2104-END-05", "P2104-END-01")
def test_ac_44_causes_after_the_last_pulse():
    host = ready()
    host.run("c 42")
    host.fall(1, after=10)
    host.pin("alm_n", 0)
    assert host.end() == (0x82, 0)


@verifies("P2104-OPR-02", "P2104-TIM-02", "P2104-LIM-08")
def test_ac_45_run_gate():
    host = ready()
    host.pins(run=0b10)
    host.run("c 43 d 18 d 00 d 00")
    host.pause(16_000)
    assert host.status() == 0x04 and host.bit("hold") == 0 and host.pulses() == []
    raised = host.t
    host.pins(run=0b11)
    assert 80 <= host.fall(1, after=300) - raised <= 86
    host.pins(run=0)
    host.idle()
    assert len(host.pulses()) == 25


@verifies("P2104-STP-01", "P2104-END-07")
def test_ac_46_stop_in_run_wait():
    host = ready()
    host.pins(run=0)
    host.pause(4)
    host.run("c 43 d 18 d 00 d 00 c 40 idle")
    host.mark = 0
    assert host.end() == (0xC3, 0x18) and host.pulses() == []
    (ended, low), _ = host.model.log.of("int_n")
    assert low == 0
    host.pause(52_000)
    host.sync()
    assert 51_200 <= host.model.bits("hold", 1)[-1][0] - ended + 1 <= 51_216


@verifies("P2104-LIM-07", "P2104-LIM-03")
def test_ac_47_48_origin_in_run_wait():
    host = ready()
    host.pins(run=0)
    host.pause(4)
    host.run("c 4F d 31")
    host.pin("org_n", 0)
    host.pause(500)
    assert host.status() & 4
    host.pin("bl_n", 0)
    assert host.end() == (0x97, 0xFFFFFF) and host.pulses() == []

    host = ready()
    host.pins(run=0)
    host.pause(4)
    host.run("c 47 d 31")
    host.pin("org_n", 0)
    host.pause(100)
    host.pins(run=3)
    assert host.end() == (0x87, 0xFFFFFF) and host.pulses() == []


@verifies("P2104-LIM-05", "P2104-FDC-04", "P2104-FSM-03")
def test_ac_49_slow_limit_in_run_wait_is_remembered():
    host = ready()
    host.pins(run=0)
    host.pause(4)
    host.run(LONG)
    host.pin("fhl_n", 0)
    host.pause(10)
    host.pin("fhl_n", 1)
    host.pause(100)
    host.pins(run=3)
    host.pause(10)
    host.write(1, 0x41)
    assert host.end() == (0x8B, 998) and len(host.pulses()) == 1
    assert host.run("e1") == [8]


@verifies("P2104-LIM-07")
def test_ac_51_origin():
    host = ready()
    host.run("c 47 d 31")
    host.fall(7, after=400)
    host.pin("org_n", 0)
    assert host.end() == (0x87, 0xFFFFF8) and len(host.pulses()) == 7


@verifies("P2104-TIM-03", "P2104-BAD-18")
def test_ac_59_stopped_external_clock():
    host = ready("c 0A d 63 d 13 d 0A d 00")
    host.run("c 44 d 09 d 09 d 00 d 00")
    host.pause(16_000)
    assert host.status() == 0x04 and host.pulses() == []
    host.run("c 40")
    assert host.end() == (0xC4, 9)


@verifies("P2104-FSM-01", "P2104-STP-05")
def test_fin_state():
    for operation, low in (("c 42", 2), ("c 43 d 00 d 00 d 00", 3)):
        host = ready()
        host.run(operation)
        fall = host.fall(1)
        host.go(fall + 4)
        host.write(1, 0x40)
        host.pause(20)
        host.write(1, 0x41)
        assert host.end() == (0x80 | low, 0) and host.run("e1") == [8]
