"""LEDs of the carriers, with a bus as host: a limit, an alarm or MON lights one LED, a motion lights the
other, and no other input lights an LED.

The hosts of this test cannot start motions of a PPMC-312, so its motion LED is tested at standstill only.
"""

from __future__ import annotations

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, with_timeout

from cocotb_tests.harness import PARTS, same

LIT = {
    "ppmc104": ("l1_n", "l2_n", "l3_n", "l4_n", "alm_n"),
    "ppmc2104": ("fl_n", "bl_n", "fhl_n", "bhl_n", "alm_n"),
    "stmc": ("l1_n", "l2_n", "l3_n", "l4_n", "mon"),
    "ppmc312": ("fl_n", "bl_n", "fhl_n", "bhl_n", "alm_n"),
}
"""Part -> pins that light led_switch while any of their bits is active."""
DARK = {"ppmc104": ("cnp_n",), "ppmc2104": ("org_n",), "stmc": ("cnp_n",), "ppmc312": ("org_n", "end_n")}
STROBES = {"ppmc104": "wr_n", "stmc": "wr_n", "ppmc2104": "ds_wrs_n"}
RAMP = (9, 4, 4, 0)  # RL, RH, PA
AXES = {"ppmc2104": (0x00, 0x20)}  # bit of the operation code that selects each axis


async def start(dut, part: str) -> None:
    """Reset the carrier with idle pins."""
    for pin, level in {"uart_rxd": 1, "rs485_rxd": 1, **PARTS[part].inputs, "rst_n": 0}.items():
        if hasattr(dut, pin):
            getattr(dut, pin).value = level
    Clock(dut.clk, 40, "ns").start()
    await ClockCycles(dut.clk, 5)
    dut.rst_n.value = 1
    await ClockCycles(dut.clk, 10)


async def write(dut, part: str, a0: int, byte: int) -> None:
    """Make one write access as the old host does."""
    strobe = getattr(dut, STROBES[part])
    dut.a0.value, dut.d_i.value, dut.cs_n.value, strobe.value = a0, byte, 0, 0
    await ClockCycles(dut.clk, 4)
    strobe.value, dut.cs_n.value = 1, 1
    await ClockCycles(dut.clk, 8)


@cocotb.test()
@cocotb.parametrize(part=[*LIT])
async def led_of_the_switches(dut, part: str):
    """Each limit and the alarm (MON of the STMC) of each axis lights led_switch and no other LED; other
    switches do not light led_switch.
    """
    await start(dut, part)
    same("at rest", (int(dut.led_switch.value), int(dut.led_moving.value)), (0, 0))
    for pin in (*LIT[part], *DARK[part]):
        handle = getattr(dut, pin)
        idle = int(handle.value)
        for bit in range(len(handle)):
            handle.value = idle ^ 1 << bit
            await ClockCycles(dut.clk, 4)
            same(f"{pin}, bit {bit}", int(dut.led_switch.value), int(pin in LIT[part]))
            handle.value = idle
            await ClockCycles(dut.clk, 4)
            same(f"{pin} is idle again", int(dut.led_switch.value), 0)


@cocotb.test()
@cocotb.parametrize(part=[*STROBES])
async def led_of_the_motion(dut, part: str):
    """During a move of each axis, led_moving is lit from the start of the move to the end of its hold
    time.
    """
    await start(dut, part)
    for axis, bit in enumerate(AXES.get(part, (0,))):
        for register, byte in ((1, 0x02 | bit), *((0, byte) for byte in RAMP)):
            await write(dut, part, register, byte)
        if part == "ppmc2104":  # a hold time of 128 us
            await ClockCycles(dut.clk, 40_000)
            await write(dut, part, 1, 0x85 | bit)
            await write(dut, part, 0, 0)
        await ClockCycles(dut.clk, 40_000)
        same("still at rest", int(dut.led_moving.value), 0)
        for register, byte in ((1, 0x43 | bit), (0, 3), (0, 0), (0, 0)):
            await write(dut, part, register, byte)
        if not dut.led_moving.value:
            await with_timeout(RisingEdge(dut.led_moving), 1, "ms")
        same("hold is low", int(dut.hold.value) >> axis & 1, 0)
        await with_timeout(FallingEdge(dut.led_moving), 100, "ms")
        same("hold is high", int(dut.hold.value) >> axis & 1, 1)
