"""pwm_a_ref and pwm_b_ref, compared with rule P006-EXC-40. They toggle all the time, so the bench does not
record them.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import RtlBench, rtl_only

from .bench import PMC006
from .builds import directed
from .host import Host
from .moves import after_steps, run, set_constant_speed


def stream(refs: list[tuple[int, int]], end: int) -> list[tuple[int, int]]:
    """Return the changes (edge, level) of a stream: the level is the carry of the running sum of the
    reference.

    Args:
        refs: pairs (edge, reference) in order of time (P006-EXC-40).
    """
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


@rtl_only("the golden model's record leaves them out; test_ac_29 counts its ones")
@directed("P006-EXC-40", "P006-AC-29")
async def p006_streams(dut: Any) -> None:
    """For references of many values and both signs, each stream is the carry of its running sum.

    In a reset, both streams are 0.
    """
    host = await Host.start(dut, boot=False)
    assert isinstance(host.bench, RtlBench)
    for name in PMC006.unwatched:
        host.bench.watch(name)
    await host.boot()
    await host.ok(e=4000)
    await set_constant_speed(host, 2000, m=8)
    await run(host)
    await after_steps(host, 40)
    await host.ok(e=400, g=1)
    await host.ok(g=0)
    await host.pause(600)
    for phase in "ab":
        seen = host.edges(f"pwm_{phase}_ref")
        assert len(seen) > 5_000 and seen == stream(host.edges(f"phase_{phase}_ref"), host.bench.now - 1)
    await host.pins(rst_n=0)
    await host.pause(4)
    assert [int(getattr(dut, name).value) for name in PMC006.unwatched] == [0, 0]
