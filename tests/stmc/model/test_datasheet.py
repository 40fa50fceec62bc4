"""DATASHEET times of the STMC (STMC-DS-01..14) on the golden model.

A time may be up to 16 cycles longer than stated, plus the delay to the pins.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from tests.stmc.model.host import INTERNAL, Host, count, init

PINS = 2


def sheet(script: str = INTERNAL, **parameters: object) -> Host:
    return Host(script, timing="DATASHEET", ext=0, **parameters)


def ready(host: Host) -> Host:
    """Wait until the part has completed the initialisation."""
    host.run("c 80 r")
    return host


def near(got: int, nominal: int, slack: int = 0) -> bool:
    return nominal <= got <= nominal + 16 + PINS + slack


def taken(host: Host) -> int:
    """Return the edge on which the waiting byte is accepted."""
    host.pause(4)
    host.sync()
    while host.model.status & 2:
        host.step()
    return host.model.now


def command_and_times(host: Host, script: str) -> tuple[int, int, int]:
    """Return the write event of the last byte, and the edges of hold's fall and of the first step
    after it.
    """
    *head, last = script.split("/")
    host.start(" ".join(head))
    reg, byte = last.split()
    event = host.write(int(reg == "c"), int(byte, 16))
    host.mark = event
    hold = host.model.log
    host.fall(1)
    return event, hold.falls("hold", event)[0] - event, host.pulses()[0] - event


@verifies("STMC-DS-01", "STMC-DS-04", "STMC-DS-05", "STMC-DS-06")
@pytest.mark.parametrize("script, start, step", [
    ("c 44 d 0A d 01 d 00/d 00", 432, 3104),
    ("/c 42", 432, 1376),
    ("c 43 d 09 d 00/d 00", 1792, 3200),
    ("/c 46", 1792, 3200),
    ("c 45/d 0A", 432, 3104),
    ("c 47/d 0A", 432, 3104),
])  # fmt: skip
def test_starts(script, start, step):
    host = ready(sheet())
    _, hold, first = command_and_times(host, script)
    assert near(hold, start) and near(first, step)


@verifies("AC-48", "STMC-DS-07", "STMC-DS-08", "STMC-DS-13")
def test_end_of_a_constant_speed_move():
    host = ready(sheet())
    _, hold, first = command_and_times(host, "c 44 d 0A d 01 d 00/d 00")
    assert near(hold, 432) and near(first, 3104)
    assert host.fall(2) - host.fall(1) == 12_800
    last = host.pulses()[-1]
    host.idle()
    fall = host.model.log.falls("int_n")[0]
    assert near(fall - last, 416)
    host.write(1, 0x80)
    assert near(taken(host) - last, 2496) and host.fetch() == 0x84


@verifies("STMC-DS-02", "STMC-DS-03", "STMC-DS-14")
@pytest.mark.parametrize("pa", [0, 8, 400])
def test_initialisation(pa):
    host = sheet("")
    host.run(init(0x2A, 20, 5, pa)[:-6])
    host.t += 40
    event = host.write(0, 0)
    if pa >= 256:
        host = sheet("")
        host.run(init(0x2A, 20, 5, pa)[:-5])
        event = host.write(0, pa >> 8)
    host.write(1, 0x42)
    host.t += 40
    host.mark = event
    host.step()
    while not host.model.log.falls("hold"):
        host.step()
    assert near(host.pulses()[0] - event, 704)
    started = host.model.log.falls("hold")[0] - event - 432
    assert near(started, 264_000 + 209 * pa, 20)


@verifies("STMC-DS-06")
def test_single_step_ends():
    host = ready(sheet())
    event, _, _ = command_and_times(host, "/c 42")
    host.idle()
    assert near(host.model.log.falls("int_n")[0] - event, 1792, 4)
    host.run("c 80 r")
    assert host.t - event < 1792 + 100


@verifies("STMC-DS-09", "STMC-DS-10", "STMC-DS-11")
@pytest.mark.parametrize("move, stop, end, opens", [
    ("c 43 d 63 d 00/d 00", {"l1_n": 0}, 3200, 3200),
    ("c 44 d 0A d 63 d 00/d 00", {"l1_n": 0}, 416, 2496),
    ("c 44 d 0A d 63 d 00/d 00", {"mon": 0}, 416, 2496),
    ("c 47/d 0A", {"cnp_n": 0}, 416, 2496),
    ("c 47/d 0A", {"l3_n": 0}, 416, 2496),
])  # fmt: skip
def test_stops(move, stop, end, opens):
    host = ready(sheet())
    command_and_times(host, move)
    host.fall(4, after=300)
    at = host.t
    host.pins(**stop)
    host.sync()
    host.idle()
    assert near(host.model.log.falls("int_n")[0] - at, end, 4) and len(host.pulses()) == 4
    host.write(1, 0x80)
    assert near(taken(host) - at, opens, 4)


@verifies("STMC-DS-09", "STMC-DS-11")
def test_end_of_a_ramp_down():
    host = ready(sheet())
    command_and_times(host, "c 43 d 63 d 00/d 00")
    host.in_gap(3)
    mark = host.mark
    host.command(0x41)
    host.mark = mark
    host.fall(8)
    last = host.pulses()[-1]
    host.idle()
    assert near(host.model.log.falls("int_n")[0] - last, 3200) and len(host.pulses()) == 8
    assert host.gaps(1280) == [20, 12, 9, 8, 9, 12, 20]


@verifies("STMC-DS-12", "STMC-DS-14")
def test_cause_at_the_start_and_waiting_stop():
    host = ready(sheet())
    host.pins(l1_n=0)
    host.pause(4)
    host.start("c 43 d 09 d 00")
    event = host.write(0, 0)
    host.idle()
    host.step()
    while not host.model.log.falls("int_n"):
        host.step()
    assert near(host.model.log.falls("hold")[0] - event, 1792)
    assert near(host.model.log.falls("int_n")[0] - event, 1792 + 3200, 6)
    host.pins(l1_n=1)
    assert host.finish() == (0x93, 9)
    host.start("c 43 d 09 d 00")
    event = host.write(0, 0)
    host.write(1, 0x40)
    assert near(taken(host) - event, 1792, 4)
    assert host.finish() == (0xC3, 9) and host.pulses() == []


@verifies("STMC-DS-11", "STMC-STP-01")
def test_stop_command_acts_at_once():
    host = ready(sheet())
    command_and_times(host, "c 44 d 03 d 63 d 00/d 00")
    host.fall(3, after=3840 - 14)
    mark = host.mark
    host.write(1, 0x40)
    host.mark = mark
    assert host.finish() == (0xC4, 99 - 3)


@verifies("STMC-DS-07")
def test_accepted_request_that_changes_nothing_ends_normally():
    host = ready(sheet())
    host.start("c 43 " + count(11))
    host.mark = host.t - 10
    host.in_gap(5)
    mark = host.mark
    host.command(0x41)
    host.mark = mark
    host.fall(12)
    last = host.pulses()[-1]
    host.idle()
    assert near(host.model.log.falls("int_n")[0] - last, 416)
