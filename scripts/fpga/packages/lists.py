"""Bender.yml and file lists: each part for Verilator, plain Verilog for vendors' tools."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT, files, listed, relative
from openppmc.parts import Row, tops
from openppmc.sources import Group
from scripts.fpga.packages.cores import board_groups

FROM = "Written by `make packages` from rtl/files.yml; change that, not this."
NOT_RUN = "Not run by this project's tests, which have no vendor tools; please report what does not work."
FOLDER = ROOT / "packages"


def carrier_groups() -> list[Group]:
    """Return the carriers and their shared files, without files of single boards."""
    return [group for group in board_groups() if group.name != "boards"]


def part_files(part: Row) -> list[Path]:
    """Return the RTL of a part and of its carrier, in compile order."""
    return files(f"{part.rtl}_carrier" if part.carrier else part.rtl)


def bender() -> str:
    """Return Bender.yml with a source group for each group of rtl/files.yml; carriers have a target."""
    text = f"# {FROM}\npackage:\n  name: openppmc\n  authors: [OpenPPMC]\n\n"
    text += "export_include_dirs: [rtl/common]\n\nsources:\n"
    carriers = carrier_groups()
    for group in listed().values():
        if group.name == "boards":
            continue
        text += f"  # {group.name}\n  - include_dirs: [rtl/common]\n"
        if group in carriers:
            text += "    target: openppmc_boards\n"
        text += "    files:\n" + "".join(f"      - {relative(path)}\n" for path in group.files)
    return text


def dot_f(part: Row) -> str:
    """Return the command file of a part; with `-F`, its paths are relative to the file."""
    lines = [
        f"// {FROM}",
        f"// verilator -F packages/{part.rtl}.f; a --top-module after it selects your own top.",
        f"--top-module {part.top}",
        "+incdir+../rtl/common",
    ]
    return "\n".join([*lines, *(f"../{relative(path)}" for path in part_files(part)), ""])


WRITE = "make verilog TOP=<top> PARAMS=CLK_HZ=<Hz of your clk>"


def plain_tcl(use: str, add: str) -> str:
    """Return Tcl that adds the plain Verilog of one top; without this file, it stops with one line."""
    return (
        f"# {FROM}\n# {NOT_RUN}\n"
        "# Plain Verilog-2005 of one part, bridge or board, written earlier by\n"
        f"#   {WRITE}\n"
        f"# {use}\n"
        "if {![info exists root]} {set root [file normalize [file join [file dirname [info script]] ..]]}\n"
        "if {![info exists top]} {set top ppmc104}\n"
        "set plain $root/build/verilog/$top.v\n"
        'if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}\n'
        f"{add}\n"
    )


def vivado() -> str:
    """Return Tcl that adds the files to a Vivado project or to a non-project script."""
    return plain_tcl(
        "Vivado, in a project: set top ppmc104; source .../packages/vivado.tcl", "add_files -norecurse $plain"
    )


def quartus() -> str:
    """Return the lines that add the files to a Quartus settings file."""
    return plain_tcl(
        "Quartus, in the .qsf: set root <checkout>; set top ppmc104; source $root/packages/quartus.qsf",
        "set_global_assignment -name VERILOG_FILE $plain",
    )


def gowin() -> str:
    """Return Tcl that adds the files in gw_sh or in the console of Gowin EDA."""
    return plain_tcl(
        "Gowin EDA, with a project open: set top ppmc104; source .../packages/gowin.tcl",
        "add_file -type verilog $plain",
    )


def list_files() -> dict[Path, str]:
    """Return all lists: path -> text."""
    return {
        ROOT / "Bender.yml": bender(),
        **{FOLDER / f"{part.rtl}.f": dot_f(part) for part in tops()},
        FOLDER / "vivado.tcl": vivado(),
        FOLDER / "quartus.qsf": quartus(),
        FOLDER / "gowin.tcl": gowin(),
    }
