"""Every latency of this PPMC-312 core is within the window that the rules allow."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.ppmc312.stages import Table, constant, ramped
from openppmc.model.ppmc312.timing import CoreTiming
from tests.ppmc312.model.reference import T1, T2, T3, T4, T5, TF, TG, TH

TIMING = CoreTiming()
TABLES = (T1, T2, T3, T4, T5, TF, TG, TH)
LONGEST = 32
"""Bytes of the longest answer."""


@verifies(
    "P312-PRT-04", "P312-PAR-05", "P312-PAR-08", "P312-RSP-20", "P312-MOT-01", "P312-MOT-05", "P312-OVR-02"
)
def test_fixed_latencies() -> None:
    begin = TIMING.arbitration + TIMING.effect
    assert begin + TIMING.copy + TIMING.answer + LONGEST <= 4096
    assert begin <= 64  # instruction 80: pout has no rising edge later than 64 cycles after the header
    assert begin + TIMING.look_up() + TIMING.ramp_lead <= 512
    assert TIMING.answer + 4 <= 64  # the answer to a start is available after t0 of the motion
    assert TIMING.report + TIMING.rest <= 64 and TIMING.turn_back <= 64
    assert TIMING.count <= 2 and TIMING.armed <= 4 and TIMING.next_response <= 4 and TIMING.reload >= 8
    assert TIMING.compare + 2 <= TIMING.least == 4  # a stop at a position is decided before the next pulse
    assert TIMING.slow_lead <= 4 and TIMING.lead + 2 <= 4 and TIMING.origin_lead + 2 <= 4


@pytest.mark.parametrize("table", TABLES)
@verifies("P312-PRT-04", "P312-CMD-00", "P312-CMD-FC-3")
def test_tables_and_plans(table: Table) -> None:
    begin = TIMING.arbitration + TIMING.effect
    assert begin + TIMING.filling(table) + TIMING.looking_up() + TIMING.answer + LONGEST <= 65_536
    assert begin + TIMING.data + 30 + TIMING.looking_up() + TIMING.answer + LONGEST <= 4096
    ends = [1, 2, 3, table.na, table.na + table.nd - 1, table.na + table.nd, 100_000]
    plans = [ramped(table, rate, n) for rate in {table.high, table.slowest} for n in [*ends, None] if n != 0]
    starts = [TIMING.starting(plan, ramped=True) for plan in plans]
    starts += [
        TIMING.starting(constant(table, table.high)),
        TIMING.starting(constant(table, table.high, 1), True),
    ]
    assert max(starts) + begin + TIMING.answer + LONGEST <= 4096
    # At 50 MHz, pulse 1 follows the header within 20 us, of which 5 us are the direction set-up.
    assert 2 + begin + max(starts) + 250 <= 20 * 50
