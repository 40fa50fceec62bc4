"""Timing after routing: the reports that are accepted, and the table of setup margins."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scripts.fpga.boards import tables
from scripts.fpga.boards.description import load_all
from scripts.fpga.flow import timing
from scripts.fpga.flow.board_table import BY_PART
from scripts.fpga.flow.boards import inputs_digest


def report(folder: Path, name: str, **changes: object) -> None:
    on = BY_PART["ppmc104"]["icebreaker"]
    values = {"fmax": 30.0, "seed": 2, "params": {}, "inputs": inputs_digest(on, "uart"), **changes}
    (folder / name).mkdir()
    (folder / name / "report.json").write_text(json.dumps(values))


def test_reports_of_other_sources_are_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Only reports of the current sources with the default parameters replace figures."""
    file = tmp_path / "timing.json"
    monkeypatch.setattr(timing, "TIMING", file)
    file.write_text('{"stmc": {"mhz": 1, "seed": 1, "of": ""}}')
    report(tmp_path, "icebreaker")
    report(tmp_path, "icebreaker-bus", inputs="0")
    report(tmp_path, "icebreaker-stmc", params={"XTAL_HZ": 1})
    assert timing.main([str(tmp_path)]) == 0
    kept = json.loads(file.read_text())
    assert kept.keys() == {"icebreaker", "stmc"} and kept["icebreaker"]["mhz"] == 30.0
    assert capsys.readouterr().out.count("left out: ") == 2


def test_margins_and_missing_bitstreams(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The smallest margin is first, and a bitstream without a figure is named, not left out silently."""
    file = tmp_path / "timing.json"
    file.write_text('{"icebreaker": {"mhz": 25, "seed": 3}, "tangnano9k": {"mhz": 55, "seed": 1}}')
    monkeypatch.setattr(tables, "TIMING", file)
    rows = [line for line in tables.timing_table(load_all()).splitlines() if line.startswith("| `")]
    assert rows == [
        "| `tangnano9k` | 54 MHz | 18.52 ns | 18.18 ns | 0.34 ns | 2 % | 1 |",
        "| `icebreaker` | 24 MHz | 41.67 ns | 40.00 ns | 1.67 ns | 4 % | 3 |",
    ]
    missing = tables.timing_table(load_all()).splitlines()[-1]
    assert missing.startswith("Not measured: `icebreaker-bus`, ") and "`ulx3s-85f-bank-spi`" in missing


def test_every_shipped_bitstream_meets_its_clock() -> None:
    figures = json.loads(tables.TIMING.read_text())
    every = {on.stem(host): on for boards in BY_PART.values() for on in boards.values() for host in on.top}
    assert figures and all(entry["mhz"] >= every[name].clk_hz / 1e6 for name, entry in figures.items())
