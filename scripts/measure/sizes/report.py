"""Tables of sizes: the cells of each instance for the terminal, and a function for Markdown tables."""

from __future__ import annotations

from rich import box
from rich.table import Table

from scripts.fpga.flow.netlist import Breakdown, Count


def breakdown_table(results: dict[str, Breakdown]) -> Table:
    """Return the table of the cells of each instance, with columns for all families."""
    table = Table(
        title="where the cells are", title_justify="left", caption_justify="left", box=box.SIMPLE_HEAD
    )
    table.caption = (
        "flat: flattened, a LUT is credited to the instance it feeds; own: each module mapped by itself"
    )
    table.add_column("instance", no_wrap=True)
    table.add_column("module", no_wrap=True)
    for family in results:
        for head in (f"{family}\nflat", "\nown", "\nFF", "\nRAM"):
            table.add_column(head, justify="right", no_wrap=True)
    for row in breakdown_rows(results, indent="  "):
        if row[0] == "total":
            table.add_section()
        table.add_row(*row, style="bold" if row[0] == "total" else None)
    return table


def breakdown_rows(results: dict[str, Breakdown], indent: str) -> list[list[str]]:
    """Return rows: instance, module, flat LUTs, own LUTs, FF, RAM of each family; the last is the total."""
    first = next(iter(results.values()))
    rows = []
    for path in sorted(first.kept):
        depth = path.count(".") + 1 if path else 0
        row = [indent * depth + (path.rsplit(".", 1)[-1] or "(top itself)"), first.module[path]]
        for result in results.values():
            flat, kept = result.flat.get(path, Count()), result.kept.get(path, Count())
            row += [str(flat.lut), str(kept.lut), str(flat.ff), str(flat.ram or "")]
        rows.append(row)
    total = ["total", ""]
    for result in results.values():
        own = sum(count.lut for count in result.kept.values())
        total += [str(result.total.lut), str(own), str(result.total.ff), str(result.total.ram or "")]
    return [*rows, total]


def markdown_table(heads: list[str], rows: list[list[str]], left: int = 1) -> str:
    """Return a Markdown table; its first `left` columns are left-aligned, the others right-aligned."""
    rule = ["---" if index < left else "---:" for index in range(len(heads))]
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, rule, *rows])
