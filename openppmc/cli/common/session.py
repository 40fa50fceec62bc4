"""Board that a command uses: versions, stored set-up, signals and progress bars.

`init` stores the values of the set-up options of each port in a small JSON file. The first signal decelerates
the motor, the second one stops it immediately, the third one ends the program.
"""

from __future__ import annotations

import json
import os
import re
import signal
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any

import typer

from ... import __version__, parts
from ...errors import PpmcError
from ...host import MotionResult, NothingToStop, open_part
from ...host.capabilities import Capabilities
from ...host.link import DEFAULT_BAUD
from ...host.motion import Progress
from ...host.part import AnyAxis, Device, Part
from ...host.port import virtual
from ...host.script import Build
from ...host.stopping import NO_MOTION, arrived, handled, name_of, print_line, stop_motors
from ...streams import StdoutLost
from . import output
from .board import BOARD
from .options import SetupValues
from .presenter import AnyPresenter, presenter_of

if TYPE_CHECKING:
    from rich.progress import Progress as Bars


def state_folder() -> Path:
    """Return $OPENPPMC_STATE, else the folder `openppmc` in the user's folder for program state."""
    own = os.environ.get("OPENPPMC_STATE")
    if own:
        return Path(own)
    if os.name == "nt":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home()) / "openppmc"
    return Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state") / "openppmc"


def stores_setup(port: str) -> bool:
    """Return True if set-ups may be stored for this port.

    This is not the case for a virtual board, because it starts in reset each time.
    """
    return bool(port) and not virtual(port)


def _file(port: str, axis: int) -> Path:
    name = re.sub(r"[^A-Za-z0-9._-]", "_", port.strip("/"))
    # On Windows, a file COM3.json is the port COM3.
    name = re.sub(r"(?i)^com\d", r"port_\g<0>", name)
    return state_folder() / (name + ("" if axis == 1 else f".axis{axis}") + ".json")


def load_setup(port: str, axis: int = 1) -> dict[str, Any]:
    """Return the stored options of an axis, or {}. Raise PpmcError for an unreadable file."""
    path = _file(port, axis)
    if not stores_setup(port) or not path.is_file():
        return {}
    try:
        values = json.loads(path.read_text(encoding="utf-8"))["setup"]
        if not isinstance(values, dict):
            raise ValueError("no table")
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise PpmcError(
            f"{path}: the stored set-up cannot be read; delete the file, then run init"
        ) from error
    return values


def store_setup(port: str, values: dict[str, Any], axis: int = 1) -> None:
    """Store the options for later commands. Raise PpmcError if the file cannot be written."""
    if not stores_setup(port):
        return
    path = _file(port, axis)
    text = json.dumps({"port": port, "setup": values}, indent=1) + "\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = path.with_suffix(f".{os.getpid()}")
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(path)
    except OSError as error:
        raise PpmcError(f"{path}: the set-up cannot be stored ({error.strerror})") from error


BAR_AFTER = 0.6
"""Time in s from the start of a motion until its progress bar is shown."""


class Interrupted(Exception):  # noqa: N818 - the user did it
    """A signal has arrived.

    The exception is raised only where the program checks for signals, so it never interrupts a frame.
    """


class Guard:
    """Context manager that only counts signals, so that they do not interrupt an exchange with a board.

    Attributes:
        number: number of the first signal.
    """

    def __init__(self) -> None:
        self.count = 0
        self.number = int(signal.SIGINT)
        self._bars: Bars | None = None
        self._handled = handled(self._on_signal)

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

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if not self.count:
            self.number = number
        self.count += 1
        if self.count > 2:
            os._exit(128 + number)

    def check(self) -> None:
        """Raise Interrupted if a signal has arrived, StdoutLost if stdout cannot be written."""
        if self.count:
            raise Interrupted
        sys.stdout.flush()

    def progress(self, now: Progress) -> None:
        """Check for signals and update the progress bar. This is the progress callback of motions."""
        self.check()
        self.bar(now)

    def pause(self, part: Device, seconds: float) -> None:
        """Wait for a time in s, measured with the clock of the board."""
        link = part.link
        end = link.clock() + seconds
        while (left := end - link.clock()) > 0:
            self.check()
            part.process_reports(min(left, 0.1))
        self.check()

    # ------------------------------------------------------------------ bar

    def bar(self, now: Progress) -> None:
        """Show or update the bar of the running motion if stderr is a terminal."""
        if not sys.stderr.isatty() or now.seconds < BAR_AFTER:
            return
        self._draw("moving", "position {task.fields[at]}", now.requested, now.done, at=now.position)

    def count_bar(self, what: str, done: int, of: int) -> None:
        """Show or update a bar with a count if stderr is a terminal."""
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
        """Remove the bar."""
        if self._bars is not None:
            with suppress(OSError):  # the terminal was closed
                self._bars.stop()
            self._bars = None

    # ------------------------------------------------------------------ signals and a lost stdout

    @contextmanager
    def stop_motors_on_exit(self, part: Device) -> Iterator[None]:
        """Stop the motors if the block ends because of a signal or a lost stdout."""
        try:
            self.check()
            yield
            sys.stdout.flush()
        except Interrupted:
            print_line(self.stop_motors(part))
            raise typer.Exit(self.status) from None
        except StdoutLost as lost:
            self.bar_off()
            motors = stop_motors([part], stop_now=lambda: self.count > 0)
            lost.motors = "" if motors.startswith(NO_MOTION) else motors
            raise

    @property
    def status(self) -> int:
        """Exit status of the program after a signal."""
        return 128 + self.number

    def stop_motors(self, part: Device) -> str:
        """Decelerate all axes, wait, and return one line for the user.

        The next signal stops the axes immediately.
        """
        self.bar_off()
        return f"{name_of(self.number)}: {stop_motors([part], stop_now=lambda: self.count > 1)}"


def mismatch(build: Build | None, number: int) -> str:
    """Return one line that states how bitstream and package differ, and what to do.

    The result is empty if they match, or if this cannot be checked.

    Args:
        number: part number in the answer to IDENT.
    """
    if build is None:
        return ""
    if build.version != __version__:
        older = "the package" if _order(build.version) > _order(__version__) else "the bitstream"
        return f"the bitstream has version {build.version}, this package {__version__}; renew {older}"
    row = parts.by_number(number)
    if not build.source or row is None:
        return ""
    from ... import sources
    from ...sim.common.build import find_root

    try:
        own = sources.digest(find_root(), f"{row.rtl}_carrier").hex()
    except (PpmcError, RuntimeError, OSError):
        return ""  # the package is not part of a checkout
    if own and build.source != own:
        return (
            f"the bitstream was built from other sources ({build.source}) than those of this checkout "
            f"({own}); build and load it again to test this checkout"
        )
    return ""


def _order(version: str) -> list[int]:
    return [int(word) for word in version.split(".") if word.isdigit()]


@dataclass
class Session:
    """An open board."""

    part: Part
    guard: Guard

    @property
    def kind(self) -> Capabilities:
        """Capabilities of the part."""
        return self.part.kind

    @property
    def presenter(self) -> AnyPresenter:
        """Presenter of the part, which defines its output and additional functions."""
        return presenter_of(self.kind)

    @property
    def xtal_hz(self) -> int:
        """Crystal frequency in Hz."""
        return self.part.link.identity.xtal_hz

    def axis(self, number: int = 1) -> AnyAxis:
        """Return an axis. Raise OutOfRange if the part does not have it."""
        return self.part.axes[self.kind.check_axis(number) - 1]

    def selected_axes(self, number: int | None) -> Sequence[AnyAxis]:
        """Return the axis with this number, all axes for None."""
        return self.part.axes if number is None else (self.axis(number),)


def setup_values(typed: dict[str, Any], axis: int = 1) -> SetupValues:
    """Return the set-up of an axis.

    Each value is the typed value, if any; otherwise, the value that `init` stored for this port and axis;
    otherwise, the default.
    """
    return SetupValues().merged(load_setup(BOARD.port, axis)).merged(typed)


def open_board() -> Part:
    """Open the board."""
    number = None if BOARD.part is None else parts.part(BOARD.part).number
    return open_part(BOARD.spec, BOARD.baud or DEFAULT_BAUD, number)


def note_mismatch(part: Part) -> None:
    """Print a note if bitstream and package do not match."""
    if line := mismatch(part.link.build(), part.link.identity.part):
        output.note(f"note: {line}")


@contextmanager
def opened() -> Iterator[Session]:
    """Open the board. A signal n stops the motors, and the exit status is then 128 + n.

    The motors are also stopped if stdout is lost.
    """
    with open_board() as part, Guard() as guard, guard.stop_motors_on_exit(part):
        note_mismatch(part)
        yield Session(part, guard)


@contextmanager
def ready(typed: dict[str, Any], axes: Iterable[int]) -> Iterator[Session]:
    """Open the board and initialise these axes."""
    with opened() as session:
        initialise(session, {axis: setup_values(typed, axis) for axis in axes})
        yield session


def initialise(session: Session, values: dict[int, SetupValues]) -> list[Any]:
    """Plan the set-ups of all axes, then initialise the axes; return the set-ups that are reached."""
    plans = {
        axis: table.plan(session.xtal_hz, session.kind, session.kind.check_axis(axis))
        for axis, table in values.items()
    }
    return [session.part.axes[axis - 1].apply(plan) for axis, plan in plans.items()]


def stop_all(axes: Sequence[AnyAxis], now: bool = False) -> list[MotionResult]:
    """Stop motions, including motions that other programs started, and wait for their ends.

    All axes are stopped before an error is raised. An axis at standstill is an error only if no axis could be
    stopped.
    """
    errors: list[PpmcError] = []
    moving = []
    for axis in axes:
        try:
            (axis.halt if now else axis.stop)(wait=False)
            moving.append(axis)
        except PpmcError as error:
            errors.append(error)
    ends = [axis.motion.wait() for axis in moving if axis.motion is not None]
    for one in errors:
        if len(errors) == len(axes) or not isinstance(one, NothingToStop):
            raise one
    return ends
