"""Selection of the tests for netlists, and how a netlist is built; `make test-gates` runs the tests."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cocotb_tests.harness import gate_tests
from cocotb_tests.harness.project import ProjectError
from cocotb_tests.harness.simulate import repro_line
from cocotb_tests.ppmc104 import test_part
from openppmc import parts
from scripts.fpga.flow import gates, plain
from scripts.measure import gate_suite

EVERYTHING = gate_suite.everything()
SUITES = gate_suite.suites()


@pytest.mark.parametrize("family", [*gates.FAMILIES, gates.BITS, plain.FAMILY])
def test_all_directed_tests_run_on_each_family(family: str) -> None:
    items = [(part, param.values[0]) for part in SUITES for param in part.directed.ITEMS]
    items = [(part, item) for part, item in items if family in gate_suite.families(part)]
    expected = {item.id for part, item in items if not part.is_too_long(item) and part.built(item)}
    here = {t.item.id for t in gate_suite.everything(None, (family,))}
    assert {f"{name}-{family}" for name in expected} <= here


def test_the_sample_of_random_hosts_uses_each_of_their_configurations() -> None:
    for part in SUITES:
        if part.random is None:
            continue
        make, all_seeds = part.random.random_item, part.random.SEEDS
        used = {make(seed).config.name for seed in part.sample[make]}
        assert used == {item.config.name for item in map(make, all_seeds) if part.built(item)}


def test_names_are_unique_and_hold_the_family() -> None:
    names = [t.item.id for t in EVERYTHING]
    assert len(set(names)) == len(names)
    assert all(t.item.id.endswith(t.family) for t in EVERYTHING)


def test_a_failure_is_repeated_by_the_same_target() -> None:
    test = EVERYTHING[0]
    assert repro_line([test.item], 7) == f"make test-gates T={test.item.id} SEED=7"
    test = gate_suite.everything(None, (plain.FAMILY,))[0]
    assert repro_line([test.item], 7) == f"make test-verilog T={test.item.id} SEED=7"


def test_the_line_that_repeats_a_random_host_chooses_it() -> None:
    test = next(t for t in EVERYTHING if t.item.test == "random_host")
    assert test in gate_suite.chosen(gate_suite.everything(test.item.seed), test.item.id)


def test_choosing() -> None:
    assert gate_suite.chosen(EVERYTHING, None) == EVERYTHING
    assert gate_suite.chosen(EVERYTHING, "nosuchtest") == []
    quick = gate_suite.chosen(EVERYTHING, "quick")
    assert 60 < len(quick) < 150
    assert {t.family for t in quick} == set(gates.FAMILIES)
    assert {t.top for t in quick} == {"ppmc104", "ppmc2104", "stmc", "ppmc312", "pmc006", "ppmc104_carrier"}
    quick = gate_suite.chosen(gate_suite.everything(None, (plain.FAMILY,)), "quick")
    assert {t.top for t in quick} >= {row.top for row in parts.tops()} - {"j105_stmc"}
    some = gate_suite.chosen(EVERYTHING, "D16-ECP5")
    assert some and all(t.group[0] == "ecp5" for t in some)


def test_what_is_left_out_has_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    reasons = (gate_tests.OTHER_BUILDS, gate_tests.COSTLY_BUILDS)
    builds = {name: why for name, why in gate_suite.left_out().items() if why in reasons}
    families = {"ppmc312 on ice40": gate_suite.TOO_BIG}
    no_netlists = dict.fromkeys(("netlists of isa_4axis", "netlists of bank"), gate_tests.NO_NETLISTS)
    listed = {}
    for part in SUITES:
        listed |= {**part.not_applicable, **part.too_long}
    builds |= {f"bank in {', '.join(part.unbuilt)}": part.why for part in SUITES if part.name == "bank"}
    builds |= {
        f"isa_4axis in {', '.join(part.unbuilt)}": part.why for part in SUITES if part.name == "isa_4axis"
    }
    assert gate_suite.left_out() == {**listed, **builds, **families, **no_netlists}
    named = {name.split(" in ")[0] for name in builds}
    assert named == {"isa_4axis", "stmc", "j105_stmc", "ppmc312", "bank", "pmc006"}
    for part in SUITES:
        items = [param.values[0] for param in part.directed.ITEMS]
        assert set(part.too_long) <= {name for item in items for name in gate_tests.names(item)}
        assert part.simulating | set(part.not_applicable) == set(part.functions)
    monkeypatch.setattr(test_part, "test_something_new", lambda: None, raising=False)
    with pytest.raises(ProjectError, match="gives no reason why test_something_new is left out"):
        gate_suite.left_out()


def test_the_control_file_shows_the_ports_and_nothing_else() -> None:
    text = gates.control_file("top", ["clk", "d_i"], "ecp5")
    assert [line for line in text.splitlines() if "public" in line] == [
        'public_flat_rw -module "top" -var "clk"',
        'public_flat_rw -module "top" -var "d_i"',
    ]


def test_another_parameter_source_or_yosys_is_another_netlist() -> None:
    job = {
        **{"top": "t", "include": [], "sources": ["rtl/common/ppmc_sync.sv"], "params": {"N": 1}},
        **{"family": "ice40", "recipe": "flow2"},
    }
    others = [
        {**job, "params": {"N": 2}},
        {**job, "sources": ["rtl/common/ppmc_ram.sv"]},
        {**job, "recipe": "default"},
        {**job, "family": "ecp5", "recipe": "flow2-soft"},
    ]
    assert len({gates._digest(each, "0.70") for each in (job, *others)}) == 5
    assert gates._digest(job, "0.71") != gates._digest(job, "0.70") == gates._digest(dict(job), "0.70")


def test_tests_of_the_suite_are_those_of_the_part() -> None:
    """The tests on netlists are the tests of `make test`, except for their tag and their make target."""
    own = {param.values[0].id: param.values[0] for part in SUITES for param in part.directed.ITEMS}
    for test in EVERYTHING:
        if test.item.module.startswith(
            ("cocotb_tests.ppmc", "cocotb_tests.stmc")
        ) and not test.item.tag.startswith("r0"):
            item = own[test.item.id.removesuffix(f"-{test.family}")]
            assert replace(test.item, tag="", target="test") == item
