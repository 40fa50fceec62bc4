"""The nodes of slang's syntax trees of the RTL, with their kinds and places."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any


def _hidden(text: str) -> str:
    """Return the text with spaces in place of code that is not for synthesis.

    The positions of all other code do not change. slang counts bytes, so each non-ASCII character is replaced
    by a character of one byte.
    """

    def blank(match: re.Match[str]) -> str:
        return re.sub(r"[^\n]", " ", match[0])

    text = re.sub(r"`ifndef SYNTHESIS.*?`endif", blank, text, flags=re.DOTALL)
    text = re.sub(r"^`(include|default_nettype).*$", blank, text, flags=re.MULTILINE)
    return re.sub(r"[^\x00-\x7f]", "?", text)


def tree(text: str) -> Any:
    """Return the syntax tree of a text."""
    from pyslang import syntax

    return syntax.SyntaxTree.fromText(_hidden(text)).root


def findings(text: str) -> list[str]:
    """Return slang's diagnostics for a text."""
    from pyslang import syntax

    return [str(found.code) for found in syntax.SyntaxTree.fromText(_hidden(text)).diagnostics]


def kind(node: Any) -> str:
    """Return the kind of a node, such as "AddExpression"."""
    return str(node.kind).rpartition(".")[2]


def span(node: Any) -> tuple[int, int]:
    """Return the start and end of a node."""
    return node.sourceRange.start.offset, node.sourceRange.end.offset


def children(node: Any) -> Iterator[Any]:
    """Yield the direct children of a node."""
    return (child for child in node if hasattr(child, "sourceRange") and hasattr(child, "getFirstToken"))


def found(node: Any, *kinds: str) -> Iterator[Any]:
    """Yield the nodes of these kinds in a node, itself included; found nodes are not searched further."""
    if kind(node) in kinds:
        yield node
        return
    for child in children(node):
        yield from found(child, *kinds)


def function_name(function: Any) -> str:
    """Return the name of a FunctionDeclaration."""
    return str(function.prototype.name.getLastToken().valueText)
