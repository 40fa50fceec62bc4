"""Edge-by-edge comparison of a run with the golden model.

The pin changes of the run are replayed into the model; every output of both sides must then show the same
levels on the same clk edges. Only outputs forced by an asynchronous reset may be one clk apart, because
rst_n can fall between two edges. A difference gives a text report, a VCD and a PNG.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from openppmc.check import replay as check
from openppmc.check.report import write_report

from . import crosses
from .comparison import Comparison
from .follower import Follower, new_model
from .part import recorded
from .stimulus import Edge, Recording

DIGESTS = "OPENPPMC_DIGESTS"
"""Tells a simulation to leave the digest of all that it compares, one a line, in DIGEST_FILE."""
DIGEST_FILE = "digests.txt"


def replay(recording: Recording, model: Any) -> list[Edge]:
    """Feed the pin changes into a model, run it to the recording's end, return its output edges.

    The model needs pins(t, **levels), run_until(t) and edges with fields t, signal, value.
    """
    model = Follower(model).catch_up(recording.stimulus, recording.end)
    return [Edge(edge.t, edge.signal, edge.value) for edge in model.edges]


def compare_recording(recording: Recording, model: Any | None = None) -> Comparison:
    """Replay a recording and compare every output of the part."""
    return _compare(recording, Follower(model or new_model(recording.part, recording.params)))


def _compare(recording: Recording, follower: Follower) -> Comparison:
    part = recorded(recording.part, recording.params)
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched}
    return check.compare_recording(recording, initial, "RTL", follower, part)


def leave_digest(recording: Recording, folder: Path) -> None:
    """If DIGESTS asks for it."""
    if os.environ.get(DIGESTS):
        with open(folder / DIGEST_FILE, "a", encoding="ascii") as file:
            file.write(recording.digest() + "\n")


def check_against_model(bench: Any) -> Comparison:
    """Compare all that a bench has seen so far; AssertionError with the report at a difference.

    The golden model is the one that has followed the bench (`Side.golden`), if a test has asked for it. The
    files of the report go to bench.out.
    """
    recording = bench.recording()
    leave_digest(recording, bench.out)
    follower = bench.follower or Follower(new_model(recording.part, recording.params))
    comparison = _compare(recording, follower)
    crosses.leave()
    if comparison.mismatch is not None:
        raise AssertionError(write_report(comparison, bench.out, bench.repro))
    return comparison
