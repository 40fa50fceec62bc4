"""Where the words of commands go: results to stdout, remarks beside them to stderr."""

from __future__ import annotations

import json
import sys
from collections.abc import Container, Sequence
from typing import Any

from rich import box
from rich.console import Console, ConsoleOptions, RenderResult
from rich.measure import Measurement
from rich.table import Table

console = Console(highlight=False)
WRAPPED = 60
"""Columns of a console from which on cells are wrapped rather than put below each other."""
UNLIMITED = 10_000


def say(text: str) -> None:
    """One line on stdout, as it is."""
    print(text)


def note(text: str) -> None:
    """One line beside the results, on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str]) -> Table:
    """Two columns, no frame."""
    grid = Table(box=None, show_header=False, pad_edge=False)
    grid.add_column(style="bold", overflow="fold")
    grid.add_column(overflow="fold")
    for name, value in rows.items():
        grid.add_row(name, value)
    return grid


class Grid:
    """Rows below heads. On a console that is too narrow each cell is on a separate line, after its head."""

    def __init__(self, heads: Sequence[str], left: Container[str] = (), framed: bool = False) -> None:
        self._heads, self._left, self._framed = heads, left, framed
        self._rows: list[tuple[str, ...]] = []

    def add_row(self, *cells: str) -> None:
        """Add a row, a cell for each head."""
        self._rows.append(cells)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        wide = Table(box=box.SIMPLE_HEAD if self._framed else None, pad_edge=False)
        for head in self._heads:
            wide.add_column(head, justify="left" if head in self._left else "right")
        for cells in self._rows:
            wide.add_row(*cells)
        needed = Measurement.get(console, options.update(width=UNLIMITED), wide)
        if (needed.minimum if options.max_width >= WRAPPED else needed.maximum) <= options.max_width:
            yield wide
            return
        for number, cells in enumerate(self._rows):
            if number:
                yield ""
            yield table({head: cell for head, cell in zip(self._heads, cells, strict=True) if cell})


def grid(rows: dict[str, dict[str, str]]) -> Grid:
    """A row each with its name in front, the names of the values above; no frame."""
    columns = list(next(iter(rows.values())))
    found = Grid(["", *columns], left=[name for name in ("", *columns) if name != "position"])
    for name, values in rows.items():
        found.add_row(name, *(values[column] for column in columns))
    return found


def print_json(values: Any) -> None:
    """One JSON document."""
    print(json.dumps(values, indent=1))
