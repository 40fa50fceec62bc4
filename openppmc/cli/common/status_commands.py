"""Commands that read the state of a board."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ...host import PpmcError
from . import output
from .moves import AxisOrAll
from .options import Json, with_setup
from .session import Session, opened, ready
from .show import Count, Every, watch

if TYPE_CHECKING:
    from rich.table import Table


def _axis_values(session: Session, axis: int | None) -> dict[str, dict[str, Any]]:
    """Return the values of each axis, by the prefix of its rows."""
    seen = session.presenter.status_of(session.part, session.selected_axes(axis))
    return {f"axis {number} " if len(seen) > 1 else "": values for number, values in seen.items()}


def _rows(session: Session, axes_values: dict[str, dict[str, Any]]) -> dict[str, str]:
    """Return the values as rows of text."""
    return {
        prefix + name: text
        for prefix, values in axes_values.items()
        for name, text in session.presenter.status_rows(values).items()
    }


def _table(session: Session, axes_values: dict[str, dict[str, Any]]) -> Table:
    """Return the values as a table."""
    if not session.presenter.wide or len(axes_values) == 1:
        return output.table(_rows(session, axes_values))
    return output.grid(
        {prefix.strip(): session.presenter.status_rows(one) for prefix, one in axes_values.items()}
    )


def status(axis: AxisOrAll = None, as_json: Json = False) -> None:
    """Print position, switches and state without side effects."""
    with opened() as session:
        axes_values = _axis_values(session, axis)
    if not as_json:
        output.console.print(_table(session, axes_values))
    elif "" in axes_values:
        output.print_json(axes_values[""])
    else:
        output.print_json({prefix.strip().replace(" ", ""): values for prefix, values in axes_values.items()})


def monitor(axis: AxisOrAll = None, count: Count = None, every: Every = 0.2) -> None:
    """Show position and switches until Ctrl-C."""
    with opened() as session:

        def line() -> list[str]:
            rows = _rows(session, _axis_values(session, axis))
            return ["  ".join(f"{name} {value}" for name, value in rows.items())]

        watch(
            count,
            lambda: session.guard.pause(session.part, every),
            line,
            lambda: _table(session, _axis_values(session, axis)),
        )


@with_setup
def table(
    typed: dict[str, Any],
    out: Annotated[Path | None, typer.Option("--out", help="write it to this file instead")] = None,
) -> None:
    """Read the ramps of a PPMC-312 as a CSV file for --curve."""
    with ready(typed, (1,)) as session:
        lines = session.presenter.table_lines(session.part)
    if out is None:
        output.print_line("\n".join(lines))
        return
    try:
        out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise PpmcError(f"{out}: cannot be written ({error.strerror})") from error
    output.print_line(f"{len(lines) - 1} stages: {out}")
