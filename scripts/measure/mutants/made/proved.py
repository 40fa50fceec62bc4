"""Quick proofs for mutants: the proofs of blocks that contain a file, and the first that a mutant breaks."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from cocotb_tests.harness.project import ROOT
from openppmc import parts
from scripts.measure.mutants.made.faults import Fault, alone
from scripts.measure.prove.check import check, place
from scripts.measure.prove.table import Change, Proof, proofs

LIMIT = 60
"""Time limit of a solver in s; a proof usually takes a few seconds."""


def _block_files(proof: Proof) -> set[str]:
    """Return the names of the files in the block of a proof, including packages."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in proof.sources()}
    found: set[str] = set()
    fresh = {proof.file.stem}
    while fresh:
        found |= fresh
        code = (re.sub("//.*", "", texts[name]) for name in fresh)
        fresh = {word for text in code for word in re.findall(r"\w+", text)} & texts.keys() - found
    return found


@cache
def proofs_of(file: str) -> tuple[list[Proof], list[Proof]]:
    """Return the proofs of the block itself, and of blocks that contain it, unless a stub replaces it.

    For a block without a proof, the proofs of blocks in its folder, except whole parts, take the first place.
    """
    folder, name = file.split("/")[1], Path(file).stem
    quick = (one for one in proofs() if not one.night)
    found = [one for one in quick if ROOT / file in one.sources() and name in _block_files(one)]
    own = [one for one in found if one.block == name]
    tops = {row.top for row in parts.tops()}
    own = own or [one for one in found if one.folder == folder and one.block not in tops]
    return own, [one for one in found if one not in own]


def failing(file: str, fault: Fault, tried: Sequence[Proof]) -> str:
    """Return the first proof with a counterexample or an unreached cover; "" if all proofs hold."""
    text = alone((ROOT / file).read_text(encoding="utf-8"), fault)
    change = Change(f"{Path(file).stem}-{fault.number}", file, text)
    for proof in tried:
        outcome = check(proof, LIMIT, change)
        shutil.rmtree(place(proof, change), ignore_errors=True)
        if outcome.refuted or any(clk < 0 for _, clk in outcome.reached):
            return proof.name
    return ""
