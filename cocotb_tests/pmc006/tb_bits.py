"""The bitstream of a board with a PMC006B4, for `make test-bits`: lines, outputs, a move, the button."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge, Timer, with_timeout

from cocotb_tests.harness import same
from cocotb_tests.pmc006.tb_board import ACCEPTED, Host

IDLE = {"rst_n": 1, "uart_rxd": 1, "rs485_rxd": 1, "cmp_a": 0, "cmp_b": 0, "ext1": 1, "ext2": 1}
IDLE |= {"gpi": 0b111, "fset_n": 1, "scl": 1, "sda": 0}
"""There is no EEPROM: SDA is low, so that the part boots immediately."""
CLOCK_PS, STEPS = 41_666, 100


@cocotb.test()
async def board_pmc006(dut: Any) -> None:
    """After a boot, both lines return replies; a move has its steps, and the button stops the bridges."""
    for name, level in IDLE.items():
        getattr(dut, name).value = level
    Clock(dut.clk, CLOCK_PS, "ps").start()
    await with_timeout(RisingEdge(dut.bridge_a_en), 60, "ms")
    await Timer(10, "us")
    usb = Host(dut.uart_rxd, dut.uart_txd, dut.rs485_de)
    rs485 = Host(dut.rs485_rxd, dut.rs485_txd, dut.rs485_de)
    usb.listen()
    rs485.listen()
    for host, other in ((usb, rs485), (rs485, usb)):
        other.bytes.clear()
        same("microstepping", await host.ask("k"), 16)
        same("the other line", bytes(other.bytes), bytes(host.bytes))
    same("y", await usb.ask("y", 0b10110 << 3), 0b10110 << 3)
    same("gpo", int(dut.gpo.value), 0b110)
    same("LED", int(dut.ledr_n.value), 1)
    same("step", await usb.ask("s", STEPS), ACCEPTED)
    same("LED", int(dut.ledr_n.value), 0)
    levels = set()
    while not dut.ledr_n.value:
        await Timer(100, "us")
        levels.add(tuple(int(getattr(dut, name).value) for name in ("m10", "m11", "m20", "m21")))
    assert len(levels) >= 4, levels
    same("position", await usb.ask("c"), STEPS)
    dut.rst_n.value = 0
    await with_timeout(FallingEdge(dut.bridge_a_en), 1, "us")
    same("the other bridge", int(dut.bridge_b_en.value), 0)
