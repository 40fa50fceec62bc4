"""MASK, GO and STOP of the bank's model (BANK-GRP).

g is the edge of the write event of GO or STOP, V the edge of a visit of the axis, R the number of cycles in a
round, and W the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

import pytest

from tests.bank.model.host import DATA, GO, INIT_B, MASK, STATUS, STOP, Host


def held(axes: int, script: str = "c 45 d 63", count: int = 3) -> Host:
    """Return a host on which axes 0 .. count - 1 hold an operation."""
    host = Host(axes)
    for axis in range(count):
        host.ready(axis, INIT_B)
    host.mask((1 << count) - 1)
    for axis in range(count):
        host.send(axis, script)
    return host


def first_pulse(go: int, host: Host) -> int:
    """Return the edge of pulse 1 after a GO whose write event is at `go`."""
    return go + 4 + host.model.round + host.w


@pytest.mark.parametrize("early, holds", [(6, True), (5, True), (4, False)])
@pytest.mark.parametrize("setting", [True, False])
def test_mask_of_a_start(early, holds, setting):
    """A start at visit V uses the MASK bit as written at V - 5 or earlier (BANK-GRP-01)."""
    host = Host(64)
    host.ready(4)
    if not setting:
        host.write(0, MASK, 0x10)
    visit = host.visit(4)
    host.write_at(visit - 20, 4, STATUS, 0x42)
    host.write_at(visit - early, 0, MASK, 0x10 if setting else 0)
    host.go(visit + 5000)
    assert host.changes("hold", 4, 100) == [(visit, 0)]
    assert host.model.busy(4) == (holds == setting)
    assert host.changes("pout_n", 4, 100)[:1] == ([] if holds == setting else [(visit + host.w, 0)])


@pytest.mark.parametrize("early, found", [(6, 0), (5, 0), (4, 64)])
def test_first_visit_that_finds_go(early, found):
    """A GO with its write event at g is detected at the first visit V >= g + 5, here by an axis without a
    held operation, which rejects it (BANK-GRP-02).
    """
    host = Host(64)
    host.mask(1 << 4)
    visit = host.visit(4)
    host.write_at(visit - early, 0, GO, 0)
    host.go(visit + found - 1)
    assert host.status(4) == 0
    host.go(visit + found)
    assert host.status(4) == 0xA0


@pytest.mark.parametrize("axes", [4, 8, 32, 64])
def test_go_starts_all_on_one_edge(axes):
    """After a GO at g, pulse 1 of all held axes is on edge g + 4 + R + W; then each axis runs independently
    (BANK-GRP-02).
    """
    host = held(axes)
    assert host.model.outputs["pout_n"] == (1 << axes) - 1
    go = host.write(2, GO, 0xFF)
    host.go(go + 5000)
    for axis in range(3):
        assert host.model.pulses(axis) == [first_pulse(go, host)]
        assert host.status(axis) == 0x04
    assert host.model.log.falls("pout_n") == [] and host.model.outputs["hold"] == (1 << axes) - 1 & ~7


def test_go_refused():
    """An axis that rejects GO sets error 1, 2 or 0, and discards a command whose parameters are incomplete
    (BANK-GRP-02).
    """
    host = held(8, count=2)
    host.ready(2)
    host.send(2, "c 44 d 01")
    host.send(3, "c 0A d 01 d 01")
    host.mask(0b10011110)
    host.write(0, GO, 0)
    host.t += 40
    host.mask(0b00011110)
    host.write(0, GO, 0)
    host.t += 40
    statuses = [host.read(axis, STATUS) for axis in range(8)]
    assert statuses == [0x04, 0x94, 0x80, 0xA0, 0xA0, 0, 0, 0xA0]
    host.send(2, "d 00")
    assert host.status(2) == 0xB0 and not host.model.busy(2)


def test_held_operation_is_watched_and_stopped():
    """Limits, the alarm and stops take effect on a held operation; if its deceleration flag is set, it
    outputs only pulse 1 after GO (BANK-GRP-01).
    """
    host = held(8, "c 43 d E7 d 03 d 00", 5)
    host.pin(host.t, 0, l1_n=0)
    host.send(1, "c 40")
    host.send(2, "c 41")
    host.pin(host.t, 3, l3_n=0)
    assert host.finish(0) == (0x93, 999) and host.finish(1) == (0xC3, 999)
    host.mask(0b11100)
    go = host.write(0, GO, 0)
    assert host.finish(2) == (0xC3, 998) and host.finish(3) == (0x8B, 998)
    assert [host.model.pulses(axis)[:1] for axis in range(5)] == [[], []] + [[first_pulse(go, host)]] * 3


def test_go_and_the_end_of_a_held_operation():
    """A held operation whose end no visit has detected yet continues with GO; the visit that ends it rejects
    GO (BANK-GRP-02, BANK-MOT-03).
    """
    for known, status in ((4, 0x00), (5, 0x80)):
        host = held(64)
        visit = host.visit(1)
        host.write_at(visit - 10, 0, GO, 0)
        host.pin(visit - known - 2, 1, alm_n=0)
        host.go(visit)
        assert host.model.busy(1) == (known == 4) and host.status(1) & 0x80 == status & 0x80
        host.go(visit + 3000)
        assert host.status(1) == status and host.model.pulses(1) == []


def test_mask_taken_away_from_a_held_operation():
    """While a GO is active, each visit uses the value that MASK had 5 cycles earlier (BANK-GRP-02,
    BANK-GRP-03).
    """
    host = held(64)
    last = host.visit(2)
    host.write_at(last - 20, 0, GO, 0)
    host.write_at(last - 5, 0, MASK, 0b011)
    go = last - 20
    host.go(go + 4000)
    assert [len(host.model.pulses(axis)) for axis in range(3)] == [1, 1, 0] and host.model.busy(2)
    host.mask(0b100)
    again = host.write(0, GO, 0)
    host.go(again + 4000)
    assert host.model.pulses(2) == [first_pulse(again, host)]


def not_found_by_the_first(gaps: tuple[int, ...]) -> tuple[Host, int]:
    """Return a host whose axis 0 holds an operation and misses a GO, and the edge of this GO.

    The MASK bit of the axis is 0 at this GO and is set 10 cycles later. Further GOs, `gaps` cycles after the
    first one, start the operation.
    """
    host = held(64, count=1)
    host.mask(0)
    go = host.visit(0) - 6
    writes = [(go, GO, 0), (go + 10, MASK, 1), *((go + gap, GO, 0) for gap in gaps)]
    for event, register, byte in sorted(writes):
        host.write_at(event, 0, register, byte)
    return host, go


@pytest.mark.parametrize("gap, acts_at", [(5, 64), (63, 64), (64, 64), (65, 65)])
def test_second_go_waits(gap, acts_at):
    """A second GO that is written while the first one is active has the same effect as one R cycles after the
    first (BANK-GRP-03).
    """
    host, go = not_found_by_the_first((gap,))
    host.go(go + 2000)
    assert host.model.pulses(0) == [first_pulse(go + acts_at, host)] and host.status(0) == 0x04


@pytest.mark.parametrize("third, status", [(20, 0x04), (63, 0x04), (64, 0x94), (70, 0x94)])
def test_third_go(third, status):
    """A third GO has no effect if it is written while the second one waits; if it is written later, it takes
    effect after the second one (BANK-GRP-03).
    """
    host, go = not_found_by_the_first((5, third))
    host.go(go + 6 + 64)
    assert host.status(0) == 0x04
    host.go(go + 6 + 128)
    assert host.status(0) == status
    host.go(go + 2000)
    assert host.model.pulses(0) == [first_pulse(go + 64, host)] and host.status(0) == status


@pytest.mark.parametrize("offset, pulses", [(-1, 4), (0, 4), (1, 5)])
def test_stop_acts_on_the_next_edge(offset, pulses):
    """STOP at g ends running operations of all axes on edge g + 1, with finish bit 6 (BANK-GRP-04)."""
    host = Host()
    for axis in (1, 6):
        host.ready(axis)
        host.send(axis, "c 45 d 13")
    due = host.model.pulses(1)[0] + 4 * 160 * 25
    stop = due + offset - 1
    host.write_at(stop, 7, STOP, 0)
    assert host.finish(1) == (0xC5, (1 << 24) - pulses - 1)
    assert len(host.model.pulses(1)) == pulses == host.position(1)
    assert host.finish(6)[0] == 0xC5


def test_stop_and_limit_on_one_edge():
    """STOP and a limit on the same edge set both finish bits (BANK-GRP-04, P104-LIM-09)."""
    for late, status in ((0, 0xD5), (1, 0xC5), (-1, 0x95)):
        host = held(8, count=1)
        stop = host.t + 50
        host.write_at(stop, 7, STOP, 0)
        host.pin(stop + 1 - 2 + late, 0, l1_n=0)
        assert host.finish(0)[0] == status


@pytest.mark.parametrize("after, stopped", [(0, True), (1, True), (30, True), (64, True), (65, False)])
def test_operation_that_starts_after_stop(after, stopped):
    """STOP at g also ends operations that start at visit g, which count as running, and at visits g + 1 to g
    + R, but no later operations (BANK-GRP-04).
    """
    host = Host(64)
    host.ready(4)
    visit = host.visit(4, 200)
    for event, axis, register, byte in sorted([(visit - 20, 4, STATUS, 0x46), (visit - after, 0, STOP, 0)]):
        host.write_at(event, axis, register, byte)
    host.go(visit)
    assert host.model.busy(4)
    host.go(visit + 64)
    assert host.model.busy(4) != stopped
    host.go(visit + 1000)
    assert bool(host.model.pulses(4)) != stopped


def test_stop_at_rest_and_after_the_last_pulse():
    """STOP at standstill and after the last pulse has no effect (BANK-GRP-04, P104-END-05)."""
    host = Host()
    host.ready(1)
    host.write(0, STOP, 0)
    host.t += 30
    start = host.send(1, "c 42")
    host.write_at(start + host.w + 100, 0, STOP, 0)
    assert host.finish(1) == (0x82, 0)
    assert host.read(1, DATA) == 0
