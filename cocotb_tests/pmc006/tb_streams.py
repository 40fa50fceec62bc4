"""pwm_a_ref and pwm_b_ref, which toggle all the time and are on no tape, against the rule itself."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness.bench import Bench
from cocotb_tests.harness.config import configs
from cocotb_tests.harness.scripts import building
from cocotb_tests.harness.stimulus import Edge
from cocotb_tests.harness.tape import record
from cocotb_tests.harness.verifies import verifies

from .bench import PMC006
from .modules import F8B
from .scenes import after_steps, brisk, run
from .script_host import Host


def turning() -> Host:
    """References of many sizes and signs, off and on again."""
    host = Host()
    host.ok(e=4000)
    brisk(host, 2000, m=8)
    run(host)
    after_steps(host, 40)
    host.ok(e=400, g=1)
    host.ok(g=0)
    host.pause(600)
    return host


def stream(refs: list[tuple[int, int]], end: int) -> list[tuple[int, int]]:
    """Changes of the carry of the running sum; refs: (edge, reference) in order (P006-EXC-40)."""
    changes, total, ref, level = [], 0, 0, 0
    coming = iter([*refs, (end + 1, 0)])
    t, following = next(coming)
    for edge in range(refs[0][0] if refs else end, end + 1):
        total += ref
        if total >> 8 != level:
            level = total >> 8
            changes.append((edge, level))
        total &= 255
        while t <= edge:
            ref = following
            t, following = next(coming)
    return changes


@cocotb.test()
@verifies("P006-EXC-40", "P006-AC-29")
@configs(F8B)
async def p006_streams(dut: Any) -> None:
    """Given references of all kinds, when time passes, then the bit streams are the carries of their sums."""
    bench = await Bench.start(dut, PMC006)
    for name in PMC006.unwatched:
        bench.watch(name)
    with building(bench.config):
        tape = turning().tape
    recording = await record(bench, tape)

    def of(name: str) -> list[tuple[int, int]]:
        found: list[Edge] = [edge for edge in recording.edges if edge.signal == name and edge.t >= 0]
        return [(edge.t, edge.value) for edge in found]

    for phase in ("a", "b"):
        seen = of(f"pwm_{phase}_ref")
        assert len(seen) > 5_000 and seen == stream(of(f"phase_{phase}_ref"), recording.end)
