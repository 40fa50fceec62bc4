"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(heads: Sequence[object], rows: Iterable[Sequence[object]], left: int | None = None) -> str:
    """Return a table as Markdown text.

    Args:
        left: number of left-aligned columns at the beginning; all others are right-aligned. With None, the
            separator row has no spaces and no alignment.
    """
    head, *lines = [f"| {' | '.join(map(str, row))} |" for row in (heads, *rows)]
    if left is None:
        head, rule = head.replace("|  |", "| |"), "|---" * len(heads) + "|"
    else:
        rule = f"| {' | '.join(['---'] * left + ['---:'] * (len(heads) - left))} |"
    return "\n".join([head, rule, *lines])
