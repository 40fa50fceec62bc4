"""Commands of `openppmc`: the options before the command, and the table of all commands.

A command raises an exception for an error; `main` in __init__ prints it as one line.
"""

from __future__ import annotations

from typing import Annotated

import typer

from .. import __version__, parts
from .common.board import BOARD, LINE_WORDS, PartName
from .common.group import BRIDGE, Command, PartGroup

SERIAL, PMC = "ppmc312-serial", "pmc006"
ALL = (BRIDGE, SERIAL, PMC)


class Commands(PartGroup):
    """All commands, in the order of `--help`."""

    rows = (
        Command("ports", "common.boards:ports", "List the serial ports of this computer.", ALL),
        Command("info", "common.boards:info", "Print part, protocol and bitstream of the board."),
        Command("init", "common.boards:init", "Initialise an axis and store the set-up for this port."),
        Command(
            "move",
            "common.moves:move",
            "Move by PULSES. Several values move several axes of the part; all start together.",
            numbers=True,
        ),
        Command("jog", "common.moves:jog", "Run until Ctrl-C, a limit switch or the alarm."),
        Command("home", "common.moves:home", "Find the origin switch and set the position to 0 there."),
        Command("stop", "common.moves:stop", "Stop a motion that is still running."),
        Command(
            "status",
            "common.status_commands:status",
            "Print position, switches and state without side effects.",
        ),
        Command("monitor", "common.status_commands:monitor", "Show position and switches until Ctrl-C."),
        Command(
            "plan", "common.moves:plan", "Predict a move; no board is needed.", (BRIDGE, SERIAL), numbers=True
        ),
        Command(
            "table",
            "common.status_commands:table",
            "Read the ramps of a PPMC-312 as a CSV file for --curve.",
        ),
        Command("script", "common.script:script", "Execute a file of commands."),
        Command("ioc", "common.ioc:ioc", "Serve a motor record for each axis to EPICS clients."),
        Command(
            "selftest",
            "common.selftest:selftest",
            "Compare every pin edge of a board with the golden model. Writes a page for an issue.",
        ),
        Command(
            "hal",
            "common.hal:hal",
            "Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W.",
        ),
        Command(
            "decode",
            "common.decode:decode_capture",
            "Decode a capture of an old chip: bytes, moves, comparison with the golden model.",
            ALL,
        ),
        Command(
            "scan",
            "ppmc312.line.commands:scan",
            "ppmc312-serial, pmc006: List devices. Clears the error counters of ppmc312.",
            (SERIAL,),
        ),
        Command(
            "poll",
            "ppmc312.line.commands:poll",
            "ppmc312-serial: Poll stations, print reports until Ctrl-C.",
            (SERIAL,),
        ),
        Command("status", "ppmc312.line.commands:status", parts=(SERIAL,)),
        Command(
            "reset",
            "ppmc312.line.commands:reset",
            "ppmc312-serial: Reset stations. Pulses end immediately; table and position are cleared.",
            (SERIAL,),
        ),
        Command("init", "ppmc312.line.commands:init", parts=(SERIAL,)),
        Command("move", "ppmc312.line.commands:move", parts=(SERIAL,), numbers=True),
        Command("jog", "ppmc312.line.commands:jog", parts=(SERIAL,)),
        Command("home", "ppmc312.line.commands:home", parts=(SERIAL,)),
        Command("stop", "ppmc312.line.commands:stop", parts=(SERIAL,)),
        Command("hal", "ppmc312.line.commands:hal", parts=(SERIAL,)),
        Command("info", "ppmc312.line.status_commands:info", parts=(SERIAL,)),
        Command("monitor", "ppmc312.line.status_commands:monitor", parts=(SERIAL,)),
        Command("script", "ppmc312.line.script:script", parts=(SERIAL,)),
        Command("ioc", "ppmc312.line.commands:ioc", parts=(SERIAL,)),
        Command("move", "pmc006.moves:move", parts=(PMC,), numbers=True),
        Command("jog", "pmc006.moves:jog", parts=(PMC,)),
        Command(
            "speed",
            "pmc006.moves:speed",
            "Start motors at this speed and return. `stop` stops them.",
            (PMC,),
            numbers=True,
        ),
        Command("stop", "pmc006.moves:stop", parts=(PMC,)),
        Command("home", "pmc006.moves:home", parts=(PMC,)),
        Command("hal", "pmc006.moves:hal", parts=(PMC,)),
        Command("scan", "pmc006.moves:scan", parts=(PMC,)),
        Command("info", "pmc006.moves:info", parts=(PMC,)),
        Command("status", "pmc006.moves:status", parts=(PMC,)),
        Command("monitor", "pmc006.moves:monitor", parts=(PMC,)),
        Command("script", "pmc006.script:script", parts=(PMC,)),
        Command("ioc", "pmc006.moves:ioc", parts=(PMC,)),
        Command(
            "set",
            "pmc006.moves:set_values",
            "Change or print settings: `set current=1500 microsteps=32`. `save` stores them.",
            (PMC,),
        ),
        Command(
            "io", "pmc006.moves:io", "Print inputs and outputs; `io gpo1=1 gpo3=0` sets outputs.", (PMC,)
        ),
        Command(
            "address",
            "pmc006.moves:address",
            "Change the address of a controller immediately. `save` stores it.",
            (PMC,),
        ),
        Command(
            "save",
            "pmc006.moves:save",
            "Store the settings with a star in `info` for the next power-up.",
            (PMC,),
        ),
        Command(
            "reset-flags",
            "pmc006.moves:reset_flags",
            "Clear the flags of EXT1, EXT2 and stall, so that motors can start. Nothing moves.",
            (PMC,),
        ),
        Command("program", "pmc006.script:program", "pmc006: Load, run and read user programs.", (PMC,)),
    )


app = typer.Typer(
    name="openppmc",
    cls=Commands,
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
            help="/dev/ttyUSB0, COM3, sim:… (RTL of a part) or model:… (golden model)",
        ),
    ] = "",
    baud: Annotated[
        int | None,
        typer.Option(help="line rate in bit/s (1000000; ppmc312-serial: 19200, 38400, 83333; pmc006: 9600)"),
    ] = None,
    part: Annotated[
        PartName | None,
        typer.Option(envvar="OPENPPMC_PART", help="part (as the board reports; virtual board: ppmc104)"),
    ] = None,
    line: Annotated[
        str,
        typer.Option(envvar="OPENPPMC_LINE", metavar="WORDS", help=f"{_LINES}: {LINE_WORDS}"),
    ] = "",
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="print the version")
    ] = False,
) -> None:
    """Drive stepper controllers of the PPMC family through their UART bridge."""
    BOARD.port, BOARD.baud, BOARD.line = port, baud, line
    BOARD.part = None if part is None else part.value
