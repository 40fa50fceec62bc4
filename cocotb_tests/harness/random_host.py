"""`RandomHost`: what the random hosts of all parts have in common; each says only what its hosts do.

A seed decides all: every random decision comes from `rng`, in one order.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol, TypeVar

from .config import Config
from .moving_pins import MovingPins
from .side import Side

T = TypeVar("T")
Weights = Sequence[tuple[Config, int]]


def weighted(rng: random.Random, table: Iterable[tuple[T, float]]) -> T:
    """One of a table of (thing, weight)."""
    things, weights = zip(*table, strict=True)
    return rng.choices(things, weights)[0]


class Builds:
    """Which build the host of a seed plays on, where it does not matter for what it does.

    name: of the part in the text of its seeds, as "p312". weights: (build, weight).
    """

    def __init__(self, name: str, weights: Weights) -> None:
        self.name, self.weights = name, tuple(weights)

    def __call__(self, seed: int) -> Config:
        """Build of a seed (any int)."""
        return weighted(random.Random(f"{self.name} build {seed}"), self.weights)

    @property
    def names(self) -> set[str]:
        """All of them."""
        return {config.name for config, _ in self.weights}


def in_turn(*builds: Config) -> Callable[[int], Config]:
    """One build after the other, seed by seed."""
    return lambda seed: builds[seed % len(builds)]


class OnSide(Protocol):
    """The host of a part that a random one speaks through."""

    @property
    def side(self) -> Side:
        """What it works on."""


class RandomHost:
    """`rng` is that of a seed; `name` begins the seed's text.

    One that acts on what it is answered has a `host`, and a `background` of pins that move by themselves.
    """

    host: OnSide
    background: MovingPins

    def __init__(self, name: str, seed: int) -> None:
        self.seed = seed
        self.rng = random.Random(f"{name} {seed}")

    @property
    def model(self) -> Any:
        """The golden model beside the part: it tells when to do something, not what was answered."""
        return self.host.side.golden

    def pick(self, acts: Iterable[tuple[Callable[[], Any], float]]) -> Callable[[], Any]:
        """One of a table of (what to do, weight)."""
        return weighted(self.rng, acts)
