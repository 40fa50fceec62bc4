"""`StageLog` passes the levels that the synchronisers have sampled to the golden model (JITTER=1)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from cocotb_tests.harness import jitter
from cocotb_tests.harness.part import PARTS, Part
from cocotb_tests.harness.paths import ROOT
from openppmc.check.records import Change

PART = Part(
    "ppmc104",
    {"l1_n": 1, "auxi": 0, "rd_n": 1, "d_i": 0},
    widths={"auxi": 2, "d_i": 8},
    stages={"u_a": ("l1_n", "auxi"), "u_b": ("rd_n",)},
    direct=frozenset({"rd_n"}),
)
FIRST = {"u_a": 0b100, "u_b": 1}


def sampled(driven: list[Change], a: list[tuple[int, int]], b: list[tuple[int, int]]) -> jitter.StageLog:
    """Return the log after all changes, which it receives edge by edge."""
    log = jitter.StageLog(PART)
    for now in range(60):
        rows = {"u_a": [row for row in a if row[0] < now], "u_b": [row for row in b if row[0] < now]}
        log.add([change for change in driven if change.t <= now], rows, FIRST, now)
    return log


def test_late_and_prompt_changes() -> None:
    """Each bit changes at the edge at which its first stage changes; a pin that a register also samples
    directly has two levels.
    """
    driven = [Change(10, "l1_n", 0), Change(20, "auxi", 3), Change(30, "rd_n", 0), Change(30, "d_i", 7)]
    log = sampled(driven, [(10, 0b000), (20, 0b010), (21, 0b011)], [(31, 0)])
    assert log.changes[1:] == [
        Change(10, "l1_n", 0),
        Change(20, "auxi", 2),
        Change(21, "auxi", 3),
        Change(30, "rd_n", 0),
        Change(30, "d_i", 7),
        Change(31, "stage.rd_n", 0),
    ]
    assert (log.late, log.prompt) == (2, 1)


def test_short_pulse_may_be_lost() -> None:
    """A level of one cycle whose first change is late does not reach the model."""
    driven = [Change(10, "l1_n", 0), Change(11, "l1_n", 1)]
    assert sampled(driven, [], []).changes[1:] == []


def test_levels_during_reset() -> None:
    """While the first stages are reset, and until their first sample, the driven levels count."""
    driven = [Change(10, "rst_n", 0), Change(11, "l1_n", 0), Change(14, "rst_n", 1), Change(20, "l1_n", 1)]
    log = sampled(driven, [(10, 0b111), (16, 0b000), (21, 0b100)], [])
    assert log.changes[1:] == [*driven[:3], Change(21, "l1_n", 1)]


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


@pytest.mark.parametrize("part", [part for part in PARTS.values() if part.stages], ids=lambda part: part.name)
def test_pins_of_stages(part: Part) -> None:
    """Every listed pin is an input of the device, and no bit has two synchronisers."""
    bits = []
    for pin in [pin for pins in part.stages.values() for pin in pins]:
        port, place = part.locate(pin)
        assert port in part.inputs
        bits += [(port, bit) for bit in (range(part.width(port)) if place is None else [place])]
    assert len(bits) == len(set(bits))
    assert part.direct <= {port for port, _ in bits}
