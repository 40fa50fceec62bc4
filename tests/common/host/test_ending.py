"""Messages of the errors that the check of a motion's end raises."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from openppmc.host import Cause, LimitReached, MotionResult, NoAnswer, StoppedByCommand
from openppmc.host.stopping import stop_motors


def test_messages_of_ends() -> None:
    """A message contains the number of pulses only if it is known: not for a motion of another program."""
    assert MotionResult(Cause.COMPLETE, 5, 0, 5, 0).check(5).complete
    with pytest.raises(StoppedByCommand, match="^stop command ended the motion at position 7 after 3 of 5 p"):
        MotionResult(Cause.STOP, 3, 2, 7, 0).check(5)
    with pytest.raises(LimitReached, match="^axis 2: limit switch ended the motion at position 7: move away"):
        MotionResult(Cause.LIMIT, None, 2, 7, 0, "axis 2: ").check()
    with pytest.raises(LimitReached, match="^limit switch ended the motion: move away"):
        MotionResult(Cause.LIMIT, None, 2, None, 0).check()


def test_a_part_that_does_not_answer_may_move() -> None:
    """If a stop is not answered, the result states that it is not known whether a motor moves."""

    class Silent:
        motion = None
        _message_prefix = ""

        def stop(self, wait: bool) -> None:
            raise NoAnswer("no answer")

        @property
        def position(self) -> int:
            raise NoAnswer("no answer")

    device: Any = SimpleNamespace(axes=[Silent()], link=SimpleNamespace(clock=lambda: 0.0))
    assert stop_motors([device], every=True) == "not known whether a motor moves, no answer"
