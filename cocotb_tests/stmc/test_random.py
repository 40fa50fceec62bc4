"""Random tests with fixed lists of seeds, or one seed with `--seed N`: hosts compared with the golden model,
noise.

`make soak PART=stmc` runs any number of other seeds.
"""

from __future__ import annotations

from cocotb_tests.harness import D16, F16, RandomItems, SimOptions, generating
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.random_host import in_turn

from .expected_timing import F12, ODD
from .random_host import DATASHEET_WEIGHTS, WEIGHTS, scenario

SEEDS = range(1, 151)
CHAOS_SEEDS = range(1, 17)


random_item = RandomItems("stmc", "tb_random", "stmc_random_host", SEEDS, lambda seed: scenario(seed).config)
noise_item = RandomItems(
    "stmc",
    "tb_random",
    "stmc_random_noise",
    CHAOS_SEEDS,
    in_turn(F16, F16, F12, ODD, F16, D16),
)
pytest_generate_tests = generating(test_random=random_item, test_noise=noise_item)


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """For the scenarios of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_noise(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """After noise on all pins, the core works again."""
    noise_item.run(item, seeds, sim_options)


def test_scenarios_are_reproducible_and_varied() -> None:
    """The same seed returns the same list; all fixed seeds together use each kind of action and each
    build.
    """
    assert scenario(5) == scenario(5) != scenario(6)
    assert random_item.complete and noise_item.complete and len(SEEDS) >= 150
    plans = [scenario(seed) for seed in SEEDS]
    kinds = {action[0] for plan in plans for action in plan.actions}
    assert kinds == set("write send status read fetch finish wait pins blip raw reset".split())
    builds = {config.name for config, _ in (*WEIGHTS, *DATASHEET_WEIGHTS)}
    assert {plan.config.name for plan in plans} == builds
    assert 50 < sum(plan.clocked for plan in plans) < 120  # the external clock
