"""Results of a simulation from its log: only a run in which exactly the requested tests passed counts."""

from __future__ import annotations

from pathlib import Path

import pytest

from cocotb_tests.harness import D16, F11, F16, Config
from cocotb_tests.harness.build import Design, SimError, build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.config import ALL_CONFIGS
from cocotb_tests.harness.runner import groups_of
from cocotb_tests.harness.simulate import Outcome, failure_text, outcomes, repro_line

A, B = (Item("m", name, F16, "x", ()) for name in "ab")
HEAD = "     0.00ns INFO     cocotb.regression                  "
GOOD, BAD = (
    f"{HEAD}m.%s passed\n",
    f"{HEAD}m.%s failed\n  Traceback (most recent call last):\n    x\n  AssertionError: no\n",
)


def read(tmp_path: Path, text: str, names: str | None = "ab", trouble: str = "") -> dict[str, Outcome]:
    """Return the outcomes of tests a and b, from this log and a results.xml with these names."""
    log, results = tmp_path / "log.txt", tmp_path / "results.xml"
    log.write_text(text, encoding="utf-8")
    if names is not None:
        cases = "".join(f'<testcase name="{name}" classname="m"/>' for name in names)
        results.write_text(
            f'<testsuites><testsuite name="m">{cases}</testsuite></testsuites>', encoding="utf-8"
        )
    return {item.test: outcome for item, outcome in outcomes([A, B], log, results, trouble).items()}


def part(name: str, rest: str) -> str:
    """Return the section of a test in a log."""
    return f"{HEAD}running m.{name} (1/2)\n    Its first line.\n{rest}"


@pytest.mark.parametrize(
    ("log", "kinds"),
    [
        (part("a", GOOD % "a") + part("b", GOOD % "b"), "passed passed"),
        (part("a", BAD % "a") + part("b", GOOD % "b"), "failed passed"),
        (part("a", "[10] %Error: x.sv:3: no\n" + GOOD % "a") + part("b", GOOD % "b"), "failed passed"),
        (
            part("a", f"{HEAD}skipping m.a: why\n") + part("b", f"{HEAD}m.b xfailed: known\n"),
            "skipped xfailed",
        ),
    ],
)
def test_each_part_of_the_log_is_one_test(tmp_path: Path, log: str, kinds: str) -> None:
    found = read(tmp_path, log)
    assert [found[name].kind for name in "ab"] == kinds.split()


def test_a_process_that_ends_within_a_test(tmp_path: Path) -> None:
    """If the process ends within a test, this test is reported as crashed, and the following tests as not
    run.
    """
    found = read(tmp_path, part("a", "x\n"), None, "the simulator ended: -11")
    assert (found["a"].kind, found["b"].kind) == ("crashed", "did not run")
    assert found["a"].text.startswith("the simulator ended: -11\n")


@pytest.mark.parametrize("names", ["", "a", "abb", "ac"])
def test_other_tests_than_those_requested_are_a_failure(tmp_path: Path, names: str) -> None:
    found = read(tmp_path, part("a", GOOD % "a") + part("b", GOOD % "b"), names)
    assert all(outcome.kind == "failed" and "exactly" in outcome.text for outcome in found.values())


def test_a_bad_end_of_good_tests_is_a_failure(tmp_path: Path) -> None:
    """If the process fails although each test has passed, all its tests fail, because the log does not state
    which test caused this.
    """
    found = read(tmp_path, part("a", GOOD % "a") + part("b", GOOD % "b"), "ab", "the simulator ended: 1")
    assert {outcome.kind for outcome in found.values()} == {"failed"}


def test_no_log_is_a_failure(tmp_path: Path) -> None:
    assert {outcome.kind for outcome in read(tmp_path, "", None).values()} == {"did not run"}


def test_failure_text_prefers_the_first_simulator_error() -> None:
    text = "INFO start\n[10] %Error: a.sv:3: Assertion failed\n%Error: $stop\n"
    text += "  Traceback (most recent call last):\n x"
    assert failure_text(text).startswith("[10] %Error: a.sv:3: Assertion failed")


def test_failure_text_shows_the_exception() -> None:
    text = "INFO\n   Traceback (most recent call last):\n     File x\n   AssertionError: AC-01\n"
    assert failure_text(text) == "  File x\nAssertionError: AC-01"


def test_groups_keep_the_order_and_are_even() -> None:
    """Tests with the same key are split evenly into groups and keep their order. Each test without a key is a
    separate group.
    """
    made = groups_of(range(100), lambda n: n % 2 or None)
    assert [len(group) for group in made] == [1, 25, 25] + [1] * 49
    assert made[1] == tuple(range(1, 50, 2)) and sorted(n for group in made for n in group) == list(
        range(100)
    )


def test_repro_line_names_test_seed_and_clock() -> None:
    item = Item("m", "p104_x/k=3", F11, "ppmc104", ())
    assert (
        repro_line([item, item.with_seed(2)], 9)
        == "make test T=p104_x.k.3-f11m,p104_x.k.3-f11m SEED=9 CLK_HZ=11059200"
    )


def test_configs_have_distinct_names_none_a_prefix_of_another() -> None:
    names = [config.name for config in ALL_CONFIGS]
    assert len(set(names)) == len(names)
    assert not [(a, b) for a in names for b in names if a != b and b.startswith(a + "-")]


def test_config_survives_json_and_knows_its_times() -> None:
    config = Config("x", clk_hz=11_059_200, timing="DATASHEET", extra=(("AXES", 2),))
    assert Config.from_json(config.to_json()) == config
    assert config.datasheet and not F16.datasheet and D16.datasheet
    # P104-GEN-03 and P104-EX-12: CYC rounds up; a quantum is 2.7648 cycles here.
    assert (F16.w, F11.w, F11.quanta(8), F16.us(34_000)) == (80, 56, 23, 544_000)
    assert all(c.period_ps % 2 == 0 for c in ALL_CONFIGS)


def test_build_failure_is_one_clear_error(tmp_path: Path) -> None:
    source = tmp_path / "broken.sv"
    source.write_text("module broken(input wire a); this is not SystemVerilog; endmodule\n", encoding="ascii")
    with pytest.raises(SimError, match="build of broken failed"):
        build(Design("broken", [source]))


def test_unknown_part_is_refused() -> None:
    with pytest.raises(SimError, match="does not know the pins of nosuchpart"):
        part_design("nosuchpart", F16)
