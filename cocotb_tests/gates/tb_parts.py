"""The bitstream of a board with each part behind the UART bridge: its self-test, or moves of a bank.

The self-test is that of the host package; it compares every edge in the recorder with the golden model. A
bank leaves no block RAM for a recorder.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cocotb
from cocotb.task import bridge, resume
from cocotb.triggers import Event, First, Timer
from cocotb.utils import get_sim_time

from cocotb_tests.gates.tb_board import CW, INIT, RESET_MS, Golden, between, present, start
from cocotb_tests.harness import PARTS, RtlBench
from cocotb_tests.harness.line import UartBfm
from openppmc import parts
from openppmc.host.bank.registers import SELECT
from openppmc.host.link import Link
from openppmc.host.script import Result, Script
from openppmc.host.selftest.plan import MOVES, REGISTERS
from openppmc.host.selftest.run import SelfTest

BAUD = 3_000_000
AXES, PULSES = 8, 30


class LinePort(UartBfm):
    """The UART of the board as a port of the host package.

    The calls of the host package are blocking, so they run in a thread.
    """

    name = "simulated line"

    def __init__(self, dut: Any) -> None:
        super().__init__(dut.uart_rxd, dut.uart_txd, 115_200)
        self._waiting = bytearray()
        self._received = Event()

    def on_char(self, byte: int) -> None:
        self._waiting.append(byte)
        self._received.set()

    async def _wait(self, seconds: float) -> None:
        self._received.clear()
        await First(self._received.wait(), Timer(max(1, round(seconds * 1e12)), "ps"))

    def read(self, timeout: float) -> bytes:
        if not self._waiting:
            resume(self._wait)(timeout)
        data = bytes(self._waiting)
        self._waiting.clear()
        return data

    def write(self, data: bytes) -> None:
        resume(self.send)(data)

    def set_baud(self, baud: int) -> None:
        self.rate = baud

    def clock(self) -> float:
        return get_sim_time("sec")

    def close(self) -> None:
        pass


@cocotb.test()
async def board_selftest(dut: Any) -> None:
    """The self-test finds no difference between the board and the golden model, in the registers and in each
    kind of move.
    """
    port = LinePort(dut)
    name = dut._name.split("_", 2)[2]
    bench = await RtlBench.start(dut, present(dut, PARTS[name]))
    port.listen()
    await Timer(RESET_MS, "ms")

    def play() -> None:
        plan = parts.part(name).load("selftest")
        test = SelfTest(Link(port, BAUD), plan, Path(bench.out), cocotb.log.info)
        for section in test.sections(switches=False):
            if section.what in (REGISTERS, MOVES):
                outcome = test.play(section)
                # If the recorder is full, it contains only the first edges of the section.
                assert outcome.full or not (outcome.difference or outcome.skipped), outcome
        assert test.results.edges > 1000, test.results.edges
        cocotb.log.info("%d edges compared in %.3f s", test.results.edges, port.clock())

    await bridge(play)()


@cocotb.test()
async def board_bank(dut: Any) -> None:
    """A move of the first and of the last axis has the pulses of a PPMC-104, and no other axis moves."""
    bench, uart = await start(dut, part=PARTS["bank"].built({"AXES": AXES}))
    for axis in (0, AXES - 1):
        golden, begin = Golden(bench.config), bench.now
        answer = await uart.ask(Script().write(SELECT, axis).call(*INIT))
        assert answer.result is Result.DONE, answer
        await Timer(1, "ms")
        sender = cocotb.start_soon(uart.ask(Script().call(CW, *(PULSES - 1).to_bytes(3, "little"))))
        first = await bench.nth_fall(1, begin, f"pout_n[{axis}]")
        answer = await sender
        assert answer.result is Result.DONE, answer
        want = golden.move(CW, PULSES, None)
        await bench.until(max(bench.now, first + want[-1][0] + 1000))
        edges = [(t, name, v) for name in ("pout_n", "dir") for t, v in bench.edges(f"{name}[{axis}]", begin)]
        got = between(first, first + want[-1][0], edges)
        bench.check(
            "bank", f"edges of axis {axis}", got, [edge for edge in want if edge[1] in ("pout_n", "dir")]
        )
        falls = [len(bench.falls(f"pout_n[{n}]", begin)) for n in range(AXES)]
        bench.check("bank", "pulses", falls, [PULSES * (n == axis) for n in range(AXES)])
        answer = await uart.ask(Script().call(0x80).get(1))
        bench.check("bank", "finish status", answer.byte(1), golden.finish())
