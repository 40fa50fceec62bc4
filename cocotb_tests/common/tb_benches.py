"""Several test benches in one simulation, as in groups of tests and batches of random hosts."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import PARTS, HostBus, RtlBench
from cocotb_tests.harness.sim_backend import sim_backend


@cocotb.test()
async def benches_leave_one_watch_a_port(dut: Any) -> None:
    """After three benches were started in one simulation, each output edge is still recorded exactly
    once.
    """
    for _ in range(3):
        bench = await RtlBench.start(dut, PARTS["ppmc104"])
    await HostBus(bench).status()
    rows = list(sim_backend().changes())
    assert [level for _, port, level in rows if port == sim_backend().port("d_oe")] == [1, 0]
    assert len(rows) == len(set(rows)), rows


@cocotb.test()
async def a_bench_records_what_it_watches_itself(dut: Any) -> None:
    """If one bench watches an additional port, the next bench does not watch this port."""
    await RtlBench.start(dut, PARTS["ppmc104"])
    more = sim_backend().port("d_i")
    sim_backend().watch(more)
    bench = await RtlBench.start(dut, PARTS["ppmc104"])
    bench.set(d_i=1)
    await bench.clocks(2)
    assert more not in {port for _, port, _ in sim_backend().changes()}
