"""Hand-made mutants (`python -m scripts.measure.mutants`): each entry fits the RTL and the tests."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.paths import ROOT
from scripts.measure.mutants.table import Mutant, mutants

EVERY = list(mutants())


@pytest.mark.parametrize("mutant", [pytest.param(one, id=one.id) for one in EVERY])
def test_a_mutant_fits_the_tree(mutant: Mutant) -> None:
    """The old text of a mutant occurs once in the source file that the mutant changes; the new text differs,
    and the tests of the mutant simulate this file.
    """
    assert mutant.new != mutant.old
    mutant.source()
    items = mutant.items()
    assert items
    assert ROOT / mutant.file in mutant.unchanged_design(items[0]).sources
    assert not mutant.caught or mutant.caught in {item.test for item in mutant.items(wide=True)}
    assert bool(mutant.caught) == (not mutant.tests) == (not mutant.why)


def test_there_are_enough() -> None:
    """There are at least forty mutants, among them some of each device."""
    assert len(EVERY) >= 40
    assert {one.part for one in EVERY} == {"ppmc104", "ppmc2104", "stmc", "ppmc312", "bank", "pmc006"}
    assert len({one.id for one in EVERY}) == len(EVERY)
