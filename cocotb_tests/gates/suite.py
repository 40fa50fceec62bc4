"""Which tests run on netlists: the part tests as they are, under every configuration, on every family."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cocotb_tests.common.collect import Item
from cocotb_tests.common.config import F16
from cocotb_tests.common.runner import Design
from cocotb_tests.gates import board
from cocotb_tests.ppmc104 import test_ppmc104, test_random
from scripts.flow import gates
from scripts.project import ProjectError

QUICK = "quick"
# The quick subset: these modules under F16 on all families, and the board on one.
QUICK_MODULES = ("tb_acceptance_1", "tb_bus")
QUICK_BOARD = "ice40"

# Random hosts and noise runs of the sample; together the hosts use every configuration they choose from.
HOST_SEEDS = (1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 18, 37, 62)
CHAOS_SEEDS = (1, 2, 3, 5)

# Test functions that are no simulation of the part: what a netlist has to do with them.
NOT_APPLICABLE = {
    "test_p104_par_01_ranges": "elaborates illegal parameters; those of a netlist are fixed",
    "test_scenarios_are_reproducible_and_varied": "checks the generator of the random hosts; no simulation",
}
SIMULATING = {"test_ppmc104", "test_random", "test_chaos"}


@dataclass(frozen=True)
class GateTest:
    """One simulation of one netlist. `item` is tagged with the family; `group` is its row in the table."""

    family: str
    item: Item
    quick: bool = False

    @property
    def top(self) -> str:
        """Top module of the netlist."""
        return board.TOP if self.item.module == board.MODULE else self.item.part

    def design(self) -> Design:
        """What is simulated; synthesizes the netlist if there is none."""
        config = self.item.config
        if self.top == board.TOP:
            folder = gates.netlist(self.family, board.TOP, board.sources(), board.params(config))
            return gates.design(self.family, board.TOP, folder)
        return gates.part_design(self.family, self.top, config.params)

    @property
    def group(self) -> tuple[str, str]:
        """Family and configuration; the board's name says that it is not the part alone."""
        name = self.item.config.name
        return self.family, f"board {name}" if self.top == board.TOP else name


def left_out() -> dict[str, str]:
    """Test functions of the part's test modules that do not run on netlists, with the reason.

    ProjectError for one that has no reason: nothing is left out unseen.
    """
    found = [
        name
        for module in (test_ppmc104, test_random)
        for name in vars(module)
        if name.startswith("test_") and name not in SIMULATING
    ]
    if unknown := [name for name in found if name not in NOT_APPLICABLE]:
        raise ProjectError(f"cocotb_tests/gates/suite.py does not say why {', '.join(unknown)} is left out")
    return {name: NOT_APPLICABLE[name] for name in found}


def _tagged(item: Item, family: str) -> Item:
    tag = f"{item.tag}-{family}" if item.tag else family
    return replace(item, tag=tag, target="test-gates")


def _directed(family: str) -> list[GateTest]:
    tests = []
    for param in test_ppmc104.ITEMS:
        item: Item = param.values[0]
        chosen = item.module.rsplit(".", 1)[-1] in QUICK_MODULES
        tests.append(GateTest(family, _tagged(item, family), quick=chosen and item.config == F16))
    return tests


def _random(family: str, seed: int | None) -> list[GateTest]:
    hosts = [test_random.random_item(n) for n in (HOST_SEEDS if seed is None else (seed,))]
    noise = [test_random.chaos_item(n) for n in (CHAOS_SEEDS if seed is None else (seed,))]
    return [GateTest(family, _tagged(item, family)) for item in (*hosts, *noise)]


def _board(family: str) -> list[GateTest]:
    return [GateTest(family, _tagged(item, family), quick=family == QUICK_BOARD) for item in board.items()]


def everything(seed: int | None = None) -> list[GateTest]:
    """All gate-level tests, those of one netlist side by side; `seed` chooses another random host."""
    tests = []
    for family in gates.FAMILIES:
        tests += [*_directed(family), *_random(family, seed), *_board(family)]
    return sorted(tests, key=lambda test: test.group)


def chosen(tests: Sequence[GateTest], word: str | None) -> list[GateTest]:
    """The tests whose name holds `word` (case does not count); `quick` stands for the quick subset."""
    if word is None:
        return list(tests)
    if word == QUICK:
        return [test for test in tests if test.quick]
    return [test for test in tests if word.lower() in test.item.id.lower()]
