"""Faults between host and virtual board: a few of the sessions that `make fire` runs on golden models."""

from __future__ import annotations

import os

import pytest

from openppmc.host import Disconnected, NothingToStop, NotInitialised, Ppmc104, open_port
from openppmc.sim import SimBoard
from scripts.measure.fire.line import DELAYS, Fault, FaultyLine, Killed, Kind

from .fixtures import PATIENCE, SETUP, CommandLine, Wait, one_line

SLOW = ("--start", "1000", "--high", "4000", "--ramp", "300")

LATE = DELAYS.index(0.12)
PULSES = 400


@pytest.mark.parametrize("to_board", [True, False])
@pytest.mark.parametrize("kind", [Kind.LOSE, Kind.DOUBLE, Kind.FLIP, Kind.DELAY, Kind.SHARE])
def test_a_damaged_byte_changes_no_result(board: SimBoard, kind: Kind, to_board: bool) -> None:
    """If a request or an answer is damaged, the driver repeats the request, and the motor nevertheless moves
    only once.
    """
    line = FaultyLine(
        open_port(board.port), [Fault(kind, to_board, 58, LATE), Fault(kind, to_board, 75, LATE)]
    )
    with Ppmc104.open(line) as axis:
        axis.initialise(**SETUP)
        assert axis.move(PULSES).position == PULSES == axis.position
        assert board.status().position == 4000 + PULSES
    assert len(line.hit) == 2
    line.port.close()


@pytest.mark.parametrize("kind", [Kind.UNPLUG, Kind.KILL])
@pytest.mark.parametrize("place", [3, 40, 62, 66, 70, 78])
def test_the_next_program_reads_the_true_position(
    board: SimBoard, until: Wait, kind: Kind, place: int
) -> None:
    """If a program ends at any byte, the next program connects and states the true position."""
    line = FaultyLine(open_port(board.port), [Fault(kind, True, place)])
    with pytest.raises((Disconnected, Killed)), Ppmc104.open(line) as axis:
        axis.initialise(**SETUP)
        axis.start_move(PULSES)
        axis.link.pause(0.02)
        axis.stop()
        axis.move(-PULSES)
    line.port.close()
    with Ppmc104.open(board.port) as again:
        until(lambda: not again.status().busy, "motor at rest")
        assert again.position == board.status().position - 4000
        with pytest.raises((NothingToStop, NotInitialised)):
            again.stop()
        before = again.position
        again.initialise(**SETUP)
        assert again.move(20).position == before + 20 == board.status().position - 4000


def test_kill_9_of_the_program(board: SimBoard, openppmc: CommandLine, until: Wait) -> None:
    """A killed command leaves the motor running; the next commands stop it and print the true position."""
    process = openppmc.begin(board.port, "jog", "cw", *SLOW)
    until(lambda: board.status().pulses > 300, "motor turning")
    process.kill()
    process.communicate(timeout=PATIENCE)
    code, out, err = openppmc.run(board.port, "stop")
    assert code == 0 and f"position {board.status().position - 4000}" in out, err
    code, _, err = openppmc.run(board.port, "move", "25", *SLOW)
    assert code == 0, err


def test_two_programs_at_one_port(board: SimBoard, openppmc: CommandLine) -> None:
    """If two programs open one port, the second program ends with one line, and the first one continues."""
    with Ppmc104.open(board.port) as axis:
        code, _, err = openppmc.run(board.port, "status")
        assert code == 1 and one_line(err) and "another program has this port open" in err
        axis.initialise(**SETUP)
        assert axis.move(90).position == 90


def test_kill_9_of_the_board(board: SimBoard, openppmc: CommandLine, until: Wait) -> None:
    """If the board is killed during a move, the running command and the next one each end with one line."""
    process = openppmc.begin(board.port, "move", "30000", *SLOW)
    until(lambda: board.status().pulses > 300, "motor turning")
    # While a pseudo-terminal is open, no board of a test in another process gets its number.
    held = os.open(board.port, os.O_RDWR | os.O_NOCTTY)
    board.process.kill()
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and one_line(err), err
    code, _, err = openppmc.run(board.port, "status")
    os.close(held)
    assert code == 1 and one_line(err), err
