"""Measurements of `make bench` at the pins, in cycles: table builds, and commands with their answers."""

from __future__ import annotations

import json
from typing import Any

import cocotb

from cocotb_tests.harness import HostBus, RtlBench

from .bench import PPMC104

INIT = 0x2A
RAMPS = {
    "initialise, ramp of the demo: RL 199, RH 19, PA 250": (199, 19, 250),
    "initialise, the longest table: RL 255, RH 0, PA 11 220": (255, 0, 11220),
}
ANSWERS = {
    "a command with its answer of 1 byte (82)": (0x82, 1),
    "a command with its answer of 3 bytes (83)": (0x83, 3),
}
AUX_ON, AUX_OFF = 0xC1, 0xC2


async def build(host: HostBus, ramp: tuple[int, int, int]) -> int:
    """Build a ramp table; return the cycles from the end of the last data strobe to the execution of a
    command that waits in the buffer.
    """
    bench, (slow, fast, pulses) = host.bench, ramp
    await host.send(INIT, [slow, fast, pulses & 0xFF])
    begin = await host.data(pulses >> 8, poll=False)
    await host.poll(2, 0)
    await host.write(1, AUX_ON)
    end = await bench.edge("aux_n", 0, timeout=100_000)
    await host.command(AUX_OFF)
    return end - begin


@cocotb.test()
async def count_costs(dut: Any) -> None:
    """The cycles of initialisations, and of commands with answers, are measured and written to costs.json."""
    host = HostBus(await RtlBench.start(dut, PPMC104))
    found = {name: await build(host, ramp) for name, ramp in RAMPS.items()}
    for name, (code, count) in ANSWERS.items():
        begin = host.bench.now
        await host.fetch(code, count)
        found[name] = host.bench.now - begin
    (host.bench.out / "costs.json").write_text(json.dumps(found))
