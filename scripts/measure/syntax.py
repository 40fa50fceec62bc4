"""slang's syntax trees of the RTL: nodes, their kinds, where they stand."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any


def _hidden(text: str) -> str:
    """The text without what is not for synthesis, every other letter in its place: slang counts bytes, so a
    letter is one."""

    def blank(match: re.Match[str]) -> str:
        return re.sub(r"[^\n]", " ", match[0])

    text = re.sub(r"`ifndef SYNTHESIS.*?`endif", blank, text, flags=re.DOTALL)
    text = re.sub(r"^`(include|default_nettype).*$", blank, text, flags=re.MULTILINE)
    return re.sub(r"[^\x00-\x7f]", "?", text)


def tree(text: str) -> Any:
    """The syntax tree."""
    from pyslang import syntax

    return syntax.SyntaxTree.fromText(_hidden(text)).root


def findings(text: str) -> list[str]:
    """What slang has against a text, as it is written."""
    from pyslang import syntax

    return [str(found.code) for found in syntax.SyntaxTree.fromText(_hidden(text)).diagnostics]


def kind(node: Any) -> str:
    """Such as "AddExpression"."""
    return str(node.kind).rpartition(".")[2]


def span(node: Any) -> tuple[int, int]:
    """Where a node stands."""
    return node.sourceRange.start.offset, node.sourceRange.end.offset


def children(node: Any) -> Iterator[Any]:
    """The nodes right below."""
    return (child for child in node if hasattr(child, "sourceRange") and hasattr(child, "getFirstToken"))


def found(node: Any, *kinds: str) -> Iterator[Any]:
    """The nodes of these kinds from this one downwards, none inside another."""
    if kind(node) in kinds:
        yield node
        return
    for child in children(node):
        yield from found(child, *kinds)


def function_name(function: Any) -> str:
    """Of a FunctionDeclaration."""
    return str(function.prototype.name.getLastToken().valueText)
