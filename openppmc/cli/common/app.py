"""The commands. What goes wrong leaves as an exception; `main` in __init__ makes one line of it."""

from __future__ import annotations

from typing import Annotated

import typer

from ... import __version__, parts
from ...host.bridge.link import DEFAULT_BAUD
from . import boards, looks, moves, plan, script, selftest
from .decode import decode_capture
from .group import PartGroup
from .line_session import LINE_WORDS
from .options import NUMBERS
from .session import BOARD, PartName

app = typer.Typer(
    name="openppmc",
    cls=PartGroup,
    help="Drive stepper controllers of the PPMC family through their UART bridge.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode="rich",
)
_LINES = ", ".join(row.name for row in parts.having("line"))


def _version(wanted: bool) -> None:
    if wanted:
        print(f"openppmc {__version__}")
        raise typer.Exit


@app.callback()
def options(
    port: Annotated[
        str,
        typer.Option(
            "--port",
            "-p",
            envvar="OPENPPMC_PORT",
            help="/dev/ttyUSB0, COM3, sim:… (the RTL of any part) or model:… (its golden model)",
        ),
    ] = "",
    baud: Annotated[
        int | None,
        typer.Option(
            help=f"line rate to work with ({DEFAULT_BAUD}; ppmc312-serial: 19200, 38400, 83333; pmc006: 9600)"
        ),
    ] = None,
    part: Annotated[
        PartName | None,
        typer.Option(envvar="OPENPPMC_PART", help="the part (what the board has; virtual: ppmc104)"),
    ] = None,
    line: Annotated[
        str,
        typer.Option(envvar="OPENPPMC_LINE", metavar="WORDS", help=f"{_LINES}: {LINE_WORDS}"),
    ] = "",
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="print it")
    ] = False,
) -> None:
    """Drive stepper controllers of the PPMC family through their UART bridge."""
    BOARD.port, BOARD.baud, BOARD.line = port, baud, line
    BOARD.part = None if part is None else part.value


app.command()(boards.ports)
app.command()(boards.info)
app.command()(boards.init)
app.command(context_settings=NUMBERS)(moves.move)
app.command()(moves.jog)
app.command()(moves.home)
app.command()(moves.stop)
app.command()(looks.status)
app.command()(looks.monitor)
app.command(context_settings=NUMBERS)(plan.plan)
app.command()(looks.table)
app.command()(script.script)
app.command()(selftest.selftest)
app.command("decode")(decode_capture)
