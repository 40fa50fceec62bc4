"""Run one proof, from the sources to the outcome, and write the trace of a counterexample."""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.project import BUILD, ROOT, ProjectError, include_dirs, ran, relative
from scripts.measure.prove import engine
from scripts.measure.prove.table import FORMAL, Change, Proof

LIMIT = 600
"""Time limit of one run of the solver in s."""
TRACE = "read_rtlil prove.il; sim -q -zinit -multiclock -r prove.aiw -map prove.aim -vcd trace.vcd"


@dataclass(frozen=True)
class Outcome:
    """Result of a proof.

    Attributes:
        trouble: reason why the proof fails, empty if the proof holds.
        reached: for each cover, the cycle in which it was reached.
        refuted: True if a property has a counterexample.
    """

    name: str
    trouble: str
    labels: tuple[str, ...] = ()
    reached: tuple[tuple[str, int], ...] = ()
    seconds: float = 0.0
    refuted: bool = False

    @property
    def good(self) -> bool:
        """True if the property is proved and all covers are reached."""
        return not self.trouble


def yosys(folder: Path, *command: str) -> str:
    """Run yosys in a separate process, with its log in the folder; return why yosys failed, or ""."""
    code, text = ran([sys.executable, *command])
    (folder / "yosys.log").write_text(text, encoding="utf-8")
    if not code:
        return ""
    lines = [line.strip() for line in text.splitlines() if "error:" in line.lower()]
    if "No module named 'pyosys'" in text:
        raise ProjectError("pyosys is not installed: run `make setup`")
    return lines[0] if lines else f"yosys ended with exit code {code}"


def model(proof: Proof, folder: Path, changed: Mapping[Path, Path]) -> str:
    """Make the graphs of a proof; return the reason if they cannot be made, else ""."""
    job = {
        "top": proof.file.stem,
        "only": proof.only,
        "folder": relative(folder),
        "includes": [relative(path) for path in (*include_dirs(), FORMAL)],
        "sources": [relative(path) for path in proof.sources(changed)],
    }
    path = folder / "job.json"
    path.write_text(json.dumps(job), encoding="utf-8")
    return yosys(folder, "-m", "scripts.measure.prove.model", relative(path))


def trace(folder: Path) -> str:
    """Write the waveforms of the counterexample; return their path, or the reason of a failure."""
    script = "import os, sys, pyosys.libyosys as ys; os.chdir(sys.argv[1]); design = ys.Design()\n"
    script += "for command in sys.argv[2].split('; '): ys.run_pass(command, design)"
    engine.fill(folder)
    said = yosys(folder, "-c", script, relative(folder), TRACE)
    return said or relative(folder / "trace.vcd")


def place(proof: Proof, change: Change | None = None) -> Path:
    """Return the folder of a run. The folder is not removed after the run."""
    return BUILD / "prove" / (f"{proof.name}.{change.name}" if change else proof.name)


def check(proof: Proof, limit: int = LIMIT, change: Change | None = None) -> Outcome:
    """Run one proof of the unchanged RTL, or of RTL with a change that must make the proof fail."""
    begin = time.monotonic()
    folder = place(proof, change)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    changed = {}
    if change:
        changed[ROOT / change.file] = folder / Path(change.file).name
        changed[ROOT / change.file].write_text(change.text, encoding="utf-8")
    if said := model(proof, folder, changed):
        return Outcome(proof.name, said)
    labels = json.loads((folder / "labels.json").read_text(encoding="utf-8"))

    def outcome(trouble: str, reached: tuple[tuple[str, int], ...] = (), refuted: bool = False) -> Outcome:
        return Outcome(
            proof.name, trouble, tuple(labels["prove"]), reached, time.monotonic() - begin, refuted
        )

    verdict, found = engine.prove(folder, proof.bound, limit, proof.induct)
    if verdict == engine.FAILED:
        number, clk = min(found.items(), key=lambda hit: hit[1])
        return outcome(f"{labels['prove'][number]} fails in cycle {clk}: {trace(folder)}", refuted=True)
    if verdict == engine.OPEN:
        return outcome(f"no result in {limit} s")
    if not labels["prove"] or not labels["cover"]:
        return outcome("the proof has no property" if labels["cover"] else "the proof has no cover")
    seen = engine.covered(folder, proof.cover, limit)
    reached = tuple((label, seen.get(at, -1)) for at, label in enumerate(labels["cover"]))
    missed = [label for label, clk in reached if clk < 0]
    return outcome(f"{missed[0]} is not reached in {proof.cover} cycles" if missed else "", reached)
