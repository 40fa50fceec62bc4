"""Where the words of commands go: results to stdout, remarks beside them to stderr."""

from __future__ import annotations

import json
import sys
from typing import Any

from rich.console import Console
from rich.table import Table

console = Console(highlight=False)


def say(text: str) -> None:
    """One line on stdout, as it is."""
    print(text)


def note(text: str) -> None:
    """One line beside the results, on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str]) -> Table:
    """Two columns, no frame."""
    grid = Table(box=None, show_header=False, pad_edge=False)
    grid.add_column(style="bold")
    grid.add_column()
    for name, value in rows.items():
        grid.add_row(name, value)
    return grid


def grid(rows: dict[str, dict[str, str]]) -> Table:
    """A row each with its name in front, the names of the values above; no frame."""
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
