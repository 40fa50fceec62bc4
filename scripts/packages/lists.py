"""Bender.yml and the file lists: one a part for Verilator, one of all for Vivado, Quartus, Gowin EDA."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT, files, listed, relative
from openppmc.parts import Row, tops
from openppmc.sources import Group
from scripts.packages.cores import board_groups

FROM = "Written by `make packages` from rtl/files.yml; change that, not this."
NOT_RUN = "Not run by this project's tests, which have no vendor tools; please report what does not work."
FOLDER = ROOT / "packages"


def carrier_groups() -> list[Group]:
    """Carriers, and what they share, without what belongs to single boards."""
    return [group for group in board_groups() if group.name != "boards"]


def part_files(part: Row) -> list[Path]:
    """RTL of a part and of its carrier, in compile order."""
    return files(f"{part.rtl}_carrier" if part.carrier else part.rtl)


def library_files() -> list[Path]:
    """RTL of all parts with their carriers, in compile order."""
    return [path for group in listed().values() if group.name != "boards" for path in group.files]


def bender() -> str:
    """Bender.yml: one source group a group of rtl/files.yml; the carriers only with their target."""
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
    """Command file of a part; `-F` takes its paths relative to the file."""
    lines = [
        f"// {FROM}",
        f"// verilator -F packages/{part.rtl}.f; a --top-module after it selects a top of your own.",
        f"--top-module {part.top}",
        "+incdir+../rtl/common",
    ]
    return "\n".join([*lines, *(f"../{relative(path)}" for path in part_files(part)), ""])


def vivado() -> str:
    """Tcl for a Vivado project or a non-project script."""
    lines = "".join(f"  $root/{relative(path)} \\\n" for path in library_files())
    return (
        f"# {FROM}\n# {NOT_RUN}\n"
        "# Vivado, in a project: source .../packages/vivado.tcl\n"
        "set root [file normalize [file join [file dirname [info script]] ..]]\n"
        f"set files [list \\\n{lines}]\n"
        "add_files -norecurse $files\n"
        "set_property file_type SystemVerilog [get_files $files]\n"
        "set dirs [get_property include_dirs [current_fileset]]\n"
        "lappend dirs $root/rtl/common\n"
        "set_property include_dirs $dirs [current_fileset]\n"
    )


def quartus() -> str:
    """Lines of a Quartus settings file."""
    lines = "".join(
        f"set_global_assignment -name SYSTEMVERILOG_FILE $root/{relative(path)}\n" for path in library_files()
    )
    return (
        f"# {FROM}\n# {NOT_RUN}\n"
        "# Quartus, in the .qsf: set root /where/openppmc/is, then source $root/packages/quartus.qsf\n"
        "set_global_assignment -name SEARCH_PATH $root/rtl/common\n" + lines
    )


def gowin() -> str:
    """Tcl for gw_sh or the console of Gowin EDA."""
    lines = "".join(f"add_file -type verilog $root/{relative(path)}\n" for path in library_files())
    return (
        f"# {FROM}\n# {NOT_RUN}\n# Gowin EDA, with a project open: source .../packages/gowin.tcl\n"
        "set root [file normalize [file join [file dirname [info script]] ..]]\n"
        "set_option -verilog_std sysv2017\n"
        "set_option -include_path $root/rtl/common\n" + lines
    )


def list_files() -> dict[Path, str]:
    """All lists: path -> text."""
    return {
        ROOT / "Bender.yml": bender(),
        **{FOLDER / f"{part.rtl}.f": dot_f(part) for part in tops()},
        FOLDER / "vivado.tcl": vivado(),
        FOLDER / "quartus.qsf": quartus(),
        FOLDER / "gowin.tcl": gowin(),
    }
