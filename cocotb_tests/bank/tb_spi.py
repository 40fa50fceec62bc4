"""ppmc_bank_carrier with HOST = "SPI": access to the complete window through SPI (docs/bank/spi.md)."""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import product
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.handle import Immediate
from cocotb.triggers import Timer

from ..harness import Config, configs, same
from ..harness.jitter import jitters

CONFIG = Config("spi8m", clk_hz=8_000_000, extra=(("AXES", 4), ("HOST", "SPI")))
AXES = 4
WRITE, NEXT_AXIS, NEXT = 0x8000, 0x4000, 0x2000
DATA, COMMAND, POSITION, MASK, MAP, INFO = 0, 1, 4, 8, 9, 12
SIGN, INT = 0x80, 1
INITIALISE = (0x0A, 9, 4, 4, 0)  # RL 9, RH 4, PA 4, four-phase
OBF, IBF, BUSY = 1, 2, 4


class Host:
    """SPI master in mode 0; a period of sck is 8 cycles, asynchronous to clk."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        self.period = Config.from_json(os.environ["OPENPPMC_CONFIG"]).period_ps
        self.status = 0

    async def start(self) -> None:
        """Start the clock, reset with idle pins, and wait until the bank is ready."""
        dut = self.dut
        dut.clk.set(Immediate(0))
        dut.rst_n.set(Immediate(1))
        for pin in ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n"):
            getattr(dut, pin).value = (1 << AXES) - 1
        for pin, level in (("uart_rxd", 1), ("spi_cs_n", 1), ("sck", 0), ("mosi", 0)):
            getattr(dut, pin).value = level
        await self.clk(1)
        dut.rst_n.value = 0
        Clock(dut.clk, self.period, "ps").start()
        await self.clk(4)
        dut.rst_n.value = 1
        await self.clk(60)

    async def clk(self, n: float) -> None:
        """Wait n cycles."""
        await Timer(round(n * self.period), "ps")

    async def frame(self, word: int, *data: int) -> bytes:
        """Send a header and bytes, store the status of the bridge, and return the bytes received after the
        header.
        """
        dut, seen = self.dut, bytearray()
        await self.clk(4.3)
        dut.spi_cs_n.value = 0
        await self.clk(1)
        for byte in (word >> 8, word & 0xFF, *data):
            got = 0
            for n in range(7, -1, -1):
                dut.sck.value = 0
                dut.mosi.value = byte >> n & 1
                await self.clk(4)
                got = got << 1 | int(dut.miso_o.value)
                dut.sck.value = 1
                await self.clk(4)
            seen.append(got)
        dut.sck.value = 0
        await self.clk(4)
        same("miso is driven", int(dut.miso_oe.value), 1)
        dut.spi_cs_n.value = 1
        self.status = seen[0]
        return bytes(seen[2:])

    async def raw(self, mode: int, skew: float, *data: int) -> bytes:
        """Send a frame in SPI mode 0 to 3 and return all bytes received on miso.

        Args:
            skew: cycles from an edge of sck to the change of mosi that belongs to it, -2 to 2.
        """
        dut, seen = self.dut, bytearray()
        idle, late = mode >> 1, mode & 1
        dut.sck.value = idle
        await self.clk(8.3)
        dut.spi_cs_n.value = 0
        dut.mosi.value = int(late) if mode else data[0] >> 7
        await self.clk(6)
        bits = [byte >> n & 1 for byte in data for n in range(7, -1, -1)]
        got: list[int] = []
        for number, bit in enumerate(bits):
            if late:
                await self._together(1 - idle, bit, skew)
            else:
                if not number:
                    dut.mosi.value = bit
                await self.clk(4)
                got.append(int(dut.miso_o.value))
                dut.sck.value = 1 - idle
            await self.clk(4)
            if late:
                got.append(int(dut.miso_o.value))
                dut.sck.value = idle
                await self.clk(4)
            else:
                await self._together(idle, bits[min(number + 1, len(bits) - 1)], skew)
        await self.clk(8)
        dut.spi_cs_n.value = 1
        seen += bytes(sum(b << 7 - n for n, b in enumerate(got[k : k + 8])) for k in range(0, len(got), 8))
        return bytes(seen)

    async def _together(self, sck: int, mosi: int, skew: float) -> None:
        """Output an edge of sck, and a change of mosi `skew` cycles after it (negative: before it)."""
        steps = [("sck", sck), ("mosi", mosi)]
        for name, level in steps if skew >= 0 else steps[::-1]:
            getattr(self.dut, name).value = level
            if name == steps[0 if skew >= 0 else 1][0] and skew:
                await self.clk(abs(skew))

    async def write(self, axis: int, register: int, *data: int, step: int = 0) -> None:
        """Write bytes in one burst."""
        await self.frame(WRITE | step | axis << 4 | register, *data)

    async def read(self, axis: int, register: int, count: int = 1, step: int = 0) -> bytes:
        """Read bytes in one burst."""
        return (await self.frame(step | axis << 4 | register, *[0xFF] * count, 0))[1:]

    async def until(self, axis: int, good: Callable[[int], bool]) -> int:
        """Poll the status of an axis and return the first one for which `good` is true."""
        for _ in range(400):
            status = (await self.read(axis, COMMAND))[0]
            if good(status):
                return status
        raise AssertionError(f"axis {axis}: status {status:#04x}")

    async def call(self, axis: int, code: int, *data: int) -> int:
        """Send a command with its parameters and return the status."""
        await self.write(axis, COMMAND, code)
        for byte in data:
            await self.until(axis, lambda status: not status & IBF)
            await self.write(axis, DATA, byte)
        return await self.until(axis, lambda status: not status & IBF)


@cocotb.test()
@configs(CONFIG)
async def spi_window(dut):
    """Bursts by axis and bursts by register find INFO, CONFIG and MASK at the addresses that the rules
    state.
    """
    host = Host(dut)
    await host.start()
    same("INFO", await host.read(0, INFO, 4, NEXT_AXIS), bytes([0x42, 1, AXES, 0]))
    same("status", host.status, SIGN)
    await host.write(0, 2, 0, 1, 2, 3, step=NEXT_AXIS)
    same("CONFIG", await host.read(0, 2, AXES + 1, NEXT_AXIS), bytes([0, 1, 2, 3, 0xFF]))
    await host.write(0, MASK, 0x0A)
    same("MASK", await host.read(0, MASK), b"\x0a")
    same("an axis that is not there", await host.read(AXES, 0, 8, NEXT), b"\xff" * 8)


@cocotb.test()
@configs(CONFIG)
async def spi_moves(dut):
    """During and after a motion, the host reads the correct status, interrupt, map, finish status and
    position.
    """
    host = Host(dut)
    await host.start()
    same("initialised", await host.call(3, *INITIALISE), 0)
    same("started", await host.call(3, 0x4B, 13, 0, 0), BUSY)
    await host.until(3, lambda status: not status & BUSY)
    same("map", await host.read(0, MAP), b"\x08")
    same("status of the bridge", host.status, SIGN | INT)
    same("finish status is there", await host.call(3, 0x80) & OBF, OBF)
    same("finish status", await host.read(3, DATA), b"\x83")
    same("position", int.from_bytes(await host.read(3, POSITION, 4, NEXT), "little", signed=True), -14)
    same("position of another one", await host.read(2, POSITION, 4, NEXT), bytes(4))
    same("status of the bridge", host.status, SIGN)


@cocotb.test()
@configs(CONFIG)
async def spi_read_back_finds_a_wrong_mode(dut):
    """MASK reads back as written in modes 0 and 3, and in mode 1 unless mosi changes after the edge of sck;
    in mode 2 it never does. The status reveals a wrong mode only in mode 2. A frame in a wrong mode moves no
    motor (docs/bank/spi.md).
    """
    host = Host(dut)
    await host.start()
    # With JITTER=1, the sampled skew differs by up to one cycle from that of the pins.
    skews = (-2, -1, 2) if jitters() else (-2, -1, -0.4, 0, 0.4, 1, 2)
    for mode, skew in product(range(4), skews):
        got = []
        for value in (0x05, 0x00):
            await host.raw(mode, skew, 0x80, 0x08, value)
            got.append((await host.raw(mode, skew, 0x00, 0x08, 0xFF, 0x00)).hex())
        what = f"mode {mode}, mosi {skew:+} cycles from sck"
        right = got == ["80000005", "80000000"]
        # In mode 1, if mosi changes together with the edge of sck or before it, the bridge samples the bits
        # that the master sends.
        same(f"MASK is read back as written, {what}", right, mode in (0, 3) or (mode == 1 and skew <= 0))
        same(f"pulses, {what}", int(dut.pout_n.value), (1 << AXES) - 1)
        same(f"sign of the status, {what}", [word[0] for word in got], ["c" if mode == 2 else "8"] * 2)
