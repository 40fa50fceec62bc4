"""Every latency of this PPMC-312 core is within the window that the rules allow."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.ppmc312.timing import Pace
from openppmc.model.ppmc312.stages import Table, constant, ramped
from tests.ppmc312.model.reference import T1, T2, T3, T4, T5, TF, TG, TH

PACE = Pace()
TABLES = (T1, T2, T3, T4, T5, TF, TG, TH)
LONGEST = 32
"""Bytes of the longest answer."""


@verifies(
    "P312-PRT-04", "P312-PAR-05", "P312-PAR-08", "P312-RSP-20", "P312-MOT-01", "P312-MOT-05", "P312-OVR-02"
)
def test_fixed_latencies() -> None:
    begin = PACE.turn + PACE.effect
    assert begin + PACE.copy + PACE.answer + LONGEST <= 4096
    assert begin <= 64  # instruction 80: no rising edge later than 64 cycles after the header
    assert begin + PACE.look_up() + PACE.ramp_lead <= 512
    assert PACE.answer + 4 <= 64  # the answer to a start follows t0
    assert PACE.report + PACE.rest <= 64 and PACE.turn_back <= 64
    assert PACE.count <= 2 and PACE.armed <= 4 and PACE.late <= 4 and PACE.reload >= 8
    assert PACE.compare + 2 <= PACE.least == 4  # a stop at a position precedes the next pulse
    assert PACE.slow_lead <= 4 and PACE.lead + 2 <= 4 and PACE.origin_lead + 2 <= 4


@pytest.mark.parametrize("table", TABLES)
@verifies("P312-PRT-04", "P312-CMD-00", "P312-CMD-FC-3")
def test_tables_and_plans(table: Table) -> None:
    begin = PACE.turn + PACE.effect
    assert begin + PACE.filling(table) + PACE.looking_up() + PACE.answer + LONGEST <= 65_536
    assert begin + PACE.data + 30 + PACE.looking_up() + PACE.answer + LONGEST <= 4096
    ends = [1, 2, 3, table.na, table.na + table.nd - 1, table.na + table.nd, 100_000]
    plans = [ramped(table, rate, n) for rate in {table.high, table.slowest} for n in [*ends, None] if n != 0]
    starts = [PACE.starting(plan, ramped=True) for plan in plans]
    starts += [
        PACE.starting(constant(table, table.high)),
        PACE.starting(constant(table, table.high, 1), True),
    ]
    assert max(starts) + begin + PACE.answer + LONGEST <= 4096
    # At 50 MHz pulse 1 occurs within 20 us of the header; 5 us of this time are direction set-up.
    assert 2 + begin + max(starts) + 250 <= 20 * 50
