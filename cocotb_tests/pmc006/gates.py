"""What `make test-gates` runs of the PMC006B4, and what it leaves out and why."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import COSTLY_BUILDS, GENERATOR, PartTests

from . import test_random, test_scripts
from .modules import F8B

SAME_BLOCKS = "2 to 15 million clk; p006_tour, _bridge, _current and random hosts have the same blocks"
SHORT = ("p006_tour", "p006_bridge", "p006_current", "p006_streams")

PART = PartTests(
    test_scripts,
    frozenset({"test_scripts", "test_random"}),
    test_random,
    {test_random.random_item: (3, 4, 5, 6)},
    frozenset({F8B.name}),
    COSTLY_BUILDS,
    not_applicable={
        "test_scenarios_are_reproducible_and_varied": GENERATOR,
        "test_hosts_are_rich": GENERATOR,
        "test_random_with_eeprom": "needs the EEPROM in the bench's top; those of a netlist have none",
    },
    too_long={
        item.test: SAME_BLOCKS
        for item in (param.values[0] for param in test_scripts.ITEMS)
        if item.test not in SHORT
    },
    quick=frozenset({"p006_tour"}),
    quick_build=F8B.name,
)
