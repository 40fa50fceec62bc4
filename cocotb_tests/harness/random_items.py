"""`RandomItems`: the random tests of one kind, as the `test_random.py` of a part lists them.

random_item = RandomItems("stmc", "tb_random", "stmc_random_host", range(1, 151), build)
pytest_generate_tests = generating(test_random=random_item)
"""

from __future__ import annotations

import importlib
import re
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pytest

from .batches import BATCH, parametrize, played, run_batch, seed_item
from .build import Design, part_design
from .collect import Item
from .config import Config
from .model_bench import OnModel, on_model
from .runner import SimOptions, run_sim
from .soaking import Played, play


@dataclass(frozen=True, eq=False)
class RandomItems:
    """`random_item(seed)` is the simulation of a seed of any number.

    seeds: those that `make test` plays, `batch` of one build in a simulation. build: that of a seed. design:
    what is simulated, if that is not the part alone. takes: whether a seed is of this kind.
    """

    part: str
    module: str
    test: str
    seeds: Sequence[int]
    build: Callable[[int], Config]
    batch: int = BATCH
    design: Callable[[Config], Design] | None = None
    takes: Callable[[int], bool] = lambda seed: True

    def __call__(self, seed: int) -> Item:
        """The simulation of a seed."""
        return seed_item(self.part, self.module, self.test, seed, self.build(seed))

    @property
    def complete(self) -> bool:
        """Whether each seed is played, once."""
        return played(self, self.seeds) == list(self.seeds)

    def _design(self, item: Item) -> Design | None:
        return self.design(item.config) if self.design else None

    def run(self, item: Item, seeds: str, options: SimOptions) -> None:
        """The seeds of a batch in one simulation, as a pytest test."""
        __tracebackhide__ = True
        run_batch(item, seeds, options, self._design(item))

    def some(self, seeds: Sequence[int]) -> Played:
        """Some seeds in this process, for `make soak`."""
        return play([self(seed) for seed in seeds], self._design, self.batch)

    def pins(self, seed: int) -> tuple[str, str]:
        """What stands for all pin changes of a seed, played on the RTL and on the golden model alone."""
        item = self(seed)
        folder = run_sim(self._design(item) or part_design(item.part, item.config), item, seed)
        found = re.search(r"edges compared, pins (\w+)", (folder / "log.txt").read_text(encoding="utf-8"))
        shutil.rmtree(folder)
        test = getattr(importlib.import_module(item.module), item.test)
        return found[1] if found else "", on_model(test.func(OnModel(item.config, seed)))


def generating(**kinds: RandomItems) -> Callable[[pytest.Metafunc], None]:
    """`pytest_generate_tests` of a module: one pytest item a batch for each test function named."""

    def generate(metafunc: pytest.Metafunc) -> None:
        kind = kinds.get(metafunc.function.__name__)
        if kind:
            chosen = metafunc.config.getoption("--seed")
            seeds = kind.seeds if chosen is None else [chosen] if kind.takes(chosen) else []
            parametrize(metafunc, kind, seeds, kind.batch)

    return generate
