"""Ports and parameters of the top module, checked with its source and by elaboration."""

from __future__ import annotations

from cocotb_tests.harness import check_ranges, verifies
from cocotb_tests.harness.build import part_design, ports

from .bench import PMC006
from .builds import F8B

RANGES = {
    "BAUD": (["1200", "115200"], ["1199", "115201"]),
    "STEP_ACK": (['"ECHO"'], ['"OTHER"']),
    "T_OFF_NS": (["100000"], ["999"]),
}


@verifies("P006-PORT-01", "P006-PORT-02", "P006-PORT-03", "P006-PORT-04")
def test_p006_ports() -> None:
    """The top has exactly the ports of docs/pmc006/README.md, 2.

    It has no ports for the supply and CAN pins of the original chip, which in turn has no mon_* ports.
    """
    found = ports(part_design("pmc006", F8B))
    expected = {name: ("input", PMC006.width(name) - 1, 0) for name in (*PMC006.inputs, "clk", "rst_n")}
    expected |= {name: ("output", PMC006.width(name) - 1, 0) for name in PMC006.outputs}
    assert found == expected


@verifies("P006-PAR-01")
def test_p006_parameter_ranges() -> None:
    """Parameter values outside the ranges of docs/pmc006/README.md, 2 fail at elaboration."""
    check_ranges("P006-PAR-01", part_design("pmc006", F8B), RANGES)
