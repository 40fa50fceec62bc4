"""A complete board top without a PLL: power-on, bidirectional bus, both resets, and the bus pins with the
UART host.
"""

from __future__ import annotations

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, with_timeout
from cocotb.utils import get_sim_time

from cocotb_tests.harness import same
from cocotb_tests.harness.collect import exact

CLK_HZ = 50_000_000
READ_PINS = 0x82  # command that requests S1 … S5, HOLD and DIR as its answer, from bit 7 down


async def power_on(dut) -> int:
    """Start the clock with every input idle; return the cycles until the top lights the LED "running"."""
    for name in ("key_n", "host_rst_n", "cs_n", "rd_n", "wr_n"):
        getattr(dut, name).value = 1
    for name in ("a0", "host_oe", "host_d"):
        getattr(dut, name).value = 0
    Clock(dut.clk, 20, "ns").start()
    return await clocks_to_run(dut)


async def clocks_to_run(dut) -> int:
    """Return the cycles from now until the LED "running" is lit; check that the outputs are inactive after
    three cycles.
    """
    start = get_sim_time("ns")
    await ClockCycles(dut.clk, 3)
    assert dut.d_oe.value == 0
    assert dut.s.value == 0
    await with_timeout(RisingEdge(dut.running), 10, "ms")
    return round((get_sim_time("ns") - start) / 20)


async def write(dut, a0: int, byte: int) -> None:
    """Make one write access as the old host does."""
    dut.a0.value, dut.host_d.value, dut.host_oe.value, dut.cs_n.value = a0, byte, 1, 0
    dut.wr_n.value = 0
    await ClockCycles(dut.clk, 4)
    same("bus in a write", int(dut.bus.value), byte)
    assert dut.d_oe.value == 0
    dut.wr_n.value = 1
    await ClockCycles(dut.clk, 2)
    dut.host_oe.value, dut.cs_n.value = 0, 1
    await ClockCycles(dut.clk, 8)


async def read(dut, a0: int) -> int:
    """Make one read access as the old host does, check the direction of the bus, and return the byte."""
    assert dut.d_oe.value == 0
    dut.a0.value, dut.cs_n.value, dut.rd_n.value = a0, 0, 0
    await ClockCycles(dut.clk, 5)
    same("d_oe in a read", int(dut.d_oe.value), 1)
    byte = int(dut.bus.value)
    dut.cs_n.value, dut.rd_n.value = 1, 1
    await ClockCycles(dut.clk, 4)
    same("d_oe after a read", int(dut.d_oe.value), 0)
    return byte


@cocotb.test()
async def bus_power_on_and_read(dut):
    """The initial register values reset the board; then a command and its answer pass through the
    bidirectional pins.
    """
    count = await power_on(dut)
    assert 1e-3 <= count / CLK_HZ <= 2.1e-3, f"{count} cycles"
    same("status", await read(dut, 1), 0x00)
    await write(dut, 1, READ_PINS)
    same("status with an answer", await read(dut, 1), 0x01)
    same("pins: phases off, HOLD", await read(dut, 0), 0x04)
    same("status after it", await read(dut, 1), 0x00)


@cocotb.test()
async def bus_resets(dut):
    """The button and the reset line of the host reset the part, which discards an answer that waits."""
    await power_on(dut)
    for name in ("key_n", "host_rst_n"):
        await write(dut, 1, READ_PINS)
        same("status with an answer", await read(dut, 1), 0x01)
        getattr(dut, name).value = 0
        await with_timeout(FallingEdge(dut.running), 1, "us")
        await ClockCycles(dut.clk, 100)
        getattr(dut, name).value = 1
        count = await clocks_to_run(dut)
        assert 1e-3 <= count / CLK_HZ <= 2.1e-3, f"{name}: {count} cycles"
        same(f"status after {name}", await read(dut, 1), 0x00)


@exact("with the UART host, the pins of the bus are not connected")
@cocotb.test()
async def uart_leaves_the_bus_alone(dut):
    """With the UART host, a strobe on the bus pins has no effect, and the line to the PC is idle."""
    await power_on(dut)
    dut.cs_n.value, dut.rd_n.value, dut.a0.value = 0, 0, 1
    for _ in range(50):
        await ClockCycles(dut.clk, 1)
        assert dut.d_oe.value == 0
        assert dut.uart_txd.value == 1
