"""The two EEPROM models of the benches (SystemVerilog and Python): with equal levels on the lines, both pull
the same lines low.
"""

from __future__ import annotations

import os
import random
from collections.abc import Iterator
from typing import Any

import cocotb
from cocotb.triggers import Timer

from openppmc.model.carrier.eeprom import Eeprom24C32

WRITE_CLK, CLK_HZ = 900, 1_000_000
Levels = tuple[int, int]


class Master:
    """Source of (cycles, SCL, SDA) of a master: complete transfers, and incomplete ones."""

    def __init__(self, rng: random.Random, device: int) -> None:
        self.rng, self.device = rng, device
        self.sda = 1

    def hold(self, scl: int, sda: int) -> tuple[int, int, int]:
        """Return (random time, SCL, SDA) for the next levels."""
        self.sda = sda
        return self.rng.choice((2, 3, 5, 9)), scl, sda

    def start(self) -> Iterator[tuple[int, int, int]]:
        """Yield a START, which may be a repeated one."""
        yield self.hold(0, 1)
        yield self.hold(1, 1)
        yield self.hold(1, 0)
        yield self.hold(0, 0)

    def stop(self) -> Iterator[tuple[int, int, int]]:
        """Yield a STOP."""
        yield self.hold(0, 0)
        yield self.hold(1, 0)
        yield self.hold(1, 1)

    def bits(self, byte: int, acknowledge: int, count: int = 9) -> Iterator[tuple[int, int, int]]:
        """Yield a byte and its acknowledge bit, or only its first bits."""
        for level in [*(byte >> place & 1 for place in reversed(range(8))), acknowledge][:count]:
            yield self.hold(0, level)
            yield self.hold(1, level)
        yield self.hold(0, self.sda)

    def transfer(self) -> Iterator[tuple[int, int, int]]:
        """Yield a write, a read, or a part of one."""
        rng = self.rng
        kind = rng.choice(("write", "write", "read", "read", "here", "poll", "cut"))
        address = rng.choice((0, 31, 32, 0x33F, 0xFFE, rng.randrange(0x10000)))
        device = rng.choice((self.device,) * 12 + (self.device ^ 1,)) << 1
        yield from self.start()
        if kind == "here":
            yield from self.bits(device | 1, 1)
        else:
            yield from self.bits(device, 1)
            if kind != "poll":
                yield from self.bits(address >> 8, 1)
                yield from self.bits(address & 0xFF, 1, rng.choice((9,) * 9 + (4,)))
        if kind in ("write", "cut"):
            for _ in range(rng.choice((0, 1, 2, 5, 32, 35))):
                yield from self.bits(rng.randrange(256), 1)
            if kind == "cut":
                yield from self.bits(rng.randrange(256), 1, rng.randrange(1, 9))
        if kind == "read":
            yield from self.start()
            yield from self.bits(device | 1, 1)
        if kind in ("read", "here"):
            for _ in range(rng.randrange(5)):
                yield from self.bits(0xFF, 0)
            yield from self.bits(0xFF, 1)
        if rng.random() < 0.9:
            yield from self.stop()
        yield rng.choice((2, 10, 400, 1200)), 1, 1


@cocotb.test()
async def p006_eeprom_device(dut: Any) -> None:
    """With random traffic, both devices pull the same lines in the same cycles."""
    rng = random.Random(int(os.environ.get("OPENPPMC_SEED", "1")))
    stretch = int(dut.StretchCycles.value)
    model = Eeprom24C32(CLK_HZ, device=int(dut.Device.value), write_us=WRITE_CLK, stretch_us=stretch)
    dut.clk_i.value, dut.on_i.value = 0, 1
    t, before, pulls = 0, (1, 1), (0, 0)
    seen = {"sda": 0, "scl": 0}
    master = Master(rng, model.device)
    for _ in range(100):
        for clk, scl, sda in master.transfer():
            left = clk
            while left:
                lines = int(scl and not pulls[0]), int(sda and not pulls[1])
                # A master waits while SCL is held low.
                left -= not (scl and pulls[0])
                dut.scl_i.value, dut.sda_i.value = lines
                await Timer(1, "step")
                dut.clk_i.value = 1
                await Timer(1, "step")
                dut.clk_i.value = 0
                if lines != before or t == model.due:
                    model.on_lines(t, *lines)
                before = lines
                pulls = int(dut.scl_oe_o.value), int(dut.sda_oe_o.value)
                assert pulls == (model.scl, model.sda), f"cycle {t}: {pulls}, model {(model.scl, model.sda)}"
                seen["scl"] += pulls[0]
                seen["sda"] += pulls[1]
                t += 1
    assert len(model.writes) > 6 and seen["sda"] > 1_000 and seen["scl"] > 1_000
    assert bytes(int(dut.memory[place].value) for place in range(4096)) == model.memory
