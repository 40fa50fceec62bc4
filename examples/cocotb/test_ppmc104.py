"""Initialise a PPMC-104 over its bus, make a move and count the pulses.

The test needs only cocotb, so you can copy this file.
"""

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge
from cocotb.utils import get_sim_time

PERIOD = 62_500  # ps: 16 MHz, the default of CLK_HZ
IDLE_HIGH = "cs_n rd_n wr_n csel vsel l1_n l2_n l3_n l4_n cnp_n alm_n".split()
DATA, COMMAND = 0, 1  # values of a0; a read of address 1 returns the status register
IBF, BUSY = 0x02, 0x04


async def read(dut, a0):
    dut.a0.value = a0
    dut.cs_n.value = dut.rd_n.value = 0
    await ClockCycles(dut.clk, 6)
    byte = int(dut.d_o.value)
    dut.cs_n.value = dut.rd_n.value = 1
    await ClockCycles(dut.clk, 4)
    return byte


async def write(dut, a0, byte):
    dut.a0.value, dut.d_i.value = a0, byte
    dut.cs_n.value = dut.wr_n.value = 0
    await ClockCycles(dut.clk, 4)
    dut.cs_n.value = dut.wr_n.value = 1
    await ClockCycles(dut.clk, 4)
    while await read(dut, COMMAND) & IBF:  # until the part has accepted the byte
        pass


@cocotb.test()
async def ramp_of_fourteen_pulses(dut):
    """With RL 99, RH 49 and PA 4, a move of 14 pulses has intervals of 200 us … 100 us … 200 us."""
    Clock(dut.clk, PERIOD, "ps").start()
    dut.a0.value = dut.d_i.value = dut.clock.value = dut.auxi.value = dut.rst_n.value = 0
    for pin in IDLE_HIGH:
        getattr(dut, pin).value = 1
    await ClockCycles(dut.clk, 4)
    dut.rst_n.value = 1
    await ClockCycles(dut.clk, 4)

    pulses = []

    async def note_pulses():
        while True:
            await FallingEdge(dut.pout_n)
            pulses.append(get_sim_time("us"))

    cocotb.start_soon(note_pulses())
    for a0, byte in [(COMMAND, 0x0A), (DATA, 99), (DATA, 49), (DATA, 4), (DATA, 0)]:
        await write(dut, a0, byte)
    for a0, byte in [(COMMAND, 0x43), (DATA, 13), (DATA, 0), (DATA, 0)]:
        await write(dut, a0, byte)
    await FallingEdge(dut.int_n)

    assert await read(dut, COMMAND) & BUSY == 0
    intervals = [b - a for a, b in zip(pulses, pulses[1:], strict=False)]
    assert len(pulses) == 14
    assert intervals[0] == intervals[-1] == 200
    assert intervals[4:9] == 5 * [100]
