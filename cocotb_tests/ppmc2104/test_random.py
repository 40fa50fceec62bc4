"""Random tests: hosts compared with the golden model, axis 2 with and without traffic to axis 1, noise on
pins.

The seeds are fixed lists, or one seed with `--seed N`. `make soak PART=ppmc2104` runs any number of other
seeds.
"""

from __future__ import annotations

from cocotb_tests.harness import D16, F11, F16, F100, RandomItems, SimOptions, generating
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.random_host import in_turn
from cocotb_tests.ppmc2104.random_host import scenario
from cocotb_tests.ppmc2104.random_pairs import pair

SEEDS = range(1, 161)
PAIR_SEEDS = range(1, 13)
CHAOS_SEEDS = range(1, 25)


random_item = RandomItems(
    "ppmc2104", "tb_random", "p2104_random_host", SEEDS, lambda seed: scenario(seed).config
)
pair_item = RandomItems(
    "ppmc2104",
    "tb_independent",
    "p2104_axis_2_alone_and_with_axis_1",
    PAIR_SEEDS,
    lambda seed: pair(seed).config,
)
noise_item = RandomItems(
    "ppmc2104",
    "tb_noise_recovery",
    "p2104_random_noise",
    CHAOS_SEEDS,
    in_turn(F16, F16, F11, F100, F16, D16),
)
pytest_generate_tests = generating(
    test_random=random_item, test_independent_axes=pair_item, test_noise=noise_item
)


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """For the scenarios of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_independent_axes(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """The edges of axis 2 do not depend on instructions to axis 1."""
    pair_item.run(item, seeds, sim_options)


def test_noise(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """After noise on all pins, the documented sequence makes the core work again."""
    noise_item.run(item, seeds, sim_options)


def test_scenarios_are_reproducible_and_varied() -> None:
    """The same seed returns the same list; all fixed seeds together use each kind of action and each
    build.
    """
    assert scenario(5) == scenario(5) != scenario(6)
    assert pair(5) == pair(5) != pair(6)
    assert random_item.complete and pair_item.complete and noise_item.complete
    plans = [scenario(seed) for seed in SEEDS]
    kinds = {action[0] for plan in plans for action in plan.actions}
    assert kinds == set("write send status read fetch finish wait pins blip raw reset".split())
    assert {plan.config.name for plan in plans} == set("f16 f8m f11m f25m f50m f100m d16 d11m d25x8".split())
    assert sum(plan.clocked for plan in plans) > 40
    assert {plan.pins["busc"] for plan in plans} == {0, 1}
