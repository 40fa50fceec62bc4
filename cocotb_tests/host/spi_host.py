"""An SPI host for ppmc_spi, and a reference model of the behaviour that docs/bank/spi.md describes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from ..harness import BlockDriver, rng
from .buses.strobe_slave import Registers, StrobeSlave

WRITE, NEXT_AXIS, NEXT = 0x8000, 0x4000, 0x2000
FAST, CUT, REFUSED, INT = 8, 4, 2, 1
SIGN = 0x80
COUNT = 1024


@dataclass(frozen=True)
class Pace:
    """Times in cycles: low and high time of sck, time from the fall of cs_n to the first rise of sck, high
    time of cs_n. `idle` is the level of sck between frames.
    """

    low: float = 4.0
    high: float = 4.0
    lead: float = 6.0
    gap: float = 6.0
    idle: int = 0


def bits_of(*values: int) -> list[int]:
    """Return bytes as a list of bits, the most significant bit first."""
    return [byte >> n & 1 for byte in values for n in range(7, -1, -1)]


def byte_of(bits: list[int]) -> int:
    """Return eight bits, the most significant bit first, as a byte."""
    return int("".join(map(str, bits)), 2)


def header(word: int) -> list[int]:
    """Return a header as two bytes."""
    return [word >> 8, word & 0xFF]


class SpiHost:
    """Drives the pins at any times, also fractions of a cycle; rising edge n of `clk` is at time n."""

    def __init__(self, unit: BlockDriver, dut: Any, name: str) -> None:
        self.unit, self.now, self.edge = unit, 0.0, 0
        pins = {
            "cs_n": "cs_no",
            "rd_n": "rd_no",
            "wr_n": "wr_no",
            "a": "a_o",
            "d": "d_o",
            "q": "d_i",
            "clk": "clk_i",
        }
        self._pins = SimpleNamespace(
            **{
                port if port == "clk" else f"bus_{port}": getattr(dut, f"{name}_{pin}")
                for port, pin in pins.items()
            }
        )
        self.slave: StrobeSlave

    async def reset(self) -> None:
        """Set idle pins, reset, and connect a slave to the bus."""
        await self.unit.reset(cs_ni=1, int_ni=1)
        self.slave = StrobeSlave(self._pins, "bus", COUNT, rng())
        await self.wait(8)

    async def until(self, time: float) -> None:
        """Generate all rising edges of `clk` that occur before this time."""
        self.now = time
        while self.edge < time:
            await self.unit.clk()
            self.edge += 1

    async def wait(self, clk: float) -> None:
        """Leave the pins unchanged for this number of cycles."""
        await self.until(self.now + clk)

    async def frame(self, bits: list[int], pace: Pace = Pace(), short: int = -1) -> list[int]:
        """Send one frame; return the level of miso before each rising edge of sck.

        The low time of sck before bit number `short` is only 2 cycles.
        """
        put, seen = self.unit.put, []
        put(sck_i=pace.idle)
        await self.wait(pace.gap)
        put(cs_ni=0)
        await self.wait(pace.lead - pace.low)
        for n, bit in enumerate(bits):
            put(sck_i=0, mosi_i=bit)
            await self.wait(2 if n == short else pace.low)
            assert self.unit.get("miso_oe_o"), "miso is not driven"
            seen.append(self.unit.get("miso_o"))
            put(sck_i=1)
            await self.wait(pace.high)
        put(sck_i=pace.idle)
        if not pace.idle:
            await self.wait(pace.low)
        put(cs_ni=1)
        return seen

    async def talk(self, *values: int, pace: Pace = Pace()) -> list[int]:
        """Send a frame of complete bytes; return the bytes of miso."""
        seen = await self.frame(bits_of(*values), pace)
        return [byte_of(seen[n : n + 8]) for n in range(0, len(seen), 8)]


class PageReference:
    """Reference model from docs/bank/spi.md: accesses, miso, flags.

    `registers` are the registers that ppmc_spi accesses.
    """

    def __init__(self) -> None:
        self.registers = Registers(COUNT)
        self.accesses: list[tuple[str, int, int]] = []
        self.flags = 0
        self.level = 0  # level of INT

    def frame(self, bits: list[int]) -> list[int]:
        """Process one frame with legal times; return the bits of miso."""
        shown = self.flags
        if len(bits) >= 8:
            self.flags = 0
        answer = iter(self._bytes(bits))
        out = bits_of(SIGN | shown | self.level, *answer)
        if len(bits) % 8 or len(bits) == 8:
            self.flags |= CUT
        return out[: len(bits)]

    def _bytes(self, bits: list[int]) -> Iterator[int]:
        """Yield the bytes of miso after the status."""
        yield 0
        if len(bits) < 16:
            return
        word = byte_of(bits[:8]) << 8 | byte_of(bits[8:16])
        if word & 0x1C00:
            self.flags |= REFUSED
            yield from [0] * math.ceil((len(bits) - 16) / 8)
            return
        address, step = word & 0x3FF, 16 * bool(word & NEXT_AXIS) + bool(word & NEXT)
        yield 0
        for n in range(16, len(bits), 8):
            data, answer = bits[n : n + 8], 0
            if word & WRITE and len(data) == 8:
                self._access("w", address, byte_of(data))
            elif not word & WRITE and data[0]:
                answer = self._access("r", address, 0)
            else:
                address -= step
            address = (address + step) % COUNT
            yield answer

    def _access(self, kind: str, address: int, value: int) -> int:
        if kind == "w":
            self.registers.write(address, value)
        else:
            value = self.registers.read(address)
        self.accesses.append((kind, address, value))
        return value
