"""Bytes of the bank's model: the visit that accepts a byte, and the rejected codes (BANK-HSK, BANK-GEN).

V is the edge of a visit of the axis, w the edge of a write event, and R the number of cycles in a round.
"""

from __future__ import annotations

import pytest

from openppmc.model.single.codes import IBF, OBF
from tests.bank.model.host import CONFIG, DATA, GO, INIT_A, STATUS, Host


@pytest.mark.parametrize("early, taken", [(8, 0), (7, 0), (6, 8)])
def test_first_visit_that_sees_a_byte(early, taken):
    """A byte with its write event at w is accepted at the first visit V >= w + 7 (BANK-HSK-01)."""
    host = Host()
    visit = host.visit(3)
    host.write_at(visit - early, 3, STATUS, 0x87)
    for edge, status in ((visit - early - 1, 0), (visit - early, IBF), (visit + taken - 1, IBF)):
        if edge > host.model.now:
            host.go(edge)
            assert host.status(3) == status
    host.go(visit + taken)
    assert host.status(3) == 0x80 and host.status(2) == 0


@pytest.mark.parametrize("early, status", [(8, 0x20), (7, 0x20), (6, 0x80 | IBF), (0, 0x80 | IBF)])
def test_byte_replaced(early, status):
    """Visit V accepts the newest byte written at V - 7 or earlier; a byte written later waits with IBF = 1
    (BANK-HSK-03).
    """
    host = Host(64)
    visit = host.visit(3)
    host.write_at(visit - 20, 3, STATUS, 0x87)
    host.write_at(visit - early, 3, STATUS, 0x84)
    host.go(visit)
    assert host.status(3) == status
    host.go(visit + 64)
    assert host.status(3) == 0x20


def test_status_read_with_a_byte_in_the_buffer():
    """All bits of the status change on the edge of the visit that accepts a byte (BANK-HSK-01,
    BANK-HSK-04).
    """
    host = Host(64)
    host.t = host.model.visit(9, 400) - 12
    host.write(9, STATUS, 0x84)
    assert host.read(9, STATUS) == IBF
    host.t += 60
    assert host.read(9, STATUS) == 0x20 and host.read(8, STATUS) == 0


def test_end_of_a_motion_takes_the_visit():
    """A visit that ends a motion does not accept a waiting byte; the next visit accepts it (BANK-HSK-02)."""
    host = Host()
    host.ready(1)
    start = host.send(1, "c 42")
    end = start + 2 * host.w + 8
    host.write_at(end - 10, 1, STATUS, 0x40)
    host.go(end)
    assert host.status(1) == IBF and not host.model.busy(1)
    host.go(end + 8)
    assert host.status(1) == 0x80


def test_completion_takes_the_visit():
    """The visit that completes an initialisation does not accept a waiting byte; the next visit accepts it
    (BANK-HSK-02, BANK-INI-02).
    """
    host = Host(64)
    last = host.send(1, "c 0A d 05 d 05 d 04 d 00")
    host.write_at(last + 20, 1, STATUS, 0x42)
    host.go(last + 127)
    assert host.status(1) == IBF
    host.go(last + 128)
    assert host.status(1) == 0x04


def test_go_and_byte_at_one_visit():
    """A visit that detects GO accepts no byte (BANK-HSK-02, BANK-GRP-02)."""
    host = Host(64)
    host.mask(0b10)
    visit = host.visit(1)
    host.write_at(visit - 12, 1, STATUS, 0x84)
    host.write_at(visit - 7, 0, GO, 0)
    host.go(visit)
    assert host.status(1) == 0xA0 | IBF
    host.go(visit + 64)
    assert host.status(1) == 0x20
    assert host.status(2) == 0


@pytest.mark.parametrize("round_before, waits", [(0, True), (1, False)])
@pytest.mark.parametrize("quanta, rest, clk_hz", [(260, 0, 32 * 10**6), (260, 4, 10**8), (695, 7, 10**8)])
def test_edge_of_the_chopper_takes_the_visit(quanta, rest, clk_hz, round_before, waits):
    """A visit accepts no byte if it schedules an edge of the chopper for the edge of the visit or for one of
    the next R - 1 edges (BANK-HSK-02, BANK-CHP-01).
    """
    host = Host(4, clk_hz=clk_hz)
    last = host.send(3, "c 2A d 05 d 05 d 04 d 00")
    boundary = last + 8 + quanta * host.w // 20
    visit = boundary - rest - 8 * round_before
    assert host.model.visit(3, visit) == visit
    host.write_at(visit - 7, 3, STATUS, 0x87)
    host.go(visit)
    assert bool(host.status(3) & IBF) == waits
    host.go(visit + 8)
    assert host.status(3) == 0x80
    host.go(boundary + 8)
    assert host.changes("s", 3, last + 1)[-1][0] == boundary


def test_answers():
    """After a data read, the next byte is loaded with OBF still 1; the last read clears OBF on edge 2 after
    its end (BANK-HSK-04).
    """
    host = Host()
    host.send(2, "c 83")
    for left in (2, 1, 0):
        begin = host.t
        host.read(2, DATA)
        host.go(begin + 7)
        assert host.status(2) == OBF
        host.go(begin + 8)
        assert host.status(2) == (OBF if left else 0)
        assert host.model.log.of("d_o", begin + 5) == []


@pytest.mark.parametrize("late, left", [(1, 0), (2, 0), (3, OBF), (8, OBF), (9, OBF)])
def test_new_answer_while_the_old_one_is_read(late, left):
    """If a new answer is stored during a read that returns the old one, the end of the read does not clear
    OBF (BANK-HSK-04).
    """
    host = Host(64)
    host.send(2, "c 80")
    visit = host.visit(2)
    host.write_at(visit - 30, 2, STATUS, 0x81)
    host.t = visit - late
    old_or_new = host.read(2, DATA)
    assert old_or_new == (0xCF if late <= 2 else 0)
    host.go(visit + 20)
    assert host.status(2) == left


@pytest.mark.parametrize("rl", range(9, 13))
@pytest.mark.parametrize("axis", [5, 6])
def test_one_builder(axis, rl):
    """While a table of another axis is built, the last byte of an initialisation waits; visits from 2 cycles
    after the end of the build accept it (BANK-HSK-05, BANK-INI-01).
    """
    host = Host()
    host.send(1, f"c 0A d {rl:02X} d 04 d 04")
    host.send(axis, "c 0A d 09 d 04 d 04")
    done = host.send(1, "d 00") + host.model.latency.build(rl, 4, 4)
    host.write(axis, DATA, 0)
    (taken,) = (edge for edge in range(done + 2, done + 10) if edge % 8 == axis)
    host.go(taken - 1)
    assert host.status(axis) == 0x10 | IBF
    host.go(taken)
    assert host.status(axis) == 0 and host.model.initialised(axis)


def test_command_need_not_wait_for_the_builder():
    """A command does not wait for the table of another axis, and replaces the last byte of an initialisation
    that waits (BANK-HSK-05).
    """
    host = Host()
    host.send(6, "c 0A d 09 d 04 d 04")
    built = host.send(1, INIT_A)
    host.write(6, DATA, 0)
    host.t += 30
    assert host.read(6, STATUS) == 0x10 | IBF
    assert host.send(6, "c 84") < built + 200
    assert host.status(6) == 0x20


def _defined(code: int) -> bool:
    """Return whether a code of the PPMC-104 is defined for a bank."""
    if code < 0x40:
        return bool(code & 3) and not code & 0x10
    if code < 0x80:
        return code & 7 > 1
    return code in (0x80, 0x81, 0x82, 0x83, 0x84) or (code >= 0xC0 and code & 7 in (0, 3, 6))


def test_codes():
    """Of all 256 codes, an axis without an initialisation accepts exactly the defined ones (BANK-GEN-03)."""
    host = Host()
    for code in range(256):
        host.send(code % 8, f"c {code:02X}")
        status = host.status(code % 8) & ~OBF
        assert (status != 0x80) == _defined(code), hex(code)


def test_codes_while_busy():
    """While BUSY = 1, code C0 (excitation off) returns error 1; the two stop codes are accepted
    (BANK-GEN-03).
    """
    host = Host()
    host.ready(0)
    host.send(0, "c 46")
    for code, status in ((0xC0, 0x94), (0xF8, 0x94), (0xC1, 0x84), (0x86, 0x84), (0x85, 0x84), (0x80, 0x94)):
        host.send(0, f"c {code:02X}")
        assert host.status(0) == status
    host.send(0, "d 11")
    assert host.status(0) == 0xE4
    host.send(0, "c 41")
    assert host.status(0) == 0x04


@pytest.mark.parametrize("early, slow", [(8, True), (7, True), (6, False)])
def test_config_of_an_operation(early, slow):
    """An operation uses a CONFIG value if it was written at least 7 cycles before the visit that starts the
    operation (BANK-GEN-04).
    """
    host = Host(64)
    host.ready(4)
    host.send(4, "c 44 d 09 d 01 d 00")
    visit = host.visit(4)
    host.write_at(visit - 20, 4, DATA, 0)
    host.write_at(visit - early, 4, CONFIG, 0b10)
    host.go(visit)
    assert host.model.busy(4)
    host.idle(4)
    first, second = host.model.pulses(4)
    assert second - first == (4 if slow else 1) * 80 * 25
