"""The module isa_4axis for the harness, and a test bench with two hosts and four axes."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import AxisDriver, Config, IsaHost, Part, RtlBench
from cocotb_tests.harness.build import Design
from cocotb_tests.harness.isa import STROBES_ISA
from cocotb_tests.harness.project import include_dirs, part, sources

from ...harness.isa import IsaMaster

BASE = 0x300
SOURCE = BASE + 4
PARTS = 2
BUSY1, BUSY2, CMND1, CMND2, ERROR = 0x04, 0x08, 0x10, 0x20, 0x80

AXIS_INPUTS = ("run", "csel", "extck", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n")
AXIS_OUTPUTS = {"pout_n": 0b1111, "dir": 0, "hold": 0b1111}
PHASES = ("s1_n", "s2_n", "s3_n", "s4_n")

ISA_4AXIS = Part(
    name="isa_4axis",
    inputs={
        "reset_drv": 0,
        "sa": 0,
        "aen": 0,
        "ior_n": 1,
        "iow_n": 1,
        "sd_i": 0,
        "errint_n": 1,
        "auxi": 0,
        **{pin: 0 if pin == "extck" else 0b1111 for pin in AXIS_INPUTS},
    },
    outputs={
        "sd_o": (8, 0),
        "sd_oe": (1, 0),
        "irq": (1, 0),
        "auxo": (4, 0b1111),
        "clk_o": (1, 0),
        **{pin: (4, level) for pin, level in AXIS_OUTPUTS.items()},
        **{pin: (5, 0b11111) for pin in PHASES},
        # Signals between the two parts and the slave, which are not pins.
        "d": (16, 0),
        "d_oe": (2, 0b00),
        "int_n": (2, 0b11),
    },
    widths={"sa": 10, "sd_i": 8, "auxi": 4, **dict.fromkeys(AXIS_INPUTS, 4)},
    parameters=("CLK_HZ", "XTAL_HZ", "TIMING"),
    styles=(STROBES_ISA,),
    clock="extck",
    lowest=dict.fromkeys((*AXIS_INPUTS, *AXIS_OUTPUTS, *PHASES), 1),
    unwatched=frozenset({"clk_o"}),
)


def design(config: Config, **params: int) -> Design:
    """Return the design of the module with its parts; `params` replaces or adds parameters."""
    ports = ("clk", "rst_n", *ISA_4AXIS.inputs, *ISA_4AXIS.outputs)
    values = {**ISA_4AXIS.params(config), "BASE_ADDR": BASE, **params}
    return Design("isa_4axis", sources(part("isa_4axis")), include_dirs(), values, ports=ports)


class Setting:
    """The test bench with one bus master, the host of each part, and the four axes `axes[1]` to `axes[4]`."""

    def __init__(self, bench: RtlBench) -> None:
        self.bench = bench
        self.master = IsaMaster(bench)
        self.hosts = [IsaHost(self.master, BASE + 2 * number) for number in range(PARTS)]
        self.axes = {
            axis: AxisDriver(
                bench,
                self.hosts[(axis - 1) // 2],
                f"pout_n[{axis}]",
                f"s{axis}_n",
                f"extck[{axis}]",
                (BUSY1, BUSY2)[(axis - 1) % 2],
                ((axis - 1) % 2) << 5,
            )
            for axis in range(1, 2 * PARTS + 1)
        }

    @classmethod
    async def start(cls, dut: Any, **pins: int) -> Setting:
        """Reset the module and wait until the parts accept bytes."""
        return cls(await RtlBench.start(dut, ISA_4AXIS, **pins))

    async def set_up(self, axis: int, code: int, rl: int, rh: int, pa: int) -> None:
        """Send the initial setting of an axis and wait for its ramp table."""
        host = self.hosts[(axis - 1) // 2]
        second = (axis - 1) % 2
        await host.init(code | second << 5, rl, rh, pa)
        await host.poll((CMND1, CMND2)[second] | 0x02, 0)
