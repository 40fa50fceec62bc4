"""docs/sizes.json: growth, digests of the RTL, tables, unreadable files. No test synthesises a design."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from openppmc.check.records import Edge, Recording
from scripts.fpga.flow import plain_sim
from scripts.fpga.flow.yosys_job import BEST, commands, recipe_text
from scripts.measure.sizes import __main__ as size
from scripts.measure.sizes import designs, figures, scan_wrapper, size_page

KEY = "part ecp5 tuned"
OLD: figures.Figures = {KEY: {"lut": 1000, "ff": 600, "ram": 2, "of": "0"}}


def changed(**counts: int) -> figures.Figures:
    """Return the figures OLD with other counts."""
    return {KEY: {**OLD[KEY], **counts}}


@pytest.mark.parametrize("counts", [{}, {"lut": 1050}, {"ff": 630}, {"lut": 950, "ff": 570}, {"lut": 1001}])
def test_up_to_five_per_cent_pass(counts: dict[str, int]) -> None:
    found = figures.compare(OLD, changed(**counts))
    assert found.wrong == [] and found.smaller == []


@pytest.mark.parametrize(
    ("counts", "text"),
    [
        ({"lut": 1051}, "LUT 1000 -> 1051 (+5.1 %), more than 5 % larger"),
        ({"ff": 631}, "FF 600 -> 631 (+5.2 %), more than 5 % larger"),
        ({"ram": 3}, "block RAM 2 -> 3 (+50.0 %), more than 5 % larger"),
    ],
)
def test_more_growth_fails_with_one_line_for_each_count(counts: dict[str, int], text: str) -> None:
    assert figures.compare(OLD, changed(**counts)).wrong == [f"{KEY}: {text}"]


def test_growth_from_zero_fails() -> None:
    assert figures.compare(changed(ram=0), OLD).wrong == [f"{KEY}: block RAM 0 -> 2, more than 5 % larger"]


def test_a_smaller_size_is_reported_and_passes() -> None:
    found = figures.compare(OLD, changed(lut=949))
    assert found.wrong == []
    assert found.smaller == [f"{KEY}: LUT 1000 -> 949 (-5.1 %), more than 5 % smaller"]


def test_a_design_without_figures_fails() -> None:
    assert figures.compare({}, OLD).wrong == [f"{KEY}: no committed figures"]


def test_the_file_is_read_as_written(tmp_path: Path) -> None:
    path = tmp_path / "sizes.json"
    table = {"b ice40 tuned": {"lut": 1, "ff": 2, "ram": 3, "mhz": [1.5], "of": "a"}, **OLD}
    figures.write(table, path)
    assert figures.read(path) == table
    assert len(path.read_text().splitlines()) == 4


def test_a_missing_file_names_the_remedy(tmp_path: Path) -> None:
    with pytest.raises(ProjectError, match="file is missing; run `make report`"):
        figures.read(tmp_path / "sizes.json")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{ not json", "not JSON"),
        ("\x00\xff", "not JSON"),
        ("[]", "not a table"),
        ('{"part": 5}', "not a table"),
        ('{"part": {"lut": 1, "ff": 2, "ram": 3}}', "not a table"),
        ('{"part": {"lut": 1, "ff": 2, "of": "a"}}', "not a table"),
        ('{"part": {"lut": "1", "ff": 2, "ram": 0, "of": "a"}}', "not a table"),
        ('{"part": {"lut": -1, "ff": 2, "ram": 0, "of": "a"}}', "not a table"),
        ('{"part": {"lut": 1, "ff": 2, "ram": 0, "mhz": ["a"], "of": "a"}}', "not a table"),
    ],
)
def test_a_damaged_file_is_one_clear_error(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "sizes.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(ProjectError, match=message):
        figures.read(path)


@pytest.mark.parametrize(("lut", "code"), [(1050, 0), (1051, 1), (500, 0)])
def test_the_check_returns_the_exit_code(monkeypatch: pytest.MonkeyPatch, lut: int, code: int) -> None:
    monkeypatch.setattr(figures, "read", lambda: OLD)
    monkeypatch.setattr(size, "sizes", lambda expected: changed(lut=lut))
    assert size.check([], fresh=False) == code


@pytest.mark.parametrize(
    ("of", "fresh", "count"), [("same", False, 0), ("same", True, 1), ("other", False, 1)]
)
def test_the_check_synthesizes_changed_designs(
    monkeypatch: pytest.MonkeyPatch, of: str, fresh: bool, count: int
) -> None:
    """A design whose RTL has the stored digest is synthesised again only on request."""
    design = designs.Design("a", "ecp5", "tuned")
    monkeypatch.setattr(designs.Design, "digest", lambda self: "same")
    monkeypatch.setattr(figures, "read", lambda: {design.key: {"of": of}})
    synthesized: list[designs.Design] = []
    monkeypatch.setattr(size, "sizes", lambda expected: synthesized.extend(expected) or {})
    assert size.check([design], fresh) == 0 and len(synthesized) == count


def test_a_design_of_other_rtl_is_stale(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A change of the source makes the figures stale; a change of a comment does not. Missing figures are
    reported.
    """
    source = tmp_path / "a.sv"
    monkeypatch.setattr(project, "ROOT", tmp_path)
    job = {"top": "a", "include": [], "sources": ["a.sv"], "params": {}}
    design = designs.Design("a", "ecp5", "plain", job=job)
    source.write_text("module a;  // one\nendmodule\n")
    held = {design.key: {"lut": 1, "ff": 1, "ram": 0, "of": design.digest()}}
    assert figures.stale(held, [design]) == []
    source.write_text("// other words\nmodule a; /* two */\n\nendmodule\n")
    assert figures.stale(held, [design]) == []
    source.write_text("module a; wire b;\nendmodule\n")
    assert ["measured with other RTL" in line for line in figures.stale(held, [design])] == [True]
    assert ["has no figures" in line for line in figures.stale({}, [design])] == [True]
    assert ["does not exist any more" in line for line in figures.stale(held, [])] == [True]
    other = replace(design, job={**job, "params": {"N": 1}})
    assert other.digest() != design.digest()


@pytest.mark.parametrize(
    ("runs", "text"),
    [(figures.RUNS - 1, "–"), (figures.RUNS, "107 (100)"), (0, "–")],
)
def test_a_clock_rate_needs_every_run(runs: int, text: str) -> None:
    assert figures.RUNS >= 15
    assert figures.rate_text({"mhz": [100.0 + at for at in range(runs)]}) == text
    assert figures.rate_text(None) == "–"


def test_the_printed_recipe_is_the_one_that_runs() -> None:
    job = {"top": "a", "include": [], "sources": [], "params": {}, "json": "x", "keep": False}
    for family in size_page.FAMILY:
        text = recipe_text(family, BEST[family])
        run = commands({**job, "family": family, "recipe": BEST[family]})[1:-1]
        assert "; ".join(run).replace(" -top a", "") == text
        assert "rename -wire" in text


def test_syntheses_of_a_clock_rate_differ() -> None:
    job = {"top": "a", "include": [], "sources": [], "params": {}, "json": "x", "keep": False}
    lists = [
        commands({**job, "family": "ecp5", "recipe": "default", "turn": turn})
        for turn in range(designs.TURNS)
    ]
    assert len({tuple(commands) for commands in lists}) == designs.TURNS


def test_missing_source_names_the_design(tmp_path: Path) -> None:
    from scripts.measure.sizes import peers

    entry = {
        "title": "one",
        "what": "…",
        "url": "https://example.org/it",
        "top": "step",
        "sources": ["one.v"],
    }
    (tmp_path / "peers.json").write_text(json.dumps([entry]))
    with pytest.raises(ProjectError, match=r"one\.v is not there; one is at https://example\.org/it"):
        designs.of_peers(tmp_path, peers.read(tmp_path))
    (tmp_path / "one.v").touch()
    found = designs.of_peers(tmp_path, peers.read(tmp_path))
    assert [design.recipe for design in found] == list(designs.RECIPES)


@pytest.mark.parametrize("text", [None, "[{]", '[{"title": "x"}]'])
def test_bad_description_of_peers_is_one_line(text: str | None, tmp_path: Path) -> None:
    from scripts.measure.sizes import peers

    if text is not None:
        (tmp_path / "peers.json").write_text(text)
    with pytest.raises(ProjectError, match=r"peers\.json"):
        peers.read(tmp_path)


def test_wrapper_leaves_other_axes_idle(tmp_path: Path) -> None:
    """Only the pins of one axis are connected to shift registers; the reset may have any name."""
    ports = {
        "clk": "input",
        "resetn": "input",
        "m0_zpd": "input",
        "m1_zpd": "input",
        "m0_drive": "output",
        "m1_dir": "output",
    }
    described = {name: {"direction": way, "bits": [1]} for name, way in ports.items()}
    netlist = tmp_path / "netlist.json"
    netlist.write_text(json.dumps({"modules": {"step": {"ports": described}}}))
    text = scan_wrapper.source(netlist, "step", {}, reset="resetn", pins_like="m0_")
    assert ".resetn(rst_n)" in text
    assert ".m1_zpd('0)" in text
    assert ".m0_zpd(in_q[0:0])" in text
    assert ".m0_drive(out[0:0])" in text
    assert "m1_dir" not in text


def test_plain_verilator_must_make_the_same_edges() -> None:
    edges = [Edge(5, "pout_n", 0), Edge(9, "pout_n", 1)]
    recording = Recording("ppmc104", {"PHASE_IDLE": 1}, end=20, edges=edges)
    plain_sim.check(recording, list(edges))
    with pytest.raises(ProjectError, match="plain Verilator differs"):
        plain_sim.check(recording, [edges[0], Edge(10, "pout_n", 1)])
