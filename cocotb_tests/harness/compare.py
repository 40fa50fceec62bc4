"""Edge-by-edge comparison of a run with the golden model.

The pin changes of the run are replayed into the model. Each output of the RTL must then change to the same
levels on the same rising edges of `clk` as in the model. Only outputs forced by an asynchronous reset may
differ by one cycle, because rst_n can fall between two edges. A difference produces a text report, a VCD and
a PNG.

If OPENPPMC_COUNTS in the environment names a file, a simulation appends the counts of its comparisons to
it, one JSON object per line.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path
from typing import Any

from openppmc.check import replay as check
from openppmc.check.comparison import Comparison
from openppmc.check.records import Edge, Recording
from openppmc.check.report import write_report

from .crosses import leave
from .dut_bench import ModelRunner, new_model
from .part import recorded

COUNTS_FILE = "OPENPPMC_COUNTS"


def add_counts(**counts: int) -> None:
    """Add these counts to the counts file of the run."""
    if name := os.environ.get(COUNTS_FILE):
        with open(name, "a", encoding="ascii") as file:
            file.write(json.dumps(counts) + "\n")


def total_counts(file: Path) -> Counter[str]:
    """Return the sums of all counts in the counts file of a run; empty if there are no counts."""
    sums: Counter[str] = Counter()
    if file.is_file():
        for line in file.read_text(encoding="ascii").splitlines():
            sums.update(json.loads(line))
    return sums


def counts_text(sums: Counter[str]) -> str:
    """Return a text such as "12 seeds, 3,456 edges"; counts that are 0 are omitted."""
    return ", ".join(f"{number:,} {name}" for name, number in sums.items() if number)


DIGESTS = "OPENPPMC_DIGESTS"
"""Environment variable: if set, a simulation appends the digest of each compared recording to DIGEST_FILE."""
DIGEST_FILE = "digests.txt"
RECORDINGS = "OPENPPMC_RECORDINGS"
"""Environment variable: folder for the recordings of all simulations that agree with the golden model."""


def replay(recording: Recording, model: Any) -> list[Edge]:
    """Feed the pin changes into a model, run it to the end of the recording, and return its output edges.

    The model needs pins(t, **levels), run_until(t) and edges with the fields t, signal and value.
    """
    model = ModelRunner(model).catch_up(recording.stimulus, recording.end)
    return [Edge(edge.t, edge.signal, edge.value) for edge in model.edges]


def compare_recording(recording: Recording, model: Any | None = None) -> Comparison:
    """Replay a recording and compare every output of the device."""
    return _compare(recording, ModelRunner(model or new_model(recording.part, recording.params)))


def _compare(recording: Recording, follower: ModelRunner) -> Comparison:
    part = recorded(recording.part, recording.params)
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched}
    return check.compare_recording(recording, initial, "RTL", follower, part)


def leave_digest(recording: Recording, folder: Path) -> None:
    """Append the digest of a recording to the digest file if DIGESTS is set."""
    if os.environ.get(DIGESTS):
        with open(folder / DIGEST_FILE, "a", encoding="ascii") as file:
            file.write(recording.digest() + "\n")


def check_against_model(bench: Any) -> Comparison:
    """Compare all changes that a bench has recorded so far.

    Raises AssertionError with the report if there is a difference.

    If a test has used the golden model that follows the bench (`DutBench.golden`), this model is compared.
    The files of the report are written to bench.out.
    """
    recording = bench.recording()
    leave_digest(recording, bench.out)
    follower = bench.follower or ModelRunner(new_model(recording.part, recording.params))
    comparison = _compare(recording, follower)
    leave()
    if comparison.mismatch is not None:
        raise AssertionError(write_report(comparison, bench.out, bench.repro))
    if folder := os.environ.get(RECORDINGS):
        (Path(folder) / f"{recording.digest()}.json").write_text(recording.to_json(), encoding="ascii")
    return comparison
