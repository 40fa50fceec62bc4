"""Scripts for vendors' tools: a list that adds a plain Verilog file, a project for each board (D-132)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.project import ROOT, relative
from scripts.fpga.boards.description import FOLDER as BOARDS
from scripts.fpga.boards.description import Description, load_all

NOT_RUN = "Not run by this project's tests, which have no vendor tools; please report what does not work."
FOLDER = ROOT / "packages"
PROJECTS = FOLDER / "projects"
WRITE = "make verilog TOP=<top> PARAMS=CLK_HZ=<Hz of your clk>"


@dataclass(frozen=True)
class Tool:
    """A vendor's tool. In its texts, `@key@` is replaced by a value of `vendor` in board.yml.

    Attributes:
        run: command that runs the project of a board.
        project: commands of the project. `$top` is the top, `$plain` its plain Verilog, `$pins` the folder of
            its constraints; the working directory is build/<tool>/<top>.
        file: name of the list in packages/; "" if the tool has no list.
        use: how the list is used.
        add: command of the list that adds the file `$plain`.
    """

    title: str
    run: str
    project: str
    file: str = ""
    use: str = ""
    add: str = ""
    suffix: str = ".tcl"


TOOLS = {
    "vivado": Tool(
        title="Vivado",
        run="vivado -mode batch -source {}",
        project="""\
create_project -force -part @device@ $top .
add_files -norecurse $plain
add_files -fileset constrs_1 -norecurse $pins/pins.xdc
set_property top $top [current_fileset]
launch_runs impl_1 -to_step write_bitstream
wait_on_run impl_1
if {[get_property PROGRESS [get_runs impl_1]] ne "100%"} {error "$top: the run impl_1 failed"}
if {[get_property STATS.WNS [get_runs impl_1]] < 0} {error "$top: too slow for its clock"}
""",
        file="vivado.tcl",
        use="Vivado, in a project: set top ppmc104; source .../packages/vivado.tcl",
        add="add_files -norecurse $plain",
    ),
    "quartus": Tool(
        title="Quartus",
        run="quartus_sh -t {}",
        project="""\
package require ::quartus::project
package require ::quartus::flow
project_new -overwrite $top
set_global_assignment -name VERILOG_FILE $plain
source $pins/pins.qsf
set_global_assignment -name SDC_FILE $pins/clocks.sdc
export_assignments
execute_flow -compile
project_close
""",
        file="quartus.qsf",
        use="Quartus, in the .qsf: set root <checkout>; set top ppmc104; source $root/packages/quartus.qsf",
        add="set_global_assignment -name VERILOG_FILE $plain",
    ),
    "gowin": Tool(
        title="Gowin EDA",
        run="gw_sh {}",
        project="""\
set_device -name @family@ @device@
add_file -type verilog $plain
add_file -type cst $pins/pins.cst
add_file -type sdc $pins/clocks.sdc
set_option -top_module $top
set_option -output_base_name $top
set_option -verilog_std v2001
set_option -use_sspi_as_gpio 1
run all
""",
        file="gowin.tcl",
        use="Gowin EDA, with a project open: set top ppmc104; source .../packages/gowin.tcl",
        add="add_file -type verilog $plain",
    ),
    "radiant": Tool(
        title="Radiant",
        run="radiantc {}",
        project="""\
file delete -force $top.rdf
prj_create -name $top -impl impl_1 -dev @device@ -performance @grade@ -synthesis lse
prj_add_source $plain
# The cells of the iCE40 have other names in Radiant.
prj_add_source $root/packages/projects/radiant_cells.v
prj_add_source $pins/pins.pdc
prj_set_impl_opt -impl impl_1 top $top
prj_save
prj_run Synthesis -impl impl_1
prj_run Map -impl impl_1
prj_run PAR -impl impl_1
prj_run Export -impl impl_1
prj_save
prj_close
""",
        file="radiant.tcl",
        use="Radiant, with a project open: set top ppmc104; source .../packages/radiant.tcl",
        add="prj_add_source $plain",
    ),
    "efinity": Tool(
        title="Efinity",
        run="python3 {}",
        project='''\
Path(f"{top}.xml").write_text(f"""<?xml version="1.0" encoding="UTF-8"?>
<efx:project xmlns:efx="http://www.efinixinc.com/enf_proj" name="{top}" location="{escape(str(work))}">
  <efx:device_info>
    <efx:family name="@family@"/>
    <efx:device name="@device@"/>
    <efx:timing_model name="@grade@"/>
  </efx:device_info>
  <efx:design_info def_veri_version="verilog_2k" def_vhdl_version="vhdl_2008">
    <efx:top_module name="{top}"/>
    <efx:design_file name="{escape(str(plain))}" version="default" library="default"/>
    <efx:top_vhdl_arch name=""/>
  </efx:design_info>
  <efx:constraint_info>
    <efx:sdc_file name="{escape(str(pins / 'clocks.sdc'))}"/>
    <efx:inter_file name=""/>
  </efx:constraint_info>
  <efx:sim_info/>
  <efx:misc_info/>
  <efx:ip_info/>
  <efx:synthesis tool_name="efx_map">
    <efx:param name="work_dir" value="work_syn" value_type="e_string"/>
    <efx:param name="mode" value="speed" value_type="e_option"/>
  </efx:synthesis>
  <efx:place_and_route tool_name="efx_pnr">
    <efx:param name="work_dir" value="work_pnr" value_type="e_string"/>
  </efx:place_and_route>
  <efx:bitstream_generation tool_name="efx_pgm">
    <efx:param name="mode" value="active" value_type="e_string"/>
    <efx:param name="width" value="1" value_type="e_string"/>
  </efx:bitstream_generation>
</efx:project>
""", encoding="utf-8")
design = DesignAPI(False)
design.create(top, "@device@", str(work), overwrite=True)
imported = design.import_design(str(pins / "pins.isf"))
if isinstance(imported, tuple) and not imported[0]:
    sys.exit(f"{pins}/pins.isf: Efinity rejects it: {imported[1]}")
design.generate(enable_bitstream=False)
design.save()
run = Path(os.environ["EFINITY_HOME"]) / "scripts" / "efx_run.py"
sys.exit(subprocess.run([sys.executable, run, "--prj", f"{top}.xml", "--flow", "compile"]).returncode)
''',
        suffix=".py",
    ),
}

HERE = "set root [file normalize [file join [file dirname [info script]] {}]]\n"
PLAIN = (
    "set plain $root/build/verilog/$top.v\n"
    'if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}\n'
)
START = {
    ".tcl": HERE.format(".. ..")
    + """\
set parts {@parts@}
set on [lindex $parts 0]
if {[info exists ::env(PART)]} {set on $::env(PART)}
if {[lsearch -exact $parts $on] < 0} {error "PART=$on: this board has $parts"}
set top board_@board@_[string map {- _} $on]
"""
    + PLAIN
    + """\
set pins $root/constraints/@board@/$on
file mkdir $root/build/@tool@/$top
cd $root/build/@tool@/$top

""",
    ".py": """\
import os
import subprocess
import sys
from html import escape
from pathlib import Path

root = Path(__file__).resolve().parents[2]
parts = "@parts@".split()
on = os.environ.get("PART", parts[0])
if on not in parts:
    sys.exit(f"PART={on}: this board has {' '.join(parts)}")
top = "board_@board@_" + on.replace("-", "_")
plain, pins = root / f"build/verilog/{top}.v", root / "constraints" / "@board@" / on
if not plain.is_file():
    sys.exit(f"{plain}: not written; run `make verilog TOP={top}` in {root}")
if "EFINITY_HOME" not in os.environ or "EFXPT_HOME" not in os.environ:
    sys.exit("EFINITY_HOME or EFXPT_HOME: not set; source bin/setup.sh of Efinity")
work = root / "build" / "@tool@" / top
work.mkdir(parents=True, exist_ok=True)
os.chdir(work)
sys.path.append(os.environ["EFXPT_HOME"] + "/bin")
from api_service.design import DesignAPI

""",
}


def list_of(tool: Tool) -> str:
    """Return Tcl that adds the plain Verilog of one top, or stops with a one-line message without it."""
    return (
        f"# Written by `make packages` from {relative(Path(__file__))}; change that, not this.\n# {NOT_RUN}\n"
        f"# Plain Verilog-2005 of one part, bridge or board, written earlier by\n#   {WRITE}\n# {tool.use}\n"
        f"if {{![info exists root]}} {{{HERE.format('..').rstrip()}}}\n"
        f"if {{![info exists top]}} {{set top ppmc104}}\n{PLAIN}{tool.add}\n"
    )


def project_of(board: Description, path: Path) -> str:
    """Return the script that makes the project of a board and runs its vendor's tool."""
    tool, parts = TOOLS[board.vendor["tool"]], [on.name for on in board.parts]
    text = f"""\
# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from {board.source}; change that, not this.
# {NOT_RUN}
# {board.title} with {tool.title}:
#   make verilog TOP={board.top(board.parts[0])}
#   {tool.run.format(relative(path))}
"""
    if len(parts) > 1:
        others = ", ".join(parts[1:])
        text += f"# The environment variable PART selects another part of the board: {others}.\n"
    text += START[tool.suffix] + tool.project
    values = {**board.vendor, "board": board.name, "parts": " ".join(parts)}
    for key, value in values.items():
        text = text.replace(f"@{key}@", value)
    return text


def project_boards() -> dict[Path, Description]:
    """Return the board of each project script for a vendor's tool, by the path of the script."""
    return {
        PROJECTS / f"{board.name}{TOOLS[board.vendor['tool']].suffix}": board
        for board in load_all(BOARDS)
        if board.vendor
    }


def vendor_files() -> dict[Path, str]:
    """Return the texts of all scripts for vendors' tools, by path."""
    return {
        **{FOLDER / tool.file: list_of(tool) for tool in TOOLS.values() if tool.file},
        **{path: project_of(board, path) for path, board in project_boards().items()},
    }
