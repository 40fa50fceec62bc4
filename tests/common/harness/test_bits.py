"""Conversion of bitstreams to netlists: a difference from the reports of the tools is an error, and a flipped
bit must be detected.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cocotb_tests.harness.project import ProjectError
from scripts.fpga.flow import bits, gates
from scripts.measure import gate_suite

ROUTED = ".comment by nextpnr\n.device 5k\n.logic_tile 1 1\n00\n10\n.logic_tile 1 2\n00\n00\n.sym 3 clk\n"
UNPACKED = ".comment unpacked\n.device 5k\n.logic_tile 1 1\n00\n10\n"
VLOG = """
module top (output [1:0] \\s , output q, input clk, input rst_n);

wire n1, \\s[0] ;
reg q = 0;
SB_PLL40_PAD #(
  .FEEDBACK_PATH("SIMPLE"),
  .PLLOUT_SELECT("GENCLK"),
  .DIVR(4'b0000),
  .DIVF(7'b0111111),
  .DIVQ(3'b101)
) PLL_12_31 (
  .PACKAGEPIN(n7),
  .PLLOUTGLOBAL(n3),
  .LOCK(n9)
);
assign n4 = /* LUT    1  1  1 */ (n2 ? 1'b0 : n1);
assign n5 = /* LUT    1  1  2 */ q;
assign n6 = /* LUT    1  1  3 */ 1'b0;
/* FF  1  1  1 */ always @(posedge n3) if (1'b1) q <= n1 ? 1'b0 : n4;
/* FF  1  1  2 */ assign n8 = n5;

// Warning: unmatched port 'clk'

endmodule
"""
USED = {"ICESTORM_LC": 2, "ICESTORM_PLL": 1, "SB_IO": 5, "ICESTORM_SPRAM": 0}
TESTS = gate_suite.everything(None, (gates.BITS,))


def converted(folder: Path, monkeypatch: pytest.MonkeyPatch, **changed: object) -> str:
    """Convert a small bitstream with stubs in place of the tools; return netlist.v.

    Args:
        changed: replacements of the texts vlog, unpacked, ff and pll, or of the count of a cell in the report
            of nextpnr.
    """
    cells = {**USED, **{name: n for name, n in changed.items() if name.isupper()}}
    (folder / "routed.asc").write_text(ROUTED)
    report = {"utilization": {name: {"used": n} for name, n in cells.items()}}
    (folder / "nextpnr.json").write_text(json.dumps(report))

    def run(command: list[str], inside: Path, what: str) -> str:
        if command[0] == "iceunpack":
            (inside / command[2]).write_text(str(changed.get("unpacked", UNPACKED)))
        return str(changed.get("vlog", VLOG))

    monkeypatch.setattr("scripts.fpga.flow.board_route.run", run)
    ff, pll = changed.get("ff", 1), changed.get("pll", (12e6, 24_000_000))
    of = bits.Bitstream(folder / "a.bin", "top", "sg48", (("clk", "35"),), ff, pll)  # type: ignore[arg-type]
    bits.convert(of, folder)
    return (folder / "netlist.v").read_text()


def test_faults_of_icebox_vlog_are_repaired(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = converted(tmp_path, monkeypatch)
    assert "module top (s, q, clk, rst_n);\noutput [1:0] s;\noutput q;\n" in text
    assert "assign n3 = clk;\nassign n9 = 1'b1;\n" in text and "Warning" not in text and "PLL" not in text
    assert (tmp_path / "pins.pcf").read_text() == "set_io clk 35\n"
    assert bits.counts(text) == (2, 1, 0)  # the second cell only passes the output q of the first one on


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"unpacked": UNPACKED.replace("10", "11")}, "the bits are not those of the router"),
        ({"ICESTORM_SPRAM": 1}, "icebox_vlog does not convert ICESTORM_SPRAM"),
        ({"ICESTORM_LC": 5}, r"in the bits: \(2, 1, 0\), reported: \(5, 1, 0\)"),
        ({"ICESTORM_LC": 1}, r"reported: \(1, 1, 0\)"),
        ({"ICESTORM_RAM": 1}, r"reported: \(2, 1, 1\)"),
        ({"ff": 2}, r"reported: \(2, 2, 0\)"),
        ({"pll": (12e6, 25_000_000)}, "the PLL does not make 25000000 Hz"),
        ({"vlog": VLOG.replace("GENCLK", "GENCLK_HALF")}, "the PLL does not make 24000000 Hz"),
        ({"vlog": VLOG.replace("port 'clk'", "port 's'")}, "unmatched port 's'"),
    ],
)
def test_a_difference_from_the_reports_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: dict[str, object], message: str
) -> None:
    with pytest.raises(ProjectError, match=message):
        converted(tmp_path, monkeypatch, **changed)


def test_each_part_with_a_uart_on_the_board_has_a_test() -> None:
    parts = {test.item.part for test in TESTS if test.on_board}
    assert parts == {on.part for on in bits.DESCRIPTION.parts if "uart" in on.hosts}
    assert {test.top for test in gate_suite.chosen(TESTS, "quick")} == {"board_icebreaker_ppmc104"}


def test_the_flipped_bit_must_give_a_wrong_edge() -> None:
    (flipped,) = (test for test in gate_suite.chosen(TESTS, "quick") if test.flipped)
    assert flipped.result(f"UART move: {gate_suite.WRONG_EDGE}: expected None") == ""
    assert "the flipped bit was not found: passed" in flipped.result("")
    assert "no frame" in flipped.result("no frame within 200000 us")
    assert len({test.item.id for test in TESTS}) == len(TESTS)
