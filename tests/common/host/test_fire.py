"""The drivers on lines with faults: some sessions of `make fire`, and proof that it detects wrong drivers."""

from __future__ import annotations

from typing import Any

import pytest

from openppmc.host import Disconnected, Link, Ppmc104
from openppmc.host.axis import Axis
from openppmc.host.frames import Session
from openppmc.host.model_port import ModelPort
from scripts.measure.fire import sweep
from scripts.measure.fire.boards import TARGETS
from scripts.measure.fire.line import DELAYS, OTHER_PROGRAM, STOLEN, Fault, FaultyLine, Kind
from scripts.measure.fire.session import KILLED, Killed
from scripts.measure.fire.sweep import KINDS, play, sizes

SAMPLE = 24
"""Number of sessions of each board."""


@pytest.mark.parametrize("name", TARGETS)
def test_what_a_driver_states_is_true(name: str) -> None:
    """After any fault, a driver states the true position, or raises one clear error.

    Each kind of fault occurs, at places that are spread over the whole session.
    """
    size = sum(sizes(name, 0))
    seeds = [size * number // SAMPLE + size * (number % len(KINDS)) for number in range(SAMPLE)]
    played = [play(name, seed) for seed in seeds]
    assert [one.error for one in played if one.error] == []
    assert {fault.kind for one in played for fault in one.faults} == set(KINDS)
    assert {one.outcome for one in played} >= {"as requested", "Disconnected", KILLED}


def test_consecutive_seeds_damage_every_byte() -> None:
    name = "ppmc104-115200"
    to_host, to_board = sizes(name, 0)
    places = {(True, place) for place in range(to_board)} | {(False, place) for place in range(to_host)}
    found: dict[Any, set[Kind]] = {place: set() for place in places}
    for seed in range(len(places) * len(KINDS)):
        number, (fault,) = sweep.faults_of(name, seed)
        found[fault.to_board, fault.place].add(fault.kind)
        assert number == 0
    assert all(kinds == set(KINDS) for kinds in found.values())
    number, faults = sweep.faults_of(name, len(places) * len(KINDS))
    assert number == 1 and len(faults) == 2


def test_a_bit_that_the_checksum_misses_is_not_inverted() -> None:
    """The checksum of the PPMC-312 does not contain bit 7 of a byte, so this bit is not part of the sweep."""
    name = "ppmc312-serial"
    faults = [fault for seed in range(4000) for fault in sweep.faults_of(name, seed)[1]]
    flips = [fault for fault in faults if fault.kind is Kind.FLIP]
    assert {fault.detail % 8 for fault in flips if fault.to_board} == {0, 1, 2, 4, 5, 6, 7}
    assert {fault.detail % 8 for fault in flips if not fault.to_board} == set(range(8))


def test_a_wrong_statement_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """`make fire` reports a driver that does not check the counter, and a link that ignores SEQ."""
    name = "ppmc104-115200"
    seeds = range(3, 4000, 41)
    monkeypatch.setattr(Axis, "_check_count", lambda axis, count: count)
    assert any("position 0 is stated" in play(name, seed).error for seed in seeds)
    monkeypatch.undo()
    request = Session.request

    def always_0(session: Session, script: bytes, patience: float, now: float) -> bytes:
        session._next_seq = 0
        return request(session, script, patience, now)

    monkeypatch.setattr(Session, "request", always_0)
    assert any(play(name, seed).error for seed in seeds)


# ---------------------------------------------------------------------- the line


class Board:
    """Port that returns each byte that it receives. Its time advances only in `read`."""

    name = "board"

    def __init__(self) -> None:
        self.received = b""
        self.waiting = b""
        self.now = 0.0

    def read(self, timeout: float) -> bytes:
        data, self.waiting = self.waiting, b""
        self.now += 0 if data else timeout
        return data

    def write(self, data: bytes) -> None:
        self.received += data
        self.waiting += data

    def set_baud(self, baud: int) -> None: ...

    def clock(self) -> float:
        return self.now

    def close(self) -> None: ...


@pytest.mark.parametrize(
    ("kind", "to_board", "received", "answered"),
    [
        (Kind.LOSE, True, b"abde", b"abde"),
        (Kind.LOSE, False, b"abcde", b"abde"),
        (Kind.DOUBLE, True, b"abccde", b"abccde"),
        (Kind.DOUBLE, False, b"abcde", b"abccde"),
        (Kind.FLIP, True, b"abbde", b"abbde"),
        (Kind.FLIP, False, b"abcde", b"abbde"),
        (Kind.SHARE, True, b"ab" + OTHER_PROGRAM + b"cde", b"ab" + OTHER_PROGRAM + b"cde"),
        (Kind.SHARE, False, b"abcde", b"ab"),
    ],
)
def test_a_damaged_byte(kind: Kind, to_board: bool, received: bytes, answered: bytes) -> None:
    assert STOLEN >= 3
    board = Board()
    line = FaultyLine(board, [Fault(kind, to_board, 2, 8)])
    line.write(b"abcde")
    assert (board.received, line.read(1)) == (received, answered)
    assert [fault.kind for fault in line.hit] == [kind]


def test_a_late_byte() -> None:
    board = Board()
    line = FaultyLine(board, [Fault(Kind.DELAY, False, 2, 4), Fault(Kind.DELAY, True, 7, 3)])
    line.write(b"abcde")
    assert line.read(0.01) == b"ab"
    assert line.read(DELAYS[4]) == b"cde" and board.now == pytest.approx(DELAYS[4], abs=0.02)
    before = board.now
    line.write(b"fghi")
    assert board.now == pytest.approx(before + DELAYS[3])
    assert line.read(1) + line.read(1) == b"fghi"


def test_the_end_of_a_port() -> None:
    restarts: list[int] = []
    for kind, error in ((Kind.UNPLUG, Disconnected), (Kind.KILL, Killed)):
        board = Board()
        line = FaultyLine(board, [Fault(kind, True, 3)])
        with pytest.raises(error):
            line.write(b"abcde")
        assert board.received == b"abc"
        with pytest.raises(error):
            line.read(1)
    board = Board()
    line = FaultyLine(board, [Fault(Kind.RESTART, False, 1)], lambda: restarts.append(len(board.received)))
    line.write(b"abcde")
    assert line.read(1) == b"a" and restarts == [5]
    line.write(b"x")
    assert line.read(1) == b"x"


def test_a_killed_program_leaves_its_motor_running() -> None:
    """After the exception `Killed` has ended a program between two bytes, the driver sends no stop
    command.
    """
    port = ModelPort("speed=max")
    line = FaultyLine(port)
    with pytest.raises(Killed), Ppmc104.open(line) as axis:
        axis.initialise(1000, 5000, 100)
        axis.jog(0)
        line._faults[True, line.passed[True]] = Fault(Kind.KILL, True, line.passed[True])
        axis.stop()
    port.set_baud(115_200)
    port.read(1)
    with Ppmc104.on(Link(port)) as again:
        assert again.status().busy and again.position == port.board.position - 4000 > 100
