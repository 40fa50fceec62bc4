"""`start_bench`: the part of a test out of reset, the RTL or the golden model, by what the test was given."""

from __future__ import annotations

from typing import Any

from .bench import Bench
from .model_bench import ModelBench, OnModel
from .part import Part
from .side import Side


async def start_bench(dut: Any, part: Part, settle: int = 4, **pins: int) -> Side:
    """A `Bench` on the simulator's `dut`, a `ModelBench` if this is `OnModel`; both with `now` = `settle`."""
    if isinstance(dut, OnModel):
        return ModelBench(part, dut, settle, **pins)
    return await Bench.start(dut, part, settle=settle, **pins)
