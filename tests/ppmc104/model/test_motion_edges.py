"""Coincidences of events in the motion of the golden model, exact to the cycle.

Rules: P104-LIM-09, P104-END, P104-FDC-06.

W is the pulse and set-up time of 5 us in cycles. The C-event of a byte is the edge on which the core consumes
it.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest

from tests.ppmc104.model.host import INIT_A, INIT_B, NOMINAL
from tests.ppmc104.model.host import Host as AnyHost

ModelHost = partial(AnyHost, latency=NOMINAL)


def moving(script: str, **changes: int) -> AnyHost:
    """Return a host that has sent `script` to a core whose constants differ from NOMINAL by `changes`."""
    host = AnyHost(latency=replace(NOMINAL, **changes))
    host.run(script)
    return host


def stop_at(host: AnyHost, code: int, edge: int) -> None:
    """Write a command with its C-event on `edge`."""
    host.go(edge - 6)
    host.write(1, code)


@pytest.mark.parametrize("offset, pulses", [(-1, 5), (0, 5), (1, 6), (2, 6)])
def test_cause_on_the_edge_of_a_pulse_event(offset, pulses):
    """A cause of an immediate end suppresses a pulse event on the same edge, but not on the edge before."""
    for cause in ("limit", "stop"):
        host = moving(INIT_A + " c 45 d 13")
        event = host.fall(5) - 1 + 640
        if cause == "limit":
            host.go(event + offset - 2)
            host.pins(l1_n=0)
        else:
            stop_at(host, 0x40, event + offset)
        mark = host.mark
        host.idle()
        host.mark = mark
        assert len(host.pulses()) == pulses
        assert host.finish() == (0x95 if cause == "limit" else 0xC5, (1 << 24) - pulses - 1)


@pytest.mark.parametrize("lead, honoured", [(0, [0, 0]), (1, [-1, 0]), (4, [-4, -3])])
def test_flag_close_to_a_pulse_event(lead, honoured):
    """A deceleration flag takes effect at a pulse event if it is set at least `flag_lead` cycles before it
    (P104-FDC-06).
    """
    latest, too_late = honoured
    for offset, pulses in ((latest, 8), (too_late, 10 if lead else 8)):
        host = moving(INIT_B + " c 43 d E7 d 03 d 00", flag_lead=lead)
        host.fall(4)
        event = host.fall(4) - 1 + 32 * 15
        stop_at(host, 0x41, event + offset)
        host.idle()
        assert len(host.model.pulses) == pulses


def test_limit_and_alarm_on_one_edge_set_both_bits():
    host = moving(INIT_A + " c 4E")
    host.fall(3, 100)
    host.pins(l2_n=0, alm_n=0, cnp_n=0, l1_n=0)
    assert host.finish()[0] == 0xB6


def test_slow_limit_and_command_on_one_edge_set_both_bits():
    host = moving(INIT_B + " c 43 d E7 d 03 d 00")
    edge = host.fall(4) + 100
    host.go(edge - 6)
    host.write(1, 0x41, gap=2)
    host.go(edge - 2)
    host.pins(l3_n=0)
    assert host.finish() == (0xCB, 991)


def test_hard_limit_while_decelerating_for_the_slow_one():
    host = moving(INIT_B + " c 43 d E7 d 03 d 00")
    host.fall(6, 50)
    host.pins(l3_n=0)
    host.fall(8, 50)
    host.pins(l1_n=0)
    assert host.finish() == (0x9B, 991)


def test_slow_limit_released_before_the_plateau_is_lost_in_pulse_mode():
    host = moving(INIT_B + " c C3 d E7 d 03 d 00")
    high = host.fall(11)
    host.go(high + 1)
    host.pins(l3_n=0)
    host.go(high + 30)
    host.pins(l3_n=1)
    assert host.finish()[0] == 0x8B
    host = moving(INIT_B + " c C3 d E7 d 03 d 00")
    host.fall(9, 5)
    host.pins(l3_n=0)
    host.go(host.fall(10) + 300)
    host.pins(l3_n=1)
    assert host.finish() == (0x83, 0)


def test_end_edges_of_an_immediate_stop():
    """If pout_n is high when an immediate end is decided, BUSY falls imm_end cycles later (a latency
    constant); if pout_n is low, BUSY falls when pout_n rises.
    """
    for after, expected in ((200, 200 + 2 + 1), (80, 80 + 2 + 1), (78, 81), (77, 80), (10, 80), (0, 80)):
        host = moving(INIT_A + " c 45 d 63")
        fall = host.fall(3)
        host.go(fall + max(after, 1))
        host.pins(alm_n=0)
        host.idle()
        expected = expected if after else 80
        assert host.model.log.falls("int_n") == [fall + expected], after
        assert host.lows()[-1:] in ([], [80])


def test_cause_at_the_start_needs_two_clk():
    """If a cause is active at the start, the end is decided on the edge after the start edge and takes effect
    one cycle later (P104-LIM-07).
    """
    host = ModelHost()
    host.run(INIT_A)
    host.pins(alm_n=0)
    host.pause(400)
    host.run("c 42")
    start = host.written + 2
    host.pause(10)
    host.sync()
    assert host.model.log.falls("int_n") == [start + 2]
    assert host.model.log.falls("hold") == [start + 1]
    host.pause(560_000)
    host.sync()
    assert host.model.log.rises("hold") == [start + 2 + 544_000 + 1]


def test_operation_on_the_edge_of_the_hold_time_keeps_hold_low():
    for offset, glitch in ((0, False), (1, True)):
        host = moving(INIT_A + " c 42")
        host.idle()
        stop_at(host, 0x42, host.model.log.falls("int_n")[0] + 544_000 + offset)
        host.pause(100)
        host.sync()
        assert bool(host.model.log.rises("hold")) == glitch


def test_latency_moves_what_it_names():
    """Each latency constant of the core shifts only the edges that it describes."""

    def run(**changes: int) -> tuple[int, ...]:
        host = moving(INIT_A, **changes)
        host.pause(400)
        host.run("c 42")
        host.idle()
        host.pause(4)
        host.sync()
        log = host.model.log
        (step,) = log.of("s", host.mark)
        edges = (log.falls("hold")[0], log.falls("pout_n")[0], step[0], log.falls("int_n")[0])
        return tuple(edge - host.written for edge in edges)

    assert run() == (3, 84, 84, 164)
    assert run(motor_pins=0) == (2, 83, 83, 163)
    assert run(c_event=5) == (6, 87, 87, 167)
    assert run(start_extra=0) == (3, 83, 83, 163)
    assert run(end_extra=3) == (3, 84, 84, 167)
    assert run(host_pins=2) == (3, 84, 84, 166)


def test_chopper_phase_survives_neither_start_nor_reset():
    host = moving("c 2A d 09 d 04 d 04 d 00")
    host.pause(1500)
    host.sync()
    assert host.out("s") == 0
    host.run("c 42")
    start = host.written + 2
    host.idle()
    assert host.model.log.of("s", start - 3)[:1] == [(start + 1, 0b00011)]
    end = host.model.log.falls("int_n")[0]
    host.pause(1100)
    host.sync()
    assert host.model.log.of("s", end)[0] == (end + 1041, 0)


def test_suppressed_base_edge_when_the_clock_gets_faster():
    """While pout_n is low, a base edge that would make a pulse is not counted (P104-TIM-05)."""
    host = moving("c 1A d 09 d 04 d 04 d 00 c 44 d 00 d 02 d 00 d 00")
    for rise in (0, 300, 320, 340, 360, 380, 600, 900):
        host.model.pins(1000 + rise, clock=1)
        host.model.pins(1000 + rise + 8, clock=0)
    host.t = 2200
    host.sync()
    assert [fall - 1000 - 3 for fall in host.pulses()] == [0, 300, 600]
    assert host.lows() == [80, 80, 80]


def test_external_clock_without_vsel_puts_the_pulse_off():
    """With vsel low, the part of 7.5 us that has not passed at edge e_a delays the pulse after edge e_b,
    unless the clock is slow at e_b. Both edges are those of P104-INT-03.
    """
    host = moving("c 1A d 09 d 04 d 04 d 00")
    host.pins(vsel=0)
    host.pause(6)
    host.run("c 44 d 01 d 03 d 00 d 00")
    start = host.t + 200
    # Rising edges of the clock. The edge at time 0 causes pulse 1. In the last interval the clock is so slow
    # that no extra time is added.
    for rise in (0, 50, 100, 260, 300, 340, 500, 700, 900, 1100, 1300):
        host.model.pins(start + rise, clock=1)
        host.model.pins(start + rise + 8, clock=0)
    host.t = start + 2000
    host.sync()
    first, *rest = (fall - start - 3 for fall in host.pulses())
    # In P104-INT-03, w is the time from a pulse to its first edge e_a, and the next pulse follows edge e_b.
    # Pulse 2: e_b = 100, w = 0, so 220. Pulse 3: e_a = 260, w = 40, e_b = 340, so 420. Pulse 4: e_b = 900,
    # where the clock is slow.
    assert (first, rest) == (0, [220, 420, 900])


def test_level_seen_on_the_start_edge_is_judged_one_clk_later():
    host = moving(INIT_A)
    host.pause(400)
    edge0 = host.model.write(host.t, 1, 0x42)
    host.model.pins(edge0 + 2, alm_n=0)
    host.go(edge0 + 20)
    host.sync()
    start = edge0 + 4
    assert host.model.log.falls("int_n") == [start + 2]


@pytest.mark.parametrize("rate, low", [(0, 16), (1, 32), (2, 48), (3, 80), (9, 80)])
def test_low_time_of_the_fastest_rates(rate, low):
    """At 500 kHz with vsel = H, rates 0 to 2 have a low time of half the interval; otherwise it is W
    (P104-TIM-05).
    """
    for csel, vsel, expected in ((1, 1, low), (0, 1, 80), (1, 0, 80)):
        host = moving(INIT_A)
        host.pins(csel=csel, vsel=vsel)
        host.pause(400)
        host.run(f"c 44 d {rate:02X} d 02 d 00 d 00")
        host.idle()
        host.pause(4)
        host.sync()
        assert host.lows() == [expected, expected, 80]


def test_interval_of_a_stopped_move_dies_with_it():
    host = moving(INIT_A)
    host.pins(csel=0)
    host.pause(400)
    host.run("c 45 d FF")
    host.fall(1, 100)
    host.command(0x40)
    host.idle()
    host.run("c 44 d FF d 02 d 00 d 00")
    host.idle()
    assert host.intervals() == [32_768, 32_768] and host.model.log.of("s")[-1][1] == 0b00011


def test_flagged_move_that_reaches_all_pulses_is_complete():
    """A move with a deceleration flag that outputs all its pulses is complete (P104-FDC-05, P104-END-05)."""
    host = moving(INIT_B + " c 43 d 01 d 00 d 00")
    host.fall(1, 100)
    assert host.command(0x41) == 0x04
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 2


@pytest.mark.parametrize("move, status", [("c 43 d 02 d 00 d 00", 0xF4), ("c 44 d 13 d 02 d 00 d 00", 0x04)])
def test_stops_in_the_last_low_time(move, status):
    """In the last low time of a ramped move, command 0x41 returns error 7; other stops are accepted and have
    no effect (P104-STP-08).
    """
    host = moving(INIT_B + " " + move)
    host.fall(3, 8)
    assert host.command(0x41) == status
    assert host.command(0x40) == 0x04
    assert host.finish()[0] & 0xF8 == 0x80


def test_limit_on_the_edge_of_the_start_acts_as_one_that_was_there_before():
    """A limit that becomes active on the start edge has the effect of one that was active before, because the
    limits are evaluated from the next cycle on.
    """
    ends = []
    for early in (True, False):
        host = moving(INIT_A)
        if early:
            host.pins(l1_n=0)
        host.pause(400)  # long enough to build the ramp table
        event = host.write(1, 0x46)
        if not early:
            host.go(event)  # detected 2 cycles later, on the C-event
            host.pins(l1_n=0)
        host.pause(20)
        host.sync()
        ends.append([edge - event for edge, _ in host.model.log.of("int_n", event)])
        assert host.finish()[0] == 0x96
    assert ends[0] == ends[1] != []
