"""Program of `make demo PART=pmc006` on the RTL."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.sessions import DemoLog

from .demo_program import run_program
from .stepping import MotorHost


@cocotb.test()
async def demo_program(dut: Any) -> None:
    """A host moves a motor and loads a program into a part that was just powered up; the run is recorded."""
    host = await MotorHost.start(dut)
    assert isinstance(host.bench, RtlBench)
    demo_log = DemoLog(host.bench)
    await run_program(host, demo_log)
    demo_log.save()
