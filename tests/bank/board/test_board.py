"""The virtual board with a bank: the RTL with its bridge, accessed by the driver and by the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.host import CW, Cause, LimitReached, PpmcBank
from openppmc.sim import SimBoard

from ...common.board.fixtures import SETUP, CommandLine, StartBoard


@pytest.fixture
def board(start_board: StartBoard, tmp_path: Path) -> SimBoard:
    """Return a board at maximum speed with four axes that writes pulses.log; axis 4 is near its limit."""
    return start_board(f"part=bank,axes=4,speed=max,start4=37900,log={tmp_path / 'pulses.log'}")


def test_axes_move_apart_and_together(board: SimBoard, tmp_path: Path) -> None:
    """After a move of one axis and a joint move of three, motors and positions agree; the three axes start in
    the same cycle.
    """
    with PpmcBank.open(board.port) as bank:
        assert bank.info() == (1, 4)
        for axis in bank.axes:
            axis.initialise(**SETUP)  # type: ignore[arg-type]
        assert bank.axis[2].move(500).position == 500
        bank.move_together({1: 300, 3: -200, 4: 50})
        assert bank.positions() == {1: 300, 2: 500, 3: -200, 4: 50}
        assert [axis.position for axis in board.status().axes] == [4300, 4500, 3800, 37950]
        bank.link.pause(2.5)  # the log is written when the board is idle
    pulses = [line.split() for line in (tmp_path / "pulses.log").read_text().splitlines()[1:]]
    first = [next(int(clk) for clk, *_, axis in pulses if axis == number) for number in "134"]
    assert len(set(first)) == 1


def test_limits_and_stops(board: SimBoard) -> None:
    """A slow-down limit and STOP end motions; a read of the switches returns their levels on the board."""
    with PpmcBank.open(board.port) as bank:
        for axis in bank.axes:
            axis.initialise(**SETUP)  # type: ignore[arg-type]
        with pytest.raises(LimitReached, match="axis 4: slow-down limit"):
            bank.axis[4].move(3000)
        assert bank.snapshot((4,))[4].inputs.slow_cw and not bank.snapshot((1,))[1].inputs.slow_cw
        bank.axis[1].jog(CW, 1000)
        bank.axis[2].jog(CW, 2000)
        assert [end.cause for end in bank.stop_all().values()] == [Cause.STOP, Cause.STOP]
        assert bank.pending() == ()


def test_command_line(board: SimBoard, openppmc: CommandLine) -> None:
    """After a move by one call of the command line, another call prints the positions of all axes."""
    code, out, _ = openppmc.run(board.port, "move", "100", "-50", "--axes", "3,1")
    assert code == 0 and out.splitlines() == [
        "axis 1: position -50, 50 pulses CCW: complete",
        "axis 3: position 100, 100 pulses CW: complete",
    ]
    rows = openppmc.run(board.port, "status")[1].splitlines()[1:]
    assert [row.split()[2] for row in rows] == ["-50", "0", "100", "0"]
