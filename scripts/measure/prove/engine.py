"""Run ABC on a model: an unbounded proof by property directed reachability, or a bounded search.

Both begin in reset. ABC is part of the wheel of pyosys.
"""

from __future__ import annotations

import os
import re
import subprocess
from importlib.util import find_spec
from pathlib import Path

from cocotb_tests.harness.project import ProjectError

_HIT = re.compile(r"Output\s+(\d+)(?: of miter \S+)? was asserted in frame\s+(\d+)")
PROVED, FAILED, OPEN = "proved", "failed", "open"
REACH = 20
"""Number of cycles by which the bounded search before an induction exceeds the length of the induction."""


def abc() -> Path:
    """Return the path of ABC; raise ProjectError if the wheel lacks it."""
    spec = find_spec("pyosys")
    path = Path(next(iter(spec.submodule_search_locations or ()), ""), "yosys-abc") if spec else Path()
    if not os.access(path, os.X_OK) or not path.is_file():
        raise ProjectError("yosys-abc: not found; the package pyosys contains it (run `make setup`)")
    return path


def ask(folder: Path, what: str, script: str) -> str:
    """Run commands of ABC on <what>.aig; return its output."""
    words = f"read_aiger {what}.aig; fold; strash; {script}"
    done = subprocess.run(
        [abc(), "-c", words],
        cwd=folder,
        text=True,
        check=False,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    (folder / f"{what}.log").write_text(done.stdout, encoding="utf-8")
    return done.stdout


def hits(said: str) -> dict[int, int]:
    """Parse ABC's output; return number of an output that can be true -> cycles after reset."""
    return {int(output): int(frame) for output, frame in _HIT.findall(said)}


def induction(folder: Path, length: int, limit: int) -> tuple[str, dict[int, int]]:
    """Prove by induction over at most `length` cycles, after a longer bounded search from reset.

    This method is for blocks with large memories; their wrappers state how memory and outputs are related.
    """
    base = length + REACH
    first = ask(folder, "prove", f"bmc3 -F {base} -T {limit}; write_cex -a prove.aiw")
    if found := hits(first):
        return FAILED, found
    said = ask(folder, "prove", f"orpos; ind -F {length} -T {limit}")
    good = f"No output asserted in {base} frames" in first and "Networks are equivalent." in said
    return (PROVED if good else OPEN), {}


def prove(folder: Path, bound: int, limit: int, induct: int = 0) -> tuple[str, dict[int, int]]:
    """Prove that no output of prove.aig can be true (within `bound` cycles); else return which, and when.

    The proof takes at most `limit` seconds. A counterexample is written to prove.aiw.

    Args:
        induct: length of the induction; 0 means no induction.
    """
    if induct:
        return induction(folder, induct, limit)
    # Some proofs need equal registers to be merged first (scorr); for others this does not help.
    half = max(limit // 2, 1)
    searches = [f"orpos; pdr -T {half}", f"scorr; orpos; pdr -T {half}", f"pdr -T {half}"]
    said = ""
    for search in [f"bmc3 -F {bound} -T {limit}"] if bound else searches:
        said = ask(folder, "prove", f"{search}; write_cex -a prove.aiw")
        if "Property UNDECIDED" not in said:
            break
    if found := hits(said):
        if not bound:  # another run finds the output, and a trace with all inputs
            again = f"bmc3 -F {min(found.values()) + 1} -T {limit}; write_cex -a prove.aiw"
            found = hits(ask(folder, "prove", again)) or found
        return FAILED, found
    whole = f"No output asserted in {bound} frames" if bound else "Property proved."
    return (PROVED if whole in said else OPEN), {}


def fill(folder: Path) -> None:
    """Add to prove.aiw the registers that ABC has removed; all begin at 0 (write_aiger -zinit)."""
    witness = folder / "prove.aiw"
    _, inputs = witness.read_text().split("\n", 1)
    registers = int((folder / "prove.aig").read_bytes().split(maxsplit=4)[3])
    witness.write_text("0" * registers + "\n" + inputs)


def covered(folder: Path, bound: int, limit: int) -> dict[int, int]:
    """Return the covers of cover.aig that are reached within `bound` cycles, with their cycles."""
    return hits(ask(folder, "cover", f"bmc3 -a -F {bound} -T {limit}"))
