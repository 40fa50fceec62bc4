"""The structural check of asynchronous inputs reports each register without a synchroniser as a case
(docs/cdc.md).
"""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from scripts.measure import cdc

pytestmark = pytest.mark.skipif(find_spec("pyosys") is None, reason="pyosys is not installed; run make setup")
SYNC = project.RTL / "common" / "ppmc_sync.sv"
CLOCK = project.RTL / "motion" / "ppmc_ext_clock.sv"
TOP = """
module top (
    input logic clk, other, rst_n, pin, gate,
    output logic good, bad, late, meta, crossed
);
  logic first, second, early, tick;

  ppmc_sync #(.Width(1)) u_sync (.clk_i(clk), .rst_ni(rst_n), .d_i(pin), .q1_o(first), .q2_o(good));
  ppmc_sync #(.Width(1)) u_gated (.clk_i(clk), .rst_ni(rst_n), .d_i(pin && gate), .q1_o(second), .q2_o(late));
  always_ff @(posedge clk) bad <= pin;
  always_ff @(posedge clk) meta <= first;
  always_ff @(posedge other) tick <= !tick;
  always_ff @(posedge clk) crossed <= tick;
endmodule
"""


def found(top: str, sources: list[Path], folder: Path) -> dict[str, list[str]]:
    """Return the cases of a top, each with the levels that its first register samples."""
    samples = cdc.elaborate(top, sources, {}, folder).samples()
    return {
        case: sorted(origin.name for origin in rows[0].origins)
        for case, rows in cdc.cases(samples).items()
        if not case.startswith("reset of")
    }


def test_missing_synchroniser(tmp_path: Path) -> None:
    """A register that samples a pin, a first stage or a level of another clock is a case; one that samples a
    synchronised pin is not.
    """
    source = tmp_path / "top.sv"
    source.write_text(TOP, encoding="utf-8")
    assert found("top", [SYNC, source], tmp_path) == {
        "logic before u_gated": ["gate", "pin"],
        "several synchronisers of a pin: u_gated, u_sync": ["gate", "pin"],
        "top.bad": ["pin"],
        "top.crossed": ["tick"],
        "top.meta": ["u_sync.q1_o"],
    }


def test_removed_synchroniser(tmp_path: Path) -> None:
    """If the external clock bypasses its synchroniser, each register that uses the pin is a case."""
    package = project.RTL / "common" / "ppmc_lfsr_pkg.sv"
    text = CLOCK.read_text(encoding="utf-8")
    assert found("ppmc_ext_clock", [package, SYNC, CLOCK], tmp_path) == {}
    broken = tmp_path / CLOCK.name
    text = text.replace(".q2_o(level)", ".q2_o()").replace("logic level,", "wire level = pin_i; logic")
    broken.write_text(text, encoding="utf-8")
    cases = found("ppmc_ext_clock", [package, SYNC, broken], tmp_path)
    assert {"ppmc_ext_clock.last_q", "ppmc_ext_clock.not_short_q"} <= set(cases)
    assert cases["ppmc_ext_clock.last_q"] == ["pin_i"]
