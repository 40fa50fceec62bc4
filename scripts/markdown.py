"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(heads: Sequence[object], rows: Iterable[Sequence[object]], left: int | None = None) -> str:
    """Return a table as Markdown text.

    Args:
        left: number of left-aligned columns at the beginning; all others are right-aligned. None selects a
            separator row without spaces and without alignment.
    """
    head, *lines = [f"| {' | '.join(map(str, row))} |" for row in (heads, *rows)]
    if left is None:
        head, rule = head.replace("|  |", "| |"), "|---" * len(heads) + "|"
    else:
        rule = f"| {' | '.join(['---'] * left + ['---:'] * (len(heads) - left))} |"
    return "\n".join([head, rule, *lines])
