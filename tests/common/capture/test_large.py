"""Large captures: speed and memory of `openppmc decode`."""

from __future__ import annotations

from pathlib import Path

from scripts.bench.captures import EDGES, measure

RATE = 1_500_000
"""edges/s of processor time, half of the goal: the machine of a test has other work."""
BYTES = 24


def test_four_million_edges(tmp_path: Path) -> None:
    """A capture of 4 million edges is decoded at 3 million edges/s in 24 bytes for each edge."""
    count, rate, size = measure(tmp_path, runs=2)
    assert count >= EDGES
    assert size <= BYTES
    assert rate >= RATE
