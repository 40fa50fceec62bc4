"""Ctrl-C and progress bars. The first Ctrl-C decelerates, the second one stops at once."""

from __future__ import annotations

import signal
import sys
import threading
from types import FrameType, TracebackType

from rich.console import Console
from rich.progress import BarColumn, TextColumn
from rich.progress import Progress as Bars

from ...host import PpmcError
from ...host.axis.device import Device
from ...host.axis.motion import Progress

BAR_AFTER = 0.6
"""Seconds that a motion runs before it gets a bar."""


class Interrupted(Exception):  # noqa: N818 - the user did it
    """Ctrl-C came; raised where the program looks for it, never in the middle of a frame."""


class Guard:
    """Context manager: counts Ctrl-C instead of letting it break the dialogue with the board."""

    def __init__(self) -> None:
        self.count = 0
        self._before: object = None
        self._bars: Bars | None = None
        self._ours = threading.current_thread() is threading.main_thread()

    def __enter__(self) -> Guard:
        if self._ours:
            self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.bar_off()
        if self._ours:
            signal.signal(signal.SIGINT, self._before)  # type: ignore[arg-type]

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.count += 1

    def check(self) -> None:
        """Raises Interrupted if Ctrl-C came."""
        if self.count:
            raise Interrupted

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
        if self._bars is None:
            columns = (
                TextColumn("{task.description}"),
                BarColumn(),
                TextColumn("position {task.fields[at]}"),
            )
            self._bars = Bars(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bars.add_task("moving", total=now.asked, at=now.position)
            self._bars.start()
        self._bars.update(self._task, total=now.asked, completed=now.made, at=now.position)

    def count_bar(self, what: str, done: int, of: int) -> None:
        """Show or move a bar that counts; only on a terminal."""
        if not sys.stderr.isatty():
            return
        if self._bars is None:
            columns = (
                TextColumn("{task.description}"),
                BarColumn(),
                TextColumn("{task.completed}/{task.total}"),
            )
            self._bars = Bars(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bars.add_task(what, total=of)
            self._bars.start()
        self._bars.update(self._task, total=of, completed=done)

    def bar_off(self) -> None:
        """The motion is over."""
        if self._bars is not None:
            self._bars.stop()
            self._bars = None

    # ------------------------------------------------------------------ what Ctrl-C does

    def bring_to_rest(self, part: Device) -> str:
        """Decelerate all axes, wait; at once on the next Ctrl-C. Returns where they stand, for the user."""
        self.bar_off()
        how = "nothing was moving"
        seen = self.count
        moving = [
            axis
            for axis in part.axes
            if axis.motion is not None and axis.motion.end is None and axis.motion.poll() is not None
        ]

        def look(now: Progress) -> None:
            nonlocal seen, how
            if self.count > seen:
                seen = self.count
                how = "stopped at once"
                for axis in moving:
                    axis.halt(wait=False)

        for axis in moving:
            how = "stopped"
            axis.stop(wait=False)
        for axis in moving:
            assert axis.motion is not None
            axis.motion.wait(progress=look)
        try:
            at = [f"{axis.who}position {axis.position}" for axis in part.axes]
        except PpmcError:
            at = []
        return ", ".join([f"interrupted: {how}", *at])
