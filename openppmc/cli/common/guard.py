"""Signals and progress bars. The first signal decelerates, the second one stops at once, the third exits."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any

import typer

from ...host.motion import Progress
from ...host.part import Device
from ...host.stopping import NO_MOTION, arrived, bring_to_rest, handled, name_of, say
from ...streams import StdoutLost

if TYPE_CHECKING:
    from rich.progress import Progress as Bars

BAR_AFTER = 0.6
"""Seconds that a motion runs before it gets a bar."""


class Interrupted(Exception):  # noqa: N818 - the user did it
    """A signal has arrived; raised where the program looks for it, never in the middle of a frame."""


class Guard:
    """Context manager: counts signals instead of letting them break the dialogue with the board. number: of
    the first signal."""

    def __init__(self) -> None:
        self.count = 0
        self.number = int(signal.SIGINT)
        self._bars: Bars | None = None
        self._handled = handled(self._note)

    def __enter__(self) -> Guard:
        self._handled.__enter__()
        if arrived:
            self.count, self.number = 1, arrived[0]
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.bar_off()
        self._handled.__exit__(None, None, None)

    def _note(self, number: int, frame: FrameType | None) -> None:
        if not self.count:
            self.number = number
        self.count += 1
        if self.count > 2:
            os._exit(128 + number)

    def check(self) -> None:
        """Raise Interrupted if a signal has arrived, StdoutLost if stdout rejects what was printed."""
        if self.count:
            raise Interrupted
        sys.stdout.flush()

    def progress(self, now: Progress) -> None:
        """Progress callback of motions."""
        self.check()
        self.bar(now)

    def pause(self, part: Device, seconds: float) -> None:
        """Let time pass on the board's clock."""
        link = part.link
        end = link.clock() + seconds
        while (left := end - link.clock()) > 0:
            self.check()
            part.attend(min(left, 0.1))
        self.check()

    # ------------------------------------------------------------------ bar

    def bar(self, now: Progress) -> None:
        """Show or move the bar of the running motion; only on a terminal."""
        if not sys.stderr.isatty() or now.seconds < BAR_AFTER:
            return
        self._draw("moving", "position {task.fields[at]}", now.asked, now.made, at=now.position)

    def count_bar(self, what: str, done: int, of: int) -> None:
        """Show or move a bar that counts; only on a terminal."""
        if sys.stderr.isatty():
            self._draw(what, "{task.completed}/{task.total}", of, done)

    def _draw(self, what: str, text: str, total: int | None, done: int, **fields: Any) -> None:
        if self._bars is None:
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn

            columns = TextColumn("{task.description}"), BarColumn(), TextColumn(text)
            self._bars = Progress(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bars.add_task(what, total=total, **fields)
            self._bars.start()
        self._bars.update(self._task, total=total, completed=done, **fields)

    def bar_off(self) -> None:
        """The motion is over."""
        if self._bars is not None:
            with suppress(OSError):  # the terminal was closed
                self._bars.stop()
            self._bars = None

    # ------------------------------------------------------------------ what a signal or a lost stdout does

    @contextmanager
    def resting(self, part: Device) -> Iterator[None]:
        """Bring the motors to rest if the block ends by a signal or because stdout is lost."""
        try:
            self.check()
            yield
            sys.stdout.flush()
        except Interrupted:
            say(self.bring_to_rest(part))
            raise typer.Exit(self.status) from None
        except StdoutLost as lost:
            self.bar_off()
            motors = bring_to_rest([part], hurry=lambda: self.count > 0)
            lost.motors = "" if motors.startswith(NO_MOTION) else motors
            raise

    @property
    def status(self) -> int:
        """Exit status after a signal."""
        return 128 + self.number

    def bring_to_rest(self, part: Device) -> str:
        """Decelerate all axes, wait; at once on the next signal. Returns one line for the user."""
        self.bar_off()
        return f"{name_of(self.number)}: {bring_to_rest([part], hurry=lambda: self.count > 1)}"
