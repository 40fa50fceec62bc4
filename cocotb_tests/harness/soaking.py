"""Many seeds of random hosts, for `make soak`: those of one build in one simulation, failing ones alone."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from . import tally
from .batches import BATCH, batches
from .build import Design
from .collect import Item
from .runner import REPRO
from .seeds import SEEDS
from .shortened import attempt_random

Failure = tuple[int, str, str]
"""Seed, test id, message."""


@dataclass
class Played:
    """What came of some seeds; `compared` counts what was compared with the golden model, by its name."""

    failures: list[Failure] = field(default_factory=list)
    compared: Counter[str] = field(default_factory=Counter)

    def add(self, other: Played) -> None:
        """Those of `other` as well."""
        self.failures += other.failures
        self.compared.update(other.compared)


def play(items: Sequence[Item], design: Callable[[Item], Design | None], size: int = BATCH) -> Played:
    """One item a seed. Of a simulation in which a seed fails each seed is played again alone."""
    played = Played()
    alone = {item.seed: item for item in items}
    for first, seeds in batches(items, size):
        numbers = [int(word) for word in seeds.split()]
        whole = {REPRO: f"make test T={first.id}"} if len(numbers) > 1 else {}
        message = _attempt(played, first, {SEEDS: seeds, **whole}, design(first))
        if not message:
            continue
        if len(numbers) == 1:
            played.failures.append((numbers[0], first.id, message))
            continue
        found = [
            (seed, alone[seed].id, said)
            for seed in numbers
            if (said := _attempt(played, alone[seed], {}, design(first)))
        ]
        played.failures += found or [(numbers[0], first.id, message)]
    return played


def _attempt(played: Played, item: Item, env: dict[str, str], design: Design | None) -> str:
    with TemporaryDirectory(prefix="openppmc-") as folder:
        file = Path(folder) / f"tally-{os.getpid()}"
        message = attempt_random(item, env={**env, tally.TALLY: str(file)}, design=design)
        if not message:
            played.compared.update(tally.told(file))
    return message


def all_of(parts: Iterable[Played]) -> Played:
    """The sum."""
    played = Played()
    for part in parts:
        played.add(part)
    return played
