"""`Bench`: clock and reset of ppmc_uart_bridge, its line bit by bit, and a Python slave on its bus."""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from typing import Any

import cocotb
from cocotb.handle import Immediate
from cocotb.triggers import Event, FallingEdge, RisingEdge, Timer, ValueChange, with_timeout
from cocotb.utils import get_sim_time

from cocotb_tests.harness import Config, watchdog
from cocotb_tests.harness.sim_backend import sim_backend
from openppmc.host.frames import Broken, Deframer, encode

from .settings import baud_of
from .slave import RegisterModel

SECOND = 10**12  # one second in ps


def now() -> int:
    """Return the simulation time in ps."""
    return int(get_sim_time("ps"))


def same(what: str, got: object, want: object) -> None:
    """Assert that both values are equal; the message contains both."""
    assert got == want, f"{what}: got {got}, want {want}"


class Bench:
    """One bridge and its surroundings.

    `slave` responds to the accesses of the bridge. `got` contains the payloads received from the bridge,
    `edges` every edge of txd. `baud` is the nominal rate of the host, and `error` its relative deviation
    (0.02: the host is 2 % fast).
    """

    def __init__(self, dut: Any, slave: RegisterModel | None) -> None:
        self.dut = dut
        self.config = Config.from_json(os.environ["OPENPPMC_CONFIG"])
        self.rng = random.Random(int(os.environ.get("OPENPPMC_SEED", "1")))
        self.period = self.config.period_ps
        self.rate_scale = SECOND / (self.period * self.config.clk_hz)  # simulated clock frequency / ClkHz
        self.baud = baud_of(self.config)
        self.error = 0.0
        self.rxd = dut.rxd_i if hasattr(dut, "rxd_i") else dut.uart_rxd
        self.slave = slave
        self.got: list[bytes] = []
        self.line: list[tuple[int, int]] = []  # (time in ps of the end of the stop bit, byte)
        self.edges: list[tuple[int, int]] = []
        self.strobes: list[tuple[int, str, int]] = []  # (time, pin, level)
        self.seq = 0
        self._deframer = Deframer()
        self._frame = Event()

    @classmethod
    async def start(cls, dut: Any, slave: RegisterModel | None = None) -> Bench:
        """Start clock, reset the bridge, and start the monitors."""
        watchdog.arm()
        bench = cls(dut, slave or RegisterModel())
        dut.clk_i.set(Immediate(0))
        dut.rst_ni.set(Immediate(1))
        idle = {"rxd_i": 1, "d_i": 0, "int_ni": 1, "pins_i": 0xFF, "watch_i": 0, "count_i": 0}
        for pin, level in idle.items():
            getattr(dut, pin).value = level
        await Timer(bench.period // 2, "ps")
        dut.rst_ni.value = 0
        sim_backend().clock(sim_backend().port("clk_i"), bench.period // 2)
        await Timer(4 * bench.period, "ps")
        dut.rst_ni.value = 1
        await bench.clocks(4)
        bench.watch_line(dut.txd_o)
        cocotb.start_soon(bench._bus())
        return bench

    @classmethod
    async def of_carrier(cls, dut: Any, idle: Mapping[str, int], settle: int = 10) -> Bench:
        """Return a bench for a carrier whose host is the bridge, after its reset and `settle` further
        cycles.
        """
        bench = cls(dut, None)
        dut.clk.set(Immediate(0))
        dut.rst_n.set(Immediate(1))
        for pin, level in {"uart_rxd": 1, **idle}.items():
            getattr(dut, pin).value = level
        await Timer(bench.period // 2, "ps")
        dut.rst_n.value = 0
        sim_backend().clock(sim_backend().port("clk"), bench.period // 2)
        await Timer(4 * bench.period, "ps")
        dut.rst_n.value = 1
        await bench.clocks(settle)
        bench.watch_line(dut.uart_txd)
        return bench

    def watch_line(self, txd: Any) -> None:
        """Receive the characters that the bridge sends."""
        self._txd = txd
        cocotb.start_soon(self._receive())
        cocotb.start_soon(self._note_edges())

    # ---------------------------------------------------------------- time

    async def clocks(self, n: int) -> None:
        """Wait n cycles."""
        await Timer(n * self.period, "ps")

    async def ms(self, n: float) -> None:
        """Wait n milliseconds of the bridge, which counts cycles and assumes the clock frequency ClkHz."""
        await Timer(round(n * self.config.clk_hz / 1000) * self.period, "ps")

    def bit_ps(self) -> float:
        """Return the bit time of the host in ps."""
        return SECOND / self.rate_scale / (self.baud * (1 + self.error))

    def clk_of(self, ps: int) -> float:
        """Convert a time in ps to cycles."""
        return ps / self.period

    # ---------------------------------------------------------------- to the bridge

    async def levels(self, bits: list[int], unit: float = 1.0) -> None:
        """Drive levels, each for `unit` bit times, without drift."""
        start, bit = now(), self.bit_ps() * unit
        for n, level in enumerate(bits):
            self.rxd.value = level
            if n + 1 == len(bits) or bits[n + 1] != level:
                await Timer(max(1, round(start + (n + 1) * bit) - now()), "ps")

    async def send(self, data: bytes | list[int], stop: int = 1) -> None:
        """Send characters back to back; each stop bit has the level `stop`."""
        bits = []
        for byte in bytes(data):
            bits += [0, *(byte >> n & 1 for n in range(8)), stop]
        await self.levels(bits)
        self.rxd.value = 1

    async def quiet(self, bits: float = 25) -> None:
        """Keep the line idle for some bit times."""
        await Timer(round(bits * self.bit_ps()), "ps")

    # ---------------------------------------------------------------- from the bridge

    async def _note_edges(self) -> None:
        while True:
            await ValueChange(self._txd)
            self.edges.append((now(), int(self._txd.value)))

    async def _receive(self) -> None:
        while True:
            await FallingEdge(self._txd)
            bit = SECOND / self.rate_scale / self.baud
            start, byte = now(), 0
            for n in range(10):
                await Timer(round(start + (n + 0.5) * bit) - now(), "ps")
                level = int(self._txd.value)
                assert n != 0 or level == 0, "false start bit from the bridge"
                assert n != 9 or level == 1, "stop bit of the bridge is low"
                byte |= level << n - 1 if 1 <= n <= 8 else 0
            self.line.append((now(), byte))
            for item in self._deframer.feed(bytes([byte])):
                assert not isinstance(item, Broken), f"the bridge sent a broken frame: {item}"
                self.got.append(item.payload)
                self._frame.set()

    async def message(self, ms: float = 50) -> bytes:
        """Return the next payload from the bridge, after its last stop bit.

        Raise TimeoutError if no payload arrives.
        """
        while not self.got:
            self._frame.clear()
            await with_timeout(self._frame.wait(), round(ms * SECOND / 1000), "ps")
        await Timer(round(0.6 * self.bit_ps()), "ps")
        return self.got.pop(0)

    async def silent(self, why: str, bits: float = 60) -> None:
        """Check that the bridge sends nothing."""
        lines = len(self.line)
        await self.quiet(bits)
        same(f"{why}: messages", (self.got, len(self.line) - lines), ([], 0))

    # ---------------------------------------------------------------- requests

    async def ask(self, script: bytes | str, seq: int | None = None, ms: float = 50) -> bytes:
        """Send a script (bytes or hexadecimal text) as a request; return the payload of its answer."""
        if seq is None:
            self.seq = seq = self.seq % 127 + 1
        data = bytes.fromhex(script) if isinstance(script, str) else script
        await self.send(encode(bytes([seq]) + data))
        answer = await self.message(ms)
        same("SEQ of the answer", answer[0], seq)
        return answer[1:]

    async def done(self, script: bytes | str, ms: float = 50) -> bytes:
        """Send a request as `ask` does, check RESULT = 0, and return the data."""
        answer = await self.ask(script, ms=ms)
        same("RESULT", answer[0], 0)
        return answer[1:]

    def accesses(self) -> list[tuple[str, int, int]]:
        """Return the accesses that the slave has logged since the last call."""
        log = list(self.slave.log)
        self.slave.log.clear()
        return log

    # ---------------------------------------------------------------- bus

    async def _bus(self) -> None:
        pins = ("cs_no", "rd_no", "wr_no", "a_o", "d_o")
        for pin in pins:
            cocotb.start_soon(self._note_pin(pin))
        cocotb.start_soon(self._reads())
        while True:
            await RisingEdge(self.dut.wr_no)
            self.slave.write(int(self.dut.a_o.value), int(self.dut.d_o.value))

    async def _reads(self) -> None:
        while True:
            await FallingEdge(self.dut.rd_no)
            # The slave outputs wrong data until the fifth cycle, because only the byte in the last cycle
            # counts.
            self.dut.d_i.value = 0x5A
            await Timer(self.period * 9 // 2, "ps")
            self.dut.d_i.value = self.slave.read(int(self.dut.a_o.value))
            await RisingEdge(self.dut.rd_no)
            await Timer(self.period // 2, "ps")
            self.dut.d_i.value = 0xA5

    async def _note_pin(self, pin: str) -> None:
        handle = getattr(self.dut, pin)
        while True:
            await ValueChange(handle)
            self.strobes.append((now(), pin, int(handle.value)))
