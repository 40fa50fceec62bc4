"""The mutants of an RTL file: small faults at places of slang's syntax tree.

Only code that becomes hardware is changed: expressions and assignments of always blocks, continuous
assignments, inputs of instances. Parameters, declarations, widths and ranges, generate conditions, case
labels, functions, assertions and all other code that SYNTHESIS excludes are not changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from scripts.measure.syntax import children, kind, span, tree

SWAPS = {
    "&&": "||",
    "||": "&&",
    "==": "!=",
    "!=": "==",
    "<": "<=",
    "<=": "<",
    ">": ">=",
    ">=": ">",
    "+": "-",
    "-": "+",
    "&": "|",
    "|": "&",
    "^": "|",
    "<<": ">>",
    ">>": "<<",
}
"""For each operator, the operator that replaces it."""
LOGIC = ("&&", "||")
ASSIGNMENTS = ("AssignmentExpression", "NonblockingAssignmentExpression")
SKIPPED = (
    *("ParameterValueAssignment", "DataDeclaration", "LocalVariableDeclaration", "FunctionDeclaration"),
    *("SimpleRangeSelect", "AscendingRangeSelect", "DescendingRangeSelect", "BitSelect", "InitialBlock"),
    *("FinalBlock", "TypedefDeclaration", "ParameterDeclarationStatement", "OpenRangeList", "RangeList"),
    *("AssertPropertyStatement", "ImmediateAssertStatement", "ConcurrentAssertionMember"),
)
"""Kinds of nodes that are not changed, including all nodes below them."""


@dataclass(frozen=True)
class Fault:
    """A mutant. `text` replaces file[start:end].

    Attributes:
        dropped: True if the statement at this place is removed.
        number: number of the mutant among those of the same source file, counted from 1.
        what: description of the fault, for tables.
    """

    number: int
    start: int
    end: int
    text: str
    what: str
    line: int
    dropped: bool = False


def alone(text: str, fault: Fault) -> str:
    """Return the file with only this fault."""
    return text[: fault.start] + ("begin end" if fault.dropped else f"({fault.text})") + text[fault.end :]


class Finder:
    """Collector of the faults of a file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.found: list[Fault] = []
        self.unused: list[tuple[int, int]] = []
        self._module(tree(text))

    def _add(self, node: Any, text: str, what: str, dropped: bool = False) -> None:
        start, end = span(node)
        line = self.text.count("\n", 0, start) + 1
        self.found.append(Fault(len(self.found) + 1, start, end, text, what, line, dropped))

    def _of(self, node: Any) -> str:
        start, end = span(node)
        return self.text[start:end]

    def _module(self, node: Any) -> None:
        """Find the code that becomes hardware: always blocks, assignments, instances."""
        name = kind(node)
        if name in ("AlwaysFFBlock", "AlwaysCombBlock", "AlwaysBlock", "ContinuousAssign"):
            if self._of(node).startswith("assign unused"):
                self.unused.append(span(node))
            self._walk(node)
        elif name == "NamedPortConnection":
            self._walk(node)
        elif name not in SKIPPED:
            for child in children(node):
                self._module(child)

    def _walk(self, node: Any) -> None:
        """Add the faults of a node in code that becomes hardware."""
        name = kind(node)
        if name in SKIPPED or "Event" in name:
            return
        skipped: list[Any] = []
        if name in ASSIGNMENTS:
            skipped.append(node.left)
            parent = node.parent
            if name == ASSIGNMENTS[1] and kind(parent) == "ExpressionStatement":
                self._add(parent, "", "removed", dropped=True)
        elif name == "ConditionalStatement":
            self._condition(node.predicate)
        elif name == "ConditionalExpression":
            self._add(node.predicate, f"!({self._of(node.predicate)})", "condition inverted")
        elif name == "MultipleConcatenationExpression":
            skipped.append(node.expression)
        elif name == "StreamingConcatenationExpression":
            skipped.append(node.sliceSize)
        elif name == "CastExpression":
            skipped.append(node.left)
        elif name == "StandardCaseItem":
            skipped.append(node.expressions)
        elif name == "ForLoopStatement":
            skipped += [node.initializers, node.stopExpr, node.steps]
        else:
            self._expression(node, name)
        spans = [span(one) for one in skipped if hasattr(one, "sourceRange")]
        for child in children(node):
            place = span(child)
            if not any(start <= place[0] and place[1] <= end for start, end in spans):
                self._walk(child)

    def _condition(self, predicate: Any) -> None:
        """Add the faults of an `if`: its condition is always or never true; for a reset, only never true."""
        text = self._of(predicate)
        if "rst" not in text:
            self._add(predicate, "1'b1", "always")
        self._add(predicate, "1'b0", "never")

    def _expression(self, node: Any, name: str) -> None:
        text = self._of(node)
        if hasattr(node, "operatorToken") and hasattr(node, "left"):
            sign = node.operatorToken.valueText
            if sign in SWAPS:
                left, right = self._of(node.left), self._of(node.right)
                self._add(node, f"({left}) {SWAPS[sign]} ({right})", f"{sign} replaced by {SWAPS[sign]}")
                if sign in LOGIC:
                    self._add(node, left, f"only left of {sign}")
                    self._add(node, right, f"only right of {sign}")
        elif name in ("UnaryLogicalNotExpression", "UnaryBitwiseNotExpression"):
            self._add(node, self._of(node.operand), f"without {text[0]}")
        elif name == "IntegerVectorExpression":
            self._add(node, f"({text} ^ 1'b1)", "lowest bit inverted")
        elif name == "IntegerLiteralExpression":
            self._add(node, f"({text} + 1)", "plus 1")
        elif name == "UnbasedUnsizedLiteralExpression" and text in ("'0", "'1"):
            self._add(node, {"'0": "'1", "'1": "'0"}[text], "all bits inverted")


def faults(text: str) -> list[Fault]:
    """Return all mutants of a file, in order of their places. Code that only silences lint has no mutants."""
    finder = Finder(text)
    return [
        fault for fault in finder.found if not any(start <= fault.start < end for start, end in finder.unused)
    ]
