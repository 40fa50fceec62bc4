"""Delays from input pins of the PMC006B4 to their effects."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.checks import check_delays

from .builds import F8B, ODD, directed
from .host import Host
from .moves import after_steps, constant_speed_host, start


@directed("P006-EXT-01", "P006-EXT-02")
async def p006_ext_01_delays(dut: Any) -> None:
    """Each edge of EXT1 and EXT2 stops the motor after the same number of cycles; with JITTER=1, also one
    cycle later.
    """
    host = await constant_speed_host(dut)
    await host.ok(f=3)
    delays = []
    for pin, clear in (("ext1", "b"), ("ext2", "l")) * 6:
        await start(host, 500)
        await after_steps(host, 2)
        await host.pins(**{pin: 0})
        edge = host.t - 1
        await host.pause(9)
        delays.append(host.edges("mon_busy", edge)[0][0] - edge)
        await host.pins(**{pin: 1})
        await host.ok(**{clear: 0})
    check_delays(host.bench, "P006-EXT-02", "from EXT1 and EXT2 to mon_busy", delays, 2, 4)


@directed("P006-CHP-05", builds=(F8B, ODD))
async def p006_chp_05_delays(dut: Any) -> None:
    """Each rising edge of a comparator after the blanking time switches its bridge off after the same number
    of cycles; with JITTER=1, also one cycle later.
    """
    host = await Host.start(dut)
    await host.ok(a=0, e=4000)
    delays = []
    for cmp, output in (("cmp_a", "m10"), ("cmp_b", "m20")) * 8:
        await host.pause(1_000 + host.bench.rng.randrange(50))
        await host.pins(**{cmp: 1})
        edge = host.t - 1
        await host.pause(9)
        delays.append(host.edges(output, edge)[0][0] - edge)
        await host.pins(**{cmp: 0})
    check_delays(host.bench, "P006-CHP-05", "from a comparator to its bridge", delays, 2, 3)
