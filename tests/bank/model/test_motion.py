"""Motion of the bank's model, exact to the cycle: which events are on their own edge, and which wait for a
visit (BANK-MOT).

V is the edge of a visit of the axis, and W the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

import pytest

from openppmc.model.single.codes import IBF
from tests.bank.model.host import DATA, GO, INIT_B, STATUS, Host

SEEN = 2
"""Number of edges from the first one that samples a switch to the one that detects its level."""


def start(host: Host, axis: int, script: str, init: str = INIT_B) -> int:
    """Initialise and start a motion; return the visit on which it starts."""
    host.ready(axis, init)
    return host.send(axis, script)


@pytest.mark.parametrize("axes, clk_hz", [(8, 100_000_000), (32, 32_000_000), (64, 200_000_000)])
def test_pins_change_on_the_edge_of_their_event(axes, clk_hz):
    """Pins change on the edge of their event: the start, pulse 1 (W cycles later), and the end of the low
    time (BANK-MOT-01); hold falls at the start (BANK-HLD-01).
    """
    host = Host(axes, clk_hz=clk_hz)
    visit = start(host, 3, "c 4C d 09 d 01 d 00 d 00")
    host.idle(3)
    w, interval = host.w, 80 * host.w // 20
    assert host.changes("hold", 3, visit) == [(visit, 0)]
    assert host.changes("dir", 3, visit) == [(visit, 1)]
    first, second = visit + w, visit + w + interval
    assert host.changes("pout_n", 3, visit) == [(first, 0), (first + w, 1), (second, 0), (second + w, 1)]
    assert host.changes("s", 3, visit) == [(first, 0b01001), (second, 0b01100)]
    assert host.model.log.of("pout_n", visit)[0] == (first, (1 << axes) - 1 & ~8)


@pytest.mark.parametrize("pin, status", [("l1_n", 0x97), ("alm_n", 0xA7), ("cnp_n", 0x87)])
@pytest.mark.parametrize("offset, pulses", [(-1, 4), (0, 4), (1, 5)])
def test_switches_act_to_the_clk(pin, status, offset, pulses):
    """A pulse is not output if a cause of an end is detected on the edge of the pulse (BANK-MOT-02)."""
    host = Host()
    visit = start(host, 5, "c 47 d 13")
    due = visit + host.w + 4 * 160 * 25
    host.pin(due - SEEN + offset, 5, **{pin: 0})
    host.idle(5)
    assert host.model.pulses(5, visit) == [due - 4000 * back for back in range(4, 4 - pulses, -1)]
    assert host.finish(5) == (status, (1 << 24) - pulses - 1)
    assert host.position(5) == pulses


def test_bits_belong_to_the_deciding_clk():
    """Only the causes that are detected on the edge that decides the end set their finish bits; a cause that
    is detected a cycle later sets no bit (BANK-MOT-02).
    """
    for late, status in ((0, 0xB5), (1, 0x95)):
        host = Host()
        visit = start(host, 5, "c 45 d 13")
        host.pin(visit + 2000, 5, l1_n=0, **({} if late else {"alm_n": 0}))
        host.pin(visit + 2000 + 1, 5, alm_n=0)
        assert host.finish(5)[0] == status


@pytest.mark.parametrize("early, busy_until", [(6, 0), (5, 0), (4, 8)])
def test_end_without_low_time(early, busy_until):
    """If the end is decided on edge e while pout_n is high, the first visit V >= e + 5 ends the motion
    (BANK-MOT-04, BANK-MOT-03).
    """
    host = Host()
    start(host, 5, "c 45 d 63")
    visit = host.visit(5, 5000)
    assert host.model.outputs["pout_n"] == 255
    host.pin(visit - early - SEEN, 5, alm_n=0)
    assert host.idle(5) == visit + busy_until
    assert host.model.log.falls("int_n") == [visit + busy_until]


@pytest.mark.parametrize("clk_hz, wait", [(100_000_000, 8), (32_000_000, 8)])
def test_end_after_low_time(clk_hz, wait):
    """If the low time ends on edge f, the first visit V >= f + 1 ends the motion; here f is the edge of a
    visit (BANK-MOT-04).
    """
    host = Host(clk_hz=clk_hz)
    visit = start(host, 5, "c 42")
    assert host.idle(5) == visit + 2 * host.w + wait
    other = Host(32)
    visit = start(other, 5, "c 42")
    assert other.idle(5) == visit + 1024


@pytest.mark.parametrize("late", range(8))
def test_end_after_low_time_on_any_edge(late):
    """If the low time ends on edge f, the first visit V >= f + 1 ends the motion; here GO shifts f by single
    cycles (BANK-MOT-04).
    """
    host = Host()
    host.ready(5)
    host.mask(1 << 5)
    held = host.send(5, "c 42")
    go = held + 80 + late
    host.write_at(go, 5, GO, 0)
    low_ended = go + 4 + 8 + 2 * host.w
    ends = [edge for edge in range(low_ended + 1, low_ended + 9) if (edge - held) % 8 == 0]
    assert [host.idle(5)] == ends
    assert host.changes("pout_n", 5, held) == [(low_ended - host.w, 0), (low_ended, 1)]


def test_low_time_ends_first_in_an_immediate_end():
    """An immediate end during a low time takes effect only after this low time (BANK-MOT-04, P104-END-02)."""
    host = Host()
    visit = start(host, 5, "c 45 d 63")
    host.pin(visit + 510, 5, l1_n=0)
    assert host.idle(5) == visit + 1008
    assert host.changes("pout_n", 5, visit) == [(visit + 500, 0), (visit + 1000, 1)]


@pytest.mark.parametrize(
    "known, status, finish", [(4, 0x04, 0xD3), (5, 0x80 | IBF, 0x93), (6, 0x80 | IBF, 0x93)]
)
def test_decelerating_stop_after_an_end(known, status, finish):
    """If an end was decided on edge e, a visit before e + 5 accepts a decelerating stop as if the motion
    continued: the stop sets the deceleration flag and finish bit 6, without error 7 (BANK-MOT-03).
    """
    host = Host(64)
    start(host, 5, "c 43 d E7 d 03 d 00")
    visit = host.visit(5, 3000)
    host.write_at(visit - 20, 5, STATUS, 0x41)
    host.pin(visit - known - SEEN, 5, l1_n=0)
    host.go(visit)
    if known < 5:
        assert host.status(5) == status
    else:
        # The visit ends the motion and does not accept the byte.
        assert host.status(5) == IBF
        host.go(visit + 64)
        assert host.status(5) == 0x80
    assert host.finish(5)[0] == finish


@pytest.mark.parametrize("known, status, finish", [(4, 0x04, 0xD3), (5, 0xF4, 0x93), (6, 0xF4, 0x93)])
def test_decelerating_stop_in_the_last_low_time(known, status, finish):
    """If an end was decided on edge e, a visit from e + 5 on rejects a decelerating stop with error 7, even
    while pout_n is still low (BANK-MOT-03).
    """
    host = Host(64)
    first = start(host, 5, "c 43 d E7 d 03 d 00") + host.w
    visit = host.model.visit(5, first + 100)
    host.write_at(visit - 20, 5, STATUS, 0x41)
    host.pin(visit - known - SEEN, 5, l1_n=0)
    host.go(visit)
    assert host.model.busy(5) and host.status(5) == status
    assert host.finish(5) == (finish, 998)


@pytest.mark.parametrize("code", [0x40, 0x41])
def test_immediate_stop_after_an_end(code):
    """If an end was decided on edge e, an immediate stop sets bit 6 at visit e, but not at later visits
    (BANK-MOT-03).
    """
    for known, finish in ((0, 0xD5), (1, 0x95), (4, 0x95), (5, 0x95)):
        host = Host(64)
        first = start(host, 5, "c 45 d 63") + host.w
        visit = host.model.visit(5, first + 100)
        host.write_at(visit - 20, 5, STATUS, code)
        host.pin(visit - known - SEEN, 5, l1_n=0)
        host.go(visit)
        assert host.status(5) == 0x04
        assert host.finish(5)[0] == finish


@pytest.mark.parametrize("seen, status, finish", [(0, 0xF4, 0x93), (1, 0xF4, 0x83)])
def test_a_pulse_that_did_not_come_counts_until_the_end_is_known(seen, status, finish):
    """After a suppressed pulse, a visit that has not detected the end yet treats this pulse as the last one
    of the motion (BANK-MOT-03, BANK-WIN-07).
    """
    host = Host()
    due = start(host, 5, "c 43 d 00 d 00 d 00") + host.w
    visit = host.model.visit(5, due)
    assert visit == due + 4
    host.write_at(visit - 8, 5, STATUS, 0x41)
    host.pin(due - SEEN + seen, 5, l1_n=0)
    host.go(visit - 1)
    assert host.model.position(5) == 1
    host.go(visit)
    assert host.status(5) == status
    if not seen:
        assert host.model.position(5) == 1 and host.model.busy(5)
        host.go(visit + 7)
        assert host.model.position(5) == 1
        host.go(visit + 8)
        assert host.model.position(5) == 0 and not host.model.busy(5)
    assert host.finish(5) == (finish, 0)
    assert len(host.model.pulses(5)) == host.position(5) == seen


def test_interval_after_a_pulse_that_did_not_come():
    """If a pulse is suppressed, the engine withdraws the pulse and the interval that was planned after it
    (BANK-MOT-03).
    """
    host = Host()
    due = start(host, 5, "c 43 d 09 d 00 d 00") + host.w
    host.pin(due - SEEN, 5, l1_n=0)
    host.go(due + 1)
    assert len(host.model.intervals(5)) == 1
    assert host.finish(5) == (0x93, 9) and host.model.intervals(5) == []


def test_interval_of_a_stopped_move_dies_with_it():
    """A pulse that was planned in a stopped move is neither output nor counted in the next move (BANK-MOT-02,
    BANK-WIN-07).
    """
    host = Host()
    first = start(host, 5, "c 45 d FF") + host.w
    host.pin(first + 2000, 5, l1_n=0)
    host.pin(first + 2100, 5, l1_n=1)
    begun = host.send(5, "c 45 d FF")
    second = begun + host.w
    host.go(first + 51_200 + 8)
    assert host.model.pulses(5) == [first, second] and host.model.position(5) == 2
    host.go(second + 51_200)
    assert host.model.pulses(5) == [first, second, second + 51_200]


@pytest.mark.parametrize("stop_at, pulses", [(-8, 1), (0, 1), (8, 2)])
def test_immediate_stop_and_the_pulse_of_its_own_edge(stop_at, pulses):
    """A stop that visit V accepts suppresses a pulse scheduled for edge V, and this pulse is not counted
    (BANK-MOT-03, P104-LIM-09).
    """
    host = Host(clk_hz=32_000_000)
    visit = start(host, 5, "c 45 d 63")
    due = visit + host.w + 800 * 8
    assert host.model.visit(5, due) == due
    host.write_at(due + stop_at - 7, 5, STATUS, 0x40)
    host.go(due + stop_at)
    assert host.model.position(5) == pulses
    assert host.idle(5) >= due + stop_at + 8
    assert host.finish(5) == (0xC5, (1 << 24) - pulses - 1)
    assert len(host.model.pulses(5, visit)) == host.position(5) == pulses


def test_stop_and_limit_on_one_edge():
    """A stop and a limit on the same edge set both finish bits (P104-LIM-09)."""
    host = Host()
    start(host, 5, "c 45 d 63")
    visit = host.visit(5, 3000)
    host.write_at(visit - 8, 5, STATUS, 0x40)
    host.pin(visit - SEEN, 5, l1_n=0)
    assert host.finish(5)[0] == 0xD5


@pytest.mark.parametrize("early, inputs", [(5, 0xC7), (4, 0xC7), (3, 0xCF)])
def test_read_of_the_switches(early, inputs):
    """Command 0x81 at visit V returns the levels of the switches detected on edge V - 4 (BANK-MOT-05)."""
    host = Host()
    visit = host.visit(5)
    host.write_at(visit - 8, 5, STATUS, 0x81)
    host.pin(visit - early - SEEN, 5, l1_n=0)
    host.go(visit + 1)
    assert host.read(5, DATA) == inputs


@pytest.mark.parametrize("early, pulses", [(5, 6), (4, 6), (3, 8)])
def test_slow_limit(early, pulses):
    """A slow-down limit that is detected on edge V - 4 sets the deceleration flag at visit V, in time for a
    pulse on edge V (BANK-MOT-05).
    """
    host = Host(clk_hz=32_000_000)
    visit = start(host, 5, "c 43 d E7 d 03 d 00")
    due = visit + host.w + (20 + 18 + 16) * 8 * 8
    assert host.model.visit(5, due) == due
    host.pin(due - early - SEEN, 5, l3_n=0)
    assert host.finish(5) == (0x8B, 1000 - pulses - 1)
    assert host.model.pulses(5)[3] == due and len(host.model.pulses(5)) == pulses


@pytest.mark.parametrize("first, length, status", [(11, 7, 0x04), (12, 7, 0xF4), (11, 8, 0xF4)])
def test_slow_limit_between_visits_is_not_seen(first, length, status):
    """A slow-down limit has an effect only if it is active 4 cycles before a visit; here it is active between
    two visits (BANK-MOT-05).
    """
    host = Host()
    start(host, 5, "c 43 d E7 d 03 d 00")
    visit = host.visit(5, 1000)
    host.pin(visit - first - SEEN, 5, l3_n=0)
    host.pin(visit - first - SEEN + length, 5, l3_n=1)
    host.go(visit + 1)
    host.write(5, STATUS, 0x41)
    host.go(visit + 16)
    assert host.status(5) == status


def test_slow_limit_before_the_start_and_in_pulse_mode():
    """If a slow-down limit is active before the start, a move has one pulse; in POUT mode the limit takes
    effect from the plateau on (BANK-MOT-05, P104-FDC-03, P104-LIM-04, P104-EX-05).
    """
    for script, pulses in (("c 43 d E7 d 03 d 00", 1), ("c C3 d E7 d 03 d 00", 22)):
        host = Host()
        host.pin(host.t, 5, l3_n=0)
        start(host, 5, script)
        assert host.finish(5) == (0x8B, 999 - pulses)
        assert len(host.model.pulses(5)) == pulses


def test_slow_limit_of_the_high_part():
    """A slow-down limit that becomes active in the state HIGH also takes effect in POUT mode (P104-LIM-04,
    BANK-MOT-05).
    """
    host = Host()
    visit = start(host, 5, "c C6")
    host.go(visit + 60_000)
    before = len(host.model.pulses(5))
    host.pin(host.t, 5, l3_n=0)
    host.idle(5)
    assert len(host.model.pulses(5)) == before + 11 and host.finish(5)[0] == 0x8E


def test_both_requests_in_one_visit():
    """A slow-down limit and a decelerating stop at one visit set finish bits 3 and 6, without an error
    (P104-LIM-09 (3)).
    """
    host = Host(64)
    start(host, 5, "c 43 d E7 d 03 d 00")
    visit = host.visit(5, 2000)
    host.write_at(visit - 20, 5, STATUS, 0x41)
    host.pin(visit - 4 - SEEN, 5, l3_n=0)
    host.go(visit)
    assert host.status(5) == 0x04 and host.finish(5)[0] == 0xCB


def test_axes_do_not_disturb_each_other():
    """The edges of a move are the same whether it runs alone or together with 31 others (BANK-MOT-01)."""
    alone, crowd = Host(32), Host(32)
    for axis in range(32):
        crowd.ready(axis, "c 0A d 05 d 05 d 04 d 00")
    alone.ready(17)
    crowd.ready(17)
    for axis in range(32):
        if axis != 17:
            crowd.send(axis, f"c 45 d {axis:02X}")
    moves = []
    for host in (alone, crowd):
        visit = host.send(17, "c 43 d 20 d 00 d 00")
        host.idle(17)
        moves.append([edge - visit for edge in host.model.pulses(17, visit)])
    assert moves[0] == moves[1] and len(moves[0]) == 33
