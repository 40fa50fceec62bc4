"""Window: registers, strobes, positions, interrupt map (BANK-WIN)."""

from __future__ import annotations

from cocotb_tests.harness.directed import directed

from .bench import B4, B8, B32, B64, F100
from .lab import INFO, INIT_A, Lab


@directed("BANK-WIN-03", builds=(B8, B32, B64, B4, F100))
async def bank_win_03_info(dut):
    """Given a bank, when INFO is read at the first and the last axis, then it tells the window and AXES."""
    lab = await Lab.start(dut)
    for base in (0, lab.size - 1 << 4 & ~0x70):
        got = [await lab.host.read(base | k << 4 | INFO) for k in range(min(8, lab.size))]
        lab.check("BANK-WIN-03", "INFO", got[:4], [0x42, 1, lab.size, 0][: len(got)])
    axis = await lab.ready(lab.size - 1, INIT_A)
    await axis.move(0x43, 14)
    lab.check("BANK-MOT-01", "pulses", len(axis.pulses), 14)
