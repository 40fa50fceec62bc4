"""Several seeds in one simulation, each from a reset: a process takes as long to start as many a host."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import cache

import pytest

from .build import Design
from .collect import Item, cocotb_items
from .config import Config
from .part import PARTS
from .runner import REPRO, SimOptions
from .seeds import SEEDS
from .shortened import attempt_random

BATCH = 25


@cache
def _items(part: str, module: str) -> dict[str, Item]:
    params = cocotb_items(f"cocotb_tests.{part}", module, part=PARTS[part])
    return {param.values[0].test: param.values[0] for param in params}


def seed_item(part: str, module: str, test: str, seed: int, config: Config) -> Item:
    """A test of a part's random hosts in the build of a seed."""
    return replace(_items(part, module)[test], config=config, seed=seed, tag=f"r{seed:04d}")


def batches(items: Sequence[Item], size: int = BATCH) -> list[tuple[Item, str]]:
    """(first item, all seeds) of each simulation: at most `size` items of one build each."""
    builds: dict[str, list[Item]] = {}
    for item in items:
        builds.setdefault(item.config.name, []).append(item)
    return [
        (group[k], " ".join(str(item.seed) for item in group[k : k + size]))
        for group in builds.values()
        for k in range(0, len(group), size)
    ]


def parametrize(
    metafunc: pytest.Metafunc, make: Callable[[int], Item], seeds: Iterable[int], size: int = BATCH
) -> None:
    """One pytest item (`item`, `seeds`) a batch of the seeds."""
    sets = batches([make(seed) for seed in seeds], size)
    metafunc.parametrize(("item", "seeds"), sets, ids=[item.id for item, _ in sets])


def run_batch(item: Item, seeds: str, options: SimOptions, design: Design | None = None) -> None:
    """The seeds of a batch in one simulation, as a pytest test."""
    __tracebackhide__ = True
    print(f"seeds {seeds}")
    whole = {REPRO: f"make {item.target} T={item.id}"} if " " in seeds else {}
    if message := attempt_random(item, options, {SEEDS: seeds, **whole}, design):
        pytest.fail(message, pytrace=False)


def played(make: Callable[[int], Item], fixed: Iterable[int]) -> list[int]:
    """All seeds of the batches, rising."""
    return sorted(int(word) for _, seeds in batches([make(seed) for seed in fixed]) for word in seeds.split())
