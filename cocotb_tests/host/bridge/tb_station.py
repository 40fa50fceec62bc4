"""A complete board with a PPMC-2104 on the bus of the old chip: both bus styles, phase drivers, LEDs,
reset.
"""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.handle import Immediate
from cocotb.triggers import FallingEdge, Timer, ValueChange, with_timeout

from cocotb_tests.harness import PARTS, BusStyle, Config, configs
from cocotb_tests.harness.sim_backend import sim_backend

from .bench import SECOND, same

STATION = Config("station100m", clk_hz=100_000_000)
PERIOD = SECOND // STATION.clk_hz
INIT = (0x02, 0x63, 0x13, 0x0A, 0x00)  # RL 99, RH 19, PA 10, four-phase, full step
LAMP_RUNNING, LAMP_SWITCH, LAMP_MOVING = 8, 4, 2


class Host:
    """Accesses in one bus style. All edges are midway between two rising edges of `clk`."""

    def __init__(self, dut: Any, style: BusStyle) -> None:
        self.dut, self.style = dut, style

    async def _strobe(self, a: int, on: dict[str, int], off: dict[str, int]) -> int:
        dut = self.dut
        dut.a0.value = a
        for pin, level in on.items():
            getattr(dut, pin).value = level
        await Timer(4 * PERIOD, "ps")
        byte = int(dut.d_o.value) if int(dut.d_oe.value) else -1
        for pin, level in off.items():
            getattr(dut, pin).value = level
        await Timer(6 * PERIOD, "ps")
        same("the bus is released", int(dut.d_oe.value), 0)
        return byte

    async def read(self, a: int) -> int:
        """Make one read access and return the byte, or -1 if the part did not drive the bus."""
        return await self._strobe(a, dict(self.style.read_on), dict(self.style.read_off))

    async def write(self, a: int, byte: int) -> None:
        """Make one write access, then wait until IBF = 0."""
        self.dut.d_i.value = byte
        driven = await self._strobe(a, dict(self.style.write_on), dict(self.style.write_off))
        same("nothing driven in a write", driven, -1)
        while await self.read(1) & 2:
            pass

    async def instruction(self, code: int, *data: int) -> None:
        """Write a code and its data bytes."""
        await self.write(1, code)
        for byte in data:
            await self.write(0, byte)


async def start(dut: Any, busc: int) -> Host:
    """Power on with idle pins; the board releases the reset of its part without the test bench."""
    dut.clk.set(Immediate(0))
    dut.lock.set(Immediate(1))
    idle = {**PARTS["ppmc2104"].inputs, "busc": busc, "req_n": 1, "uart_rxd": 1}
    for pin, level in idle.items():
        getattr(dut, pin).value = level
    await Timer(PERIOD // 2, "ps")
    dut.lock.value = 0
    sim_backend().clock(sim_backend().port("clk"), PERIOD // 2)
    await Timer(4 * PERIOD, "ps")
    same("lamps in reset", int(dut.lamps.value), 0)
    dut.lock.value = 1
    await released(dut)
    return Host(dut, PARTS["ppmc2104"].styles[busc])


async def released(dut: Any) -> None:
    """Wait until the part is out of reset, which takes 1 ms to 2 ms."""
    for _ in range(20):
        await Timer(SECOND // 10_000, "ps")
        if int(dut.lamps.value) & LAMP_RUNNING:
            return
    raise AssertionError("the station stays in reset")


async def move_one(dut: Any, busc: int) -> None:
    """Initialise axis 1, make one step and check its end status."""
    host = await start(dut, busc)
    same("windings are off", (int(dut.s1.value), int(dut.s2.value)), (0, 0))
    await host.instruction(*INIT)
    same("S1 and S2 are on with H", (int(dut.s1.value), int(dut.s2.value)), (0b00011, 0))
    while await host.read(1) & 0x10:
        pass
    await host.instruction(0x42)
    same("moving", int(dut.lamps.value) & LAMP_MOVING, LAMP_MOVING)
    await with_timeout(FallingEdge(dut.int_n), SECOND // 1000, "ps")
    same("one step on", int(dut.s1.value), 0b00110)
    await host.instruction(0x80)
    same("end status", (await host.read(0), int(dut.int_n.value)), (0x82, 1))
    dut.alm_n.value = 0b01
    await Timer(4 * PERIOD, "ps")
    same("lamp of the switches", int(dut.lamps.value) & LAMP_SWITCH, LAMP_SWITCH)


@cocotb.test()
@configs(STATION)
async def station_strobes(dut):
    """With strobes WRS and RDS the host controls the part; the phase outputs of the board are inverted, and
    the LEDs show the state of the part (P2104-BUS-02).
    """
    await move_one(dut, 0)


@cocotb.test()
@configs(STATION)
async def station_direction(dut):
    """With DS and R/W the host controls the part (P2104-BUS-01)."""
    await move_one(dut, 1)


@cocotb.test()
@configs(STATION)
async def station_reset(dut):
    """The reset line of the host stops a motion immediately and switches all outputs off. The straps are
    connected to pins of the board: a motion waits until its run pin is high.
    """
    host = await start(dut, 0)
    await host.instruction(*INIT)
    while await host.read(1) & 0x10:
        pass
    dut.run.value = 0b10
    await host.instruction(0x45, 0x31)
    await Timer(100 * PERIOD, "ps")
    same("waits for RUN", (await host.read(1), int(dut.pout_n.value)), (0x04, 0b11))
    dut.run.value = 0b11
    await with_timeout(ValueChange(dut.pout_n), SECOND // 1000, "ps")
    same("pulse of axis 1", int(dut.pout_n.value), 0b10)
    dut.req_n.value = 0
    await Timer(6 * PERIOD, "ps")
    same("off", (int(dut.s1.value), int(dut.lamps.value), int(dut.hold.value)), (0, 0, 0b11))
    dut.req_n.value = 1
    await released(dut)
    same("status", await host.read(1), 0)
