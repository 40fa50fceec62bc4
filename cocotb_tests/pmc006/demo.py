"""Program of `make demo PART=pmc006` on the RTL."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import Bench
from cocotb_tests.harness.sessions import Story

from .demo_program import tell
from .stepping import MotorHost


@cocotb.test()
async def demo_program(dut: Any) -> None:
    """A host moves a motor and loads a program on a part just powered up, and the run is recorded."""
    host = await MotorHost.start(dut)
    assert isinstance(host.side, Bench)
    story = Story(host.side)
    await tell(host, story)
    story.save()
