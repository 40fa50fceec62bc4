"""A register model on the strobe bus, which checks the pins for UB-BUS-01 in every cycle."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from cocotb.triggers import Event, RisingEdge

WRITE_CLK, READ_CLK, GAP_CLK = 4, 6, 4


class Registers:
    """Contents of the registers. A read returns the value of a register, then increments it.

    Therefore an extra strobe, a missing strobe or a strobe at a wrong address changes later reads.
    """

    def __init__(self, count: int) -> None:
        self.values = [17 * n & 0xFF for n in range(count)]

    def write(self, address: int, value: int) -> None:
        """Write a register."""
        self.values[address] = value

    def read(self, address: int) -> int:
        """Return the value of a register, then increment it."""
        value = self.values[address]
        self.values[address] = value + 1 & 0xFF
        return value


class StrobeSlave:
    """Slave at the pins `<prefix>_*`.

    `cycles` lists ("w" or "r", address, value, cycle of the first low level) of each strobe. A read outputs
    the value in the last cycle of its strobe only, and random data in all other cycles. Any violation of the
    timing raises AssertionError in the simulation.
    """

    def __init__(self, dut: Any, prefix: str, count: int, rng: random.Random) -> None:
        self._pins = {
            name: getattr(dut, f"{prefix}_{name}") for name in ("cs_n", "rd_n", "wr_n", "a", "d", "q")
        }
        self._clk, self._rng = dut.clk, rng
        self.registers = Registers(count)
        self.cycles: list[tuple[str, int, int, int]] = []
        self.clk = 0
        self.ended = Event()
        self._task = cocotb.start_soon(self._run())

    def _sample(self) -> tuple[int, int, int, int, int]:
        return tuple(int(self._pins[name].value) for name in ("cs_n", "rd_n", "wr_n", "a", "d"))  # type: ignore

    async def _run(self) -> None:
        edge = RisingEdge(self._clk)
        before, low, high, first = (1, 1, 1, 0, 0), 0, GAP_CLK, 0
        while True:
            await edge
            self.clk += 1
            now = self._sample()
            cs_n, rd_n, wr_n, address, _ = now
            where = f"cycle {self.clk}, pins {now}"
            assert cs_n == (rd_n and wr_n) and (rd_n or wr_n), f"{where}: cs_n goes with one strobe"
            if not cs_n:
                if not low:
                    assert high >= GAP_CLK, f"{where}: only {high} cycles since the strobe before"
                    first = self.clk
                # At the first low level, `before` is the cycle before the strobe, in which the pins must have
                # the same values.
                assert before[3:] == now[3:], f"{where}: address or data changed from {before}"
                low += 1
                last = low == READ_CLK - 1 and not rd_n
                self._pins["q"].value = self.registers.values[address] if last else self._rng.getrandbits(8)
            elif low:
                assert before[3:] == now[3:], f"{where}: address or data not held 1 cycle after the strobe"
                write = not before[2]
                assert low == (WRITE_CLK if write else READ_CLK), f"{where}: strobe of {low} cycles"
                self._end(write, before[3], before[4], first)
                low, high = 0, 1
            else:
                high += 1
                self._pins["q"].value = self._rng.getrandbits(8)
            before = now

    def _end(self, write: bool, address: int, value: int, first: int) -> None:
        if write:
            self.registers.write(address, value)
        else:
            value = self.registers.read(address)
        self.cycles.append(("w" if write else "r", address, value, first))
        self.ended.set()

    def check_alive(self) -> None:
        """Raise the error that the check of the pins has found, if any."""
        if self._task.done():
            self._task.result()

    def accesses(self) -> list[tuple[str, int, int]]:
        """Return the accesses so far without their times."""
        self.check_alive()
        return [cycle[:3] for cycle in self.cycles]
