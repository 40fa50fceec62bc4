"""Bender.yml and the file lists: one a part for Verilator, one of all for Vivado, Quartus, Gowin EDA."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import PARTS, ROOT, board_files, file_groups, relative

FROM = "Written by `make packages` from rtl/files.yml; change that, not this."
NOT_RUN = "Not run by this project's tests, which have no vendor tools; please report what does not work."
FOLDER = ROOT / "packages"


def board_modules() -> list[Path]:
    """Part with its host, for each part that has one, without what belongs to single boards."""
    used = {path for part in PARTS for path in board_files(part)}
    return [path for path in file_groups()["boards"] if path in used]


def part_files(part: str) -> list[Path]:
    """RTL of a part and its board module, in compile order."""
    return [path for group in PARTS[part].groups for path in file_groups()[group]] + board_files(part)


def library_files() -> list[Path]:
    """RTL of all parts with their board modules, in compile order."""
    groups = file_groups()
    return [path for group in groups if group != "boards" for path in groups[group]] + board_modules()


def bender() -> str:
    """Bender.yml: one source group a group of rtl/files.yml; the boards only with their target."""
    text = f"# {FROM}\npackage:\n  name: openppmc\n  authors: [OpenPPMC]\n\n"
    text += "export_include_dirs: [rtl/common]\n\nsources:\n"
    for group, files in file_groups().items():
        text += f"  # {group}\n  - include_dirs: [rtl/common]\n"
        if group == "boards":
            text += "    target: openppmc_boards\n"
            files = board_modules()
        text += "    files:\n" + "".join(f"      - {relative(path)}\n" for path in files)
    return text


def dot_f(part: str) -> str:
    """Command file of a part; `-F` takes its paths relative to the file."""
    lines = [f"// {FROM}", f"// verilator -F packages/{part}.f --top-module {part}", "+incdir+../rtl/common"]
    return "\n".join([*lines, *(f"../{relative(path)}" for path in part_files(part)), ""])


def vivado() -> str:
    """Tcl for a Vivado project or a non-project script."""
    files = "".join(f"  $root/{relative(path)} \\\n" for path in library_files())
    return (
        f"# {FROM}\n# {NOT_RUN}\n"
        "# Vivado, in a project: source .../packages/vivado.tcl\n"
        "set root [file normalize [file join [file dirname [info script]] ..]]\n"
        f"set files [list \\\n{files}]\n"
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
        **{FOLDER / f"{part}.f": dot_f(part) for part in PARTS},
        FOLDER / "vivado.tcl": vivado(),
        FOLDER / "quartus.qsf": quartus(),
        FOLDER / "gowin.tcl": gowin(),
    }
