"""docs/proofs.md: what is proved of which block, and how far, from the table of proofs (`make docs`)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from cocotb_tests.harness.project import DOCS, ProjectError, relative

from .table import Proof, proofs

PAGE = DOCS / "proofs.md"
MARK = "<!-- proofs -->"
"""What is between two of these is written here, the rest by hand."""


def method(proof: Proof) -> str:
    """How it is proved."""
    return f"the first {proof.bound} clk" if proof.bound else "without end"


def row(proof: Proof) -> str:
    """One line of the table."""
    says = "<br>".join(proof.says)
    if proof.why:
        says += f"<br>*Bounded:* {proof.why}"
    taken = "<br>".join(f"`{label}`: {where}" for label, where in proof.assumes.items()) or "nothing"
    rules = ", ".join(proof.rules) or "its header"
    source = f"[{proof.name}](../{relative(proof.file)})"
    return f"| {source} | {says} | {method(proof)} | {proof.cover} clk | {taken} | {rules} |"


def table(every: Sequence[Proof]) -> str:
    """All proofs, a table a folder."""
    lines = [
        "",
        f"{len(every)} proofs of {len({one.block for one in every})} blocks;"
        f" {sum(not one.bound for one in every)} hold without end,"
        f" {sum(bool(one.bound) for one in every)} for the first clk that the table says.",
        "",
    ]
    for folder, group in groupby(every, key=lambda one: one.folder):
        lines += [
            f"### {folder}",
            "",
            "| Proof | Properties | Holds for | Cover in | Assumes: guarded by | Rules |",
        ]
        lines += ["|---|---|---|---|---|---|", *map(row, group), ""]
    return "\n".join(lines)


def text() -> str:
    """The whole page as it should be; what is outside of the marks stays."""
    parts = PAGE.read_text(encoding="utf-8").split(MARK)
    if len(parts) != 3:
        raise ProjectError(f"{relative(PAGE)} must have {MARK} twice")
    return MARK.join([parts[0], table(list(proofs())), parts[2]])
