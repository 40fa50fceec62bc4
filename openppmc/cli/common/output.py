"""Where the words of commands go: results to stdout, remarks beside them to stderr."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    console: Console


def __getattr__(name: str) -> Any:
    """`console`, made when it is first used: most commands print plain lines and need no rich."""
    if name != "console":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from rich.console import Console

    console = globals()[name] = Console(highlight=False)
    return console


def say(text: str) -> None:
    """One line on stdout, as it is."""
    print(text)


def note(text: str) -> None:
    """One line beside the results, on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str]) -> Table:
    """Two columns, no frame."""
    from rich.table import Table

    grid = Table(box=None, show_header=False, pad_edge=False)
    grid.add_column(style="bold")
    grid.add_column()
    for name, value in rows.items():
        grid.add_row(name, value)
    return grid


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
