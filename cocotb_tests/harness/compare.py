"""Edge-by-edge comparison of a run with the golden model.

The pin changes of the run are replayed into the model; every output of both sides must then show the same
levels on the same clk edges. Only outputs forced by an asynchronous reset may be one clk apart, because
rst_n can fall between two edges. A difference gives a text report, a VCD and a PNG.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from .compare_draw import draw_png
from .compare_report import report
from .compare_vcd import write_vcd
from .comparison import Comparison, compare_edges
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
    return _edges(Follower(model), recording)


def _edges(follower: Follower, recording: Recording) -> list[Edge]:
    model = follower.catch_up(recording.stimulus, recording.end)
    return [Edge(edge.t, edge.signal, edge.value) for edge in model.edges]


def compare_recording(recording: Recording, model: Any | None = None) -> Comparison:
    """Replay a recording and compare every output of the part."""
    return _compare(recording, Follower(model or new_model(recording.part, recording.params)))


def _compare(recording: Recording, follower: Follower) -> Comparison:
    part = recorded(recording.part, recording.params)
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched}
    resets = [c.t for c in recording.stimulus if c.pin == "rst_n" and c.value == 0]
    edges = _edges(follower, recording)
    expected, actual, mismatch = compare_edges(edges, recording.edges, initial, recording.end, resets)
    return Comparison(recording, initial, expected, actual, mismatch)


def write_report(comparison: Comparison, folder: Path, repro: str = "") -> str:
    """Write compare.txt, compare.vcd, compare.png and recording.json; returns the text."""
    folder.mkdir(parents=True, exist_ok=True)
    text = report(comparison, repro)
    (folder / "compare.txt").write_text(text + "\n", encoding="utf-8")
    (folder / "recording.json").write_text(comparison.recording.to_json(), encoding="utf-8")
    write_vcd(comparison, folder / "compare.vcd")
    draw_png(comparison, folder / "compare.png")
    return text


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
    if comparison.mismatch is not None:
        raise AssertionError(write_report(comparison, bench.out, bench.repro))
    return comparison
