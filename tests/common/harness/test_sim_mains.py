"""The project's own simulation main program and that of cocotb produce the same pins, accesses and output
edges.

`python -m scripts.measure.sim_mains WORD` compares any other test in the same way.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness.config import SEEDS
from cocotb_tests.harness.gate_tests import PartTests
from cocotb_tests.harness.random_items import batches
from cocotb_tests.harness.runner import check_mains
from openppmc import parts

# One directed test per device. Together they contain resets between two edges, short strobes and moves.
DIRECTED = {
    "ppmc104": "p104_ac_57_reset_in_motion-f16",
    "ppmc2104": "p2104_ac_30_what_refuses-f16",
    "stmc": "stmc_ini_07_reset_in_the_build-f16",
    "ppmc312": "p312_reset_while_running_leaves_no_state-f16",
    "pmc006": "p006_sequence-f8b",
}


def suite_of(name: str) -> PartTests:
    """Return the tests of a device."""
    found: PartTests = parts.part(name).load("gates")
    return found


@pytest.mark.parametrize("name", DIRECTED)
def test_a_directed_test_records_the_same_on_both_mains(name: str) -> None:
    """The recordings of a directed test on both main programs have the same digest."""
    (item,) = [item for item in suite_of(name).items if item.id == DIRECTED[name]]
    assert check_mains(item) >= 1


@pytest.mark.parametrize("name", DIRECTED)
def test_random_hosts_record_the_same_on_both_mains(name: str) -> None:
    """The recordings of several random hosts in one simulation have the same digests on both main
    programs.
    """
    tests = suite_of(name)
    make, seeds = next(iter(tests.sample.items()))
    sets = batches([make(seed) for seed in seeds], 3)
    item, batch = next((one for one in sets if one[0].config.name == tests.quick_build), sets[0])
    assert check_mains(item, {SEEDS: batch}) == len(batch.split())


def test_all_parts_with_random_hosts_are_here() -> None:
    """DIRECTED contains every device that has random hosts."""
    assert set(DIRECTED) == {row.name for row in parts.having("gates") if suite_of(row.name).sample}
