"""Sixteen stations on one line: the RTL compared with its models, and the models alone with more seeds."""

from __future__ import annotations

import random

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items, run_item
from cocotb_tests.harness.collect import Item

from .master import Master, at_once
from .models import ModelLine
from .scenarios import BAD, ONE_MUTE, TWINS, twins
from .setting import LINE, design
from .stream import model_line, play
from .tb_stream import SIZE

EXACT = "the stations are a library that is built without the simulation model of the synchroniser"
ITEMS = cocotb_items("cocotb_tests.ppmc312.line", "tb_line", "tb_stream", part=LINE, exact=EXACT)


def stream_item(seed: int) -> Item:
    """Return the item that runs the stream of one seed on the RTL."""
    return next(p.values[0] for p in ITEMS if p.values[0].test == "line_stream").with_seed(seed)


@pytest.mark.parametrize("item", ITEMS)
def test_line(item: Item, sim_options: SimOptions) -> None:
    """One simulation of the line passes."""
    run_item(item, sim_options, design=design(item.config))


@pytest.fixture
def seeds(request: pytest.FixtureRequest) -> list[int]:
    """Return two fixed seeds, or the seed of the command line; pytest prints them when a test fails."""
    chosen = request.config.getoption("--seed")
    picked = [2, 3] if chosen is None else [chosen]
    print(f"seeds {picked}")
    return picked


def test_scenes_on_models(seeds: list[int]) -> None:
    """On golden models alone, the disturbances and the scenario with equal addresses pass with other
    seeds.
    """
    for seed in seeds:
        for scenes, line in ((BAD, ModelLine()), ((twins,), ModelLine(adr=TWINS, mod=ONE_MUTE))):
            at_once(line.until(8))
            for scene in scenes:
                at_once(scene(Master(line), random.Random(f"{scene.__name__} {seed}")))


def test_streams_on_models(seeds: list[int]) -> None:
    """On golden models alone, every station is recoverable after streams with other seeds.

    On an undisturbed line, few stations need a second poll.
    """
    late = sum(at_once(play(Master(model_line(seed, 8)), seed, SIZE, 8)) for seed in seeds)
    assert late <= 8 * len(seeds)
