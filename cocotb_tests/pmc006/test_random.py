"""Compares the part under random hosts with the golden model, for fixed seeds or with `--seed N`.

One simulation plays several seeds of one build in turn, each after a reset. `make soak PART=pmc006` plays any
number of other seeds.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from cocotb_tests.harness import OnModel, RandomItems, SimOptions, generating, on_model
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.random_items import Played, all_of

from .random_host import build, play, with_chip
from .test_memory import design

SEEDS = range(1, 151)


WITH_CHIP = [seed for seed in SEEDS if with_chip(seed)]
ALONE = [seed for seed in SEEDS if seed not in WITH_CHIP]
random_item = RandomItems(
    "pmc006", "tb_random", "p006_random_host", ALONE, build, takes=lambda seed: not with_chip(seed)
)
chip_item = RandomItems(
    "pmc006", "tb_random", "p006_random_host", WITH_CHIP, build, design=design, takes=with_chip
)
pytest_generate_tests = generating(test_random=random_item, test_random_with_eeprom=chip_item)


class Either:
    """Seeds of `make soak`; each seed determines whether its host has an EEPROM."""

    def some(self, seeds: Sequence[int]) -> Played:
        """Run seeds in this process."""
        kinds = (random_item, chip_item)
        return all_of(kind.some([seed for seed in seeds if kind.takes(seed)]) for kind in kinds)


SOAK = Either()


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With the hosts of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_random_with_eeprom(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With hosts that have an EEPROM, every output edge equals that of the golden model. Some EEPROMs do
    not respond.
    """
    chip_item.run(item, seeds, sim_options)


def test_scenarios_are_reproducible_and_varied() -> None:
    """The fixed seeds are all different and together use each build; enough of their hosts have an EEPROM."""
    assert {build(seed).name for seed in SEEDS} == build.names
    assert random_item.complete and chip_item.complete
    assert sorted([*ALONE, *WITH_CHIP]) == list(SEEDS) and len(SEEDS) >= 150 and len(WITH_CHIP) >= 10


LEAST = {
    **{"reply": 300, "steps": 150, "halts": 12, "m11": 300, "phase_a_sign": 30, "gpo": 4, "ext1_pu": 5},
    **{"mon_dir": 4, "code z": 4, "code E": 5, "code N": 12, "code s": 15, "code I": 1, "code v": 15},
    **{"ext": 8, "stall": 3, "analog": 2, "keys": 1, "chopper": 4, "bad_frame": 5, "foreign": 2},
    **{"talk_out_of_turn": 2, "collisions": 20, "noise": 2, "unknown": 2, "bridge_a_en": 25},
}
"""Minimum number of each event in the hosts of every third seed of `make test`."""


def test_hosts_are_rich() -> None:
    """Each kind of event occurs often enough, and the part is active."""
    seen: Counter[str] = Counter()
    for seed in SEEDS[::3]:
        seen += on_model(play(OnModel(build(seed), seed), seed))
    thin = {kind: (seen[kind], least) for kind, least in LEAST.items() if seen[kind] < least}
    assert not thin, f"too rare (seen, needed): {thin}"
