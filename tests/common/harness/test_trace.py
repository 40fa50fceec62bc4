"""The traceability script and `@verifies`: rules without tests, unknown IDs and failures are all reported."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cocotb_tests.harness import verifies
from cocotb_tests.harness.collect import RULE_ID, part_of_rule, rules_of
from scripts.measure.prove.results import by_rule
from scripts.measure.trace import join, page, unproved

RULES = {"P104-BUS-01": "Register map", "P104-BUS-02": "Strobes", "AC-01": "Reset levels"}


def record(
    test: str, *rules: str, outcome: str = "passed", config: str = "f16", runs: int = 1
) -> dict[str, object]:
    """Return a line of results in the format of the pytest plugin."""
    return {"test": f"t.py::t[{test}-{config}]", "name": test, "part": "ppmc104", "config": config,
            "runs": runs, "rules": list(rules), "outcome": outcome}  # fmt: skip


def test_all_covered_and_passing_has_no_problem() -> None:
    trace = join(RULES, [record("a", *RULES), record("a", *RULES, config="f8m", runs=25)], "ppmc104")
    assert trace.problems == []
    assert "`a` ×26 (f16, f8m) | pass |" in page(trace, "ppmc104")
    assert "2 of 2 rules and 1 of 1 acceptance checks" in page(trace, "ppmc104")


def test_rule_without_test_is_a_problem() -> None:
    trace = join(RULES, [record("a", "P104-BUS-01", "AC-01")], "ppmc104")
    assert trace.problems == ["rule without a passing test: P104-BUS-02"]
    assert "| P104-BUS-02 | Strobes | none | NO TEST |" in page(trace, "ppmc104")


def test_unknown_rule_is_a_problem() -> None:
    trace = join(RULES, [record("a", *RULES, "P104-BUS-99")], "ppmc104")
    assert trace.problems == ["unknown rule P104-BUS-99: named by t.py::t[a-f16]"]


def test_failed_test_is_a_problem_even_if_another_passes() -> None:
    trace = join(RULES, [record("a", *RULES), record("b", "P104-BUS-01", outcome="failed")], "ppmc104")
    assert trace.problems == ["test failed: t.py::t[b-f16]"]
    assert "| P104-BUS-01 | Register map | `a` (f16)<br>`b` (f16) | FAIL |" in page(trace, "ppmc104")


def test_rule_whose_only_test_failed_is_reported_twice() -> None:
    trace = join({"P104-BUS-01": "x"}, [record("b", "P104-BUS-01", outcome="failed")], "ppmc104")
    assert trace.problems == ["rule without a passing test: P104-BUS-01", "test failed: t.py::t[b-f16]"]


def test_rules_of_other_parts_are_left_alone() -> None:
    trace = join(RULES, [record("a", *RULES, "P2104-BUS-01")], "ppmc104")
    assert trace.problems == []


def test_acceptance_checks_of_other_parts_are_left_alone() -> None:
    other = {**record("b", "P104-BUS-01", "AC-01", outcome="failed"), "part": "ppmc2104"}
    trace = join(RULES, [record("a", *RULES), other], "ppmc104")
    assert trace.problems == ["test failed: t.py::t[b-f16]"]
    assert trace.result("AC-01") == "pass" and trace.result("P104-BUS-01") == "FAIL"


def test_a_board_is_in_the_manual_of_its_part() -> None:
    rules = {"STMC-BUS-01": "Access", "J105-01": "Addresses", "AC-46": "Board"}
    board = {**record("b", "J105-01", "AC-46"), "part": "j105_stmc"}
    assert join(rules, [{**record("a", "STMC-BUS-01"), "part": "stmc"}, board], "stmc").problems == []


def test_page_does_not_depend_on_the_order_of_results() -> None:
    records = [record(name, *RULES) for name in "cab"]
    assert page(join(RULES, records, "ppmc104"), "ppmc104") == page(
        join(RULES, records[::-1], "ppmc104"), "ppmc104"
    )


def test_verifies_keeps_order_and_merges() -> None:
    @verifies("P104-BUS-01")
    @verifies("AC-01", "P104-BUS-01")
    def target() -> None: ...

    assert rules_of(target) == ("P104-BUS-01", "AC-01")


@pytest.mark.parametrize("rule", ["P104-BUS-1", "BUS-01", "P999-BUS-01", "AC-1", "p104-bus-01", ""])
def test_verifies_refuses_what_is_no_rule_id(rule: str) -> None:
    assert not RULE_ID.match(rule)
    with pytest.raises(ValueError, match="not a rule ID"):
        verifies(rule)


def test_part_of_rule() -> None:
    assert part_of_rule("P104-BUS-01") == "ppmc104"
    assert part_of_rule("P2104-BUS-01") == "ppmc2104"
    assert part_of_rule("J105-01") == part_of_rule("STMC-BUS-01") == "stmc"
    assert part_of_rule("AC-07") is None


def test_proofs_are_listed_with_the_tests() -> None:
    """The row of a rule names its proofs; a bounded proof has its number of cycles."""
    rules = {"P104-OPR-02": "Count", "P104-BUS-01": "Register map"}
    trace = join(rules, [record("a", *rules)], "ppmc104")
    first, second, *_ = by_rule()["P104-OPR-02"]
    trace.proofs = {"P104-OPR-02": [first, replace(second, bound=40)]}
    shown = page(trace, "ppmc104")
    assert "| pass | `ppmc_ramp_seq`<br>`ppmc_axis_count` (40 cycles) |" in shown
    assert "| P104-BUS-01 | Register map | `a` (f16) | pass |  |" in shown
    assert "1 of them are proved as well" in shown
    strange = {"P104-OPR-77": trace.proofs["P104-OPR-02"]}
    assert unproved(strange, rules, "ppmc104") == ["unknown rule P104-OPR-77: named by proof ppmc_ramp_seq"]
