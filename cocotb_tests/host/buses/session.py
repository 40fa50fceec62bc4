"""A host program for the PPMC-104 over any bus, and the comparison of the part with the golden model."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

import cocotb
from cocotb.triggers import RisingEdge

from openppmc.model import Ppmc104
from openppmc.model.single.predict import predict_move

DATA, STATUS, BRIDGE = 0x0, 0x4, 0x8
OBF, IBF, BUSY = 1, 2, 4
INIT = bytes([9, 4, 4, 0])
PULSES = 14
INPUTS = {"a0": "a0", "cs_n": "cs_n", "rd_n": "rd_n", "wr_n": "wr_n", "d_i": "to_part"}
OUTPUTS = {"d_o": "from_part", "int_n": "int_n", "s": "s", "hold": "hold", "pout_n": "pout_n", "dir": "dir"}

Read = Callable[[int], Awaitable[int]]
Write = Callable[[int, int], Awaitable[None]]


class PartMonitor:
    """Records each change of the pins of a part. Edge 0 is the first edge that samples rst_n = 1 at the part.

    The time of an input is the edge that samples it; the time of an output is the edge on which it changes.
    """

    def __init__(self, dut: Any, instance: str) -> None:
        self._clk = dut.clk
        top = getattr(dut, instance)
        self._reset = top.rst
        self._inputs = {pin: getattr(top, name) for pin, name in INPUTS.items()}
        self._outputs = {pin: getattr(top, name) for pin, name in OUTPUTS.items()}
        self.inputs: list[tuple[int, str, int]] = []
        self.outputs: list[tuple[int, str, int]] = []
        self.edge = -1
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        edge = RisingEdge(self._clk)
        seen_in: dict[str, int] = {"cs_n": 1, "rd_n": 1, "wr_n": 1, "a0": 0, "d_i": 0}
        seen_out: dict[str, int] = {}
        while True:
            await edge
            if not int(self._reset.value):
                continue
            self.edge += 1
            for pins, seen, log, back in (
                (self._inputs, seen_in, self.inputs, 0),
                (self._outputs, seen_out, self.outputs, 1),
            ):
                for pin, handle in pins.items():
                    if (level := int(handle.value)) != seen.get(pin, level):
                        log.append((self.edge - back, pin, level))
                    seen[pin] = level

    def pulses(self) -> list[int]:
        """Return the edges of all pulses (falling edges of pout_n)."""
        return [t for t, pin, level in self.outputs if pin == "pout_n" and not level]

    def check_against_model(self) -> None:
        """Replay the strobes into the golden model and compare every output edge, exact to the cycle."""
        model = Ppmc104()
        groups: dict[int, dict[str, int]] = {}
        for t, pin, level in self.inputs:
            groups.setdefault(t, {})[pin] = level
        end = self.edge - 1
        for t, levels in groups.items():
            model.pins(t, **levels)
        model.run_until(max(end, model.now))
        want = sorted(tuple(edge) for edge in model.edges if edge.signal in OUTPUTS and 0 <= edge.t < end)
        got = sorted(entry for entry in self.outputs if entry[0] < end)
        for n, (a, b) in enumerate(zip(got, want, strict=False)):
            assert a == b, f"output edge {n}: RTL {a}, model {b}"
        assert len(got) == len(want), f"RTL has {len(got)} output edges, the model {len(want)}"
        assert len(got) > 3 * PULSES, f"only {len(got)} output edges to compare"


async def run_session(read: Read, write: Write, irq: Callable[[], int]) -> dict[str, int]:
    """Initialise the part, move PULSES pulses, wait for the end with the bridge register, then read finish
    status and remaining pulses. Return the values that were read, by name.
    """

    async def until(mask: int, value: int) -> int:
        for _ in range(2000):
            status = await read(STATUS)
            if status & mask == value:
                return status
        raise AssertionError(f"status & {mask:#x} never became {value:#x}")

    async def send(code: int, *data: int) -> int:
        for register, byte in [(STATUS, code), *((DATA, byte) for byte in data)]:
            await until(IBF, 0)
            await write(register, byte)
        return await until(IBF, 0)

    async def fetch(code: int, count: int) -> int:
        await send(code)
        value = 0
        for n in range(count):
            await until(OBF, OBF)
            value |= await read(DATA) << 8 * n
        return value

    assert await send(0x0A, *INIT) == 0, "initialisation refused"
    assert not irq() and await read(BRIDGE) == 0, "interrupt before the move"
    status = await send(0x43, PULSES - 1, 0, 0)
    assert status == BUSY, f"status {status:#04x} after the start"
    for _ in range(5000):
        if await read(BRIDGE):
            break
    else:
        raise AssertionError("the bridge register never showed the interrupt")
    assert irq(), "bridge register set, irq low"
    result = {"status": await until(BUSY, 0), "finish": await fetch(0x80, 1), "left": await fetch(0x83, 3)}
    assert not irq() and await read(BRIDGE) == 0, "interrupt after the finish status was read"
    return result


def check_session(monitor: PartMonitor, result: dict[str, int]) -> None:
    """Compare the answers with the expected ones, the pulses with the calculated times, and every output edge
    with the golden model.
    """
    assert result == {"status": 0, "finish": 0x83, "left": 0}, result
    pulses = monitor.pulses()
    got = [b - a for a, b in zip(pulses, pulses[1:], strict=False)]
    assert got == predict_move(INIT, PULSES).intervals, f"{len(pulses)} pulses, intervals {got}"
    monitor.check_against_model()
