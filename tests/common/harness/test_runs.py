"""Every way in which a cocotb test can end, alone and in a group, and the message about it."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from cocotb_tests.harness import Part, SimOptions, cocotb_items, probe, run_item
from cocotb_tests.harness.build import Design, locked
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.paths import BUILD, FAILURES, ROOT, relative
from cocotb_tests.harness.runner import HINT, attempt, outcome_of, run_group, with_probes
from cocotb_tests.harness.simulate import Job
from cocotb_tests.harness.variants import MUTANT

ITEMS: dict[str, Item] = {
    param.values[0].test: replace(param.values[0], tag="own", uncompared="it has no part")
    for param in cocotb_items("cocotb_tests.common", "tb_runs", part=Part("x", {}), exact="without a part")
}
SOURCE = """module runs_inner (input wire logic clk, output logic q);
  logic [3:0] count = 4'd0;
  always_ff @(posedge clk) count <= count + 4'd1;
  assign q = count[0];
endmodule
module runs_top (input wire logic clk, input wire logic fire, input wire logic die, output logic q);
  runs_inner u_inner (.clk, .q);
  always_ff @(posedge clk) begin
    a_quiet: assert (!fire) else $error("it fired");
    if (die) $fatal(1, "it died");
  end
endmodule
"""


def counter() -> Design:
    """Return a counter whose assertion the test can make fail; its inner signals are hidden."""
    path = BUILD / "blocks" / "runs_top.sv"
    with locked(path.with_suffix(".lock")):
        if not path.exists() or path.read_text(encoding="ascii") != SOURCE:
            path.write_text(SOURCE, encoding="ascii")
    return Design("runs_top", [path], ports=("clk", "fire", "die", "q"))


@pytest.fixture(scope="module", name="design")
def _design() -> Design:
    return counter()


def kinds(design: Design, *names: str, **env: str) -> dict[str, str]:
    """Return the outcome of each test of a group."""
    job = Job(design, tuple(ITEMS[name] for name in names), 1, env=env)
    return {item.test: outcome.kind for item, (outcome, _) in run_group(job).items()}


def said(design: Design, *names: str, seed: int = 1, **env: str) -> str:
    """Return the message about the last test of a group.

    If two tests fail at the same time, they need different seeds, because the names of their files contain
    only the seed.
    """
    items = tuple(ITEMS[name] for name in names)
    return attempt(items[-1], SimOptions(seed=seed, group=items), env, design)


def test_each_ends_in_its_own_way(design: Design) -> None:
    """raise, skip, xfail, parametrize and a failed assertion in one group each have their own outcome."""
    names = "passes fires raises skips xfails expected cases/step=1 cases/step=-2 follows".split()
    ends = "passed failed passed skipped xfailed xfailed passed failed passed".split()
    assert kinds(design, *names) == dict(zip(names, ends, strict=True))


def test_nothing_is_asserted_of_the_first_edge(design: Design) -> None:
    """Assertions do not check the state at power-up on the first edge; they check from the second edge on."""
    # with cocotb's own main program, assertions cannot be disabled for the first edge
    design = replace(design, main="own")
    assert kinds(design, "clocked/edge=1", "passes") == {"clocked/edge=1": "passed", "passes": "passed"}
    assert kinds(design, "clocked/edge=2", "passes") == {"clocked/edge=2": "failed", "passes": "passed"}


@pytest.mark.parametrize("end", ["dies", "crashes", "loops"])
def test_the_rest_of_a_group_still_runs(design: Design, end: str) -> None:
    """$fatal, a segmentation fault and an endless loop are reported; the other tests of the group have their
    own results.
    """
    found = kinds(design, "passes", end, "raises", "shows", OPENPPMC_WALL_S="6")
    assert found.pop(end) in ("failed", "crashed")
    assert found == {"passes": "passed", "raises": "passed", "shows": "failed"}


@pytest.mark.parametrize("end", ["shows", "dies", "loops"])
def test_a_mutant_needs_no_rest_of_a_group(design: Design, end: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a test fails on a mutant, the following tests of the group do not run, because they could take an
    hour.
    """
    monkeypatch.setenv(MUTANT, "rtl/none.sv 1 none.sv")
    found = kinds(design, "passes", end, "leaks", "looks", OPENPPMC_WALL_S="6")
    assert found.pop(end) in ("failed", "crashed")
    assert found == {"passes": "passed", "leaks": "did not run", "looks": "did not run"}


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("shows", r"assert \[[01], [01]\] == \[7, 7\]"),
        ("fires", r"%Error: .*it fired"),
        ("dies", r"it died"),
        ("crashes", r"crashed\n(.*\n)*.*Segmentation fault(.*\n)*.*tb_runs\.py\", line \d+ in crashes"),
        ("loops", r"not finished within the wall-clock limit\n(.*\n)*.*tb_runs\.py\", line \d+ in loops"),
        ("cases/step=-2", r"assert -2 > 0"),
    ],
)
def test_a_failure_is_shown(design: Design, name: str, words: str) -> None:
    """The message names the test, shows the compared values or the failing line, and contains the command
    that repeats the test. It does not state that the failure was not reproduced, or occurs only after other
    tests.
    """
    text = said(design, "passes", name, OPENPPMC_WALL_S="6")
    assert text.startswith(f"{ITEMS[name].id}: ") and re.search(words, text), text
    assert f"repeat with: make test T={ITEMS[name].id} SEED=1 CLK_HZ=16000000" in text
    assert "deterministic" not in text and "not reproduced" not in text and "only after" not in text


def test_a_failure_leaves_log_and_waves(design: Design) -> None:
    """After a failure, log and waveforms are in build/failures/."""
    text = said(design, "shows", seed=2)
    folder = FAILURES / "shows-f16-own-s2"
    assert f"log {relative(folder / 'log.txt')}" in text
    assert f"waves in {relative(folder / 'waves' / 'dump.vcd')}" in text
    assert (folder / "log.txt").is_file() and (folder / "waves" / "dump.vcd").stat().st_size > 100


def test_what_needs_another_test_names_it(design: Design) -> None:
    """If a test fails only after a certain one of three other tests, the printed command repeats only these
    two tests.
    """
    text = said(design, "passes", "leaks", "raises", "follows")
    assert "(fails only after leaks-f16-own; alone it passes)" in text and "assert not ['something']" in text
    assert "repeat with: make test T=leaks-f16-own,follows-f16-own SEED=1 CLK_HZ=16000000" in text


@pytest.mark.parametrize("others", [(), ("passes",)])
def test_only_the_same_run_again_shows_nondeterminism(
    design: Design, tmp_path: Path, others: tuple[str, ...]
) -> None:
    """If a test, alone or in a group, fails only the first time, it is reported as not deterministic."""
    text = said(design, *others, "wavers", OPENPPMC_SEEN=str(tmp_path / "seen"))
    assert "once more" in text and "it is not deterministic)" in text and "the first time" in text


def test_waves_may_hide_a_failure(design: Design) -> None:
    """If a failure does not occur with waves, it is reported as not reproduced, not as not deterministic."""
    text = said(design, "shy")
    assert "no trace" in text and "(not reproduced with waves: there it passed)" in text
    assert "deterministic" not in text


def test_a_hidden_signal_is_reported(design: Design) -> None:
    """An access to a hidden signal is reported, alone and in a group; if all signals are visible, the test
    passes.
    """
    for names in (("pries",), ("passes", "pries")):
        text = said(design, *names)
        assert "AttributeError: runs_top contains no child object named u_inner" in text and HINT in text
        assert "not reproduced" not in text
    assert attempt(ITEMS["pries"], SimOptions(probe=True), design=design) == ""


def test_a_test_may_probe_signals(design: Design) -> None:
    """Only the signals that a test names are visible in addition to the ports."""
    assert ITEMS["looks"].probes == ("u_inner.count",)
    assert attempt(ITEMS["looks"], design=design) == ""
    assert with_probes(design, ()) == design and not with_probes(design, ("q",), True).ports
    with pytest.raises(ValueError, match="expected paths"):
        probe("u_inner/count")


def test_waves_of_a_test_that_passes(design: Design, capsys: pytest.CaptureFixture[str]) -> None:
    """The folder of a VCD also contains saved views of the ports, and the paths are printed."""
    assert outcome_of(ITEMS["passes"], SimOptions(waves=True), {}, design).good
    folder = "build/waves/passes-f16-own/dump"
    assert capsys.readouterr().out == f"waves in {folder}.vcd, {folder}.gtkw, {folder}.sucl\n"
    assert (ROOT / f"{folder}.gtkw").read_text().splitlines()[-1].endswith("runs_top.q")
    assert "variable_add runs_top.clk" in (ROOT / f"{folder}.sucl").read_text()


@pytest.mark.parametrize(("name", "reason"), [("skips", "nothing to do"), ("skipped", "skip=True")])
def test_a_skip_is_a_skip_of_pytest(design: Design, name: str, reason: str) -> None:
    """A skipped cocotb test is also skipped in pytest, with its reason."""
    with pytest.raises(pytest.skip.Exception, match=reason):
        run_item(ITEMS[name], design=design)


@pytest.mark.parametrize(("name", "reason"), [("xfails", "known fault"), ("expected", "failed as expected")])
def test_an_expected_failure_is_one_of_pytest(design: Design, name: str, reason: str) -> None:
    """An expected failure of a cocotb test is also one in pytest, with its reason."""
    with pytest.raises(pytest.xfail.Exception, match=reason):
        run_item(ITEMS[name], design=design)
