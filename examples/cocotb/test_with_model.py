"""The same move with this project's host and golden model: every edge of every output is compared.

It runs on cocotb's own main program as well, without `directed` and without `make test`.
"""

import cocotb

from cocotb_tests.harness.compare import check_against_model
from cocotb_tests.ppmc104.lab import Lab


@cocotb.test()
async def ramp_as_the_golden_model_has_it(dut):
    """Given RL 99, RH 49 and PA 4, when 14 pulses are ordered, then all outputs are the golden model's."""
    lab = await Lab.start(dut, (0x0A, 99, 49, 4))
    assert len(await lab.move(0x43, 14)) == 14
    assert check_against_model(lab.bench).mismatch is None
