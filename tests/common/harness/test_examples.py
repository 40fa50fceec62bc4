"""examples/cocotb: its tests pass in simulations with the main program that cocotb supplies
(SIM_MAIN=cocotb); a broken example fails with an AssertionError.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from cocotb_tests.harness import F16
from cocotb_tests.harness.build import SimError, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.project import ROOT
from cocotb_tests.harness.runner import run_sim

EXAMPLE = ROOT / "examples" / "cocotb"
EXACT = "the examples know nothing of JITTER=1"
PLAIN = Item("test_ppmc104", "ramp_of_fourteen_pulses", F16, "ppmc104", (), exact=EXACT)
WITH_MODEL = Item("test_with_model", "ramp_as_the_golden_model_has_it", F16, "ppmc104", (), exact=EXACT)


def run(item: Item, folder: Path) -> None:
    """Run the test as the Makefile does; SimError states the failure."""
    run_sim(replace(part_design(item.part, item.config), main="cocotb"), item, 1, folder=folder)


@pytest.mark.parametrize("item", [PLAIN, WITH_MODEL], ids=lambda item: item.module)
def test_the_example_passes(item: Item, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(EXAMPLE)
    run(item, tmp_path / "run")


def test_it_imports_nothing_of_this_project() -> None:
    text = (EXAMPLE / "test_ppmc104.py").read_text(encoding="utf-8")
    imports = [line for line in text.splitlines() if line.startswith(("import ", "from "))]
    assert {line.split()[1].partition(".")[0] for line in imports} == {"cocotb"}


@pytest.mark.parametrize(
    ("right", "wrong"), [("== 14", "== 15"), ("5 * [100]", "5 * [101]"), ("(DATA, 13)", "(DATA, 14)")]
)
def test_it_fails_when_broken(
    right: str, wrong: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wrong expected value, or a host that commands another move, makes the test fail."""
    text = (EXAMPLE / "test_ppmc104.py").read_text(encoding="utf-8")
    assert right in text
    (tmp_path / "broken_ppmc104.py").write_text(text.replace(right, wrong), encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(SimError, match="AssertionError"):
        run(replace(PLAIN, module="broken_ppmc104"), tmp_path / "run")
