"""The command that predicts a move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ...host import PpmcError, speeds
from . import output
from .board import BOARD
from .forecast import plot_move
from .options import Json, with_setup
from .session import setup_values
from .view import view_of

XTAL_HZ = 16_000_000


@with_setup
def plan(
    typed: dict[str, Any],
    pulses: Annotated[int, typer.Argument(help="pulses, CW positive")],
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    plot: Annotated[Path | None, typer.Option(help="speed over time into this file (png, svg, pdf)")] = None,
    xtal: Annotated[int, typer.Option(min=1_000_000, max=XTAL_HZ, help="crystal in Hz")] = XTAL_HZ,
    as_json: Json = False,
) -> None:
    """Predict a move. Needs no board."""
    kind = BOARD.planned
    view = view_of(kind)
    setup = setup_values(typed).plan(xtal, kind)
    constant = None
    if speed is not None:
        constant = kind.constant_clock(xtal, setup.clock, speed).choose(speed)
    figures = view.figures(setup, pulses, constant)
    if plot is not None:
        try:
            plot_move(lambda n: view.course(setup, n, constant), pulses, plot)
        except OSError as error:
            raise PpmcError(f"{plot}: the plot cannot be written ({error.strerror})") from error
    if as_json:
        output.print_json({"setup": view.setup_values(setup), "move": figures})
        return
    rows = view.setup_rows(setup) if constant is None else {"speed": str(constant)}
    rows["move"] = f"{pulses} pulses, {figures['profile']}"
    rows["top speed"] = f"{speeds.nearby(figures['top_pps'])} pps"
    if "plateau_intervals" in figures:
        rows["acceleration"] = f"{figures['ramp_pulses']} pulses, {figures['ramp_seconds']:.6g} s"
        if "down_pulses" in figures:
            rows["deceleration"] = f"{figures['down_pulses']} pulses"
        rows["plateau"] = f"{figures['plateau_intervals']} intervals"
    rows["duration"] = f"{figures['seconds']:.6g} s from the first to the last pulse"
    output.console.print(output.table(rows))
    if plot is not None:
        output.say(f"plot: {plot}")
