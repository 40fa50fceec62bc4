"""Tests that run on netlists: the unchanged tests of each part, on every family of the part.

Most tests run in every configuration. cocotb_tests/<part>/gates.py lists the exceptions, with reasons.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from cocotb_tests.gates import board
from cocotb_tests.harness import gate_tests, project
from cocotb_tests.harness import part as common_part
from cocotb_tests.harness.build import Design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.gate_tests import PartTests
from cocotb_tests.harness.project import ProjectError
from openppmc import parts
from scripts.fpga.flow import bits, boards, gates, plain

QUICK = "quick"
# The quick subset contains the tests that each part lists. They run on one family for each part, so each
# family has some of the parts. Most of the run time is synthesis.
QUICK_FAMILY = {"ppmc2104": "ice40", "stmc": "ice40", board.TOP: "ice40"}
QUICK_DEFAULT = "ecp5"

RECORDER = (("RECORD", 10),)
"""Parameters of the bitstreams for the self-test. A larger recorder needs RAM, which is not converted."""
PARAMS = {"bank": (), "pmc006": (("BAUD", 115_200),)}
"""Parameters of the bitstream for tests without a recorder, by part."""
TARGETS = {plain.FAMILY: "test-verilog", gates.BITS: "test-bits"}
"""Make target that repeats a test, by family; the default is test-gates."""
WRONG_EDGE = "first wrong edge"
"""Part of the message of a test that has found a difference from the golden model."""

TOO_BIG = "the part does not fit in this family"


def suites() -> list[PartTests]:
    """Return the tests for netlists, by part, from the table of parts."""
    return [row.load("gates") for row in parts.having("gates")]


def families(of: PartTests) -> list[str]:
    """Return the families of a part's tests: FPGA families with netlists, bitstreams, plain Verilog."""
    made = project.part(of.name).families if of.netlists else ()
    of_bits = [gates.BITS] if "ice40" in made else []
    return [*(family for family in gates.FAMILIES if family in made), *of_bits, plain.FAMILY]


@dataclass(frozen=True)
class GateTest:
    """One simulation of a netlist. `item` has the tag of the family; `group` is its row in the table.

    Attributes:
        params: parameters of the part's top.
        probes: as in `PartTests`.
        flipped: True if one bit of the bitstream is flipped, so that the test must find a wrong edge.
    """

    family: str
    item: Item
    quick: bool = False
    params: tuple[tuple[str, Any], ...] = ()
    probes: tuple[str, ...] = ()
    four_state: bool = False
    flipped: bool = False

    @property
    def on_board(self) -> bool:
        """True for a test of a board, False for a test of a part."""
        return self.item.module in (board.MODULE, board.PART_TESTS, board.PMC006)

    @property
    def top(self) -> str:
        """Top module of the netlist."""
        if self.family == gates.BITS and self.on_board:
            return boards.board(bits.BOARD, self.item.part).top["uart"]
        return board.TOP if self.item.module == board.MODULE else project.part(self.item.part).top

    def design(self) -> Design:
        """Return the design to be simulated; its netlist is synthesised if it is missing."""
        config = self.item.config
        if self.family == gates.BITS:
            if self.on_board:
                return bits.board_design(self.item.part, dict(self.params), self.flipped)
            return bits.part_design(self.item.part, dict(self.params))
        if self.top == board.TOP:
            folder = gates.netlist(self.family, board.TOP, board.sources(), board.params(config))
            return gates.design(self.family, board.TOP, folder)
        return gates.part_design(self.family, self.item.part, dict(self.params), self.probes)

    @property
    def group(self) -> tuple[str, str]:
        """Family, and name of the top with its configuration."""
        return self.family, f"{self.top} {self.item.config.name}{', one bit flipped' if self.flipped else ''}"

    def result(self, message: str) -> str:
        """Return the error message of the simulation, empty if the result is as required.

        If a bit is flipped, the simulation must fail with a wrong edge; any other result is an error.
        """
        if self.flipped:
            found = WRONG_EDGE in message
            return "" if found else f"{self.item.id}: the flipped bit was not found: {message or 'passed'}"
        return message


def left_out() -> dict[str, str]:
    """Return the tests in the parts' test modules that do not run on netlists, each with its reason.

    ProjectError is raised for a test function that has no reason, so that no test is omitted by mistake.
    """
    every = suites()
    reasons: dict[str, str] = {}
    for part in every:
        found = [name for name in part.functions if name not in part.simulating]
        if unknown := [name for name in found if name not in part.not_applicable]:
            raise ProjectError(
                f"gates.py of {part.name} gives no reason why {', '.join(unknown)} is left out"
            )
        reasons |= {name: part.not_applicable[name] for name in found}
    for part in every:
        reasons |= part.too_long
    reasons |= {f"{part.name} in {', '.join(part.unbuilt)}": part.why for part in every if part.unbuilt}
    for part in every:
        if not part.netlists:
            reasons[f"netlists of {part.name}"] = gate_tests.NO_NETLISTS
            continue
        too_big = [family for family in gates.FAMILIES if family not in families(part)]
        reasons |= {f"{part.name} on {family}": TOO_BIG for family in too_big}
    return reasons


def _is_quick(name: str, family: str) -> bool:
    return family in (QUICK_FAMILY.get(name, QUICK_DEFAULT), plain.FAMILY)


def _tagged(item: Item, family: str) -> Item:
    tag = f"{item.tag}-{family}" if item.tag else family
    return replace(item, tag=tag, target=TARGETS.get(family, "test-gates"))


def _test(part: PartTests, item: Item, family: str) -> GateTest:
    pins = part.pins or common_part.PARTS[item.part]
    params = {**pins.params(item.config), **part.params}
    quick = part.is_quick(item) and _is_quick(part.name, family)
    more = tuple(params.items()), part.probes
    return GateTest(family, _tagged(item, family), quick, *more, part.is_four_state(item))


def _directed(part: PartTests, family: str) -> list[GateTest]:
    return [_test(part, item, family) for item in part.items]


def _random(part: PartTests, family: str, seed: int | None) -> list[GateTest]:
    items = [make(n) for make, seeds in part.sample.items() for n in (seeds if seed is None else (seed,))]
    return [_test(part, item, family) for item in items if part.built(item)]


def _board(family: str) -> list[GateTest]:
    if family == gates.BITS:
        return _boards()
    quick = _is_quick(board.TOP, family)
    return [GateTest(family, _tagged(item, family), quick=quick) for item in board.items()]


def _boards() -> list[GateTest]:
    """Return the tests of the board's bitstreams: the tests of the quick sample, then one of each part."""
    config = replace(bits.config("ppmc104"), name=f"{bits.BOARD}-shipped")
    items = [replace(item, config=config) for item in board.items()]
    tests = [GateTest(gates.BITS, _tagged(item, gates.BITS), quick=True) for item in items]
    moves = next(item for item in items if item.test.startswith("board_moves"))
    flipped = _tagged(replace(moves, tag="flipped"), gates.BITS)
    tests.append(GateTest(gates.BITS, flipped, quick=True, flipped=True))
    for on in bits.DESCRIPTION.parts:
        if "uart" in on.hosts:
            item = board.part_test(on.part, bits.config(on.part, **(on.set or {})))
            tests.append(
                GateTest(gates.BITS, _tagged(item, gates.BITS), params=PARAMS.get(on.part, RECORDER))
            )
    return tests


def everything(seed: int | None = None, of: Sequence[str] = gates.FAMILIES) -> list[GateTest]:
    """Return all tests of these families, grouped by netlist. `seed` is the seed of the random hosts."""
    tests = []
    every = suites()
    for family in of:
        for part in every:
            if family in families(part):
                tests += [*_directed(part, family), *_random(part, family, seed)]
        tests += _board(family)
    return sorted(tests, key=lambda test: test.group)


def chosen(tests: Sequence[GateTest], word: str | None, four_state: bool = False) -> list[GateTest]:
    """Return the tests whose name contains `word`, or one of several words separated by commas.

    Upper and lower case are equal. The word `quick` selects the quick subset; if `four_state` is True, it
    selects the subset for a four-state simulator.
    """
    if word is None:
        return list(tests)
    if word == QUICK:
        return [test for test in tests if (test.four_state if four_state else test.quick)]
    words = word.lower().split(",")
    return [test for test in tests if any(word in test.item.id.lower() for word in words)]
