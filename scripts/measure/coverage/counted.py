"""Copies of the RTL with the same line numbers, in which Verilator counts correctly.

Verilator puts the counter of a block after its last statement. If this statement is a `return`, the counter
is never reached. Before its pull request 8425, Verilator also loses the counters of a package that contains
only functions. Therefore, in the copy, a `return x;` that ends its function becomes `<function> = x;`, the
statements after an `if (c) return x;` move into its else branch, and a package begins with a variable.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness.build import locked
from cocotb_tests.harness.project import BUILD, RTL, relative
from scripts.measure.syntax import children, found, function_name, kind, span, tree

KEPT = " int unsigned openppmc_counted /*verilator public_flat_rw*/;"


class Copy:
    """A text with changes, each of which replaces the range [start, end)."""

    def __init__(self, text: str) -> None:
        self._changes: list[tuple[int, int, str]] = []
        root = tree(text)
        functions = list(found(root, "FunctionDeclaration"))
        for package in found(root, "PackageDeclaration") if functions else ():
            self._put(span(package.header)[1], KEPT)
        for function in functions:
            statements = [node for node in children(function) if kind(node) != "FunctionPrototype"]
            self._list(statements, function_name(function))
        self.text = text
        for start, end, new in sorted(self._changes, reverse=True):
            self.text = self.text[:start] + new + self.text[end:]

    def _put(self, at: int, new: str) -> None:
        self._changes.append((at, at, new))

    def _list(self, statements: Sequence[Any], name: str) -> None:
        """Change the last statement; move the statements after an `if` with `return` into an else branch."""
        for number, node in enumerate(statements):
            if node is statements[-1]:
                self._last(node, name)
            elif kind(node) == "ConditionalStatement" and not node.elseClause and _returns(node.statement):
                self._last(node.statement, name)
                self._put(span(node)[1], " else begin")
                self._list(statements[number + 1 :], name)
                self._put(span(statements[-1])[1], " end")
                return

    def _last(self, node: Any, name: str) -> None:
        if kind(node) == "ReturnStatement":
            start = span(node)[0]
            self._changes.append((start, start + len("return"), f"{name} ="))
        elif kind(node) == "ConditionalStatement":
            self._last(node.statement, name)
            if node.elseClause:
                self._last(node.elseClause.clause, name)
        elif kind(node) == "CaseStatement":
            for item in found(node, "StandardCaseItem", "DefaultCaseItem"):
                self._last(item.clause, name)
        elif kind(node) == "SequentialBlockStatement":
            self._list(list(children(node)), name)


def _returns(node: Any) -> bool:
    """Return True if no code runs after this statement."""
    if kind(node) == "SequentialBlockStatement":
        inside = list(children(node))
        return bool(inside) and _returns(inside[-1])
    return kind(node) == "ReturnStatement"


def copies() -> Path:
    """Return the folder with a copy of rtl/, made if needed; files keep their project paths."""
    files = sorted(RTL.rglob("*.sv"))
    sha = hashlib.sha256(Path(__file__).read_bytes())
    for file in files:
        sha.update(file.read_bytes())
    folder = BUILD / "counted" / sha.hexdigest()[:16]
    with locked(folder.with_suffix(".lock")):
        if not (folder / "done").is_file():
            for file in files:
                copy = folder / relative(file)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_text(Copy(file.read_text(encoding="utf-8")).text, encoding="utf-8")
            (folder / "done").touch()
    return folder
