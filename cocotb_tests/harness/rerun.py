"""Given pin changes on the RTL once more, from a reset, in a simulation that may have seen others before."""

from __future__ import annotations

from collections.abc import Iterable

from .bench import Bench
from .stimulus import Change, Edge


async def rerun(bench: Bench, changes: Iterable[Change], end: int) -> list[Edge]:
    """Reset the part and make the changes; all output edges, times counted as in `changes`, to edge `end`."""
    await bench.align()
    bench.set(rst_n=0)
    await bench.clocks(1)
    bench.set(**bench.part.inputs)
    await bench.clocks(3)
    base = bench.set(rst_n=1)
    bench.forget()
    driven = bench.drive((base + t, {pin: value}) for t, pin, value in changes)
    await bench.until(base + end + 1)
    driven.cancel()  # what is beyond the end belongs to no other run
    return [edge._replace(t=edge.t - base) for edge in bench.recording().edges]
