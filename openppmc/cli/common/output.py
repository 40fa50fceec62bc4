"""Output of commands: results on stdout, notes on stderr."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ...streams import is_narrow

if TYPE_CHECKING:
    from rich.table import Table

    from .narrow import Console

    console: Console


def __getattr__(name: str) -> Any:
    """Create `console` when it is first used: most commands print plain lines without rich."""
    if name != "console":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name not in globals():
        from .narrow import Console

        globals()[name] = Console(highlight=False)
    return globals()[name]


def print_line(text: str) -> None:
    """Print one line on stdout, unchanged."""
    print(text)


def note(text: str) -> None:
    """Print one note on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str]) -> Table:
    """Return a table of two columns without a frame."""
    from .narrow import two_columns

    return two_columns(rows.items())


def print_rows(rows: Sequence[Sequence[str]], sides: str) -> None:
    """Print a table whose lines may be longer than a line of the terminal.

    Args:
        rows: rows of cells; the first row contains the headings.
        sides: one character per column, which aligns it: "<" left, ">" right.
    """
    if is_narrow():
        from .narrow import listed

        __getattr__("console").print(listed(rows[0], rows[1:]))
        return
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (f"{cell:{side}{width}}" for cell, side, width in zip(row, sides, widths, strict=True))
        print_line(" ".join(cells).rstrip())


def grid(rows: dict[str, dict[str, str]]) -> Table:
    """Return a table without a frame. The first column contains the names of the rows."""
    from rich.table import Table

    columns = list(next(iter(rows.values())))
    grid = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("", *columns):
        grid.add_column(name, style="" if name else "bold", justify="right" if name == "position" else "left")
    for name, values in rows.items():
        grid.add_row(name, *(values[column] for column in columns))
    return grid


def print_json(values: Any) -> None:
    """Print one JSON document."""
    print(json.dumps(values, indent=1))
