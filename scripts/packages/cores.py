"""FuseSoC core files (CAPI2): one core a group of rtl/files.yml, the boards, the smoke test."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.project import PARTS, ROOT, file_groups, relative
from openppmc import __version__
from scripts.boards.description import FOLDER, load_all

WAIVERS = ROOT / "rtl" / "common" / "waivers.vlt"
HEAD = """CAPI=2:
# Written by `make packages` from rtl/files.yml; change that, not this.
"""
TEXT = {
    "common": "OpenPPMC, blocks that every part uses",
    "motion": "OpenPPMC, pulse timing, ramps, phases",
    "host": "OpenPPMC, host port of the parts, UART, Wishbone and AXI4-Lite bridges",
    "single": "OpenPPMC, what the parts with one axis share",
    "stage": "OpenPPMC, tables of 127 stages, ramps along them, exact intervals",
    "ppmc312": "OpenPPMC, PPMC-312, a stepper controller for one axis with block instructions",
    "pmc006": "OpenPPMC, PMC006B4, a microstepping controller with a serial line and user programs",
    "ppmc104": "OpenPPMC, PPMC-104, a stepper controller for one axis",
    "ppmc2104": "OpenPPMC, PPMC-2104, a stepper controller for two axes",
    "stmc": "OpenPPMC, J105 STMC, a stepper controller for one axis without pulse output",
    "j105_stmc": "OpenPPMC, J105 STMC, the PC/104 board with its second step clock",
    "isa_4axis": "OpenPPMC, four axes on an ISA bus, two PPMC-2104",
}
NEEDS = {
    "motion": ["common"],
    "host": ["common"],
    "single": ["common", "motion", "host"],
    "stage": ["common", "motion"],
}
PARAMETERS = {
    "CLK_HZ": ("int", "Frequency of clk in Hz, 8e6 .. 200e6", "16000000"),
    "XTAL_HZ": ("int", "Crystal of the old chip in Hz, 1e6 .. 16e6", "16000000"),
    "TIMING": ("str", "FAST or DATASHEET", "FAST"),
    "PHASE_IDLE": ("int", "Level of s until the first initialisation", "1"),
}
# Parts that have no parameter of that name.
LACKS = {"PHASE_IDLE": ("ppmc2104", "isa_4axis", "j105_stmc", "ppmc312", "pmc006")}
STMC = {
    "XTAL_HZ": ("int", "Crystal of the old part in Hz, 1e6 .. 20e6", "16000000"),
    "READ_MAP": ("str", "Codes of the read commands, SHEET or FAMILY", "SHEET"),
    "HOLD_XT": ("int", "Hold delay in crystal cycles", "544000"),
    "CHOP_ON_XT": ("int", "On time of the chopper in crystal cycles", "1040"),
    "CHOP_OFF_XT": ("int", "Off time of the chopper in crystal cycles", "1740"),
}
# What a part has in their place, or besides.
OWN = {
    "stmc": {**STMC, "PHASE_IDLE": ("int", "Level of s until the first initialisation", "0")},
    "j105_stmc": {
        **STMC,
        "BASE_ADDR": ("int", "ISA address of the data register, even", "944"),
        "EXT_HZ": ("int", "Second step clock in Hz, 1 .. CLK_HZ / 4", "48675"),
    },
    "ppmc312": {
        "VERSION": ("int", "Byte that the version instruction answers, 0 .. 255", "18"),
        "SUM_MODE": ("str", "Checksum of the serial mode, BINARY or CHARS", "BINARY"),
    },
    "pmc006": {
        "XTAL_HZ": ("int", "Without effect", "16000000"),
        "STEP_ACK": ("str", "Answer to the step command, MANUAL (3) or ECHO (its data)", "MANUAL"),
        "BAUD": ("int", "Serial rate, 1200 .. 115200", "9600"),
        "I2C_HZ": ("int", "Clock of the EEPROM, 10000 .. 400000", "400000"),
        "EE_DEV": ("int", "Address of the EEPROM, 0 .. 127", "80"),
        "T_OFF_NS": ("int", "Off time of the chopper in ns, 1000 .. 100000", "20000"),
        "T_BLANK_NS": ("int", "Blanking of the comparator in ns, 100 .. 10000", "1000"),
        "FW_VERSION": ("int", "Answer to the version command, 32 bits", "291"),
    },
}
SMOKE_PART = "ppmc104"  # the one with a sim target
# Vendor's tool -> what a target says to FuseSoC; constraint file's suffix -> its type there.
FLOWS = {
    "vivado": "    flow: vivado\n    flow_options:\n      part: {device}\n",
    "quartus": "    default_tool: quartus\n    tools:\n      quartus:\n        family: {family}\n"
    "        device: {device}\n",
}
TYPES = {".xdc": "xdc", ".qsf": "tclSource", ".sdc": "SDC"}


@dataclass(frozen=True)
class Vendor:
    """A board with a part, for a vendor's tool: top, constraint files with their types, options."""

    top: str
    source: Path
    constraints: dict[str, str]
    flow: str


def vendor_boards() -> dict[str, Vendor]:
    """FuseSoC target -> board; the first part of a board has the target's plain name."""
    found = {}
    for board in load_all():
        for on in board.parts if board.vendor else ():
            name = board.vendor["target"] + ("" if on is board.parts[0] else f"-{on.name}")
            files = sorted((FOLDER / board.name / on.name).iterdir(), reverse=True)  # pins, clocks
            found[name] = Vendor(
                board.top(on),
                ROOT / "rtl" / "boards" / board.name / f"{board.top(on)}.sv",
                {relative(path): TYPES[path.suffix] for path in files},
                FLOWS[board.vendor["tool"]].format(**board.vendor),
            )
    return found


def vlnv(name: str, library: str = "ppmc") -> str:
    """Full name of a core."""
    return f"openppmc:{library}:{name}:{__version__}"


def fileset(
    name: str,
    files: list[str],
    depend: list[str],
    kind: str = "systemVerilogSource",
    headers: tuple[str, ...] = (),
) -> str:
    """One entry below `filesets:`."""
    text = f"  {name}:\n"
    if files or headers:
        text += "    files:\n"
        text += "".join(f"      - {file}: {{is_include_file: true}}\n" for file in headers)
        text += "".join(f"      - {file}\n" for file in files)
        text += f"    file_type: {kind}\n"
    if depend:
        text += "    depend:\n" + "".join(f"      - {core}\n" for core in depend)
    return text


def group_core(group: str, files: list[Path]) -> str:
    """Core of one group; its files are named relative to the group's folder."""
    folder = files[0].parent
    headers = tuple(path.name for path in sorted(folder.glob("*.svh")))
    needs = NEEDS.get(group, [])
    if group in PARTS:
        needs = [need for need in PARTS[group].groups if need != group]
    text = f"{HEAD}name: {vlnv(group)}\ndescription: {TEXT[group]}\n\nfilesets:\n"
    text += fileset(
        "rtl",
        [path.relative_to(folder).as_posix() for path in files],
        [vlnv(need) for need in needs],
        headers=headers,
    )
    if group not in PARTS:
        return text + "\ntargets:\n  default:\n    filesets: [rtl]\n"
    return text + part_targets(group)


def part_targets(part: str) -> str:
    """Targets and parameters of a part's core."""
    params = {name: text for name, text in PARAMETERS.items() if part not in LACKS.get(name, ())}
    params |= OWN.get(part, {})
    text = fileset("waivers", [], [vlnv("waivers")])
    if part == SMOKE_PART:
        text += fileset("smoke", [], [vlnv(f"{part}_smoke", "test")])
    text += f"""
targets:
  default: &default
    filesets: [rtl]
    toplevel: {part}
    # In a design of someone else they are set by the one that instantiates the part.
    parameters: [{", ".join(f'"is_toplevel ? ({name})"' for name in params)}]
  # fusesoc run --target=lint openppmc:ppmc:{part}
  lint:
    <<: *default
    filesets: [rtl, waivers]
    flow: lint
    flow_options:
      tool: verilator
      verilator_options: [-Wall, --timing]
"""
    if part == SMOKE_PART:
        text += SIM_TARGET
    text += "\nparameters:\n"
    for name, (kind, about, value) in params.items():
        text += f"  {name}:\n    datatype: {kind}\n    description: {about}\n    default: {value}\n"
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
      # Some builds of Verilator do not know their compiler's flag for coroutines, or for split C++ output.
      verilator_options: [--timing, --assert, --output-split, "0", -CFLAGS, -std=c++20]
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


def boards_core(files: list[Path]) -> str:
    """Core of the boards; it lies at the root, because constraints/ is not below rtl/."""
    special = {path for path in files if path.name.startswith(("board_", "ppmc_clock_"))}
    text = f"{HEAD}name: {vlnv('boards', 'boards')}\n"
    text += "description: OpenPPMC, board tops of all parts; for the open-source flows see make bitstream\n\n"
    text += "filesets:\n"
    text += fileset(
        "rtl", [relative(path) for path in files if path not in special], [vlnv(part) for part in PARTS]
    )
    targets = "\ntargets:\n  default:\n    filesets: [rtl]\n    toplevel: ppmc104_carrier\n"
    for target, board in vendor_boards().items():
        name = target.replace("-", "_")
        text += fileset(name, [relative(board.source)], [])
        text += f"  {name}_pins:\n    files:\n"
        text += "".join(
            f"      - {file}: {{file_type: {kind}}}\n" for file, kind in board.constraints.items()
        )
        targets += f"  # Not run by this project's tests: it needs the vendor's tools.\n  {target}:\n"
        targets += f"    filesets: [rtl, {name}, {name}_pins]\n    toplevel: {board.top}\n{board.flow}"
    return text + targets


def core_files() -> dict[Path, str]:
    """All core files: path -> text."""
    groups = file_groups()
    cores = {
        groups[group][0].parent / f"openppmc_{group}.core": group_core(group, groups[group]) for group in TEXT
    }
    cores[WAIVERS.parent / "openppmc_waivers.core"] = WAIVERS_CORE
    cores[WAIVERS] = (ROOT / "lint" / "verilator.vlt").read_text()
    cores[ROOT / "tb/ppmc104/ppmc104_smoke.core"] = SMOKE
    cores[ROOT / "openppmc_boards.core"] = boards_core(groups["boards"])
    return cores
