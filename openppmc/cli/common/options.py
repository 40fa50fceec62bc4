"""Set-up options that several commands share; `init` stores their values."""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields, replace
from enum import Enum
from typing import Annotated, Any

import typer

from ... import parts
from ...errors import PpmcError
from ...host.capabilities import AnySetup, Capabilities, SetupRequest

MOST_AXES = max(row.axes for row in parts.having("number", "capabilities"))
"""Highest axis number that --axis accepts. The connected part may have fewer axes."""
Json = Annotated[bool, typer.Option("--json", help="print JSON")]
_PANEL = "Set-up (stored by init)"


def check_seconds(seconds: float | None) -> None:
    """Raise BadParameter if the value of --seconds is negative, infinite or not a number."""
    if seconds is not None and not 0 <= seconds < float("inf"):
        raise typer.BadParameter(f"--seconds {seconds:g}: not a valid time; use 0 or more")


class Logic(str, Enum):
    """Level that switches a coil on."""

    POSITIVE = "positive"
    NEGATIVE = "negative"


class Direction(str, Enum):
    """Directions as users type them."""

    CW = "cw"
    CCW = "ccw"

    @property
    def code(self) -> int:
        """Number of the direction: 0 for CW, 1 for CCW."""
        return int(self is Direction.CCW)


@dataclass(frozen=True)
class SetupValues:
    """Values of the set-up options: speeds in pps, clocks in Hz. If ramp is None, the default is used."""

    start: float = 1000
    high: float = 5000
    ramp: int | None = None
    phases: int = 4
    half_step: bool = False
    logic: str | None = None
    chop: bool = False
    base_clock: float | None = None
    external_clock: float | None = None
    long_intervals: bool = False
    stop: float | None = None
    down: int | None = None
    sigmoid: bool = False
    curve: str | None = None

    def merged(self, changes: dict[str, Any]) -> SetupValues:
        """Return a copy with those changes that are not None. Raise PpmcError for unknown names."""
        known = {field.name for field in fields(self)}
        if unknown := set(changes) - known:
            raise PpmcError(
                f"unknown set-up value {sorted(unknown)[0]!r} (there are {', '.join(sorted(known))})"
            )
        return replace(self, **{name: value for name, value in changes.items() if value is not None})

    def table(self) -> dict[str, Any]:
        """Return the values for the state file."""
        return asdict(self)

    def request(self, axis: int = 1) -> SetupRequest:
        """Return the request for an axis."""
        return SetupRequest(
            self.start,
            self.high,
            self.ramp,
            self.phases,
            self.half_step,
            None if self.logic is None else Logic(self.logic) is Logic.POSITIVE,
            self.chop,
            self.base_clock,
            self.external_clock,
            self.long_intervals,
            axis,
            self.stop,
            self.down,
            self.sigmoid,
            self.curve,
        )

    def plan(self, xtal_hz: int, kind: Capabilities, axis: int = 1) -> AnySetup:
        """Return the plan of an axis with this crystal. Raise OutOfRange for unsupported values."""
        return kind.plan(xtal_hz, self.request(axis))


def _option(*names: str, text: str, metavar: str | None = None) -> Any:
    return typer.Option(*names, help=text, rich_help_panel=_PANEL, metavar=metavar, show_default=False)


_OPTIONS: dict[str, Any] = {
    "start": Annotated[float | None, _option("--start", text="start-up speed (1000)", metavar="PPS")],
    "high": Annotated[float | None, _option("--high", text="high speed (5000)", metavar="PPS")],
    "ramp": Annotated[
        int | None,
        _option("--ramp", text="pulses from start to high speed (200; ppmc312: 2000)", metavar="PULSES"),
    ],
    "phases": Annotated[
        int | None, _option("--phases", text="number of motor phases: 3, 4 or 5 (4)", metavar="N")
    ],
    "half_step": Annotated[bool | None, _option("--half-step/--full-step", text="excitation (full step)")],
    "logic": Annotated[
        Logic | None,
        _option("--logic", text="level that switches a coil on (positive; not for ppmc2104)"),
    ],
    "chop": Annotated[bool | None, _option("--chop/--no-chop", text="chopper at standstill (no)")],
    "base_clock": Annotated[
        float | None,
        _option(
            "--base-clock",
            text="500000 or 125000, stmc: 48675 or 12500, ppmc312: 8e6 … 15625 "
            "(default: reaches the start speed)",
            metavar="HZ",
        ),
    ],
    "external_clock": Annotated[
        float | None, _option("--external-clock", text="frequency at the clock pin (not used)", metavar="HZ")
    ],
    "long_intervals": Annotated[
        bool | None,
        _option("--long-intervals/--plain-intervals", text="7.5 us longer intervals, vsel low (plain)"),
    ],
    "stop": Annotated[
        float | None, _option("--stop", text="ppmc312: stop speed (the start speed)", metavar="PPS")
    ],
    "down": Annotated[
        int | None, _option("--down", text="ppmc312: pulses of the deceleration (--ramp)", metavar="PULSES")
    ],
    "sigmoid": Annotated[bool | None, _option("--sigmoid/--linear", text="ppmc312: shape (linear)")],
    "curve": Annotated[
        str | None,
        _option("--curve", text="ppmc312: free curve, a CSV of pps,up[,down], slowest first", metavar="FILE"),
    ],
}


def with_setup(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the set-up options to a command.

    The command receives the options that the user has typed as the dict `typed`.
    """
    return with_options("typed", _OPTIONS, _setup_values)(command)


def _setup_values(typed: dict[str, Any]) -> dict[str, Any]:
    if "logic" in typed:
        typed["logic"] = typed["logic"].value
    if "curve" in typed:
        # `init` stores the path, and later commands may run in another folder.
        typed["curve"] = os.path.abspath(typed["curve"])
    return typed


def with_options(
    parameter: str, options: dict[str, Any], finish: Callable[[dict[str, Any]], Any]
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds options to a command, which receives them as one parameter.

    Args:
        options: annotation of each option, by its name. The default value of each option is None.
        finish: function that returns the value of this parameter from the options that the user typed.
    """

    def decorator(command: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(command)
        def wrapper(**arguments: Any) -> Any:
            values = {name: arguments.pop(name) for name in options}
            typed = {name: value for name, value in values.items() if value is not None}
            return command(**arguments, **{parameter: finish(typed)})

        # get_type_hints is not used: on Python 3.10, its result lacks the Annotated of options with the
        # default None.
        own = [
            one.replace(kind=inspect.Parameter.KEYWORD_ONLY)
            for name, one in inspect.signature(command, eval_str=True).parameters.items()
            if name != parameter
        ]
        added = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)
            for name, annotation in options.items()
        ]
        seen: Any = wrapper  # typer reads its signature
        del seen.__wrapped__
        seen.__signature__ = inspect.Signature([*own, *added])
        seen.__annotations__ = {one.name: one.annotation for one in (*own, *added)}
        return wrapper

    return decorator
