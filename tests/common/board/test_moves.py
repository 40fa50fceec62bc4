"""Queues of moves on virtual boards: the RTL executes the frames of `moves`."""

from __future__ import annotations

import signal
from types import FrameType
from typing import Any

import pytest

from openppmc.host import Disconnected, LimitReached, Ppmc104, open_part
from openppmc.sim import SimBoard

from .fixtures import SETUP, StartBoard, Wait

SETUPS: dict[str, tuple[int, int, int]] = {
    "ppmc104": (100_000, 200_000, 4),
    "ppmc2104": (100_000, 200_000, 4),
    "stmc": (9_000, 9_700, 4),
    "bank": (100_000, 200_000, 4),
    "ppmc312": (40_000, 400_000, 1_400),
}
SHORT = [3, -1, 2, 0, 1, -5, 4, 1, 1, -2, 3, -1, 2, 1, 0, 0, -5, 4, 600, -600, 7]


@pytest.mark.parametrize("part", SETUPS)
@pytest.mark.parametrize("pps", [None, 50_000])
def test_results_and_pulses(start_board: StartBoard, until: Wait, part: str, pps: int | None) -> None:
    """Each result belongs to its move, and the motor has made all pulses of all moves."""
    if part == "stmc" and pps:
        pps = 9_500
    board = start_board(part=part, speed="max")
    with open_part(board.port) as opened:
        axis: Any = opened.axes[-1]
        axis.initialise(*SETUPS[part])
        ends = list(axis.moves(SHORT, pps))
        assert [end.pulses for end in ends] == SHORT and all(end.complete for end in ends)
        assert [end.position for end in ends] == [sum(SHORT[: n + 1]) for n in range(len(SHORT))]
        assert axis.position == sum(SHORT)
    moved = board.status().axes[-1]
    assert moved.pulses == sum(map(abs, SHORT)) and moved.position == 4000 + sum(SHORT)


def test_datasheet_timing(start_board: StartBoard) -> None:
    board = start_board(timing="DATASHEET", speed="max")
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        assert [end.pulses for end in axis.moves(SHORT)] == SHORT
    assert board.status().pulses == sum(map(abs, SHORT))


@pytest.mark.parametrize("limit", [4003, 4006, 4013])
def test_a_limit_ends_the_queue(start_board: StartBoard, limit: int) -> None:
    """No pulse follows the move that the limit has ended."""
    board = start_board(cw=limit, speed="max")
    moves, ends = [3, -1, 3, 3, -2, 20, -5, 1], []
    with Ppmc104.open(board.port) as axis:
        axis.initialise(*SETUPS["ppmc104"])
        with pytest.raises(LimitReached) as caught:
            for end in axis.moves(moves):
                ends.append(end.pulses)
        assert ends == moves[: len(ends)]
        assert caught.value.result.position == axis.position == sum(ends) + caught.value.result.pulses
    now = board.status()
    assert now.l1 and now.pulses == sum(map(abs, ends)) + caught.value.result.pulses


def test_an_interrupt_stops_the_motor(board: SimBoard, until: Wait) -> None:
    """Ctrl-C during a frame stops the running move, and no further move of the frame starts."""

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        with pytest.raises(KeyboardInterrupt), Ppmc104.open(board.port) as axis:
            axis.initialise(**SETUP)
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            list(axis.moves([60] * 1000))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    until(lambda: board.status().hold, "motor at rest")
    pulses = board.status().pulses
    assert 0 < pulses < 60_000
    with Ppmc104.open(board.port) as again:
        assert not again.status().busy
        again.initialise(**SETUP)
        assert [end.pulses for end in again.moves([5, -5])] == [5, -5]
    assert board.status().pulses == pulses + 10


def test_a_board_that_ends(board: SimBoard) -> None:
    ends = []
    with pytest.raises(Disconnected), Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        for end in axis.moves([2] * 1000):
            ends.append(end)
            if len(ends) == 40:
                board.close()
    assert 40 <= len(ends) <= 64 and all(end.complete for end in ends)
