"""Queues of moves: `Axis.moves` executes several moves with one frame.

Each yielded result is confirmed by the device and by the pulse counter, in the order of the moves. No move
starts after one that did not end as requested.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from openppmc.host import (
    AlarmStop,
    AxisBusy,
    Cause,
    Disconnected,
    EndUnknown,
    LimitReached,
    NotCalledError,
    NotInitialised,
    OutOfRange,
    Ppmc104,
    Ppmc312,
    Ppmc2104,
    PpmcBank,
    ProtocolError,
    Stmc,
    StoppedByCommand,
)
from openppmc.host.bank.axis import BankAxis
from openppmc.host.model_port import ModelPort
from openppmc.host.moves import AHEAD, LONGEST_WAIT_MS
from openppmc.host.script import Script

KINDS: dict[str, tuple[Any, str, Callable[[Any], Any]]] = {
    "ppmc104": (Ppmc104, "part=ppmc104", lambda part: part),
    "ppmc104-datasheet": (Ppmc104, "part=ppmc104,timing=DATASHEET", lambda part: part),
    "ppmc2104-x": (Ppmc2104, "part=ppmc2104", lambda part: part.x),
    "ppmc2104-y": (Ppmc2104, "part=ppmc2104,timing=DATASHEET", lambda part: part.y),
    "stmc": (Stmc, "part=stmc", lambda part: part),
    "stmc-datasheet": (Stmc, "part=stmc,timing=DATASHEET", lambda part: part),
    "bank": (PpmcBank, "part=bank,axes=4", lambda part: part.axis[3]),
}
SHORT = [3, -1, 2, 0, 1, -5, 4, 1, 1, -2, 3, -1, 2, 1, 0, 0, -5, 4, 1, 1, -2, 7]


@contextmanager
def opened(kind: str, words: str = "") -> Iterator[Any]:
    """Open an initialised axis with 5000 to 9000 pulses/s."""
    driver, text, chosen = KINDS[kind]
    with driver.open(f"model:speed=max,{text},{words}") as part:
        axis = chosen(part)
        axis.initialise(5000, 9000, 4)
        yield axis


@pytest.fixture(params=KINDS)
def axis(request: pytest.FixtureRequest) -> Iterator[Any]:
    with opened(request.param) as ready:
        yield ready


def port_of(axis: Any) -> ModelPort:
    """Return the modelled board's port."""
    port = getattr(axis.link, "_link", axis.link).port
    assert isinstance(port, ModelPort)
    return port


def frames(axis: Any) -> int:
    """Return the number of scripts that the bridge has executed."""
    return port_of(axis).bridge.scripts


def before_start(
    axis: Any, monkeypatch: pytest.MonkeyPatch, number: int, act: Callable[[], Any]
) -> list[int]:
    """Call `act` before the n-th command of a move is written; return the codes of all commands written."""
    board = port_of(axis).board
    write, codes = board.write, []

    def writing(a: int, byte: int) -> None:
        if a & 1 and byte & 0x47 in (0x43, 0x44) and byte < 0x80:
            codes.append(byte)
            if len(codes) == number:
                act()
        write(a, byte)

    monkeypatch.setattr(board, "write", writing)
    return codes


def after_start(axis: Any, monkeypatch: pytest.MonkeyPatch, number: int, act: Callable[[], Any]) -> list[int]:
    """Call `act` at the first read of the status while the n-th move is running."""
    board = port_of(axis).board
    codes = before_start(axis, monkeypatch, 0, act)
    read, reads = board.read, []

    def reading(a: int) -> int:
        byte: int = read(a)
        if len(codes) == number and byte & axis._busy_mask and a == 1:
            reads.append(a)
            if len(reads) == 1:
                act()
        return byte

    monkeypatch.setattr(board, "read", reading)
    return codes


# ---------------------------------------------------------------------- results


@pytest.mark.parametrize("pps", [None, 6000])
def test_results_are_those_of_single_moves(axis: Any, pps: int | None) -> None:
    """Results, order and positions equal those of `move`, with fewer frames."""
    before = frames(axis)
    queued = list(axis.moves(SHORT, pps))
    used = frames(axis) - before
    axis.move(-sum(SHORT))
    single = [axis.move_constant(one, pps) if pps and one else axis.move(one) for one in SHORT]
    assert queued == single
    assert [end.pulses for end in queued] == SHORT and used <= 8
    assert axis.motion.over and axis.position == sum(SHORT)


def test_a_move_of_its_own_after_a_queue_and_before(axis: Any) -> None:
    assert axis.move(30).complete
    assert [end.position for end in axis.moves([1, 2])] == [31, 33]
    assert axis.move(-3).position == 30
    assert [end.position for end in axis.moves(iter([-30]))] == [0]
    assert list(axis.moves([])) == []


def test_long_moves_are_waited_for_by_the_host(axis: Any) -> None:
    """A move that lasts longer than the time limit of the wait in its frame delays the queue, but does not
    end it.
    """
    assert 600 / 9000 > 2e-3 * LONGEST_WAIT_MS
    moves = [1, 600, -2, 3, -600, -600, 1, 1]
    assert [end.pulses for end in axis.moves(moves)] == moves


def test_the_queue_reads_few_moves_ahead(axis: Any) -> None:
    taken: list[int] = []

    def endless() -> Iterator[int]:
        while True:
            taken.append(1)
            yield -1 if len(taken) % 2 else 1

    queue = axis.moves(endless())
    assert next(queue).pulses == -1
    assert len(taken) == AHEAD
    queue.close()
    assert axis.motion.over and len(taken) == AHEAD


# ---------------------------------------------------------------------- arguments


@pytest.mark.parametrize("wrong", [2.5, "5", None, 1 << 25, True])
def test_a_wrong_number_moves_nothing_of_its_frame(axis: Any, wrong: Any) -> None:
    with pytest.raises(OutOfRange):
        list(axis.moves([1, 2, wrong]))
    assert axis.position == 0


def test_no_iterable_is_one_clear_error(axis: Any) -> None:
    with pytest.raises(OutOfRange, match=r"pulses 5: wants several numbers, as in \(100, -50\)"):
        axis.moves(5)
    with pytest.raises(OutOfRange):
        list(axis.moves([5], pps=1e9))


def test_a_queue_during_a_motion(axis: Any) -> None:
    motion = axis.start_move(3000)
    axis.link.pause(0.01)
    with pytest.raises(AxisBusy):
        list(axis.moves([1, 2]))
    assert axis.motion is motion and motion.wait().complete


# ---------------------------------------------------------------------- early ends


@pytest.mark.parametrize("kind", ["ppmc104", "ppmc104-datasheet", "ppmc2104-x", "stmc", "bank"])
@pytest.mark.parametrize("words, error, cause", [
    ("{n}cw{n}=4006", LimitReached, Cause.LIMIT),
    ("alarm{n}=4006..4100", AlarmStop, Cause.ALARM),
])  # fmt: skip
def test_a_switch_ends_the_queue(kind: str, words: str, error: type[Exception], cause: Cause) -> None:
    number = "3" if kind == "bank" else ""
    with opened(kind, words.replace("{n}cw", "cw").format(n=number)) as axis:
        ends = []
        with pytest.raises(error, match=r"at position \d+ after \d of 4 pulses") as caught:
            for end in axis.moves([2, -1, 2, -1, 2, 4, 4, -2, 5]):
                ends.append(end.pulses)
        assert ends == [2, -1, 2, -1, 2]
        result = caught.value.result
        assert result.cause == cause and result.pulses + result.remaining == 4
        assert result.position == axis.position == 4 + result.pulses
        assert axis.motion.over and axis.motion.result == result
        if cause is Cause.LIMIT:
            assert [end.pulses for end in axis.moves([-2, -1])] == [-2, -1]


def test_a_switch_that_prevents_a_start() -> None:
    """A PPMC-2104 rejects the start of a move onto an active limit switch (P2104-ERR-05)."""
    with opened("ppmc2104-x", "cw=4002,slow_cw=9000") as axis:
        ends = []
        with pytest.raises(LimitReached) as caught:
            for end in axis.moves([2, 3, -1]):
                ends.append(end.pulses)
        assert ends == [2] and caught.value.result.pulses == 0 and axis.position == 2


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_stop_of_another_program_ends_the_queue(
    axis: Any, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    stop = lambda: port_of(axis).board.write(1, 0x40 | axis._code_bits)  # noqa: E731
    codes = after_start(axis, monkeypatch, number, stop)
    ends = []
    with pytest.raises(StoppedByCommand):
        for end in axis.moves([20, -30, 40, 1, 1]):
            ends.append(end.pulses)
    assert ends == [20, -30, 40][: number - 1] and len(codes) == number and axis.motion.over


# ---------------------------------------------------------------------- faults


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_reset_during_a_move_is_no_end(axis: Any, number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    codes = after_start(axis, monkeypatch, number, lambda: port_of(axis).board.reset())
    ends = []
    with pytest.raises(EndUnknown, match="the end of the motion is not confirmed") as caught:
        for end in axis.moves([20, -30, 40, 1, 1]):
            ends.append(end.pulses)
    assert ends == [20, -30, 40][: number - 1] and len(codes) == number
    assert caught.value.requested == abs([20, -30, 40][number - 1])
    assert axis.motion.over and axis.motion.result is None


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_reset_between_two_moves_is_refused(
    axis: Any, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    codes = before_start(axis, monkeypatch, number, lambda: port_of(axis).board.reset())
    ends = []
    with pytest.raises(NotInitialised):
        for end in axis.moves([2, -3, 4, 1, 1]):
            ends.append(end.pulses)
    assert ends == [2, -3, 4][: number - 1] and len(codes) == number
    monkeypatch.undo()
    # a bank counts in the part, so the reset has cleared its counter
    if number > 1 and isinstance(axis, BankAxis):
        with pytest.raises(ProtocolError, match="now reads 0, because the part was reset"):
            axis.initialise(5000, 9000, 4)
    axis.initialise(5000, 9000, 4)
    assert axis.move(5).complete


@pytest.mark.parametrize("kind", ["ppmc104", "ppmc2104-x", "stmc"])
def test_a_counter_that_jumped_contradicts_the_status(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the pulse counter contradicts the status, the host detects this after the frame and sends no further
    frame.
    """
    with opened(kind) as axis:

        def jump() -> None:
            port_of(axis).board.counts[0] -= 40

        after_start(axis, monkeypatch, 2, jump)
        before, ends = frames(axis), []
        with pytest.raises(EndUnknown, match=r"finish status 0x83 says 30 pulses, 70 of 30 pulses counted"):
            for end in axis.moves([20, -30, 40, *[1] * 30]):
                ends.append(end.pulses)
        assert ends == [20] and frames(axis) == before + 1


def test_noise_that_ends_a_wait_delays_the_queue(axis: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A byte that arrives during a wait ends the script (UB-FRM-07). The motion continues, and so does the
    queue."""
    engine = port_of(axis).bridge._engine
    codes = after_start(axis, monkeypatch, 3, lambda: setattr(engine, "_interrupted", lambda: True))
    assert [end.pulses for end in axis.moves([20, -30, 40, 1, 1])] == [20, -30, 40, 1, 1]
    assert len(codes) == 5


def test_a_floating_bus_ends_no_move(axis: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    board = port_of(axis).board
    read = board.read

    def float_bus() -> None:
        # the original read is called, so the access takes its time
        monkeypatch.setattr(board, "read", lambda a: read(a) | 0xFF)

    codes = after_start(axis, monkeypatch, 2, float_bus)
    ends = []
    with pytest.raises(ProtocolError, match="status 0xFF does not exist"):
        for end in axis.moves([20, -30, 40]):
            ends.append(end.pulses)
    assert ends == [20] and len(codes) == 2 and not axis.motion.over


def test_a_board_that_disappears(axis: Any) -> None:
    port = port_of(axis)
    ends = []
    with pytest.raises(Disconnected, match="the port went away"):
        for end in axis.moves(SHORT):
            ends.append(end.pulses)
            port._unplug = port.board.seconds
    assert 0 < len(ends) <= AHEAD and ends == SHORT[: len(ends)]


def test_an_exception_during_a_frame_stops_the_motor(monkeypatch: pytest.MonkeyPatch) -> None:
    """If an exception leaves the `with` block of the axis during a frame, the motion decelerates and no
    further move starts.
    """
    with pytest.raises(KeyboardInterrupt), opened("ppmc104") as axis:
        board = port_of(axis).board

        def interrupted(timeout: float) -> bytes:
            monkeypatch.undo()
            raise KeyboardInterrupt

        monkeypatch.setattr(port_of(axis), "read", interrupted)
        list(axis.moves([2, 600, 600]))
    board.run_until(board.t + board.clk_hz)
    assert 100 < board.counts[0] < 500 and not board.read(1) & 4


def test_a_stop_after_an_interrupted_frame_is_no_unknown_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """After an interrupted frame, the end of the motion is confirmed, although the script may already have
    read the finish status.
    """
    with opened("ppmc104") as axis:
        port = port_of(axis)

        def interrupted(timeout: float) -> bytes:
            monkeypatch.undo()
            raise KeyboardInterrupt

        monkeypatch.setattr(port, "read", interrupted)
        with pytest.raises(KeyboardInterrupt):
            list(axis.moves([1, 2, 3]))
        assert not axis.motion.over
        assert axis.stop().position == axis.position == 6
        assert [end.position for end in axis.moves([1])] == [7]


# ---------------------------------------------------------------------- other axes


def test_the_end_of_the_other_axis_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    with opened("ppmc2104-x") as x:
        y = x.part.y
        y.initialise(5000, 9000, 4)
        motion = y.start_move(7)
        assert [end.pulses for end in x.moves([40, -40])] == [40, -40]
        assert motion.result is not None and motion.result.complete
        assert not x.link.execute(Script().pins()).byte(0) & 1 == 0


def test_axes_of_a_bank_one_after_the_other() -> None:
    with opened("bank") as third:
        bank = third._bank
        bank.axis[1].initialise(5000, 9000, 4)
        motion = bank.axis[1].start_move(7)
        assert [end.pulses for end in third.moves([40, -40])] == [40, -40]
        assert motion.over and motion.result.complete


def test_a_queue_in_an_open_group() -> None:
    """A group holds the first move of a queue, so the queue cannot be executed there."""
    with opened("bank") as third, third._bank.group((3,)):
        with pytest.raises(NotCalledError, match="its group holds this motion"):
            list(third.moves([1, 2]))
        assert third.position == 0


def test_a_ppmc312_makes_the_moves_one_by_one() -> None:
    with Ppmc312.open("model:speed=max,part=ppmc312") as part:
        part.initialise(4000, 8000, 600)
        assert [end.pulses for end in part.moves([5, 0, -7])] == [5, 0, -7]
        assert [end.pulses for end in part.moves([5, 0, -7], 5000)] == [5, 0, -7]
        with pytest.raises(OutOfRange):
            part.moves(3)
