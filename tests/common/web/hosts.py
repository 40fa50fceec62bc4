"""Random hosts on the golden model: the pin changes that each host makes, and the expected edges."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from itertools import count, islice

from cocotb_tests.bank.random_host import in_motion
from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.harness.random_items import RandomItems
from cocotb_tests.harness.run_context import last_test
from openppmc.check.records import Recording
from scripts.site.webparts import WebPart

IN_MOTION = 3
"""Number of bank hosts that keep all axes in motion; each one makes 50 000 intervals."""


def _items(part: WebPart) -> RandomItems:
    items: RandomItems = importlib.import_module(f"cocotb_tests.{part.name}.test_random").random_item
    return items


def seeds(part: WebPart) -> Iterator[int]:
    """Yield the seeds of `make test` that use the build of the playground, then those of `make soak`."""
    items = _items(part)
    fitting = (seed for seed in count(1) if items.takes(seed) and items.build(seed) == part.config)
    if part.name != "bank":
        return fitting
    quick = (seed for seed in count(1) if items.build(seed) == part.config and in_motion(seed))
    still = (seed for seed in fitting if not in_motion(seed))
    return (seed for some in (islice(quick, IN_MOTION), still) for seed in some)


def recorded(part: WebPart, seed: int) -> Recording:
    """Run the host of a seed on the golden model; return the recording."""
    item = _items(part)(seed)
    test = getattr(importlib.import_module(item.module), item.test)
    on_model(test.func(OnModel(item.config, seed)))
    last = last_test()
    assert last is not None and last.bench is not None
    return last.bench.recording()
