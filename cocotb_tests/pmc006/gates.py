"""The PMC006B4 tests that `make test-gates` runs, and those that it omits, with the reasons."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import COSTLY_BUILDS, GENERATOR, PartTests

from . import test_part, test_random
from .builds import F8B

SAME_BLOCKS = "2 to 15 million cycles a module; tb_sequence, tb_bridge and random hosts have the same blocks"
SHORT = ("tb_sequence", "tb_bridge", "tb_current", "tb_streams")

PART = PartTests(
    test_part,
    frozenset({"test_pmc006", "test_random"}),
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
        for item in (param.values[0] for param in test_part.ITEMS)
        if item.module.rpartition(".")[2] not in SHORT
    },
    quick=frozenset({"tb_sequence"}),
    quick_build=F8B.name,
    four_state=frozenset({"p006_sequence"}),
)
