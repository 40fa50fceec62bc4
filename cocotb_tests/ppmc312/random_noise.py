"""Noise on each input pin of the PPMC-312 (short strobes, fast clocks, changing switches), then recovery."""

from __future__ import annotations

import random
from typing import Any

from cocotb_tests.harness.bus import CSR, DWR, MREF, MWEF, WAR, WCR
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import HOST_PINS, INPUTS, WIDTHS, Code

from .blocks import TF
from .host import Host
from .misuse_host import reset_by_bus

SWITCHES = tuple(pin for pin in INPUTS if pin not in (*HOST_PINS, "rst_n", "mode"))
BYTES = (0x03, 0x03, 0x01, 0x02, 0x20, 0x1D, 0x1C, 0x40, 0x4D, 0x82, 0x84, 0x86, 0x80, 0x00, 0x00, 0xFF)


async def play(dut: Any, seed: int) -> None:
    """Apply noise; afterwards a host must recover the device."""
    rng = random.Random(f"p312 noise {seed}")
    host = await Host.start(dut)
    if rng.random() < 0.7:
        for block in TF:
            await host.ask(block)
        await host.put(message(Code.FOREVER_CONSTANT, "00 0064"))
        await host.pause(rng.choice((10, 400)))
    end = host.t + rng.choice((3_000, 10_000, 25_000))
    changes: dict[int, dict[str, int]] = {}
    for source in (_bus, _switches):
        t = host.t
        while t < end:
            for at, levels in source(rng, t):
                changes.setdefault(at, {}).update(levels)
                t = at
            t += rng.choice((1, 1, 1, 2, 2, 3, 3, 4, 7, 20))
    host.bench.drive(sorted(changes.items()))
    await host.go(max(changes) + 4)
    await host.pins(**{pin: level for pin, level in INPUTS.items() if pin != "rst_n"})
    await host.pause(20)
    for _ in range(200):
        if not await host.read(CSR) & MREF:
            await host.response()
        elif not await host.read(CSR) & MWEF:
            break
        await host.pause(400)
    await host.write(CSR, 0)
    await reset_by_bus(host)


Changes = list[tuple[int, dict[str, int]]]


def _bus(rng: random.Random, t: int) -> Changes:
    """Return the changes of one strobe of any length, or of both strobes together.

    Address and data may change during the strobe. At least 3 cycles without a strobe follow.
    """
    register = rng.choice((CSR, WCR, WAR, DWR, DWR, DWR, DWR, 7, 7, 2, 1))
    begin = {"d_i": rng.choice(BYTES), "rs": register, "cs_n": rng.choice((0, 0, 0, 1))}
    strobes = rng.choice(({"we_n": 0}, {"we_n": 0}, {"oe_n": 0}, {"we_n": 0, "oe_n": 0}))
    changes: Changes = [(t, begin | strobes)]
    t += rng.randint(1, 5)
    if rng.random() < 0.1:
        changes.append((t, {"rs": rng.randrange(8), "d_i": rng.choice(BYTES)}))
        t += rng.randint(1, 3)
    return [*changes, (t, {"cs_n": rng.getrandbits(1), "we_n": 1, "oe_n": 1}), (t + 2, {})]


def _switches(rng: random.Random, t: int) -> Changes:
    """Return a change of a pin that is not part of the bus."""
    if rng.random() < 0.4:
        return [(t, {"extck": rng.getrandbits(1), "epin": rng.getrandbits(1)})]
    pin = rng.choice(SWITCHES)
    width = WIDTHS.get(pin, 1)
    return [(t, {pin: rng.getrandbits(width) if width > 1 else int(rng.random() < 0.7)})]
