"""`make yardsticks` and the ratios of `make bench`: like is set against like. Nothing is synthesized here."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from cocotb_tests.harness.stimulus import Edge, Recording
from scripts import yardsticks
from scripts.flow import plain_sim, scan_wrapper


def designs(folder: Path) -> Path:
    """A folder as a user would have it, with two designs."""
    entry = {
        "what": "…",
        "url": "https://example.org/it",
        "top": "step",
        "params": {"AXES": 1},
        "pins": "m0_",
    }
    for name in ("one", "two"):
        (folder / f"{name}.v").touch()
    described = [{**entry, "title": name, "sources": [f"{name}.v"]} for name in ("one", "two")]
    (folder / "peers.json").write_text(json.dumps(described))
    return folder


def test_each_measured_design_has_both_recipes(tmp_path: Path) -> None:
    rows = yardsticks.rows("ppmc104", designs(tmp_path))
    assert len(rows) == 3
    by = {name: {"comb": at, "ff": 3, "ram": 4, "mhz": at + 0.4} for at, name in ((1, "plain"), (2, "tuned"))}
    cells = yardsticks.table([(row, by) for row in rows])
    assert all(len(line) == len(yardsticks.HEADS) for line in cells)
    assert [line[4:] for line in cells[: len(rows)]] == [["1", "1", "2", "2"]] * len(rows)


def test_page_sets_no_tuned_figure_against_a_plain_one() -> None:
    page = (project.DOCS / "benchmarks.md").read_text()
    block = page.split("<!-- yardsticks -->")[1].split("<!-- /yardsticks -->")[0]
    lines = [line.split(" | ") for line in block.splitlines() if line.startswith("| ")][2:]
    assert lines[0][0] == "| **this ppmc104**"
    for line in lines:
        before = line[0].endswith("¹")
        assert (line[-2] == "–") == before, line
    assert "Yardsticks" not in page.split("<!-- yardsticks -->")[0]


def test_missing_source_says_where_the_design_is(tmp_path: Path) -> None:
    (designs(tmp_path) / "two.v").unlink()
    with pytest.raises(ProjectError, match=r"two\.v is not there; two is at https://example\.org/it"):
        yardsticks.rows("ppmc104", tmp_path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            None,
            r"peers\.json is not there: PEERS is a folder with open designs \(https://github\.com/walkthetalk/fsref",
        ),
        ("[{]", "expected a list of objects with params, pins, reset"),
        ('[{"title": "x"}]', "expected a list of objects"),
    ],
)
def test_bad_description_is_one_line(text: str | None, said: str, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / "peers.json").write_text(text)
    with pytest.raises(ProjectError, match=said):
        yardsticks.rows("ppmc104", tmp_path)


def test_wrapper_leaves_other_axes_idle(tmp_path: Path) -> None:
    """Only the pins of one axis go through the shift registers; the reset has its own name."""
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
