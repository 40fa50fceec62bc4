"""The script files for a line of PPMC-312.

The commands are the same as for a board, but each command names its station.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from ....host import Ppmc312Bus, Station312
from ....host.ppmc312.line.line import CAPABILITIES
from ...common import output
from ...common.options import with_setup
from ...common.script import (
    OF_ALL_AXES,
    OF_AXES,
    ScriptError,
    ScriptRunner,
    Step,
    check_speeds,
    check_steps,
    positions,
    read_file,
    read_program,
)
from ...common.script_parser import Numbered, part_commands
from ...common.session import Guard, setup_values
from . import show
from .session import Session, opened


class LinePresenter:
    """Methods of a presenter that a script uses, for the stations of a line."""

    def busy(self, part: Ppmc312Bus, axes: Sequence[Station312]) -> tuple[Station312, ...]:
        """Return the stations that are moving."""
        return tuple(axis for axis in axes if axis.busy_now())

    def reports(self, part: Ppmc312Bus, tell: Callable[[str], None]) -> None:
        """Print the reports of the stations. Raise the first error among the reports."""
        show.reports(part.axes, tell)


class LineSession:
    """Line as the target of a script. Its stations are the axes.

    Args:
        used: stations that the script names.
    """

    kind = CAPABILITIES
    presenter = LinePresenter()

    def __init__(self, session: Session, used: Sequence[int]) -> None:
        self.part, self.used = session.bus, used
        self.guard: Guard = session.guard

    @property
    def xtal_hz(self) -> int:
        """Crystal frequency of the stations in Hz."""
        return self.part.line.identity.xtal_hz

    def axis(self, number: int = 1) -> Any:
        """Return a station."""
        return self.part.axis(number)

    def selected_axes(self, number: int | None) -> Sequence[Any]:
        """Return the station with this number; for None, all stations of the script."""
        return [self.axis(one) for one in ([number] if number is not None else self.used)]


def check_line(steps: Iterable[Step], name: str) -> None:
    """Raise ScriptError for steps that a line does not support.

    A line does not support motions that name no station, moves of two axes, and commands of other parts.
    """
    for step in steps:
        where = f"{name}:{step.line}: "
        if step.word in OF_AXES and step.word not in OF_ALL_AXES and step.axis is None:
            raise ScriptError(f"{where}{step.word}: no station; add axis=N")
        if step.values.get("second") is not None:
            raise ScriptError(
                f"{where}two numbers: only for a part with two axes; write a line for each station"
            )
        if step.word in part_commands():
            raise ScriptError(f"{where}{step.word}: not supported on a line")
        check_line(step.body, name)


@with_setup
def script(
    typed: dict[str, Any],
    file: Annotated[Path, typer.Argument(help="text file, one command a line; - for standard input")],
) -> None:
    """Execute a file of commands."""
    name, text = read_file(file)
    steps = read_program(text, name, numbered=Numbered(low=0))
    check_line(steps, name)
    used = [number for number in check_steps(steps, name, CAPABILITIES) if _names(steps, number)]
    with opened() as session:
        session.bus.check(used)
        line = LineSession(session, used)
        values = {number: setup_values(typed, number) for number in used}
        check_speeds(steps, dict(values), line.xtal_hz, name, CAPABILITIES)
        plans = {number: one.plan(line.xtal_hz, CAPABILITIES, number) for number, one in values.items()}
        for number, plan in plans.items():
            session.guard.check()
            line.axis(number).apply(plan)
        ScriptRunner(line, values, name, output.print_line).run(steps)
        session.guard.bar_off()
        output.print_line(f"done, {positions(line.axis(number) for number in used)}")


def _names(steps: Iterable[Step], number: int) -> bool:
    """Return True if a line of the script names this station."""
    return any(step.axis == number or _names(step.body, number) for step in steps)
