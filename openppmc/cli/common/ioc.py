"""The command `ioc`, which serves motor records to EPICS clients."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from typing import Annotated, Any, TypeVar

import typer

from ...host.capabilities import SetupRequest
from ...host.part import Device
from ...host.stopping import print_line
from . import output
from .line_session import parse_numbers
from .options import with_options, with_setup
from .session import Guard, initialise, open_board, opened, setup_values

T = TypeVar("T")
Prefix = Annotated[str, typer.Option("--prefix", metavar="TEXT", help="beginning of the PV names: lab:")]
Axes = Annotated[
    str | None, typer.Option("--axis", metavar="N", help="axes, as 3, 1,2,5 or 1-4 (all)", show_default=False)
]
_EACH = "one for all or each axis"


def _option(metavar: str, text: str) -> Any:
    return Annotated[str | None, typer.Option(metavar=metavar, help=f"{text}; {_EACH}")]


_OPTIONS = {
    "mres": _option("X,…", "units for each pulse (1)"),
    "egu": _option("X,…", "unit (pulses)"),
    "prec": _option("N,…", "decimal places (3)"),
    "limits": _option("X:Y,…", "soft limits in units (none)"),
}
with_units = with_options("units", _OPTIONS, dict)
"""Decorator that adds the options of motor records to a command, as the dict `units`."""


def _each(
    name: str, texts: Mapping[str, str], count: int, default: T, parse: Callable[[str], T]
) -> Sequence[T]:
    """Return the values of an option for all axes. Raise BadParameter if a value is invalid."""
    if name not in texts:
        return [default] * count
    try:
        values = [parse(word.strip()) for word in texts[name].split(",")]
    except ValueError:
        raise typer.BadParameter(f"--{name} {texts[name]}: not valid; see the form in --help") from None
    if len(values) not in (1, count):
        raise typer.BadParameter(
            f"--{name} {texts[name]}: {len(values)} values for {count} axes; give one for all or one for each"
        )
    return values * count if len(values) == 1 else values


def _step(text: str) -> float:
    if not math.isfinite(value := float(text)) or not value:
        raise ValueError
    return value


def _limits(text: str) -> tuple[float, float]:
    low, high = map(float, text.split(":"))
    if not -math.inf < low < high < math.inf:
        raise ValueError
    return low, high


def check_prefix(prefix: str) -> None:
    """Check the prefix of PV names.

    Raise BadParameter if it is invalid, or MissingExtraError if caproto is not installed.
    """
    if not re.fullmatch(r"[A-Za-z0-9_:;<>\[\]-]{1,50}", prefix):
        raise typer.BadParameter(f"--prefix {prefix!r}: use 1 to 50 letters, digits or _ - : ; < > [ ]")
    from ... import epics  # noqa: F401 - checks the extra before a port is opened


def serve(
    device: Device,
    guard: Guard,
    prefix: str,
    units: Mapping[str, str],
    requests: Mapping[int, SetupRequest | None],
    reopen: Callable[[], Device],
) -> None:
    """Serve records until a signal arrives.

    Args:
        requests: set-up with which each axis is initialised, by its number.
        reopen: function that opens the device again after its port was lost.
    """
    from ...epics import Units, serve
    from ...positioner import Positioner

    count = len(requests)
    columns = (
        _each("mres", units, count, 1.0, _step),
        _each("egu", units, count, "pulses", str),
        _each("prec", units, count, 3, int),
        _each("limits", units, count, (0.0, 0.0), _limits),
    )
    motors = {
        f"{prefix}m{number}": (Positioner(device, number, request=request), Units(*values))
        for (number, request), values in zip(requests.items(), zip(*columns, strict=True), strict=True)
    }

    def ready(port: int) -> None:
        output.print_line(f"{' '.join(motors)}: ready, TCP port {port}; Ctrl-C ends the IOC")

    with ExitStack() as later:

        def open_again() -> Device:
            later.close()
            device.close()
            fresh = later.enter_context(reopen())
            later.enter_context(guard.stop_motors_on_exit(fresh))
            return fresh

        serve(motors, guard.check, ready, print_line, open_again)


@with_setup
@with_units
def ioc(typed: dict[str, Any], units: dict[str, str], prefix: Prefix, axis: Axes = None) -> None:
    """Serve a motor record for each axis to EPICS clients."""
    check_prefix(prefix)
    with opened() as session:
        last = session.kind.axes
        numbers = parse_numbers(
            "--axis", axis or f"1-{last}", range(1, last + 1), f"axes are 1 to {last}", "1-4"
        )
        values = {number: setup_values(typed, number) for number in numbers}
        initialise(session, values)
        requests = {number: one.request(number) for number, one in values.items()}
        serve(session.part, session.guard, prefix, units, requests, open_board)
