"""Compares the bank under random hosts with the golden model, for fixed seeds or with `--seed N`.

One simulation runs several seeds of one build. `make soak PART=bank` runs any number of other seeds.
"""

from __future__ import annotations

from cocotb_tests.harness import RandomItems, SimOptions, generating
from cocotb_tests.harness.collect import Item

from .random_host import INTERVALS, build, in_motion

SEEDS = range(1, 28)
BATCH = 5

random_item = RandomItems("bank", "tb_random", "bank_random_host", SEEDS, build, BATCH)
pytest_generate_tests = generating(test_random=random_item)


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """For the hosts of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_seeds_are_enough() -> None:
    """The fixed seeds are all different, and together they use each build and compare a million intervals.
    Each host checks its number of intervals.
    """
    assert random_item.complete
    assert {build(seed).name for seed in SEEDS} == build.names
    assert sum(INTERVALS for seed in SEEDS if in_motion(seed)) >= 1_000_000
