"""Faults between host and virtual board: a small sample of what `make fire` runs on golden models."""

from __future__ import annotations

import pytest

from openppmc.host import Disconnected, NothingToStop, NotInitialised, Ppmc104, open_port
from openppmc.sim import SimBoard
from scripts.measure.fire.line import DELAYS, Fault, FaultyLine, Killed, Kind

from .fixtures import SETUP, Wait

LATE = DELAYS.index(0.12)
PULSES = 400


@pytest.mark.parametrize("to_board", [True, False])
@pytest.mark.parametrize("kind", [Kind.LOSE, Kind.DOUBLE, Kind.FLIP, Kind.DELAY, Kind.SHARE])
def test_a_damaged_byte_changes_no_result(board: SimBoard, kind: Kind, to_board: bool) -> None:
    """The driver repeats a damaged request or answer, and the motor moves once."""
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
    """After the end of a program at any byte, the next one connects, and states the true position."""
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
