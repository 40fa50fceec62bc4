"""Output of a measurement to the console and into a block of docs/benchmarks.md."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts import markdown


def show(heads: Sequence[str], row: Sequence[str]) -> None:
    """Print a row as soon as it is measured."""
    console.print(", ".join(f"{head}: {value}" for head, value in zip(heads, row, strict=True)))


def write(
    marker: str, text: str, heads: Sequence[str], rows: Sequence[Sequence[str]], title: str = ""
) -> None:
    """Write a table, with `text` above it, into docs/benchmarks.md; with a title, also print it."""
    if title:
        table = Table(title=title, title_justify="left")
        for index, head in enumerate(heads):
            table.add_column(head, justify="right" if index else "left")
        for row in rows:
            table.add_row(*row)
        console.print(table)
    project.update_benchmarks(f"bench:{marker}", f"{text}\n\n{markdown.table(heads, rows, left=1)}")
    console.print(f"written: docs/benchmarks.md, bench:{marker}")
