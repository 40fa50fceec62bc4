"""The form of the Markdown tables of docs/benchmarks.md."""

from __future__ import annotations


def markdown_table(heads: list[str], rows: list[list[str]], left: int = 1) -> str:
    """Return a Markdown table; its first `left` columns are left-aligned, the others right-aligned."""
    rule = ["---" if index < left else "---:" for index in range(len(heads))]
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, rule, *rows])
