"""FuseSoC core files (CAPI2): one core for each group of rtl/files.yml, the boards, the smoke test."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.header import Parameter, parameters
from cocotb_tests.harness.project import ROOT, listed, relative, top_file
from openppmc import __version__
from openppmc.parts import Row, tops
from openppmc.sources import Group, needed
from scripts.fpga.boards.description import FOLDER, load_all

WAIVERS = ROOT / "rtl" / "common" / "waivers.vlt"
HEAD = """CAPI=2:
# Written by `make packages` from rtl/files.yml; change that, not this.
"""
SMOKE_PART = "ppmc104"  # the part whose core has a sim target
# Options of the FuseSoC target by vendor's tool, and file type in FuseSoC by suffix of a constraint file.
FLOWS = {
    "vivado": "    flow: vivado\n    flow_options:\n      part: {device}\n",
    "quartus": "    default_tool: quartus\n    tools:\n      quartus:\n        family: {family}\n"
    "        device: {device}\n",
}
TYPES = {".xdc": "xdc", ".qsf": "tclSource", ".sdc": "SDC"}


@dataclass(frozen=True)
class Vendor:
    """A part on a board for a vendor's tool: top, constraint files with their types, options."""

    top: str
    constraints: dict[str, str]
    flow: str


def vendor_boards() -> dict[str, Vendor]:
    """Return the boards by FuseSoC target; the name of the target for a board's first part has no suffix."""
    found = {}
    for board in load_all():
        for on in board.parts if "target" in board.vendor else ():
            name = board.vendor["target"] + ("" if on is board.parts[0] else f"-{on.name}")
            files = sorted((FOLDER / board.name / on.name).iterdir(), reverse=True)  # pins before clocks
            found[name] = Vendor(
                board.top(on),
                {relative(path): TYPES[path.suffix] for path in files},
                FLOWS[board.vendor["tool"]].format(**board.vendor),
            )
    return found


def vlnv(name: str, library: str = "ppmc") -> str:
    """Return the full name of a core."""
    return f"openppmc:{library}:{name}:{__version__}"


def fileset(
    name: str,
    files: list[str],
    depend: list[str],
    kind: str = "systemVerilogSource",
    headers: tuple[str, ...] = (),
) -> str:
    """Return one entry below `filesets:`."""
    text = f"  {name}:\n"
    if files or headers:
        text += "    files:\n"
        text += "".join(f"      - {file}: {{is_include_file: true}}\n" for file in headers)
        text += "".join(f"      - {file}\n" for file in files)
        text += f"    file_type: {kind}\n"
    if depend:
        text += "    depend:\n" + "".join(f"      - {core}\n" for core in depend)
    return text


def group_core(group: Group, part: Row | None) -> str:
    """Return the core of one group (`part`: row of the part), with file names relative to its folder."""
    folder = group.files[0].parent
    headers = tuple(path.name for path in sorted(folder.glob("*.svh")))
    text = f"{HEAD}name: {vlnv(group.name)}\ndescription: OpenPPMC, {group.about}\n\nfilesets:\n"
    text += fileset(
        "rtl",
        [path.relative_to(folder).as_posix() for path in group.files],
        [vlnv(need) for need in group.needs],
        headers=headers,
    )
    if part is None:
        return text + "\ntargets:\n  default:\n    filesets: [rtl]\n"
    return text + part_targets(part)


def described(parameter: Parameter) -> str:
    """Return the description of a parameter as a YAML string: its comment in the header of the top."""
    about = parameter.about or parameter.name
    if about.startswith("or "):
        about = f"{parameter.default} {about}"
    return "'" + (about[0].upper() + about[1:]).replace("'", "''") + "'"


def part_targets(part: Row) -> str:
    """Return targets and parameters of a part's core."""
    params = parameters(top_file(part))
    text = fileset("waivers", [], [vlnv("waivers")])
    if part.name == SMOKE_PART:
        text += fileset("smoke", [], [vlnv(f"{part.name}_smoke", "test")])
    text += f"""
targets:
  default: &default
    filesets: [rtl]
    toplevel: {part.top}
    # In a design of a user, the instance of the part sets them.
    parameters: [{", ".join(f'"is_toplevel ? ({name})"' for name in params)}]
  # fusesoc run --target=lint openppmc:ppmc:{part.rtl}
  lint:
    <<: *default
    filesets: [rtl, waivers]
    flow: lint
    flow_options:
      tool: verilator
      verilator_options: [-Wall, --timing]
"""
    if part.name == SMOKE_PART:
        text += SIM_TARGET
    text += "\nparameters:\n"
    for name, parameter in params.items():
        kind = "str" if parameter.is_text else "int"
        text += f"  {name}:\n    datatype: {kind}\n    description: {described(parameter)}\n"
        text += f"    default: {parameter.default}\n"
        text += "    paramtype: vlogparam\n"
    return text


SIM_TARGET = f"""  # fusesoc run --target=sim openppmc:ppmc:{SMOKE_PART}
  # It works if it prints "{SMOKE_PART}_smoke: PASS".
  sim:
    filesets: [rtl, smoke]
    toplevel: {SMOKE_PART}_smoke
    flow: sim
    flow_options:
      tool: verilator
      mode: binary
      # Some builds of Verilator do not know the compiler's flags for coroutines and precompiled headers.
      verilator_options: [--timing, --assert, --output-split, "0", -CFLAGS, -std=c++20, -MAKEFLAGS,
        CFG_CXXFLAGS_PCH_I=-include]
"""

WAIVERS_CORE = f"""{HEAD}name: {vlnv("waivers")}
description: OpenPPMC, waivers of Verilator's lint

filesets:
  waivers:
    files:
      - waivers.vlt
    file_type: vlt

targets:
  default:
    filesets: [waivers]
"""

SMOKE = f"""{HEAD}name: {vlnv("ppmc104_smoke", "test")}
description: OpenPPMC, test bench of the sim target of the PPMC-104

filesets:
  tb:
    files:
      - ppmc104_smoke.sv
    file_type: systemVerilogSource

targets:
  default:
    filesets: [tb]
"""


def waivers() -> str:
    """Return the waivers for a part: lint/verilator.vlt without the paragraphs about board files."""
    paragraphs = (ROOT / "lint" / "verilator.vlt").read_text().split("\n\n")
    return "\n\n".join(text for text in paragraphs if "boards/" not in text)


def board_groups() -> list[Group]:
    """Return the groups that belong to no part: carriers, their shared files, the boards."""
    groups = listed()
    within = needed(groups, *(row.rtl for row in tops()))
    return [group for group in groups.values() if group.name not in within]


def boards_core() -> str:
    """Return the core of the boards. Its file is at the root, because constraints/ is not below rtl/."""
    files = [path for group in board_groups() for path in group.files]
    special = {path for path in files if path.name.startswith(("board_", "ppmc_clock_"))}
    text = f"{HEAD}name: {vlnv('boards', 'boards')}\n"
    text += "description: OpenPPMC, board tops of all parts; for the open-source flows see make bitstream\n\n"
    text += "filesets:\n"
    text += fileset(
        "rtl",
        [relative(path) for path in files if path not in special],
        [vlnv(row.rtl) for row in tops()],
    )
    targets = "\ntargets:\n  default:\n    filesets: [rtl]\n    toplevel: ppmc104_carrier\n"
    for target, board in vendor_boards().items():
        name = target.replace("-", "_")
        # The plain Verilog of the whole board: vendors' front ends reject the SystemVerilog (D-108).
        text += fileset(name, [f"build/verilog/{board.top}.v"], [], "verilogSource-2005")
        text += f"  {name}_pins:\n    files:\n"
        text += "".join(
            f"      - {file}: {{file_type: {kind}}}\n" for file, kind in board.constraints.items()
        )
        targets += f"  # First: make verilog TOP={board.top}\n"
        targets += f"  # Not run by this project's tests: it needs the vendor's tools.\n  {target}:\n"
        targets += f"    filesets: [{name}, {name}_pins]\n    toplevel: {board.top}\n{board.flow}"
    return text + targets


def core_files() -> dict[Path, str]:
    """Return the texts of all core files, by path."""
    groups, parts = listed(), {row.rtl: row for row in tops()}
    cores = {
        groups[name].files[0].parent / f"openppmc_{name}.core": group_core(groups[name], parts.get(name))
        for name in needed(groups, *parts)
    }
    cores[WAIVERS.parent / "openppmc_waivers.core"] = WAIVERS_CORE
    cores[WAIVERS] = waivers()
    cores[ROOT / "tb/ppmc104/ppmc104_smoke.core"] = SMOKE
    cores[ROOT / "openppmc_boards.core"] = boards_core()
    return cores
