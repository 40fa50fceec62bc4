"""The page docs/proofs.md: proved properties of each block and their bounds, from the table of proofs."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from cocotb_tests.harness.project import DOCS, RTL, ProjectError, relative
from scripts import markdown
from scripts.measure.prove.table import Proof, proofs

PAGE = DOCS / "proofs.md"
MARK = "<!-- proofs -->"
"""Text between two of these marks is generated; all other text of the page is written by hand."""


ROOMS = ("common", "host", "motion", "single", "bank")
"""Folders of rtl/ in which each block should have a proof."""
HEADS = ("Proof", "Properties", "Holds for", "Cover in", "Assumes: guarded by", "Rules")
SHOWN = 6
"""Maximum number of proofs that are listed for a package; further proofs are only counted."""


def unproved(every: Sequence[Proof]) -> dict[str, list[str]]:
    """Return each shared file without a separate proof, with the proofs whose blocks use the file."""
    proved = {one.block for one in every}
    paths = [path for room in ROOMS for path in sorted((RTL / room).glob("*.sv")) if path.stem not in proved]
    sources = {path: path.read_text(encoding="utf-8") for one in every for path in one.sources()}
    own = {one.name: sources[path] for one in every for path in one.sources() if path.stem == one.block}
    return {path.stem: [name for name, source in own.items() if f"{path.stem}::" in source] for path in paths}


def without(every: Sequence[Proof]) -> str:
    """Return the table of files of the shared folders without a separate proof, and the reasons."""
    rows = []
    for name, by in unproved(every).items():
        package = "package: constants, types and functions, no state"
        why = package if name.endswith("_pkg") else "**open**"
        more = f" and {len(by) - SHOWN} more" if len(by) > SHOWN else ""
        rows.append((name, why, f"{', '.join(by[:SHOWN])}{more}"))
    return markdown.table(("File", "Why", "It is part of"), rows)


def method(proof: Proof) -> str:
    """Return the text in the table about the method of a proof."""
    if proof.induct:
        return f"unbounded, by induction over {proof.induct} cycles"
    return f"the first {proof.bound} cycles" if proof.bound else "unbounded"


def row(proof: Proof) -> tuple[str, ...]:
    """Return one row of the table."""
    says = " <br>".join(f"{text}." for text in proof.says)
    if proof.why:
        says += f"<br>*Bounded:* {proof.why}"
    taken = "<br>".join(f"`{label}`: {where}" for label, where in proof.assumes.items()) or "no assumption"
    rules = ", ".join(proof.rules) or "its header"
    source = f"[{proof.name}](../{relative(proof.file)})"
    return source, says, method(proof), f"{proof.cover} cycles", taken, rules


def table(every: Sequence[Proof]) -> str:
    """Return the tables of all proofs, one for each folder."""
    lines = [
        "",
        f"{len(every)} proofs of {len({one.block for one in every})} blocks;"
        f" {sum(not one.bound for one in every)} are unbounded,"
        f" {sum(bool(one.bound) for one in every)} hold for the first cycles that the table states.",
        "",
    ]
    for folder, group in groupby(every, key=lambda one: one.folder):
        lines += [f"### {folder}", "", markdown.table(HEADS, map(row, group)), ""]
    return "\n".join([*lines, "### Without a separate proof", "", without(every), ""])


def text() -> str:
    """Return the page with generated tables; text outside the marks is not changed."""
    parts = PAGE.read_text(encoding="utf-8").split(MARK)
    if len(parts) != 3:
        raise ProjectError(f"{relative(PAGE)} must have {MARK} twice")
    return MARK.join([parts[0], table(list(proofs())), parts[2]])
