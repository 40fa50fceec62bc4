"""Several benches in one simulation, as groups of tests and batches of random hosts make them."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import PARTS, Bench, HostBus
from cocotb_tests.harness.clock import clockwork


@cocotb.test()
async def benches_leave_one_watch_a_port(dut: Any) -> None:
    """Given three benches one after the other, when an output changes, then it is recorded once."""
    for _ in range(3):
        bench = await Bench.start(dut, PARTS["ppmc104"])
    await HostBus(bench).status()
    rows = list(clockwork().seen())
    assert [level for _, port, level in rows if port == clockwork().port("d_oe")] == [1, 0]
    assert len(rows) == len(set(rows)), rows


@cocotb.test()
async def a_bench_records_what_it_watches_itself(dut: Any) -> None:
    """Given a bench that watches one more port, when the next one starts, then that is forgotten."""
    await Bench.start(dut, PARTS["ppmc104"])
    more = clockwork().port("d_i")
    clockwork().watch(more)
    bench = await Bench.start(dut, PARTS["ppmc104"])
    bench.set(d_i=1)
    await bench.clocks(2)
    assert more not in {port for _, port, _ in clockwork().seen()}
