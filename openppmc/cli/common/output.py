"""Where the words of commands go: results to stdout, remarks beside them to stderr."""

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
    """`console`, made when it is first used: most commands print plain lines and need no rich."""
    if name != "console":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name not in globals():
        from .narrow import Console

        globals()[name] = Console(highlight=False)
    return globals()[name]


def say(text: str) -> None:
    """One line on stdout, as it is."""
    print(text)


def note(text: str) -> None:
    """One line beside the results, on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str]) -> Table:
    """Two columns, no frame."""
    from .narrow import two_columns

    return two_columns(rows.items())


def print_rows(rows: Sequence[Sequence[str]], sides: str) -> None:
    """A table whose lines may be longer than those of the terminal. rows: headings first; sides: < or > of
    each column."""
    if is_narrow():
        from .narrow import listed

        __getattr__("console").print(listed(rows[0], rows[1:]))
        return
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (f"{cell:{side}{width}}" for cell, side, width in zip(row, sides, widths, strict=True))
        say(" ".join(cells).rstrip())


def grid(rows: dict[str, dict[str, str]]) -> Table:
    """A row each with its name in front, the names of the values above; no frame."""
    from rich.table import Table

    columns = list(next(iter(rows.values())))
    grid = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("", *columns):
        grid.add_column(name, style="" if name else "bold", justify="right" if name == "position" else "left")
    for name, values in rows.items():
        grid.add_row(name, *(values[column] for column in columns))
    return grid


def print_json(values: Any) -> None:
    """One JSON document."""
    print(json.dumps(values, indent=1))
