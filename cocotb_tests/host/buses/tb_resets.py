"""Resets during an access, on both buses: all outputs become idle immediately, and the access has no effect
after the reset.
"""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, RisingEdge, Timer

from .setting import PERIOD_PS, start

REST = {
    "model_wb": {"ack": 0, "err": 0, "bus_irq": 0, "bus_cs_n": 1, "bus_rd_n": 1, "bus_wr_n": 1},
    "model_axil": {"bvalid": 0, "rvalid": 0, "bus_irq": 0, "bus_cs_n": 1, "bus_rd_n": 1, "bus_wr_n": 1},
}
CALLS = {
    "model_wb": ({"cyc": 1, "stb": 1, "we": 1, "sel": 15}, {"cyc": 1, "stb": 1, "sel": 15}),
    "model_axil": ({"awvalid": 1, "wvalid": 1, "wstrb": 15}, {"arvalid": 1}),
}
ADDRESS = {"model_wb": ("adr", 2), "model_axil": ("awaddr", 0)}
"""Name of the address port, and the number of bits by which a byte address is shifted right for it."""
LONGEST = 14
"""Maximum length of an access in cycles."""


async def cut(dut: Any, prefix: str, call: dict[str, int], after: int) -> None:
    """Start an access and assert the reset `after` cycles later, while clk is low; check all outputs."""

    def put(**levels: int) -> None:
        for name, level in levels.items():
            getattr(dut, f"{prefix}_{name}").value = level

    def outputs() -> dict[str, int]:
        return {name: int(getattr(dut, f"{prefix}_{name}").value) for name in REST[prefix]}

    put(**call)
    for _ in range(after):
        await RisingEdge(dut.clk)
    await FallingEdge(dut.clk)
    dut.rst_n.value = 0
    await Timer(PERIOD_PS // 4, "ps")
    assert outputs() == REST[prefix], f"{after} cycles into {call}"
    put(**dict.fromkeys(call, 0))
    for _ in range(3):
        await RisingEdge(dut.clk)
        assert outputs() == REST[prefix], f"{after} cycles into {call}, held"
    await FallingEdge(dut.clk)
    dut.rst_n.value = 1
    for n in range(2 * LONGEST):
        await RisingEdge(dut.clk)
        irq = 1 if n else 0
        assert outputs() == {**REST[prefix], "bus_irq": irq}, f"{after} cycles into {call}, {n} cycles after"


@cocotb.test()
@cocotb.parametrize(prefix=list(REST), register=[0, 1])
async def bus_reset_in_an_access(dut: Any, prefix: str, register: int) -> None:
    """A reset during an access to a register or to the bridge sets all outputs to idle immediately. After the
    reset, irq is asserted again, because int_n is low.
    """
    await start(dut)
    getattr(dut, f"{prefix}_bus_int_n").value = 0
    for _ in range(3):
        await RisingEdge(dut.clk)
    bridge = 4 << len(getattr(dut, f"{prefix}_bus_a"))
    pin, shift = ADDRESS[prefix]
    for call in CALLS[prefix]:
        name = "araddr" if "arvalid" in call else pin
        for after in range(1, LONGEST):
            await cut(dut, prefix, {**call, name: (bridge if register else 4) >> shift}, after)
