"""Functions that only elaboration calls: no simulation runs them, so the coverage does not include them.

A function is called only by elaboration if each call of its name in rtl/ satisfies one of these conditions:

- it is in a parameter, a dimension, the head of a generate block or the parameter values of an instance;
- its arguments contain only parameters, genvars and numbers;
- it is inside another function of this kind.

Names are compared as text. If one call of a name satisfies no condition, all its functions are included.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from cocotb_tests.harness.project import ROOT, RTL, relative
from scripts.measure.syntax import children, found, function_name, kind, span, tree

CONSTANT = (
    *("ParameterDeclaration", "ParameterDeclarationStatement", "ParameterValueAssignment"),
    *("VariableDimension", "LoopGenerate"),
)
"""Kinds of nodes that contain only constants. In a LoopGenerate, this applies only to the head."""
NAMES = ("IdentifierName", "IdentifierSelectName", "ScopedName")


@dataclass(frozen=True)
class Call:
    """A call in rtl/.

    Attributes:
        inside: name of the function that contains the call, or "".
        constant: True if the call satisfies one of the first two conditions (see the text of the module).
    """

    name: str
    inside: str
    constant: bool


@dataclass(frozen=True)
class Function:
    """A function with its lines from `function` to `endfunction`."""

    file: str
    name: str
    first: int
    last: int


def _last(node: Any) -> str:
    """Return the name in a node, without packages and selects."""
    while kind(node) == "ScopedName":
        node = node.right
    return str(node.getFirstToken().valueText)


def _constants(root: Any) -> set[str]:
    """Return the names of the parameters and genvars in a file."""
    names = set()
    for node in found(root, "ParameterDeclaration", "LoopGenerate"):
        if kind(node) == "LoopGenerate":
            names.add(str(node.identifier.valueText))
            names |= _constants_in(node.block)
        else:
            names |= {_last(one) for one in found(node, "Declarator")}
    return names


def _constants_in(node: Any) -> set[str]:
    return set().union(*(_constants(child) for child in children(node)))


def calls(root: Any) -> Iterator[Call]:
    """Yield all calls of a file."""
    constants = _constants(root)

    def fixed(call: Any) -> bool:
        names = [name for child in list(children(call))[1:] for name in found(child, *NAMES)]
        return all("::" in str(name) or str(name.getFirstToken().valueText) in constants for name in names)

    def walk(node: Any, inside: str, constant: bool) -> Iterator[Call]:
        name = kind(node)
        if name == "FunctionDeclaration":
            inside = function_name(node)
        if name == "InvocationExpression" and kind(node.left) in NAMES:
            yield Call(_last(node.left), inside, constant or fixed(node))
        heads: list[Any] = []
        if name == "LoopGenerate":
            heads = [node.block]
        elif name == "IfGenerate":
            heads = [child for child in children(node) if child is not node.condition]
        elif name in CONSTANT:
            constant = True
        for child in children(node):
            outside = any(span(child) == span(head) for head in heads)
            yield from walk(child, inside, constant or bool(heads and not outside))

    yield from walk(root, "", False)


def functions(file: str, text: str, root: Any) -> Iterator[Function]:
    """Yield the functions of a file."""
    for node in found(root, "FunctionDeclaration"):
        first, last = (text.count("\n", 0, at) + 1 for at in span(node))
        yield Function(file, function_name(node), first, last)


def only_elaborated(every: Iterable[Call]) -> set[str]:
    """Return the names that are called, but never by code that runs in a simulation."""
    every = list(every)
    names = {call.name for call in every}
    while True:
        runs = {call.name for call in every if not call.constant and call.inside not in names}
        if not runs & names:
            return names
        names -= runs


@cache
def left_out() -> list[Function]:
    """Return the functions of rtl/ that only elaboration calls."""
    every: list[Call] = []
    known: list[Function] = []
    for path in sorted(RTL.rglob("*.sv")):
        text = (ROOT / path).read_text(encoding="utf-8")
        root = tree(text)
        every += calls(root)
        known += functions(relative(path), text, root)
    names = only_elaborated(every)
    return [function for function in known if function.name in names]
