"""Commands that list ports, identify a board and initialise an axis."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from ...host import serial_ports
from . import output, show
from .board import BOARD
from .options import MOST_AXES, Json, with_setup
from .session import initialise, opened, setup_values, store_setup, stores_setup

AxisNumber = Annotated[
    int, typer.Option("--axis", min=1, max=MOST_AXES, metavar="N", help="number of the axis, from 1")
]


def ports(as_json: Json = False) -> None:
    """List the serial ports of this computer."""
    found = serial_ports()
    if as_json:
        output.print_json([{"port": device, "description": text} for device, text in found])
    elif found:
        output.console.print(output.table(dict(found)))
    else:
        output.print_line("no serial port; use --port model: for a virtual board")


def info(as_json: Json = False) -> None:
    """Print part, protocol and bitstream of the board."""
    from ...host.selftest.page import built

    with opened() as session:
        link = session.part.link
        build = link.build()
        values = {**show.identity_values(link), "axes": session.kind.axes, "bitstream": built(build)}
    if as_json:
        output.print_json(values)
    else:
        rows = {name.replace("_", " "): str(value) for name, value in values.items()}
        output.console.print(output.table(rows))


@with_setup
def init(typed: dict[str, Any], axis: AxisNumber = 1, as_json: Json = False) -> None:
    """Initialise an axis and store the set-up for this port."""
    values = setup_values(typed, axis)
    with opened() as session:
        (setup,) = initialise(session, {axis: values})
        presenter = session.presenter
    store_setup(BOARD.port, values.table(), axis)
    if as_json:
        output.print_json(presenter.setup_values(setup))
        return
    output.console.print(output.table(presenter.setup_rows(setup)))
    if not stores_setup(BOARD.port):
        output.note("(a virtual board is new each time; the set-up is not stored)")
