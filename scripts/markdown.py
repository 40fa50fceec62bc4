"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(heads: Sequence[object], rows: Iterable[Sequence[object]], left: int | None = None) -> str:
    """Return a table.

    Args:
        left: number of left-aligned columns, before right-aligned columns; None for columns without spaces
            in their rule.
    """
    head, *lines = [f"| {' | '.join(map(str, row))} |" for row in (heads, *rows)]
    if left is None:
        head, rule = head.replace("|  |", "| |"), "|---" * len(heads) + "|"
    else:
        rule = f"| {' | '.join(['---'] * left + ['---:'] * (len(heads) - left))} |"
    return "\n".join([head, rule, *lines])
