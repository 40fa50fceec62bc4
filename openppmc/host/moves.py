"""Consecutive moves of one axis; one frame contains several of them.

For each move, the frame contains the command, a wait for its end, and reads of finish status and pulse
counter. The bridge executes these steps. It starts the next move only if the finish status names the
operation of the completed move and no cause of an early end. Otherwise, the script ends there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice, takewhile
from typing import Protocol

from ..model.motion.codes import FINISH_NEW, OBF
from .errors import PpmcError, StartRefused
from .motion import READ_FINISH, AnyMotion, Motion, MotionAxis, MotionRequest
from .motion_result import MotionResult
from .script import LONGEST_SCRIPT, Answer, Result, Script

AHEAD = 16
"""Largest number of moves that are taken from the iterator before they can be started."""
LONGEST_WAIT_MS = 20
"""Longest wait for the end of a move within a frame.

If a move takes longer, the frame ends, and the host waits for the end of the move. Thus the moves stop soon
after the host has disappeared.
"""
_SELECT_BYTES = 2
_HEAD = 3
"""Number of values in an answer before the values of the first move.

The last of these values is the position counter.
"""
_STATUS, _FINISH, _COUNT = -4, -2, -1
"""Indices of the values of one move in its answer, counted from the end."""


class QueueAxis(MotionAxis, Protocol):
    """Members of an axis (`axis.Axis`) that the functions of this module need."""

    _motion: Motion | None

    def _start_script(self, request: MotionRequest) -> Script: ...
    def _motion_started(self, request: MotionRequest, begin: int) -> Motion: ...
    def _refused_start_motion(self, request: MotionRequest, refused: StartRefused) -> Motion: ...


def run_moves(
    numbers: Iterator[int],
    ahead: int,
    execute: Callable[[Sequence[int]], tuple[Sequence[AnyMotion], PpmcError | None]],
    empty: Callable[[], MotionResult],
) -> Iterator[MotionResult]:
    """Execute moves in order and yield their results; see `Axis.moves`.

    Args:
        numbers: pulses of each move.
        ahead: largest number of moves that are taken from `numbers` before they can be started.
        execute: function that executes one frame with as many of the given moves as fit, beginning with the
            first. It returns the motions that were started, and the error that prevented the next move. The
            last motion may still be running.
        empty: function that returns the result of a move of 0 pulses.
    """
    waiting: list[int] = []
    while True:
        waiting += islice(numbers, ahead - len(waiting))
        if not waiting:
            return
        if not waiting[0]:
            del waiting[0]
            yield empty()
            continue
        motions, error = execute(list(takewhile(bool, waiting)))
        del waiting[: len(motions)]
        for motion in motions:
            yield motion.wait().check(motion.requested)
        if error is not None:
            raise error


def execute_moves(
    axis: QueueAxis, requests: Sequence[MotionRequest]
) -> tuple[Sequence[Motion], PpmcError | None]:
    """Execute one frame with the first moves that fit into it; see `run_moves`."""
    script = axis._start_script(requests[0]).timeout(LONGEST_WAIT_MS)
    room = LONGEST_SCRIPT - _SELECT_BYTES - len(bytes(script))
    requests = requests[: room // len(bytes(_add_move(Script(), axis, requests[0])))]
    for request in requests:
        _add_move(script, axis, request)
    # If an exception ends the wait for the answer, a move may still be running, and the script may have read
    # the finish status of the last move.
    before, unknown = axis._motion, Motion(axis, requests[0], 0, ours=False, new=FINISH_NEW)
    axis._motion = unknown
    axis.link.forget_events()
    answer = axis.link.attempt(script)
    refused = answer.result is Result.REFUSED
    if refused:
        axis._motion = before
    motions: list[Motion] = []
    try:
        _decode(axis, requests, answer, motions)
    except PpmcError as error:
        if not refused and (not motions or motions[-1].over):
            axis._motion = unknown
        return motions, error
    return motions, None


def _add_move(script: Script, axis: QueueAxis, request: MotionRequest) -> Script:
    """Add the steps of one move to a script."""
    bit, busy, datasheet = axis._code_bits, axis._busy_mask, axis.link.identity.datasheet
    script.call(request.code | bit, *request.data)
    if datasheet:  # BUSY and OBF may rise after a delay
        script.wait(1, busy, busy)
    script.wait(1, busy | axis._zero_mask, 0).call(READ_FINISH | bit)
    if datasheet:
        script.wait(1, OBF, OBF)
    return axis._add_position_read(script.wait(0, 0xFF, FINISH_NEW | request.operation))


def _decode(
    axis: QueueAxis, requests: Sequence[MotionRequest], answer: Answer, motions: list[Motion]
) -> None:
    """Append a motion for each move that was started. Raises the error that ended the script."""
    size = 7 if axis.link.identity.datasheet else 5
    head, rest = answer.values[:_HEAD], answer.values[_HEAD:]
    begin = b"".join(head[-1:])
    for request in requests:
        values, rest = rest[:size], rest[size:]
        if not values:
            try:
                axis.link.check_answer(answer)
            except StartRefused as refused:
                motions.append(axis._refused_start_motion(request, refused))
            return
        motion = axis._motion_started(request, int.from_bytes(begin, "little", signed=True))
        motions.append(motion)
        if len(values) < size:
            if len(values) >= size + _FINISH:
                motion._finish((*values, bytes([answer.last]))[_FINISH + size][0])
            return
        motion._decode(values[_FINISH][0], b"", values[_COUNT])
        begin = values[_COUNT]
    axis._on_status(values[_STATUS][0])
