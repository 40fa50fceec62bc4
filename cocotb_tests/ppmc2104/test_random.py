"""Random hosts against the golden model, axis 2 with and without axis 1, noise: fixed lists of seeds.

`--seed N` plays seed N only. `make soak PART=ppmc2104` plays as many others as you like.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness.batches import parametrize, played, run_batch, seed_item
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.config import D16, F11, F16, F100
from cocotb_tests.harness.runner import SimOptions
from cocotb_tests.ppmc2104.random_host import scenario
from cocotb_tests.ppmc2104.random_pairs import pair

SEEDS = range(1, 161)
PAIR_SEEDS = range(1, 13)
CHAOS_SEEDS = range(1, 25)


def random_item(seed: int) -> Item:
    """The random host of one seed; the seed decides the build configuration, too."""
    return seed_item("ppmc2104", "tb_random", "p2104_random_host", seed, scenario(seed).config)


def pair_item(seed: int) -> Item:
    """Axis 2 alone and beside a working axis 1."""
    test = "p2104_axis_2_alone_and_beside_axis_1"
    return seed_item("ppmc2104", "tb_independent", test, seed, pair(seed).config)


def chaos_item(seed: int) -> Item:
    """The noise run of one seed."""
    config = (F16, F16, F11, F100, F16, D16)[seed % 6]
    return seed_item("ppmc2104", "tb_chaos", "p2104_random_chaos", seed, config)


_KINDS = {
    "test_random": (random_item, SEEDS),
    "test_independent_axes": (pair_item, PAIR_SEEDS),
    "test_chaos": (chaos_item, CHAOS_SEEDS),
}


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """One pytest item a batch."""
    if "item" in metafunc.fixturenames:
        parametrize(metafunc, *_KINDS[metafunc.function.__name__])


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """The scenarios of some seeds: every output edge equals the golden model's."""
    run_batch(item, seeds, sim_options)


def test_independent_axes(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """Axis 2 shows the same edges whatever axis 1 is told."""
    run_batch(item, seeds, sim_options)


def test_chaos(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """Noise on all pins, then recovery by the documented sequence."""
    run_batch(item, seeds, sim_options)


def test_scenarios_are_reproducible_and_varied() -> None:
    """Same seed, same list; the fixed seeds together use every action kind and every build."""
    assert scenario(5) == scenario(5) != scenario(6)
    assert pair(5) == pair(5) != pair(6)
    for make, seeds in _KINDS.values():
        assert played(make, seeds) == list(seeds)
    plans = [scenario(seed) for seed in SEEDS]
    kinds = {action[0] for plan in plans for action in plan.actions}
    assert kinds == set("write send status read fetch finish wait pins blip raw reset".split())
    assert {plan.config.name for plan in plans} == set("f16 f8m f11m f25m f50m f100m d16 d11m d25x8".split())
    assert sum(any(clock.segments for clock in plan.clocks) for plan in plans) > 40
    assert {plan.pins["busc"] for plan in plans} == {0, 1}
