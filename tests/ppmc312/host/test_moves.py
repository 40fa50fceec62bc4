"""Queues of moves of a PPMC-312 on a bridge: `moves` executes several moves with one frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from openppmc.host import (
    AlarmStop,
    AxisBusy,
    CommandRefused,
    Disconnected,
    EndUnknown,
    LimitReached,
    NotInitialised,
    OutOfRange,
    Ppmc312,
    StoppedByCommand,
)
from openppmc.host.model_port import ModelPort
from openppmc.host.moves import LONGEST_WAIT_MS
from openppmc.host.ppmc312 import blocks
from openppmc.host.ppmc312.part import MOVES_PER_FRAME
from openppmc.host.ppmc312.window import ADDRESS, READ

SHORT = [3, -1, 2, 0, 1, -5, 4, 1, 1, -2, 3, -1, 2, 1, 0, 0, -5, 4]


def opened(words: str = "", timing: str = "FAST") -> Ppmc312:
    part = Ppmc312.open(f"model:speed=max,part=ppmc312,timing={timing},{words}")
    part.initialise(4000, 8000, 600)
    return part


@pytest.fixture(params=["FAST", "DATASHEET"])
def part(request: pytest.FixtureRequest) -> Iterator[Ppmc312]:
    with opened(timing=request.param) as ready:
        yield ready


def port_of(part: Ppmc312) -> ModelPort:
    assert isinstance(part.link.port, ModelPort)
    return part.link.port


def after_start(
    part: Ppmc312, monkeypatch: pytest.MonkeyPatch, number: int, act: Callable[[], Any]
) -> list[int]:
    """Call `act` when the response to the n-th start has been read; return the lengths of all instructions
    sent.
    """
    board = port_of(part).board
    read, write, reads, lengths = board.read, board.write, [], []
    # bytes read: 8 for the position; for each move, 4 for the start and 8 for the end
    last = 8 + 12 * (number - 1) + 4

    def reading(a: int) -> int:
        byte: int = read(a)
        if a == READ:
            reads.append(byte)
            if len(reads) == last:
                act()
        return byte

    def writing(a: int, byte: int) -> None:
        if a == ADDRESS:
            lengths.append(0x20 - byte)
        write(a, byte)

    monkeypatch.setattr(board, "read", reading)
    monkeypatch.setattr(board, "write", writing)
    return lengths


def collected(part: Ppmc312, moves: list[int], ends: list[int | None]) -> None:
    """Execute moves and append the pulses of each result."""
    for end in part.moves(moves):
        ends.append(end.pulses)


@pytest.mark.parametrize("pps", [None, 5000])
def test_results_are_those_of_single_moves(part: Ppmc312, pps: int | None) -> None:
    before = port_of(part).bridge.scripts
    queued = list(part.moves(SHORT, pps))
    used = port_of(part).bridge.scripts - before
    part.move(-sum(SHORT))
    single = [part.move_constant(one, pps) if pps and one else part.move(one) for one in SHORT]
    assert queued == single and used <= 2 + len(SHORT) // 2
    assert part.motion is not None and part.motion.over and not part.reports


def test_long_moves_are_waited_for_by_the_host(part: Ppmc312) -> None:
    assert 900 / 8000 > 2e-3 * LONGEST_WAIT_MS
    moves = [1, 900, -2, 3, -900, -900, 1, 1]
    assert [end.pulses for end in part.moves(moves)] == moves
    assert part.move(5).complete and not part.reports


def test_few_moves_are_read_ahead(part: Ppmc312) -> None:
    numbers = iter(range(1, 100))
    queue = part.moves(numbers)
    assert next(queue).pulses == 1 and next(numbers) == MOVES_PER_FRAME + 1


@pytest.mark.parametrize("wrong", [2.5, "5", None, 1 << 32, True])
def test_a_wrong_number_moves_nothing_of_its_frame(part: Ppmc312, wrong: Any) -> None:
    with pytest.raises(OutOfRange):
        list(part.moves([1, wrong]))
    with pytest.raises(OutOfRange):
        part.moves(wrong if not isinstance(wrong, str) else 5)
    assert part.position == 0


def test_a_queue_during_a_motion(part: Ppmc312) -> None:
    motion = part.start_move(3000)
    with pytest.raises(AxisBusy):
        list(part.moves([1, 2]))
    assert part.motion is motion and motion.wait().complete


def test_a_part_without_a_table() -> None:
    with Ppmc312.open("model:speed=max,part=ppmc312") as part:
        with pytest.raises(NotInitialised):
            list(part.moves([1, 2]))
        assert part.motion is None and part.position == 0


@pytest.mark.parametrize("words, error", [("cw=4006", LimitReached), ("alarm=4006..4100", AlarmStop)])
@pytest.mark.parametrize("timing", ["FAST", "DATASHEET"])
def test_a_switch_ends_the_queue(words: str, error: type[Exception], timing: str) -> None:
    with opened(words, timing) as part:
        ends: list[int | None] = []
        with pytest.raises(error) as caught:
            collected(part, [2, -1, 2, -1, 2, 300, 4, -2, 5], ends)
        assert ends == [2, -1, 2, -1, 2]
        assert caught.value.result.position == part.position < 100
        assert part.motion is not None and part.motion.result == caught.value.result


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_stop_of_another_program_ends_the_queue(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    with opened() as part:
        board = port_of(part).board
        block = blocks.bus_order(blocks.immediate_stop())

        def stop() -> None:
            board.write(ADDRESS, 0x20 - len(block))
            for byte in block:
                board.write(5, byte)

        lengths = after_start(part, monkeypatch, number, stop)
        ends: list[int | None] = []
        with pytest.raises((StoppedByCommand, CommandRefused)):
            collected(part, [40, -30, 35, 1], ends)
        assert ends == [40, -30, 35][: number - 1]
        assert lengths.count(10) == number and part.position not in (40, 10, 45)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_reset_during_a_move_is_no_end(part: Ppmc312, number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    lengths = after_start(part, monkeypatch, number, lambda: port_of(part).board.reset())
    ends: list[int | None] = []
    with pytest.raises(EndUnknown):
        collected(part, [40, -30, 35, 1], ends)
    assert ends == [40, -30, 35][: number - 1] and lengths.count(10) == number
    monkeypatch.undo()
    part.initialise(4000, 8000, 600)
    assert [end.pulses for end in part.moves([1, 2])] == [1, 2]


def test_a_board_that_disappears(part: Ppmc312) -> None:
    port, ends = port_of(part), []
    with pytest.raises(Disconnected, match="the port went away"):
        for end in part.moves(SHORT):
            ends.append(end.pulses)
            port._unplug = port.board.seconds
    assert 0 < len(ends) <= MOVES_PER_FRAME and ends == SHORT[: len(ends)]


def test_an_exception_during_a_frame_stops_the_motor(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(KeyboardInterrupt), opened() as part:
        board = port_of(part).board

        def interrupted(timeout: float) -> bytes:
            monkeypatch.undo()
            raise KeyboardInterrupt

        monkeypatch.setattr(port_of(part), "read", interrupted)
        list(part.moves([2, 5000, 600]))
    board.run_until(board.t + board.clk_hz)
    assert 2 < board.counts[0] < 5000
    stopped = board.counts[0]
    board.run_until(board.t + board.clk_hz)
    assert board.counts[0] == stopped
