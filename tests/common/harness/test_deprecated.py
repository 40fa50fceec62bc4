"""Old names of the harness and of the environments still work and emit a DeprecationWarning."""

from __future__ import annotations

from importlib import import_module

import pytest

from cocotb_tests import harness

OLD = {
    "Bench": "RtlBench",
    "Drive": "AxisDriver",
    "Side": "DutBench",
    "Unit": "BlockDriver",
    "inside": "probe",
}


@pytest.mark.parametrize("old", OLD)
def test_old_names_of_the_harness(old: str) -> None:
    """An old name returns the object of the new name, and the warning states the new name."""
    with pytest.warns(DeprecationWarning, match=rf"^cocotb_tests\.harness\.{old} is now {OLD[old]};"):
        assert getattr(harness, old) is getattr(harness, OLD[old])
    assert old not in harness.__all__


@pytest.mark.parametrize("part", ["ppmc104", "ppmc2104", "stmc"])
def test_old_name_of_an_environment(part: str) -> None:
    """`Lab` of the old module `lab` is `Env`; the old module has no other names."""
    module = import_module(f"cocotb_tests.{part}.lab")
    with pytest.warns(DeprecationWarning, match="Lab is now Env;"):
        assert module.Lab is import_module(f"cocotb_tests.{part}.env").Env
    with pytest.raises(AttributeError, match="no attribute 'Laboratory'"):
        module.Laboratory  # noqa: B018
