"""Make the move of test_ppmc104.py with a host of this project, and compare it with the golden model.

Every edge of every output is compared. The test runs with cocotb's own main program, too; it needs neither
`directed` nor `make test`.
"""

import cocotb

from cocotb_tests.harness.compare import check_against_model
from cocotb_tests.ppmc104.env import Env


@cocotb.test()
async def ramp_as_the_golden_model_has_it(dut):
    """With RL 99, RH 49 and PA 4, all outputs of a move of 14 pulses equal those of the golden model."""
    env = await Env.start(dut, (0x0A, 99, 49, 4))
    assert len(await env.move(0x43, 14)) == 14
    assert check_against_model(env.bench).mismatch is None
