"""The board top, accessed through its UART: identification, moves compared with the golden model edge by
edge, invalid frames.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import zip_longest
from typing import Any

import cocotb
from cocotb.triggers import Timer

from cocotb_tests.gates.board import B24
from cocotb_tests.gates.uart import Uart
from cocotb_tests.harness import PARTS, Config, Part, RtlBench, configs
from openppmc.host.frames import encode
from openppmc.host.script import RATES, Identity, Result, Script
from openppmc.model.ppmc104 import Ppmc104

INIT = (0x0A, 9, 4, 4, 0)
CW, CCW = 0x43, 0x4B
MOTOR = ("pout_n", "dir", "s", "hold", "int_n")
EVENT, NAK, NAK_CRC = 0x80, 0x81, 2
RESET_MS = 3
"""Duration of the longest reset of a board. The reset of a carrier without a board ends immediately."""


def present(dut: Any, part: Part) -> Part:
    """Return the part with only those of its pins that this board has."""
    inputs, outputs = (
        {name: pin for name, pin in pins.items() if hasattr(dut, name)}
        for pins in (part.inputs, part.outputs)
    )
    return replace(part, inputs=inputs, outputs=outputs, shape=None)


async def start(dut: Any, code: int = 0, part: Part | None = None) -> tuple[RtlBench, Uart]:
    """Reset the board, then select the line rate with the code `rate`."""
    uart = Uart(dut)
    bench = await RtlBench.start(dut, present(dut, part or PARTS["ppmc104"]))
    uart.listen()
    await Timer(RESET_MS, "ms")
    answer = await uart.ask(Script().rate(code))
    assert answer.result is Result.DONE, answer
    # The new rate applies after the stop bit; the answer was complete in the middle of the stop bit.
    await Timer(10, "us")
    uart.rate = RATES[code]
    return bench, uart


class Golden:
    """An initialised golden model that makes one move after another."""

    def __init__(self, config: Config) -> None:
        self.model = Ppmc104(config.clk_hz, config.xtal_hz, config.timing, config.phase_idle)
        self.t = 100
        self.call(*INIT)
        self.t += 100_000  # the ramp table is built during this time

    def call(self, command: int, *data: int) -> None:
        """Send a command with its parameters."""
        for place, byte in enumerate((command, *data)):
            self.t = self.model.write(self.t, int(place == 0), byte) + 400

    def move(self, op: int, count: int, limit_at: int | None) -> list[tuple[int, str, int]]:
        """Return the motor edges of a move, in cycles after its first pulse, up to the fall of int_n.

        Args:
            limit_at: cycles from the first pulse to the fall of l2_n.
        """
        model, before = self.model, len(self.model.pulses)
        for place, byte in enumerate((op, *(count - 1).to_bytes(3, "little"))):
            self.t = model.write(self.t, int(place == 0), byte) + 10
        while len(model.pulses) == before:
            model.run_until(self.t)
            self.t += 1
        first = model.pulses[before]
        if limit_at is not None:
            model.pins(first + limit_at, l2_n=0)
        self.t += 1_000_000
        model.run_until(self.t - 1)
        edges = [(edge.t, edge.signal, edge.value) for edge in model.edges]
        end = min(t for t, name, value in edges if t >= first and (name, value) == ("int_n", 0))
        return between(first, end, edges)

    def finish(self) -> int:
        """Read and return the finish status; the read deasserts int_n (high)."""
        self.call(0x80)
        status = self.model.read(self.t, 0)
        self.t += 10
        return status


def between(first: int, end: int, edges: list[tuple[int, str, int]]) -> list[tuple[int, str, int]]:
    """Return the sorted edges of the motor pins in the cycles `first` to `end`, counted from `first`."""
    return sorted((t - first, name, value) for t, name, value in edges if first <= t <= end and name in MOTOR)


async def move(
    bench: RtlBench,
    uart: Uart,
    golden: Golden,
    op: int,
    count: int,
    counted: int = 0,
    limit_at: int | None = None,
) -> int:
    """Make one move with one frame and compare edges and finish status with the golden model.

    `counted` is the value of the pulse counter before the move; the counter must count each pulse (upwards
    for CW). The event at the end of the move ends the comparison, because a board may have no pin for int_n.
    Return the number of pulses.
    """
    begin = bench.now
    sender = cocotb.start_soon(uart.ask(Script().call(op, *(count - 1).to_bytes(3, "little"))))
    first = await bench.nth_fall(1, begin)
    if limit_at is not None:
        bench.at(first + limit_at, l2_n=0)
    answer = await sender
    assert answer.result is Result.DONE, answer
    event = await uart.frame()
    assert event.payload[0] == EVENT, f"expected an event, got {event}"
    want = golden.move(op, count, limit_at)
    pins = [name for name in MOTOR if name in bench.outputs]
    edges = [(t, name, value) for name in pins for t, value in bench.edges(name, begin)]
    got = between(first, first + want[-1][0], edges)
    want = [edge for edge in want if edge[1] in pins]
    wrong = next((pair for pair in zip_longest(got, want) if pair[0] != pair[1]), None)
    bench.check("UART move", "first wrong edge (cycles after the first pulse, pin, level)", wrong, None)
    answer = await uart.ask(Script().call(0x80).get(1).count())
    assert answer.result is Result.DONE, answer
    bench.check("UART move", "finish status", answer.byte(1), golden.finish())
    pulses = len(bench.pulses(begin))
    way = pulses if op == CW else -pulses
    bench.check("UART move", "pulse counter", answer.number(2, signed=True), counted + way)
    return pulses


@cocotb.test()
@configs(B24)
async def board_identifies_itself(dut: Any) -> None:
    """After reset, the board reports its part and its clocks at 115 200 baud."""
    bench, uart = await start(dut)
    answer = await uart.ask(Script().ident().pins())
    who = Identity.parse(answer.values[0])
    assert (who.part, who.clk_hz, who.xtal_hz) == (104, bench.config.clk_hz, bench.config.xtal_hz), who
    assert not who.datasheet and who.counter and who.best_rate == RATES.index(3_000_000), who


@cocotb.test()
@configs(B24)
async def board_drops_a_bad_frame(dut: Any) -> None:
    """A frame with a wrong CRC is answered with NAK 2, and no command in it is executed."""
    bench, uart = await start(dut, RATES.index(1_000_000))
    line = bytearray(encode(bytes([5]) + bytes(Script().call(*INIT))))
    line[3] ^= 0x01
    await uart.send(bytes(line))
    nak = await uart.frame()
    assert nak.payload == bytes([NAK, NAK_CRC]), nak
    status = await uart.ask(Script().read(1).call(CW, 0, 0, 0))
    # The part rejects the move, because it is not initialised: the initialisation in the invalid frame did
    # not reach it.
    assert status.result is Result.REFUSED, status
    assert not bench.pulses()


@cocotb.test()
@configs(B24)
@cocotb.parametrize(rate=(1_000_000, 3_000_000))
async def board_moves(dut: Any, rate: int) -> None:
    """After an initialisation through the UART, each edge of a CW move, and of a CCW move that ends at its
    limit, equals that of the golden model.
    """
    bench, uart = await start(dut, RATES.index(rate))
    answer = await uart.ask(Script().events(True).call(*INIT))
    assert answer.result is Result.DONE, answer
    golden = Golden(bench.config)
    assert await move(bench, uart, golden, CW, 30) == 30
    made = await move(bench, uart, golden, CCW, 200, counted=30, limit_at=14_001)
    assert 0 < made < 200, f"{made} pulses: the limit came too late or too early"
