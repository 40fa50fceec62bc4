"""The bank's model at standstill: initialisation, chopper, hold (BANK-INI, BANK-CHP, BANK-HLD)."""

from __future__ import annotations

import pytest

from openppmc.model.bank import part
from openppmc.model.clock import Latency
from tests.bank.model.host import CONFIG, DATA, STATUS, Host

FLAT = "c 2A d 05 d 05 d 04 d 00"


@pytest.mark.parametrize("rl, rh", [(9, 4), (200, 20), (255, 0), (30, 29)])
def test_completion(rl, rh):
    """The phases change at the visit of the last byte; the times of the chopper are counted from the
    completion of the initialisation (BANK-INI-01, BANK-INI-02).
    """
    for axis in range(8):
        host = Host()
        last = host.send(axis, f"c 2A d {rl:02X} d {rh:02X} d 04 d 00")
        done = last + host.model.latency.build(rl, rh, 4)
        complete = next(edge for edge in range(done + 3, done + 11) if (edge - axis) % 8 == 0)
        host.go(complete + 260 * 25)
        assert host.changes("s", axis, 0) == [(last, 0b00011), (complete + 260 * 25, 0)]


@pytest.mark.parametrize("wait", [4, 3, 10])
def test_completion_to_the_clk(wait, monkeypatch):
    """The initialisation completes at the first visit 3 or more cycles after the end of the build
    (BANK-INI-02).

    Here the build ends 4, 3 and 2 cycles before a visit.
    """
    build = 4000 - wait
    monkeypatch.setattr(part, "Latency", lambda **rest: Latency(build_clk=lambda rl, rh, pa: build, **rest))
    host = Host()
    last = host.send(2, "c 0A d 14 d 0A d 04 d 00")
    host.write_at(last + 20, 2, STATUS, 0x42)
    # The visit that completes the initialisation does not accept the byte; the next visit accepts it.
    started = last + build + wait + 8
    host.go(started - 1)
    assert not host.model.busy(2)
    host.go(started)
    assert host.model.busy(2)


def test_chopper_after_completion_and_after_a_motion():
    """The edges of the chopper are exact to the cycle (BANK-CHP-01, P104-SW-02..04)."""
    host = Host()
    complete = host.send(3, FLAT) + 8
    host.go(complete + 1000 * 25)
    s = [(complete + 260 * 25, 0), (complete + 695 * 25, 3), (complete + 955 * 25, 0)]
    assert host.changes("s", 3, complete) == s
    start = host.send(3, "c 42")
    end = host.idle(3)
    host.go(end + 700 * 25)
    assert host.changes("s", 3, start) == [
        (start, 3),
        (start + 500, 6),
        (end + 260 * 25, 0),
        (end + 695 * 25, 6),
    ]


@pytest.mark.parametrize("early, off", [(8, 115), (7, 115), (6, 132)])
def test_config_of_a_phase(early, off):
    """A phase of the chopper uses vsel as written 7 cycles before the visit that schedules its first edge
    (BANK-GEN-04).
    """
    host = Host()
    host.send(3, "c 84 d 00 d 00")
    complete = host.send(3, FLAT) + 8
    boundary = complete + 108 * 25
    ordering = boundary - 4
    assert host.model.visit(3, ordering) == ordering
    host.write_at(ordering - early, 3, CONFIG, 0b01)
    host.go(boundary + (off + 100) * 25)
    assert host.changes("s", 3, complete)[:2] == [(boundary, 0), (boundary + off * 25, 3)]


def test_reinitialisation_keeps_chopping_until_it_completes():
    """During a re-initialisation the chopping continues unchanged until the re-initialisation completes
    (P104-INI-08, BANK-INI-02, BANK-CHP-01).
    """
    host = Host()
    complete = host.send(3, FLAT) + 8
    host.go(complete + 5000)
    last = host.send(3, "c 2A d FF d 00 d 04 d 00")
    second = host.model.visit(3, last + host.model.latency.build(255, 0, 4) + 5)
    host.go(second + 300 * 25)
    edges = host.changes("s", 3, complete)
    cycle = [complete + n * 695 * 25 + phase for n in range(9) for phase in (260 * 25, 695 * 25)]
    before = [edge for edge in cycle if edge < second]
    assert [edge for edge, _ in edges if edge < second] == before
    assert [edge for edge, level in edges if edge >= second and not level] == [second + 260 * 25]


@pytest.mark.parametrize("init", ["c 0A d 05 d 05 d 04 d 00", FLAT])
def test_hold(init):
    """hold rises CYC(544000) cycles after the end, here at a visit, with and without chopping (BANK-HLD-01,
    P104-END-08).
    """
    host = Host(4, clk_hz=32_000_000)
    host.ready(1, init)
    host.send(1, "c 42")
    end = host.idle(1)
    due = end + host.model.timebase.cyc(544_000)
    assert host.model.visit(1, due) == due
    host.go(due + 100)
    assert host.changes("hold", 1, end) == [(due, 1)]
    start = host.send(1, "c 42")
    assert host.changes("hold", 1, due + 1) == [(start, 0)]


def _on_time(on: int, off: int) -> bool:
    """Return whether the chopper has an edge 136 000 quanta after its start."""
    return 136_000 % (on + off) in (0, on)


@pytest.mark.parametrize("hit", [True, False])
def test_hold_on_an_edge_of_the_chopper(hit):
    """If a visit schedules an edge of the chopper, hold does not rise at this visit but at the next one
    (BANK-HLD-01).
    """
    p_on, p_off = next((a, b) for a in range(256) for b in range(256) if _on_time(12 * a + 100, 12 * b + 115))
    host = Host(4, clk_hz=32_000_000)
    host.write(1, CONFIG, 0b01)
    host.send(1, f"c 84 d {p_on:02X} d {p_off if hit else p_off ^ 1:02X}")
    host.ready(1, FLAT)
    host.send(1, "c 42")
    end = host.idle(1)
    due = end + host.model.timebase.cyc(544_000)
    host.go(due + 100)
    assert (due in [edge for edge, _ in host.changes("s", 1, end)]) == hit
    assert host.changes("hold", 1, end) == [(due + (8 if hit else 0), 1)]


def test_excitation_off_and_second_initialisation():
    """On an axis of a bank, excitation off takes effect immediately and does not change the other axes
    (P104-INI-05, P104-AUX-04).
    """
    host = Host()
    host.ready(2)
    off = host.send(2, "c C0")
    last = host.send(2, "c 0E d 05 d 05 d 04 d 00")
    assert host.changes("s", 2, off) == [(off, 0), (last, 3)]
    assert all(host.out("s", axis) == 31 for axis in range(8) if axis != 2)
    host.send(2, "c 82")
    assert host.read(2, DATA) == 0xC4


def test_output_register_shows_pins_of_its_axis():
    """On an axis of a bank, read command 82 returns the phases, hold and dir of this axis (P104-RD-06)."""
    host = Host()
    for axis, code in ((0, 0x42), (2, 0x4A)):
        host.ready(axis)
        host.send(axis, f"c {code:02X}")
        host.idle(axis)
    host.ready(3)
    assert [host.answer(axis, 0x82) for axis in (0, 2, 3, 4)] == [0x60, 0x92, 0xC4, 0xFC]
