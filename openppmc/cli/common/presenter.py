"""Output of a device on the command line, and functions that only some devices support.

The column `presenter` of the table of parts names the presenter of a part. Parts without an entry use
`RampPresenter`, the presenter of the PPMC-104. A forecast is computed from the ramp of the golden model
before the move. `--at POSITION:WHAT` sets an override: an action that the device executes when it passes a
position.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from ...errors import needs
from ...host import MotionResult, speeds
from ...host import speeds as units
from ...host.axis import OnProgress
from ...host.capabilities import Capabilities
from ...host.errors import OutOfRange
from ...host.link import Link
from ...host.motion import AnyMotion
from ...host.part import AnyAxis
from ...model.motion.codes import ENDLESS
from ...model.motion.ramp import profile_index
from . import show

FARTHEST = 1 << 31


@dataclass(frozen=True)
class Override:
    """Action at a position: a change of the speed with a ramp, or a stop.

    Attributes:
        now: True for a stop without a ramp.
    """

    at: int
    speed: float | None = None
    now: bool = False


def parse_override(text: str) -> Override:
    """Parse `2000:stop`, `2000:halt` or `2000:3500`. Raise ValueError for any other text."""
    place, colon, what = (piece.strip() for piece in text.partition(":"))
    try:
        at = int(place)
        if not (colon and -FARTHEST <= at < FARTHEST):
            raise ValueError
        if what in ("stop", "halt"):
            return Override(at, now=what == "halt")
        speed = float(what)
        if not 0 < speed < float("inf"):
            raise ValueError
    except ValueError:
        raise ValueError(f"{text!r} is not POSITION:stop, POSITION:halt or POSITION:PPS") from None
    return Override(at, speed)


LONGEST_PLOT = 1_000_000


def key_figures(setup: units.Setup, pulses: int, speed: units.Speed | None) -> dict[str, Any]:
    """Return the figures of an undisturbed move.

    Times are in s, from the first to the last pulse; speeds are in pps. The ramps are computed interval by
    interval, the motion between them by a formula. Raises OutOfRange if the part does not support the number
    of pulses.
    """
    n = abs(pulses)
    if not 1 <= n <= ENDLESS:
        raise OutOfRange(f"{pulses} pulses: a move has 1 to {ENDLESS} pulses either way")
    if speed is not None:
        return {
            "pulses": pulses,
            "profile": "constant speed",
            "top_pps": float(speed.reached),
            "seconds": float((n - 1) / speed.reached),
        }
    ramp, clock = setup.ramp(), setup.clock
    pa = ramp.pa
    plateau = max(0, n - 1 - 2 * pa)
    sloped = range(1, n) if not plateau else (*range(1, pa + 1), *range(n - pa, n))
    periods = [1 / clock.speed_of(ramp.rate(profile_index(n, pa, j)) + 1) for j in sloped]
    slopes = sum(periods, Fraction(0))
    top = setup.high.reached if plateau else 1 / min(periods, default=1 / clock.speed_of(ramp.rl + 1))
    return {
        "pulses": pulses,
        "profile": "trapezoid" if plateau else "triangle",
        "top_pps": float(top),
        "ramp_pulses": pa if plateau else (n - 1) // 2,
        "plateau_intervals": plateau,
        "ramp_seconds": float(sum(periods[: len(periods) // 2], Fraction(0))),
        "seconds": float(slopes + plateau / setup.high.reached),
    }


@dataclass(frozen=True)
class Trajectory:
    """A move that is drawn: time of each pulse in s, and speed in each interval in pps."""

    seconds: list[float]
    speeds: list[float]

    @classmethod
    def of(cls, setup: units.Setup, pulses: int, speed: units.Speed | None) -> Trajectory:
        """Compute the trajectory of a move with the ramp of the set-up, or at constant `speed`.

        Args:
            pulses: 1 or more.
        """
        if speed is None:
            ramp, clock = setup.ramp(), setup.clock
            counts = [ramp.rate(profile_index(pulses, ramp.pa, j)) + 1 for j in range(1, pulses)]
        else:
            clock = speed.clock
            counts = [speed.rate + clock.beyond] * (pulses - 1)
        period, extra = float(clock.period), float(clock.extra)
        seconds = [n * extra + total * period for n, total in enumerate(accumulate(counts, initial=0))]
        speeds = {count: float(clock.speed_of(count)) for count in set(counts)}
        return cls(seconds, [speeds[count] for count in counts])


def plot_move(trajectory: Callable[[int], Trajectory], pulses: int, path: Path) -> None:
    """Write a plot of the speed over time as PNG, SVG or PDF.

    Raises OutOfRange if the move is too long to draw, or if the plotter does not support the file format that
    the suffix of the file name requests.

    Args:
        trajectory: function that computes the trajectory of a move of a given number of pulses.
    """
    needs("plot", "a plot", "matplotlib")
    from ...plot.profile import FORMATS, draw_profile

    if abs(pulses) > LONGEST_PLOT:
        raise OutOfRange(f"a plot shows up to {LONGEST_PLOT} pulses; choose a shorter move")
    if path.suffix.lower() not in FORMATS:
        raise OutOfRange(f"{path}: unsupported suffix of a plot; use {', '.join(FORMATS)}")
    draw_profile(trajectory(abs(pulses)), f"{pulses} pulses", path)


class Status(Protocol):
    """Status register of a part; each part defines the bits."""

    @property
    def raw(self) -> int:
        """Value that was read from the part."""


class WithStatus(Protocol):
    """Part with a status register."""

    @property
    def kind(self) -> Capabilities: ...
    @property
    def link(self) -> Link: ...
    def status(self) -> Status:
        """Read the status, without side effects in the part."""


PartT = TypeVar("PartT", bound=WithStatus)
SetupT = TypeVar("SetupT")


class Presenter(ABC, Generic[PartT, SetupT]):
    """Output and additional functions of a part.

    PartT is the driver of the part, SetupT the type of its plans. Speeds are in pps, times in s. If the part
    does not have the function of an optional method, the method raises OutOfRange or does nothing.

    Attributes:
        wide: True to print several axes as the rows of one table.
    """

    wide = False

    # ------------------------------------------------------------------ reading

    @abstractmethod
    def status_values(self, part: PartT, axis: AnyAxis) -> dict[str, Any]:
        """Return the values that may be read at any time: position, moving, error, status, inputs."""

    def status_of(self, part: PartT, axes: Sequence[AnyAxis]) -> dict[int, dict[str, Any]]:
        """Return the `status_values` of these axes, by axis number."""
        return {axis.number: self.status_values(part, axis) for axis in axes}

    def status_rows(self, values: dict[str, Any]) -> dict[str, str]:
        """Return the values as rows of text."""
        error = values["error"]
        return {
            "position": "no counter" if values["position"] is None else str(values["position"]),
            "motor": "moving" if values["moving"] else "at rest",
            "switches": show.switches(values["inputs"]),
            "last byte": "good" if error is None else f"error {error}",
        }

    def busy(self, part: PartT, axes: Sequence[AnyAxis]) -> tuple[AnyAxis, ...]:
        """Return the axes that are moving."""
        return tuple(axis for axis in axes if self.status_values(part, axis)["moving"])

    def reports(self, part: PartT, print_line: Callable[[str], None]) -> None:
        """Pass each new report to `print_line` as a line; then raise the first error among the reports."""

    # ------------------------------------------------------------------ plans

    @abstractmethod
    def setup_rows(self, setup: SetupT) -> dict[str, str]:
        """Return rows with the requested and reached speeds, the ramp and the bytes."""

    @abstractmethod
    def setup_values(self, setup: SetupT) -> dict[str, Any]:
        """Return the values for JSON."""

    @abstractmethod
    def figures(self, setup: SetupT, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
        """Return the predicted figures of a move; see `key_figures`.

        Args:
            speed: constant speed, None for a move with ramps.
        """

    @abstractmethod
    def trajectory(self, setup: SetupT, pulses: int, speed: speeds.Speed | None) -> Trajectory:
        """Return the move to draw.

        Args:
            pulses: 1 or more.
        """

    # ------------------------------------------------------------------ functions of some parts only

    def prepare(self, part: PartT, overrides: Sequence[Override], encoder: int | None) -> None:
        """Set the overrides of the next move, and the permitted deviation of the encoder in pulses."""
        if encoder is not None:
            raise OutOfRange(f"encoder: a {part.kind} does not have that")
        if overrides:
            raise OutOfRange(f"overrides: a {part.kind} does not have that")

    def move_together(
        self,
        part: PartT,
        pulses: Mapping[int, int],
        pps: float | None,
        progress: OnProgress,
        pulse_only: bool = False,
    ) -> Sequence[MotionResult]:
        """Move several axes, which start together, and wait for the end of all motions.

        Args:
            pulses: pulses of each axis, by its number.
        """
        raise OutOfRange(f"two moves at a time: a {part.kind} does not have that")

    def start_together(self, part: PartT, pulses: Mapping[int, int]) -> Mapping[int, AnyMotion]:
        """Start moves of several axes with ramps in the same cycle, and return the motions.

        Args:
            pulses: number of pulses of each axis, by axis number.
        """
        raise OutOfRange(f"two moves at a time: a {part.kind} does not have that")

    def halt_all(self, part: PartT) -> list[MotionResult] | None:
        """Stop all axes immediately, at the same time, and return the results.

        Returns None if the part does not support this.
        """
        return None

    def home(
        self,
        part: PartT,
        axis: AnyAxis,
        direction: int,
        pps: float | None,
        fast: bool,
        to_limit: bool,
        index: bool,
        progress: OnProgress,
    ) -> None:
        """Find the origin.

        Args:
            index: True if the origin is the first index of the encoder on the switch.
        """
        if index:
            raise OutOfRange(f"index: a {part.kind} does not have that")
        axis.home(direction, pps, fast, to_limit, progress=progress)

    def table_lines(self, part: PartT) -> list[str]:
        """Return the ramps that are stored in the part, as the lines of a CSV file for --curve."""
        raise OutOfRange(f"table: a {part.kind} does not have that")


class RampPresenter(Presenter[PartT, speeds.Setup]):
    """Presenter of the parts with the ramp of the PPMC family."""

    def status_values(self, part: PartT, axis: AnyAxis) -> dict[str, Any]:
        status: Any = part.status()
        moving, error = self.moving(status, axis.number)
        return {
            "position": axis.position if part.link.identity.counter else None,
            "moving": moving,
            "error": error,
            "status": status.raw,
            "inputs": {name: bool(on) for name, on in vars(axis.inputs()).items()},
        }

    def moving(self, status: Any, number: int) -> tuple[bool, int | str | None]:
        """Return (True if the axis moves, error code) from a status of axis `number`."""
        return status.busy, None if status.error is None else int(status.error)

    def setup_rows(self, setup: speeds.Setup) -> dict[str, str]:
        return show.setup_rows(setup)

    def setup_values(self, setup: speeds.Setup) -> dict[str, Any]:
        return show.setup_values(setup)

    def figures(self, setup: speeds.Setup, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
        return key_figures(setup, pulses, speed)

    def trajectory(self, setup: speeds.Setup, pulses: int, speed: speeds.Speed | None) -> Trajectory:
        return Trajectory.of(setup, pulses, speed)


AnyPresenter = Presenter[Any, Any]
"""Presenter for a part of any type."""
_USUAL: AnyPresenter = RampPresenter[WithStatus]()


def presenter_of(kind: Capabilities) -> AnyPresenter:
    """Return the presenter of the parts with these capabilities."""
    presenter: AnyPresenter = kind.row.load("presenter") if kind.row.presenter else _USUAL
    return presenter
