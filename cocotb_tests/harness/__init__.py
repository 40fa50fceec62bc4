"""Test harness of the OpenPPMC devices: a test needs only `from cocotb_tests.harness import …`.

    # cocotb_tests/ppmc104/tb_stops.py                       (runs inside the simulator)
    from cocotb_tests.harness import F11, F16, directed
    from .expected_timing import INIT_A
    from .env import Env

    @directed("P104-STP-01", "AC-20", builds=(F16, F11))      # builds are optional; default: only F16
    async def p104_stp_01_immediate_stop(dut):
        "After 0x40 in a constant-speed move, no further pulse is output."
        env = await Env.start(dut, INIT_A)                    # clock, reset 1-0-1, initialisation
        await env.go(0x44, 1000, rate=99)
        await env.pulse(10, 400)                              # 400 cycles after the tenth pulse
        await env.host.command(0x40)
        await env.idle()
        env.check("P104-STP-01", "pulses", len(env.pulses), 10)
        env.check("AC-20", "finish status", await env.finish(), 0xC4)
                                                              # here every output edge is compared

    # cocotb_tests/ppmc104/test_part.py                       (runs under pytest)
    ITEMS = cocotb_items("cocotb_tests.ppmc104", "tb_stops", "tb_bus", part=PPMC104)

    @pytest.mark.parametrize("item", ITEMS)
    def test_ppmc104(item, sim_options):
        run_item(item, sim_options)

Importing a name from this package loads only the modules that this name needs. The modules import each other,
but never this package. The first line of each module states its purpose (`head -qn1
cocotb_tests/harness/*.py`); docs/testing.md describes how the modules work together. No module depends on a
device: the `bench.py` of a device lists its pins (`PARTS`).

Times are counted in rising edges of `clk`; edge 0 is the first that samples rst_n = 1. Input pins change on
falling edges. The stamp of an input change is the first rising edge that samples it; the stamp of an output
edge is the rising edge that causes it.

A failed test writes log.txt and waves/dump.vcd (all signals) to build/failures/<test>/. A failed comparison
also writes compare.txt, compare.vcd and compare.png. The message ends with the command that repeats the test.
"""

from typing import TYPE_CHECKING

from openppmc.lazy import lazy

if TYPE_CHECKING:
    from .axis_driver import AxisDriver
    from .block_driver import Block, BlockDriver, rng, same
    from .build import check_ranges
    from .bus import BUSY, COMMAND, DATA, ERR, IBF, OBF, STATUS, BlockHost, HostBus
    from .collect import cocotb_items, probe, verifies
    from .config import D11, D16, F8, F11, F16, F25, F48, F50, F100, Config, configs
    from .dut_bench import DutBench
    from .isa import IsaHost
    from .line import SerialLine
    from .model_bench import ModelBench, OnModel, on_model, rtl_only
    from .part import PARTS, BusStyle, Part
    from .random_items import RandomItems, generating
    from .rtl_bench import RtlBench
    from .run_context import directed, random_test, start_bench
    from .runner import SimOptions, run_item
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        .axis_driver AxisDriver
        .block_driver Block BlockDriver rng same
        .build check_ranges
        .bus BUSY COMMAND DATA ERR IBF OBF STATUS BlockHost HostBus
        .collect cocotb_items probe verifies
        .config D11 D16 F8 F11 F16 F25 F48 F50 F100 Config configs
        .dut_bench DutBench
        .isa IsaHost
        .line SerialLine
        .model_bench ModelBench OnModel on_model rtl_only
        .part PARTS BusStyle Part
        .random_items RandomItems generating
        .rtl_bench RtlBench
        .run_context directed random_test start_bench
        .runner SimOptions run_item
        """,
        old={
            "Bench": "RtlBench",
            "Drive": "AxisDriver",
            "Side": "DutBench",
            "Unit": "BlockDriver",
            "inside": "probe",
        },
    )

__all__ = [
    "BUSY",
    "COMMAND",
    "D11",
    "D16",
    "DATA",
    "ERR",
    "F8",
    "F11",
    "F16",
    "F25",
    "F48",
    "F50",
    "F100",
    "IBF",
    "OBF",
    "PARTS",
    "STATUS",
    "AxisDriver",
    "Block",
    "BlockDriver",
    "BlockHost",
    "BusStyle",
    "Config",
    "DutBench",
    "HostBus",
    "IsaHost",
    "ModelBench",
    "OnModel",
    "Part",
    "RandomItems",
    "RtlBench",
    "SerialLine",
    "SimOptions",
    "check_ranges",
    "cocotb_items",
    "configs",
    "directed",
    "generating",
    "probe",
    "on_model",
    "random_test",
    "rng",
    "rtl_only",
    "run_item",
    "same",
    "start_bench",
    "verifies",
]
