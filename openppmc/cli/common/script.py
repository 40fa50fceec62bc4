"""The command that carries script files out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from . import output
from .options import with_setup
from .player import Player, check_speeds, check_steps, positions
from .program import read_file, read_program
from .session import initialise, opened, setup_values


@with_setup
def script(
    typed: dict[str, Any],
    file: Annotated[Path, typer.Argument(help="text file, one command a line; - for standard input")],
) -> None:
    """Carry out a file of commands."""
    name, text = read_file(file)
    steps = read_program(text, name)
    with opened() as session:
        used = check_steps(steps, name, session.kind)
        values = {axis: setup_values(typed, axis) for axis in used}
        check_speeds(steps, dict(values), session.xtal_hz, name, session.kind)
        initialise(session, values)
        Player(session, values, name, output.say).run(steps)
        session.guard.bar_off()
        output.say(f"done, {positions(session.axis(number) for number in used)}")
