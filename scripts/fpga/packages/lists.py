"""Bender.yml and the file lists of the parts for Verilator."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness.project import ROOT, files, listed, relative
from openppmc.parts import Row, tops
from openppmc.sources import Group
from scripts.fpga.packages.cores import board_groups

FROM = "Written by `make packages` from rtl/files.yml; change that, not this."
FOLDER = ROOT / "packages"


def carrier_groups() -> list[Group]:
    """Return the carriers and their shared files, without files of single boards."""
    return [group for group in board_groups() if group.name != "boards"]


def part_files(part: Row) -> list[Path]:
    """Return the RTL of a part and of its carrier, in compile order."""
    return files(f"{part.rtl}_carrier" if part.carrier else part.rtl)


def bender() -> str:
    """Return Bender.yml with a source group per group of rtl/files.yml; carriers have a target."""
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


def list_files() -> dict[Path, str]:
    """Return the texts of all lists, by path."""
    return {
        ROOT / "Bender.yml": bender(),
        **{FOLDER / f"{part.rtl}.f": dot_f(part) for part in tops()},
    }
