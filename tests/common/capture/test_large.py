"""Large captures: speed and memory of `openppmc decode`."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest

from openppmc.capture.common.compare import Result, match_edges
from openppmc.capture.common.signals import Channel, numpy
from scripts.measure.bench.captures import COMPARED, EDGES, measure

BYTES = 24
PLAIN = {"moves.vcd": 40.0, "bus.vcd": 60.0, "moves.csv": 17.0}
"""File -> maximum decoding time, divided by the time of a numpy pass over its bytes: twice the measured
ratio.
"""


@pytest.mark.parametrize("name", PLAIN)
def test_four_million_edges(name: str, tmp_path: Path) -> None:
    """A capture of 4 million edges needs 24 bytes per edge, and a bounded multiple of the time of a numpy
    pass.
    """
    found = measure(tmp_path, name, runs=3)
    assert found.edges >= EDGES
    assert found.size <= BYTES
    assert found.plain <= PLAIN[name]


def test_compare_needs_columns(tmp_path: Path) -> None:
    """A comparison needs only two additional columns of times and levels, and no object for each edge."""
    small, large = (measure(tmp_path, COMPARED, edges, runs=1) for edges in (50_000, 250_000))
    assert (large.size * large.edges - small.size * small.edges) / (large.edges - small.edges) <= 2 * BYTES


@pytest.mark.parametrize(("mine", "other"), [(1000, 0), (0, 1000), (1000, 1), (257, 256)])
def test_a_side_without_edges(mine: int, other: int) -> None:
    """If only one side has edges, each of them is a difference."""
    np = numpy()
    sides = [Channel.of(1, np.arange(n) * 10**6, (np.arange(n) & 1).astype(np.uint8)) for n in (mine, other)]
    result = Result()
    match_edges("dir", *sides, 0, 10**10, 1000, True, result)
    assert result.compared == min(mine, other) and len(result.differences) == abs(mine - other)


def test_differences_need_columns() -> None:
    """If no edge has a partner on the other side, a comparison still needs only two additional columns."""
    np = numpy()
    count = 40_000
    times = np.arange(count) * 1_000_000
    levels = (np.arange(count) & 1).astype(np.uint8)
    chip, model = Channel.of(1, times, levels), Channel.of(1, times + 400_000, levels)
    result = Result()
    tracemalloc.start()
    match_edges("pout_n", chip, model, 0, int(times[-1]) + 10_000_000, 1000, True, result)
    result.differences.sort()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(result.differences) == 2 * count and result.compared == 0
    assert peak <= 2 * count * BYTES * 2
    assert [(one.t, one.chip) for one in result.differences[:3]] == [
        (0, True),
        (400_000, False),
        (10**6, True),
    ]
