"""Unplugging the cable during a motion, and reconnecting."""

from __future__ import annotations

import os

import pytest
import serial

from openppmc.host import CW, NothingToStop, Ppmc104
from openppmc.host.script import RATES, Script
from openppmc.model import predict_move
from openppmc.sim import SimBoard

from .fixtures import SETUP, Wait


def yank(axis: Ppmc104) -> None:
    """Close the port without notice, as a crash of the host or a pulled cable would."""
    axis.link.port._serial.close()


@pytest.mark.parametrize("baud", [115_200, 460_800, 1_000_000])
def test_move_ends_by_itself(board: SimBoard, until: Wait, baud: int) -> None:
    """Without a host, the motor makes all its pulses; after that a new host can connect at any baud rate."""
    axis = Ppmc104.open(board.port, baud)
    axis.initialise(**SETUP)
    axis.start_move(8000)
    until(lambda: board.status().pulses > 1500, "motor turning")
    yank(axis)
    until(lambda: not board.status().open, "port closed")
    assert board.status().pulses < 8000, "the move was over too early for this test"
    with Ppmc104.open(board.port) as again:
        assert again.link.baud == 1_000_000
        until(lambda: not again.status().busy, "end of the move")
        assert again.position == 8000
        assert again.initialise(**SETUP).ramp_pulses == 400
        assert again.move(-100).complete
    assert (board.status().position, board.status().pulses) == (11_900, 8100)


def test_stays_away_until_the_move_is_over(board: SimBoard, until: Wait) -> None:
    """An interrupt message that is sent while the port is closed causes no error when a host opens it
    later.
    """
    axis = Ppmc104.open(board.port)
    axis.initialise(**SETUP)
    axis.start_move(3000)
    yank(axis)
    until(lambda: board.status().hold, "end of the move")
    assert board.status().position == 7000
    with Ppmc104.open(board.port) as again:
        assert again.position == 3000
        again.initialise(**SETUP)
        assert again.move(10).position == 3010


def test_stop_what_a_dead_host_left_running(board: SimBoard, until: Wait) -> None:
    """A continuous motion continues without its host; another host can stop it."""
    axis = Ppmc104.open(board.port)
    axis.initialise(start_pps=1000, high_pps=5000, ramp_pulses=100)
    axis.jog(CW, high=True)
    yank(axis)
    seen = board.status().pulses
    until(lambda: board.status().pulses > seen + 500, "motor still turning")
    with Ppmc104.open(board.port) as again:
        assert again.status().busy
        again.stop()
        assert not again.status().busy
        with pytest.raises(NothingToStop):
            again.stop()
    until(lambda: board.status().hold, "motor at rest")


@pytest.mark.parametrize("baud", RATES[1:5])
def test_host_lost_at_a_higher_rate(board: SimBoard, baud: int) -> None:
    """If the host ends within a frame at a high baud rate, the next host connects at 115 200 baud."""
    axis = Ppmc104.open(board.port, baud)
    axis.link.port._serial.write(b"\x7e\x01\x3a\x40")
    yank(axis)
    with Ppmc104.open(board.port, 115_200) as again:
        assert again.link.baud == 115_200
        assert not again.status().busy


def test_many_times(board: SimBoard, until: Wait) -> None:
    """After the port was opened and closed at random points of the dialogue, board and host still work."""
    for turn in range(12):
        with serial.Serial(board.port, 115_200) as port:
            port.write(b"\x7e" + os.urandom(turn * 5))
        axis = Ppmc104.open(board.port)
        axis.link.port.write(bytes(turn))
        yank(axis)
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        assert axis.move(50).position == 50
        assert axis.link.execute(Script().count()).number(0, signed=True) == 50


def test_move_duration_is_that_of_the_board(board: SimBoard, until: Wait) -> None:
    """A move takes the same time, measured with the board's clock, with and without a host."""
    axis = Ppmc104.open(board.port)
    setup = axis.initialise(**SETUP)
    begin = board.status()
    axis.start_move(6000)
    yank(axis)
    until(lambda: board.status().hold and board.status().pulses, "end of the move")
    seconds = predict_move(bytes(setup.data), 6000).seconds[-1]
    # hold rises 34 ms after the last pulse; the rest of the limit is for frames and polling.
    assert seconds + 0.034 <= board.status().seconds - begin.seconds < seconds + 1.0
