"""Commands that read the state of a line of PPMC-312."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import typer

from ....host import PpmcError
from ...common import output
from ...common.options import Json
from ...common.show import Count, Every, watch
from . import show
from .session import opened


def info(as_json: Json = False) -> None:
    """Print the speed of the line, the stations that reply, and their versions."""
    with opened() as session:
        line, found = session.bus.line, session.scan()
    if not found:
        raise PpmcError(show.no_station_message(line.name))
    values = {
        "port": line.name,
        "part": "ppmc312-serial",
        "stations": {one.station: one.version for one in found},
        "baud": line.baud,
        "checksum": line.sum_mode.value,
        "crystal_hz": line.identity.xtal_hz,
    }
    if as_json:
        output.print_json(values)
        return
    versions = ", ".join(
        f"{one.station} (version {'-' if one.version is None else f'{one.version:02X}'})" for one in found
    )
    rows = {name.replace("_", " "): str(value) for name, value in values.items()} | {"stations": versions}
    output.console.print(output.table(rows))


def monitor(
    axis: Annotated[
        str | None,
        typer.Option("--axis", metavar="N", help="ppmc312-serial: stations, as 3, 0,2,5 or 0-7 (all)"),
    ] = None,
    count: Count = None,
    every: Every = 0.2,
) -> None:
    """Show position and switches until Ctrl-C."""
    with opened() as session:
        axes = session.selected_axes(axis)

        def lines() -> Iterator[str]:
            for one in axes:
                session.guard.check()
                yield show.status_line(one)

        watch(
            count,
            lambda: session.guard.pause(session.bus, every),
            lines,
            lambda: show.status_table(axes),
        )
