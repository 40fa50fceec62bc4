"""JITTER=1: levels of the golden model, reasons of the tests that do not run, and counts of late changes."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from cocotb_tests.harness import F16, jitter
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.part import PARTS, Part
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.simulate import outcomes
from openppmc.check.records import Change

PART = Part(
    "ppmc104",
    {"l1_n": 1, "auxi": 0, "rd_n": 1, "d_i": 0, "rxd": 1},
    widths={"auxi": 2, "d_i": 8},
    stages={
        "u_a": ("l1_n", "auxi"),
        "u_b": ("stage.rd_n",),
        "u_c": ("rxd",),
        "u_d": ("stage.rxd",),
    },
)
FIRST = [Change(0, "stage.rd_n", 1), Change(0, "stage.rxd", 1)]


def sampled(driven: list[Change], **late: list[tuple[int, int]]) -> jitter.StageLog:
    """Return the log after all changes, which it receives edge by edge."""
    log = jitter.StageLog(PART)
    for now in range(60):
        rows = {path: [row for row in late.get(path, []) if row[0] < now] for path in PART.stages}
        log.add([change for change in driven if change.t <= now], rows, now)
    assert log.changes[:2] == FIRST
    return log


def test_late_and_prompt_changes() -> None:
    """Each bit changes at the edge at which the first stage of its synchroniser changes. A pin that another
    register samples directly has two levels.
    """
    driven = [Change(10, "l1_n", 0), Change(20, "auxi", 3), Change(30, "rd_n", 0), Change(30, "d_i", 7)]
    log = sampled(driven, u_a=[(20, 0b001), (21, 0)], u_b=[(30, 1), (31, 0)])
    assert log.changes[2:] == [
        Change(10, "l1_n", 0),
        Change(20, "auxi", 2),
        Change(21, "auxi", 3),
        Change(30, "rd_n", 0),
        Change(30, "d_i", 7),
        Change(31, "stage.rd_n", 0),
    ]
    assert (log.late, log.prompt) == (2, 1)


def test_edges_that_are_not_sampled_yet() -> None:
    """After a change of a pin, its edge and the next one are pending until the log knows their levels."""
    log = jitter.StageLog(PART)
    rows: dict[str, list[tuple[int, int]]] = {path: [] for path in PART.stages}
    pending = []
    for now in (10, 11, 12):
        log.add([Change(10, "l1_n", 0)], rows, now)
        pending.append(log.pending)
    assert pending == [10, 11, None]


def test_two_synchronisers_of_a_pin() -> None:
    """Each synchroniser of a pin has its own level."""
    log = sampled([Change(10, "rxd", 0)], u_d=[(10, 1), (11, 0)])
    assert log.changes[2:] == [Change(10, "rxd", 0), Change(11, "stage.rxd", 0)]


@pytest.mark.parametrize(
    ("late", "seen"),
    [([(10, 1), (11, 0)], []), ([(10, 1), (12, 0)], [11, 12]), ([(11, 1), (12, 0)], [10, 12])],
)
def test_short_pulse(late: list[tuple[int, int]], seen: list[int]) -> None:
    """A level of one cycle is missed, sampled late, or sampled for longer, depending on which of its two
    changes are late.
    """
    driven = [Change(10, "rxd", 0), Change(11, "rxd", 1)]
    levels = [(c.t, c.value) for c in sampled(driven, u_c=late).changes[2:] if c.pin == "rxd"]
    assert levels == list(zip(seen, (0, 1), strict=False))


def test_sources(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only with JITTER=1, the simulation model replaces the synchroniser; both have the same ports."""
    sources = [Path("rtl/common/ppmc_sync.sv"), ROOT / "rtl/common/ppmc_reset.sv"]
    monkeypatch.delenv(jitter.JITTER, raising=False)
    assert jitter.with_jitter(sources) == sources
    monkeypatch.setenv(jitter.JITTER, "1")
    model, other = jitter.with_jitter(sources)
    assert (model, other) == (ROOT / "tb/jitter/ppmc_sync.sv", sources[1])
    texts = [(ROOT / path).read_text(encoding="utf-8") for path in (sources[0], model)]
    ports = [re.findall(r"\b(\w+_n?[io])\b", text.split("module ")[1].split("\n);")[0]) for text in texts]
    assert ports[0] == ports[1] == ["clk_i", "rst_ni", "d_i", "q1_o", "q2_o"]


def test_reasons() -> None:
    """A test runs with JITTER=1, or states a reason; a test that does neither is an error."""
    directed = Item("tb_bus", "p104_bus", F16, "ppmc104", (), uncompared="")
    assert jitter.reason_against(directed) == ""
    assert jitter.reason_against(replace(directed, exact="one edge")) == "one edge"
    assert jitter.reason_against(replace(directed, module="ppmc104.tb_random", exact="one edge")) == ""
    bridge = Item("tb_line", "line_rates", F16, "bridge", (), tolerant=True)
    assert jitter.reason_against(bridge) == ""
    for silent in (replace(bridge, tolerant=False), replace(directed, uncompared=None)):
        with pytest.raises(ValueError, match="state why it does not run with JITTER=1"):
            jitter.reason_against(silent)


def test_counts_of_a_log() -> None:
    """The counts of all synchronisers are added; a log without counts has none."""
    log = "ppmc_sync: 3 late, 0 prompt\n  0.00ns INFO cocotb\nppmc_sync: 4 late, 12 prompt\n"
    assert jitter.stage_counts(log) == (7, 12)
    assert jitter.stage_counts("passed\n") == (0, 0)


@pytest.mark.parametrize("changes", [(0, 0), (0, 5), (5, 0), (5, 5)])
def test_no_late_change_is_a_failure(
    changes: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With JITTER=1, a tolerant test fails if no change was sampled late, or none without delay."""
    monkeypatch.setenv(jitter.JITTER, "1")
    item = Item("tb_line", "line_rates", F16, "bridge", (), tolerant=True)
    entry = "     0.00ns INFO     cocotb.regression                  "
    log = tmp_path / "log.txt"
    log.write_text(
        f"{entry}running {item.full_name} (1/1)\n{entry}{item.full_name} passed\n"
        f"ppmc_sync: {changes[0]} late, {changes[1]} prompt\n",
        encoding="utf-8",
    )
    (outcome,) = outcomes([item], log, tmp_path / "results.xml", "").values()
    assert outcome.good == all(changes), outcome
    monkeypatch.delenv(jitter.JITTER)
    (outcome,) = outcomes([item], log, tmp_path / "results.xml", "").values()
    assert outcome.good, outcome


@pytest.mark.parametrize("part", [part for part in PARTS.values() if part.stages], ids=lambda part: part.name)
def test_pins_of_stages(part: Part) -> None:
    """Every listed pin is an input of the device, and no two synchronisers have the same name for a bit."""
    bits = []
    for name in [name for names in part.stages.values() for name in names]:
        port, place = part.locate(name.removeprefix(jitter.SECOND))
        assert port in part.inputs
        rows = range(part.width(port)) if place is None else [place]
        bits += [(name.startswith(jitter.SECOND), port, bit) for bit in rows]
    assert len(bits) == len(set(bits))
