"""One session of a driver on a line with faults, and the checks of what the driver states."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import Any

from openppmc.host import Disconnected, NothingToStop, NotInitialised, PpmcError
from openppmc.host.ppmc312.errors import InAlarm
from scripts.measure.fire.boards import TARGETS
from scripts.measure.fire.line import DELAYS, Fault, FaultyLine, Hang, Killed

LONGEST_CALL = 40.0
"""Longest time of a call of the driver in s, measured with the clock of the line."""
AS_REQUESTED, KILLED = "as requested", "killed"
Span = tuple[int, int]


class WrongError(Exception):
    """The driver stated something untrue, did not return in time, or raised an unexpected exception."""


class Player:
    """Session of one board; `play` runs it.

    Args:
        name: key of TARGETS.
        rng: random generator for distances and pauses.
        faults: faults of the line.

    Attributes:
        outcome: AS_REQUESTED, KILLED, or the name of the exception that the driver raised.
        longest: longest time of a call in s.
    """

    def __init__(self, name: str, rng: Random, faults: Sequence[Fault] = ()) -> None:
        self.target = TARGETS[name]
        self.board = self.target.make()
        self.line = FaultyLine(self.board.port, faults, self._restart)
        self.outcome = AS_REQUESTED
        self.longest = 0.0
        self._starts = list(self.board.starts)
        self._restarted: list[int] | None = None
        self._rng = rng
        self._device: Any = None
        self._endless = False

    def _restart(self) -> None:
        self.board.restart()
        self._restarted = self.board.positions()

    def play(self) -> None:
        """Run the session, and then a session without faults. Raises WrongError."""
        spans: list[Span] = []
        try:
            for reachable in self._steps():
                spans = reachable
            self._call(self._device.close)
        except Killed:
            self.outcome = KILLED
        except PpmcError as error:
            self.outcome = type(error).__name__
            self._continue(error)
        try:
            settled = self._connect_again()
        except PpmcError as error:
            raise WrongError(f"the next session fails: {type(error).__name__}: {error}") from error
        if self.outcome != AS_REQUESTED and not self._endless:
            for true, (low, high) in zip(settled, spans, strict=False):
                if not low <= true <= high:
                    raise WrongError(f"the motor is at {true}, not at {low} to {high}")

    # ------------------------------------------------------------------ checks

    def _true(self) -> list[int]:
        """Return the positions that the driver should state."""
        return [at - start for at, start in zip(self.board.positions(), self._starts, strict=True)]

    def _check_position(self, axis: Any, number: int) -> None:
        before = self._true()[number]
        stated = self._call(lambda: axis.position)
        after = self._true()[number]
        if not min(before, after) <= stated <= max(before, after):
            raise WrongError(f"position {stated} is stated, {before} to {after} is true")

    def _check_end(self, number: int, end: Any, pulses: int, begin: int) -> None:
        true = self._true()[number]
        if (end.position, end.pulses, true - begin) != (true, pulses, pulses):
            raise WrongError(
                f"{end.pulses} pulses to {end.position} are stated, {true - begin} to {true} are true, "
                f"{pulses} were requested"
            )

    def _call(self, action: Callable[[], Any]) -> Any:
        """Call the driver.

        Raises:
            PpmcError: the driver raised this exception with a message of one line.
            WrongError: the call took more than LONGEST_CALL, or raised another exception.
        """
        begin = self.line.clock()
        self.line.limit = begin + LONGEST_CALL
        try:
            return action()
        except Hang as error:
            raise WrongError(f"a call does not return: {error}") from error
        except PpmcError as error:
            if not str(error) or "\n" in str(error):
                raise WrongError(f"{type(error).__name__} has no message of one line: {error}") from error
            raise
        except Exception as error:
            raise WrongError(f"{type(error).__name__}: {error}") from error
        finally:
            self.longest = max(self.longest, self.line.clock() - begin)
            self.line.limit = float("inf")

    # ------------------------------------------------------------------ the session

    def _steps(self) -> Iterator[list[Span]]:
        """Use the driver. Before each motion, yield the ranges in which the motors may be from then on."""
        target, rng = self.target, self._rng
        self._device = self._call(lambda: target.open(self.line))
        axes = target.axes(self._device)
        yield self._spans({})
        for axis in axes:
            self._call(lambda axis=axis: target.prepare(axis))
        last = len(axes) - 1
        yield from self._move(axes[last], last, rng.choice((1, 3, 40, 90)))
        self._check_position(axes[last], last)
        if target.queue:
            yield from self._queue(axes[0], [rng.choice((-7, 1, 2, 5, 30)) for _ in range(rng.randint(2, 6))])
        if target.group:
            yield from self._together((rng.randint(-60, -1), rng.randint(1, 60)))
        yield from self._jog(axes[0])
        yield from self._move(axes[0], 0, -rng.randint(1, 60))
        self._check_position(axes[0], 0)

    def _spans(self, ways: dict[int, Sequence[int]]) -> list[Span]:
        """Return the range of possible positions of each motor if axes move by the given distances."""
        found = []
        for number, at in enumerate(self.board.positions()):
            way = [at, *(at + distance for distance in ways.get(number, ()))]
            found.append((min(way), max(way)))
        return found

    def _move(self, axis: Any, number: int, pulses: int) -> Iterator[list[Span]]:
        begin = self._true()[number]
        yield self._spans({number: [pulses]})
        self._check_end(number, self._call(lambda: axis.move(pulses)), pulses, begin)

    def _queue(self, axis: Any, pulses: list[int]) -> Iterator[list[Span]]:
        begin = self._true()[0]
        sums = [sum(pulses[: place + 1]) for place in range(len(pulses))]
        yield self._spans({0: sums})
        results: list[Any] = []
        try:
            self._call(lambda: results.extend(axis.moves(pulses)))
        finally:
            stated = [(end.position, end.pulses) for end in results]
            true = [(begin + way, one) for way, one in zip(sums, pulses, strict=True)]
            if stated != true[: len(stated)]:
                raise WrongError(f"the moves {pulses} from {begin} are stated as {stated}")
        if len(results) != len(pulses) or self._true()[0] != begin + sums[-1]:
            raise WrongError(f"the moves {pulses} from {begin} ended at {self._true()[0]} with {stated}")

    def _together(self, pulses: tuple[int, int]) -> Iterator[list[Span]]:
        begin, device = self._true(), self._device
        yield self._spans({0: pulses[:1], 1: pulses[1:]})
        bank = hasattr(device, "group")
        ways = [dict(enumerate(pulses, 1))] if bank else pulses
        ends = self._call(lambda: device.move_together(*ways))
        for number, end in enumerate(ends.values() if bank else ends):
            self._check_end(number, end, pulses[number], begin[number])

    def _jog(self, axis: Any) -> Iterator[list[Span]]:
        begin = self._true()[0]
        yield []
        self._endless = True
        motion = self._call(lambda: self.target.jog(axis))
        self._call(lambda: self._device.link.pause(self._rng.choice((0.001, 0.02))))
        self._check_position(axis, 0)
        end = self._call(axis.stop)
        self._endless = False
        self._check_end(0, end, self._true()[0] - begin, begin)
        if motion.result != end:
            raise WrongError(f"{motion.result} and {end} are stated for one motion")

    # ------------------------------------------------------------------ after the session

    def _continue(self, error: PpmcError) -> None:
        """After an exception, check that the same objects state the true position, or raise one again."""
        if self._device is None or self._restarted or isinstance(error, Disconnected):
            return
        try:
            for number, axis in enumerate(self.target.axes(self._device)):
                self._check_position(axis, number)
                motion = axis.motion
                if motion is not None:
                    end = self._call(lambda motion=motion: motion.wait(1.0))
                    if end.position != self._true()[number]:
                        raise WrongError(f"{end.position} is stated, {self._true()[number]} is true")
        except PpmcError:
            pass
        except Killed:
            self.outcome = KILLED

    def _connect_again(self) -> list[int]:
        """Connect as a new process, stop all motors, and move; return the positions before this move."""
        if self._restarted:
            self._starts = self._restarted
        self.board.port.read(self._rng.choice((0.0, *DELAYS)))
        self.board.port.set_baud(self.target.baud)
        self.line = FaultyLine(self.board.port)
        device = self._call(lambda: self.target.open(self.line))
        axes = self.target.axes(device)
        for number, axis in enumerate(axes):
            self._check_position(axis, number)
            try:
                self._call(axis.halt)
            except (NothingToStop, NotInitialised):
                pass
            except InAlarm:
                # A repeated request on a restarted PPMC-312 can leave an unread answer, which is an alarm at
                # the next instruction.
                if not self._restarted:
                    raise
                self._call(axis.clear_alarm)
        self._call(lambda: device.link.pause(0.2))
        settled = self.board.positions()
        for number, axis in enumerate(axes):
            self._check_position(axis, number)
            self._call(lambda axis=axis: self.target.prepare(axis))
        for _ in self._move(axes[0], 0, 7):
            pass
        self._check_position(axes[0], 0)
        self._call(device.close)
        return settled
