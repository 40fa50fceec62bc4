"""Motions on the virtual board, made with `openppmc.host`."""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.host import (
    CCW,
    CW,
    AlarmStop,
    AxisBusy,
    Cause,
    CommandRefused,
    LimitReached,
    NotInitialised,
    OriginNotFound,
    Ppmc104,
)
from openppmc.model import Timebase, predict_move
from openppmc.sim import SimBoard

from .fixtures import SETUP, StartBoard, Wait


def test_info(board: SimBoard, until: Wait) -> None:
    """The bridge reports device, clocks and the highest baud rate; the link works at 1 Mbaud."""
    with Ppmc104.open(board.port) as axis:
        identity = axis.link.identity
        assert (identity.part, identity.clk_hz, identity.xtal_hz) == (104, 8_000_000, 16_000_000)
        assert (identity.version, identity.counter, identity.datasheet) == (1, True, False)
        assert identity.best_rate == 4  # the highest rate with at least 5 cycles per bit
        assert board.status().rate == axis.link.baud == 1_000_000
    until(lambda: not board.status().open, "the board sees the port closed")


def test_not_initialised(board: SimBoard) -> None:
    """A device that is not initialised rejects a move with a reason, and the motor does not move."""
    with Ppmc104.open(board.port) as axis:
        with pytest.raises(NotInitialised):
            axis.move(10)
    assert board.status().pulses == 0


def test_move_with_event(board: SimBoard) -> None:
    """The end of a move is reported by an interrupt message, and the motor is at the commanded position."""
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        axis.start_move(1500)
        pins = axis.link.wait_event(20)
        assert pins is not None and not pins & 1, "no interrupt message within 20 s"
        end = axis.motion.wait()
        assert end.complete and end.pulses == 1500
        assert axis.move(-600).position == 900
    now = board.status()
    assert (now.position, now.pulses) == (4900, 2100)


@pytest.mark.parametrize("start", [3000, -150, 0], ids=["above", "below_on_switch", "on_the_edge"])
def test_home(start_board: StartBoard, start: int) -> None:
    """Homing ends on the same edge of the switch from any start position."""
    board = start_board(start=start)
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        end = axis.home(CCW, fast=True)
        assert end.cause is Cause.ORIGIN and axis.position == 0
        now = board.status()
        assert now.position == 0 and now.cnp
        axis.move_to(250)
        assert board.status().position == 250


def test_home_without_switch(start_board: StartBoard) -> None:
    """If the origin switch is out of reach, the limit ends the search and the driver raises
    OriginNotFound.
    """
    board = start_board(start=500, origin=-10_000)
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        with pytest.raises(OriginNotFound):
            axis.home(CCW)
    assert board.status().position == -400


def test_hard_limit_stops(start_board: StartBoard) -> None:
    """At constant speed the hard limit ends the motion on the first pulse at the limit; then a step in the
    other direction is possible.
    """
    board = start_board(start=37_000, cw=38_500)
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        with pytest.raises(LimitReached) as limit:
            axis.move_constant(10_000, 10_000)
        assert Cause.LIMIT in limit.value.result.cause
        assert limit.value.result.pulses == 1500
        now = board.status()
        assert now.position == 38_500 and now.l1 and now.l3
        with pytest.raises(LimitReached):
            axis.step(CW)
        axis.step(CCW)
        assert board.status().position == 38_499


def test_slow_down_limit_stops(start_board: StartBoard) -> None:
    """A ramped move that reaches L3 stops with its ramp of at most 400 pulses, before the hard limit."""
    board = start_board(start=37_000)
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        with pytest.raises(LimitReached) as limit:
            axis.move(10_000)
        assert limit.value.result.cause is Cause.SLOW_LIMIT
        assert 38_000 < board.status().position <= 38_401
        assert limit.value.result.pulses == board.status().position - 37_000


def test_alarm_stops(start_board: StartBoard) -> None:
    """The alarm ends a motion immediately and prevents the next one."""
    board = start_board(alarm="5000..5100")
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        with pytest.raises(AlarmStop):
            axis.move(3000)
        assert board.status().position == 5000 and board.status().alm
        with pytest.raises(AlarmStop):
            axis.step(CCW)


def test_jog_and_stop(board: SimBoard, until: Wait) -> None:
    """A jog runs until it is stopped with the deceleration ramp; after that the motor does not move."""
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        axis.jog(CW, high=True)
        until(lambda: board.status().pulses > 2000, "2000 pulses made")
        with pytest.raises(AxisBusy):
            axis.step(CW)
        before = board.status().pulses
        end = axis.stop()
        assert end is not None and end.cause is Cause.STOP
        after = board.status()
        assert after.pulses - before >= 400, "no ramp down from high speed"
        assert end.pulses == after.pulses == after.position - 4000
        until(lambda: board.status().hold, "hold output")
        assert board.status().pulses == after.pulses


def test_refused_while_moving_disturbs_nothing(board: SimBoard) -> None:
    """Commands that the device rejects during a move do not change the number of pulses of this move."""
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        motion = axis.start_move(4000)
        for _ in range(5):
            with pytest.raises(CommandRefused):
                axis.remaining()
        assert motion.wait().check(4000).pulses == 4000
    assert board.status().position == 8000


@pytest.mark.parametrize("timing", ["FAST", "DATASHEET"])
def test_edges_exact(start_board: StartBoard, tmp_path: Path, timing: str) -> None:
    """Every interval between POUT edges of a ramped move has the predicted number of cycles."""
    log = tmp_path / "pulses.txt"
    board = start_board(log=log, timing=timing)
    with Ppmc104.open(board.port) as axis:
        assert axis.link.identity.datasheet == (timing == "DATASHEET")
        setup = axis.initialise(start_pps=3000, high_pps=17_000, ramp_pulses=150)
        axis.move(1000)
    board.close()
    rows = [[int(word) for word in line.split()] for line in log.read_text().splitlines()[1:]]
    move = predict_move(bytes(setup.data), 1000, timebase=Timebase(8_000_000, 16_000_000))
    assert [row[0] - rows[0][0] for row in rows] == list(move.clk)
    assert [row[1:] for row in rows] == [[0, 4001 + n] for n in range(1000)]
