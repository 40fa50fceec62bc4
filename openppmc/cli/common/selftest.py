"""The command `selftest`: compare a board with the golden model, write a page about it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from ... import parts
from ...host import PpmcError
from ...host.link import DEFAULT_BAUD, Link
from ...host.port import MODEL, SIM
from ...host.selftest import page
from ...host.selftest.plan import COMMANDS, MOVES, REGISTERS, SWITCHES, Plan
from ...host.selftest.run import SelfTest
from . import output
from .board import BOARD
from .options import Json
from .session import mismatch

RECORDS = 13
"""Size of the recorder of a virtual board without `record=`: 2**RECORDS records."""
KINDS = (REGISTERS, COMMANDS, MOVES, SWITCHES)
Kinds = Annotated[
    list[str] | None,
    typer.Option("--only", metavar="KIND", help=f"{', '.join(KINDS)} (repeatable; all)", show_default=False),
]


def selftest(
    yes: Annotated[bool, typer.Option("--yes", help="do not ask whether motors may turn")] = False,
    jumpers: Annotated[
        bool, typer.Option("--jumpers", help="also test limits and origin; requires two wires")
    ] = False,
    only: Kinds = None,
    folder: Annotated[
        Path,
        typer.Option("--out", metavar="FOLDER", help="folder for the page and for pictures of differences"),
    ] = Path("selftest"),
    as_json: Json = False,
) -> None:
    """Compare every pin edge of a board with the golden model. Writes a page for an issue."""
    for kind in only or ():
        if kind not in KINDS:
            raise typer.BadParameter(f"--only {kind}: unknown kind; use {', '.join(KINDS)}")
    tell = output.note if as_json else output.print_line
    number = None if BOARD.part is None else parts.part(BOARD.part).number
    with Link(_spec(), BOARD.baud or DEFAULT_BAUD, number) as link:
        plan = _plan(link)
        test = SelfTest(link, plan, folder, tell)
        notes = [line for line in (mismatch(test.results.build, link.identity.part),) if line]
        tell(f"{page.board_name(test.results.build)}: {page.built(test.results.build)}")
        for line in notes:
            output.note(f"note: {line}")
        sections = [one for one in test.sections(jumpers) if one.what in (only or KINDS)]
        _ask(plan, yes, jumpers)
        try:
            test.rates()
            for section in sections:
                test.play(section)
        finally:
            test.safe()
        made = page.values(link, test.results, notes)
    try:
        text, values = page.write(folder, made, test.results.build)
    except OSError as error:
        raise PpmcError(f"{folder}: cannot be written ({error.strerror})") from error
    if as_json:
        output.print_json(made)
    else:
        output.print_line(f"page: {text}, {values}")
        output.print_line(made["verdict"])
    if test.results.differences:
        raise typer.Exit(1)


def _spec() -> str:
    """Return the text of the port; for a virtual board, it includes the option for a recorder.

    Raises PpmcError for `model:`, because the golden model cannot be compared with itself.
    """
    spec = BOARD.spec
    if spec.startswith(MODEL):
        raise PpmcError("model: cannot be compared with itself; use the port of a board, or sim:")
    if not spec.startswith(SIM) or "record=" in spec:
        return spec
    return f"{spec}{'' if spec.endswith(':') else ','}record={RECORDS}"


def _plan(link: Link) -> Plan:
    row: Any = parts.by_number(link.identity.part)
    if row is None or not row.selftest:
        raise PpmcError(f"{link.name}: no self-test for this part; renew the package")
    plan: Plan = row.load("selftest")
    return plan


def _ask(plan: Plan, yes: bool, jumpers: bool) -> None:
    """List the wires, and ask the user whether motors may turn.

    Raises PpmcError if stdin is not a terminal, Abort if the user declines.
    """
    for wire in plan.jumpers if jumpers else ():
        output.note(f"wire: {wire}")
    if yes or BOARD.spec.startswith(SIM):
        return
    if not sys.stdin.isatty():
        raise PpmcError("selftest: a connected motor turns; add --yes if it may turn")
    output.note("The self-test outputs some thousand pulses. A connected motor turns.")
    typer.confirm("May all connected motors turn?", abort=True, err=True)
