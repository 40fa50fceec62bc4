"""Which tests run on netlists: the part tests as they are, on every family that the part is made for, mostly
in every configuration.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import ModuleType

from cocotb_tests.gates import board
from cocotb_tests.harness import part as common_part
from cocotb_tests.harness import project
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.config import F16
from cocotb_tests.harness.project import ProjectError
from cocotb_tests.harness.runner import Design
from cocotb_tests.pmc006 import test_random as test_random_006
from cocotb_tests.pmc006 import test_scripts as test_pmc006
from cocotb_tests.pmc006.modules import F8B
from cocotb_tests.ppmc104 import test_part as test_ppmc104
from cocotb_tests.ppmc104 import test_random
from cocotb_tests.ppmc312 import test_random as test_random_312
from cocotb_tests.ppmc312 import test_scripts as test_ppmc312
from cocotb_tests.ppmc2104 import test_part as test_ppmc2104
from cocotb_tests.ppmc2104 import test_random as test_random_2104
from cocotb_tests.stmc import test_board as test_j105_stmc
from cocotb_tests.stmc import test_part as test_stmc
from cocotb_tests.stmc import test_random as test_random_stmc
from scripts.flow import gates

QUICK = "quick"
# The quick subset: these modules and tests in one build on all families of the part, and the board on one.
QUICK_MODULES = ("cocotb_tests.ppmc104.tb_acceptance_moves", "cocotb_tests.ppmc104.tb_bus")
QUICK_MODULES += ("cocotb_tests.ppmc2104.tb_acceptance_errors", "cocotb_tests.stmc.tb_init")
QUICK_TESTS = ("p312_bus", "p312_serial_tour", "p006_tour")
QUICK_BUILDS = (F16, F8B)
QUICK_BOARD = "ice40"

OTHER_BUILDS = "other clocks or times; netlists of the sister part have such clocks in the same blocks"
TOO_BIG = "the part does not fit into this family"
COSTLY_BUILDS = "other clocks or times; synthesis of another netlist takes minutes"


@dataclass(frozen=True)
class PartTests:
    """The tests of one part: its directed and random test modules.

    `sample` is the sample of its random tests: what makes the item of a seed, and the seeds. Together the
    hosts of a sample use every configuration they choose from. `builds`: names of the configurations that
    netlists are made of, for the reason in `why`; none: all.
    """

    directed: ModuleType
    random: ModuleType | None = None
    sample: Mapping[Callable[[int], Item], Sequence[int]] = field(default_factory=dict)
    builds: frozenset[str] = frozenset()
    why: str = OTHER_BUILDS

    @property
    def name(self) -> str:
        """The part's name."""
        return self.directed.ITEMS[0].values[0].part

    @property
    def families(self) -> list[str]:
        """FPGA families that the part is made for."""
        return [family for family in gates.FAMILIES if family in project.part(self.name).families]

    @property
    def items(self) -> list[Item]:
        """The directed tests that run on netlists."""
        items = [param.values[0] for param in self.directed.ITEMS]
        return [item for item in items if item.test not in TOO_LONG and self.built(item)]

    def built(self, item: Item) -> bool:
        """Whether there are netlists of its configuration."""
        return not self.builds or item.config.name in self.builds

    @property
    def unbuilt(self) -> list[str]:
        """Names of the configurations without netlists."""
        items = [param.values[0] for param in self.directed.ITEMS]
        return sorted({item.config.name for item in items if not self.built(item)})


PARTS = (
    PartTests(
        test_ppmc104,
        test_random,
        {
            test_random.random_item: (1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 18, 37, 62),
            test_random.chaos_item: (1, 2, 3, 5),
        },
    ),
    PartTests(
        test_ppmc2104,
        test_random_2104,
        {
            test_random_2104.random_item: (1, 2, 4, 7, 9, 10, 11, 25, 27, 38),
            test_random_2104.pair_item: (1, 2),
            test_random_2104.chaos_item: (1, 2, 3, 5),
        },
    ),
    # Clocks and DATASHEET times are those of the PPMC-104BFP, in the same blocks.
    PartTests(
        test_stmc,
        test_random_stmc,
        {test_random_stmc.random_item: (1, 3, 4, 5, 7, 8, 10, 13, 65), test_random_stmc.chaos_item: (1, 4)},
        frozenset({"f16", "family", "d25x8"}),
    ),
    PartTests(test_j105_stmc, builds=frozenset({"f16"})),
    PartTests(
        test_ppmc312,
        test_random_312,
        {
            test_random_312.random_item: (2, 3, 4, 5, 6, 8),
            test_random_312.noise_item: (1, 4, 7),
            test_random_312.serial_item: (31,),
        },
        frozenset({"f16"}),
        COSTLY_BUILDS,
    ),
    PartTests(
        test_pmc006,
        test_random_006,
        {test_random_006.random_item: (3, 4, 5, 6)},
        frozenset({F8B.name}),
        COSTLY_BUILDS,
    ),
)

# Test functions that are no simulation of the part: what a netlist has to do with them.
NOT_APPLICABLE = {
    "test_p104_par_01_ranges": "elaborates illegal parameters; those of a netlist are fixed",
    "test_p2104_par_01_ranges": "elaborates illegal parameters; those of a netlist are fixed",
    "test_p2104_port_05_ports": "reads the ports from the source; no simulation",
    "test_stmc_parameter_ranges": "elaborates illegal parameters; those of a netlist are fixed",
    "test_j105_parameter_ranges": "elaborates illegal parameters; those of a netlist are fixed",
    "test_scenarios_are_reproducible_and_varied": "checks the generator of the random hosts; no simulation",
    "test_hosts_are_rich": "checks the generator of the random hosts; no simulation",
    "test_hosts_on_the_line_are_rich": "checks the generator of the random hosts; no simulation",
}
SIMULATING = {"test_ppmc104", "test_ppmc2104", "test_stmc", "test_board"}
SIMULATING |= {
    "test_random",
    "test_chaos",
    "test_independent_axes",
    "test_scripts",
    "test_noise",
    "test_serial",
}

# Simulations that are left out, because a netlist would take far too long for so many clk.
TOO_LONG = {
    "p2104_ac_12_largest_ramp": "15 million clk; p2104_rmp_02_long_ramp_up has the same ramp",
    "p2104_ac_68_ramps_and_two_axes": "12 million clk in settings; p2104_ac_67_rate_bytes has the comparison",
    "p312_transactions": "8 million clk; p312_motion, p312_abnormal and p312_bus have the same instructions",
    "p312_terminals": "3 million clk, most of them waiting for clear pulses and for the current reduction",
    **dict.fromkeys(
        (
            f"p312_serial_{name}"
            for name in ("checks", "transactions", "line", "frames", "codes", "polls", "resets")
        ),
        "4 to 15 million clk; p312_serial_tour and the random hosts of the line have the same blocks",
    ),
    "p312_checks_motion": "15 million clk; p312_motion and p312_bounds have shorter moves of all kinds",
    **{
        item.test: "2 to 15 million clk; p006_tour, _bridge, _current and random hosts have the same blocks"
        for item in (param.values[0] for param in test_pmc006.ITEMS)
        if item.test not in ("p006_tour", "p006_bridge", "p006_current", "p006_streams")
    },
}


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
        return gates.part_design(self.family, self.top, common_part.PARTS[self.top].params(config))

    @property
    def group(self) -> tuple[str, str]:
        """Family, and the top with its configuration."""
        return self.family, f"{self.top} {self.item.config.name}"


def left_out() -> dict[str, str]:
    """Tests of the parts' test modules that do not run on netlists, with the reason.

    ProjectError for a test function that has no reason: nothing is left out unseen.
    """
    found = [
        name
        for part in PARTS
        for module in (part.directed, part.random)
        if module
        for name in vars(module)
        if name.startswith("test_") and name not in SIMULATING
    ]
    if unknown := [name for name in found if name not in NOT_APPLICABLE]:
        raise ProjectError(f"scripts/flow/gate_suite.py does not say why {', '.join(unknown)} is left out")
    builds = {f"{part.name} in {', '.join(part.unbuilt)}": part.why for part in PARTS if part.unbuilt}
    families = {
        f"{part.name} on {family}": TOO_BIG
        for part in PARTS
        for family in gates.FAMILIES
        if family not in part.families
    }
    return {**{name: NOT_APPLICABLE[name] for name in found}, **TOO_LONG, **builds, **families}


def _tagged(item: Item, family: str) -> Item:
    tag = f"{item.tag}-{family}" if item.tag else family
    return replace(item, tag=tag, target="test-gates")


def _directed(part: PartTests, family: str) -> list[GateTest]:
    def quick(item: Item) -> bool:
        return (item.module in QUICK_MODULES or item.test in QUICK_TESTS) and item.config in QUICK_BUILDS

    return [GateTest(family, _tagged(item, family), quick(item)) for item in part.items]


def _random(part: PartTests, family: str, seed: int | None) -> list[GateTest]:
    items = [make(n) for make, seeds in part.sample.items() for n in (seeds if seed is None else (seed,))]
    return [GateTest(family, _tagged(item, family)) for item in items if part.built(item)]


def _board(family: str) -> list[GateTest]:
    return [GateTest(family, _tagged(item, family), quick=family == QUICK_BOARD) for item in board.items()]


def everything(seed: int | None = None) -> list[GateTest]:
    """All gate-level tests, those of one netlist side by side; `seed` chooses another random host."""
    tests = []
    for family in gates.FAMILIES:
        for part in PARTS:
            if family in part.families:
                tests += [*_directed(part, family), *_random(part, family, seed)]
        tests += _board(family)
    return sorted(tests, key=lambda test: test.group)


def chosen(tests: Sequence[GateTest], word: str | None) -> list[GateTest]:
    """The tests whose name holds `word` (case does not count); `quick` stands for the quick subset."""
    if word is None:
        return list(tests)
    if word == QUICK:
        return [test for test in tests if test.quick]
    return [test for test in tests if word.lower() in test.item.id.lower()]
