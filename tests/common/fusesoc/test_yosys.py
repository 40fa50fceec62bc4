"""Plain Verilog of boards, written and read by yosys: `make test WITH=fusesoc`, because it needs yosys."""

from __future__ import annotations

import json

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import BUILD
from scripts.fpga.packages import plain_boards
from tests.common.packages.test_plain_boards import launched

MODULE = "module m (input a, output b);\n  assign b = ~a;\nendmodule\n"


def test_library():
    """The folder of a board contains core, Verilog and pins, and no file contains a path of this computer."""
    folder = BUILD / "test" / "plain_boards"
    made = plain_boards.write_library(["ulx3s-25f"], folder)
    names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    assert names == ["board_ulx3s_ppmc104.v", made.name, "ulx3s/ppmc104/pins.lpf"]
    verilog = (folder / "board_ulx3s_ppmc104.v").read_text(encoding="utf-8")
    # Attributes set the loop filter of the PLL; without them the PLL would use other values.
    assert '(* FREQUENCY_PIN_CLKI = "25", ICP_CURRENT = "12", LPF_RESISTOR = "8", ' in verilog
    assert 'MFG_ENABLE_FILTEROPAMP = "1", MFG_GMCREF_SEL = "2" *)\n  EHXPLLL #(\n' in verilog
    assert "    inout  wire [7:0] d,\n" in verilog and str(ROOT) not in verilog


def test_yosys_does_what_tcl_says(tmp_path):
    """The launcher executes a script of edalize; the output of yosys is only in the log."""
    (tmp_path / "m.v").write_text(MODULE)
    (tmp_path / "procs.tcl").write_text("proc read_files {} {\nread_verilog {m.v}\n}\nset top m\n")
    script = "yosys -import\nsource procs.tcl\nread_files\nsynth -top $top\nprocs\nwrite_json $top.json\n"
    (tmp_path / "s.tcl").write_text(script)
    done = launched("yosys", "-l", "y.log", "-p", "tcl s.tcl", folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert list(json.loads((tmp_path / "m.json").read_text())["modules"]) == ["m"]
    assert ">>> synth -top m" in (tmp_path / "y.log").read_text()


def test_what_yosys_refuses(tmp_path):
    """If yosys cannot read the Verilog, its error is on the terminal, and the exit code is not 0."""
    (tmp_path / "m.v").write_text("module m (;\n")
    (tmp_path / "s.tcl").write_text("read_verilog m.v\n")
    done = launched("yosys", "-l", "y.log", "-p", "tcl s.tcl", folder=tmp_path)
    assert done.returncode and done.stderr.startswith("m.v:1: ERROR: ") and len(done.stderr.splitlines()) == 1
