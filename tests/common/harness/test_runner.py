"""The simulation runner's own judgement: nothing but "exactly this test ran and passed" counts."""

from __future__ import annotations

from pathlib import Path

import pytest

from cocotb_tests.harness import runner
from cocotb_tests.harness.build import Design, SimError, build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.config import ALL_CONFIGS, D16, F11, F16, Config


def results(tmp_path: Path, *cases: str) -> Path:
    """A results.xml with these test cases."""
    path = tmp_path / "results.xml"
    path.write_text(
        f'<testsuites name="r"><testsuite name="a">{"".join(cases)}</testsuite></testsuites>',
        encoding="utf-8",
    )
    return path


GOOD = '<testcase name="t" classname="m"/>'
BAD = '<testcase name="t" classname="m"><failure message="no"/></testcase>'
SKIPPED = '<testcase name="t" classname="m"><skipped/></testcase>'


def test_one_passed_test_is_good(tmp_path: Path) -> None:
    assert runner._judge(results(tmp_path, GOOD), "t") == ""


@pytest.mark.parametrize(
    ("cases", "word"),
    [
        ((), "exactly"),
        ((GOOD, GOOD), "exactly"),
        ((BAD,), "failed"),
        ((SKIPPED,), "skipped"),
        ((GOOD.replace('"t"', '"other"'),), "exactly"),
    ],
)
def test_everything_else_is_not(tmp_path: Path, cases: tuple[str, ...], word: str) -> None:
    assert word in runner._judge(results(tmp_path, *cases), "t")


def test_missing_results_are_a_failure(tmp_path: Path) -> None:
    assert "no results.xml" in runner._judge(tmp_path / "results.xml", "t")


def test_failure_text_prefers_the_first_simulator_error(tmp_path: Path) -> None:
    log = tmp_path / "log.txt"
    log.write_text(
        "INFO start\n[10] %Error: a.sv:3: Assertion failed\n%Error: $stop\n"
        "  Traceback (most recent call last):\n x",
        encoding="utf-8",
    )
    assert runner._failure_text(log).startswith("[10] %Error: a.sv:3: Assertion failed")


def test_failure_text_shows_the_exception_without_colours(tmp_path: Path) -> None:
    log = tmp_path / "log.txt"
    log.write_text(
        "INFO\n   \x1b[31mTraceback (most recent call last):\n     File x\n   AssertionError: AC-01\n",
        encoding="utf-8",
    )
    assert "AssertionError: AC-01" in runner._failure_text(log)
    assert "\x1b" not in runner._failure_text(log) and "INFO" not in runner._failure_text(log)


def test_repro_line_names_test_seed_and_clock() -> None:
    item = Item("m", "p104_x/k=3", F11, "ppmc104", ())
    assert runner.repro_line(item, 9) == "make test T=p104_x.k.3-f11m SEED=9 CLK_HZ=11059200"


def test_configs_have_distinct_names_none_a_prefix_of_another() -> None:
    names = [config.name for config in ALL_CONFIGS]
    assert len(set(names)) == len(names)
    assert not [(a, b) for a in names for b in names if a != b and b.startswith(a + "-")]


def test_config_survives_json_and_knows_its_times() -> None:
    config = Config("x", clk_hz=11_059_200, timing="DATASHEET", extra=(("AXES", 2),))
    assert Config.from_json(config.to_json()) == config
    assert config.datasheet and not F16.datasheet and D16.datasheet
    # P104-GEN-03 and P104-EX-12: CYC rounds up, a quantum is 2.7648 clk here.
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
