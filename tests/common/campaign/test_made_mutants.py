"""Mutants by rule: what is changed and what is not, and a copy that holds them all."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.project import ROOT, ProjectError
from scripts.mutants.made import page
from scripts.mutants.made.chosen import rtl_files, sample
from scripts.mutants.made.faults import faults
from scripts.mutants.made.page import Tried, score
from scripts.mutants.made.schema import CHOSEN, instrumented
from scripts.mutants.made.work import ALIVE, ENDLESS, KILLED
from scripts.syntax import findings

TEXT = """module m #(parameter int W = 4 + 1) (input wire logic clk_i, rst_ni, a, b, output logic [W-1:0] q);
  localparam int N = W * 2 - 1;
  assign unused_b = &{1'b0, b && a};
  if (W > 3) begin : g_wide
    other #(.W(W + 1)) u_other (.clk_i(clk_i), .en_i(a && b), .q_o());
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) q <= '0;
    else if (a) q <= a == b ? q + 1'b1 : {W{b}};
  end
`ifndef SYNTHESIS
  `PPMC_ASSERT(m_rule, a || b)
`endif
endmodule
"""


def test_what_is_changed() -> None:
    """Given a module, then only what runs is changed: no width, parameter, generate condition, assertion."""
    found = [(fault.line, fault.what) for fault in faults(TEXT)]
    assert {line for line, _ in found} == {5, 8, 9}
    assert {what for line, what in found if line == 5} == {
        "&& as ||",
        "left of && alone",
        "right of && alone",
    }
    assert {what for line, what in found if line == 8} == {
        "never",
        "without !",
        "left out",
        "all bits turned",
    }
    assert {what for line, what in found if line == 9} == {
        *("always", "never", "left out", "other way round", "== as !=", "+ as -", "lowest bit turned"),
    }


def test_a_copy_holds_all_and_keeps_lines() -> None:
    """Given a file, then its copy has each mutant by its number, and as many lines."""
    every = faults(TEXT)
    copy = instrumented(TEXT, every)
    assert copy.count("\n") == TEXT.count("\n")
    assert all(f"{CHOSEN} == {f.number})" in copy or f"{CHOSEN} != {f.number})" in copy for f in every)
    plain = instrumented(TEXT, [])
    assert plain.replace(plain[plain.index(f" int {CHOSEN}") : plain.index("\n")], "") == TEXT


def test_letters_of_several_bytes() -> None:
    """Given such letters in comments, then the same mutants in the same places."""
    text = TEXT.replace("begin\n", "begin  // 0 µs, 1 …\n")
    assert [text[fault.start : fault.end] for fault in faults(text)] == [
        TEXT[fault.start : fault.end] for fault in faults(TEXT)
    ]


def test_every_file_can_be_changed() -> None:
    """Given each file of rtl/, then its copy is as good SystemVerilog, with as many lines, and there are
    thousands of mutants in all."""
    count = 0
    for file in rtl_files():
        text = (ROOT / file).read_text(encoding="utf-8")
        every = faults(text)
        count += len(every)
        copy = instrumented(text, every)
        assert copy.count("\n") == text.count("\n"), file
        assert findings(copy) == findings(text), file
    assert count > 10_000


def test_a_sample_keeps_what_it_has() -> None:
    """Given a higher count, then the lower one's mutants are among them, so many of each folder."""
    files = [*rtl_files("motion"), *rtl_files("common")]
    few, more = ({(file, fault.number) for file, fault in sample(files, n)} for n in (5, 20))
    assert len(few) == 10 and len(more) == 40 and few < more
    with pytest.raises(ProjectError, match="T=nowhere: no such folder or file"):
        rtl_files("nowhere")


def test_scores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Given verdicts, then those without end and equivalent ones count apart."""
    file = "rtl/common/ppmc_sync.sv"
    fault = faults(TEXT)[0]
    tried = [Tried(file, fault, verdict, "") for verdict in (KILLED, KILLED, KILLED, ENDLESS, ALIVE)]
    assert (found := score(tried, 9)).percent == 75 and found.endless == 1 and found.alive == 1
    monkeypatch.setattr(page, "judged", lambda: {(file, tried[0].source, fault.what): "the same"})
    assert (found := score(tried, 9)).percent == 100 and found.equivalent == 1 and found.alive == 0
    assert "equivalent: the same" in page.page(tried, [file], page.QUICK)


def test_judged_mutants_fit_the_tree() -> None:
    """Given judged.yml, then each text stands in its file, with a reason."""
    assert all(page.judged().values())
