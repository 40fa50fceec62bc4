"""Tables on a narrow terminal: a table that does not fit is printed as a list."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import rich.console
from rich.console import ConsoleOptions, Group, RenderableType
from rich.measure import Measurement
from rich.segment import Segment
from rich.table import Table

from ...streams import NARROW


class Console(rich.console.Console):
    """Console that prints a table as a list, with a line for each cell, if the table does not fit."""

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        options = options or self.options
        if isinstance(renderable, Table) and len(renderable.columns) > 2 and options.max_width < NARROW:
            needed = Measurement.get(self, options.update(max_width=10_000), renderable).maximum
            if needed > options.max_width:
                heads = [str(column.header) for column in renderable.columns]
                renderable = listed(heads, zip(*(column.cells for column in renderable.columns), strict=True))
        return super().render(renderable, options)


def two_columns(rows: Iterable[tuple[str, str]]) -> Table:
    """Return a table of names and values without a frame."""
    grid = Table(box=None, show_header=False, pad_edge=False)
    grid.add_column(style="bold", overflow="fold")
    grid.add_column(overflow="fold")
    for name, value in rows:
        grid.add_row(name, value)
    return grid


def listed(heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> Group:
    """Return the rows of a table as lists, one below the other.

    Each line contains the heading of a column and its cell. Empty cells are omitted. A cell of a column
    without a heading is the name of its row.
    """
    tables: list[RenderableType] = []
    for row in rows:
        cells = [(head, str(cell)) for head, cell in zip(heads, row, strict=True) if cell]
        tables += ["", two_columns((head or cell, cell if head else "") for head, cell in cells)]
    return Group(*tables[1:])
