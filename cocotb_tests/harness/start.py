"""`start_bench`: the part of a test out of reset, the RTL or the golden model, by what the test was given."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from .bench import Bench
from .model_bench import ModelBench, OnModel
from .part import Part
from .running import present
from .side import Side


async def start_bench(dut: Any, part: Part, settle: int = 4, **pins: int) -> Side:
    """A `Bench` on the simulator's `dut`, a `ModelBench` if this is `OnModel`; both with `now` = `settle`.

    In a directed test it may be called again: what the side has seen so far is compared with the golden
    model, nothing drives its pins any more, and the part starts anew from a reset.
    """
    test = present()
    if test:
        await test.put_away()
    seed = test.seed if test else None
    if isinstance(dut, OnModel):
        side: Side = ModelBench(part, dut if seed is None else replace(dut, seed=seed), settle, **pins)
    else:
        side = await Bench.start(dut, part, settle=settle, seed=seed, **pins)
    if test:
        test.side = side
    return side
