"""Constraint files for nextpnr (.pcf, .lpf, .cst) and vendors' tools (.xdc, .qsf, .pdc, .isf, .cst)."""

from __future__ import annotations

import re

from scripts.fpga.boards.pads import Fitted, Pad
from scripts.fpga.boards.texts import head, title, wrapped


def pcf(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for the iCE40, whose pads have pull-ups but no pull-downs."""
    pull = "-pullup yes " if pad.pull == "up" else ""
    return [f"{f'set_io {pull}{pad.bit}':<30}{pad.pin:<3} # {pad.where}"]


def lpf(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for the ECP5."""
    drive = f" DRIVE={fitted.board.pads['drive']}" if pad.way != "in" else ""
    place = f'LOCATE COMP "{pad.bit}" SITE "{pad.pin}";'
    buffer = f'IOBUF PORT "{pad.bit}" PULLMODE={pad.pull.upper()} IO_TYPE={pad.standard}{drive};'
    return [f"{place:<41} {buffer:<77} # {pad.where}"]


def cst(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for Gowin."""
    drive = f" DRIVE={fitted.board.pads['drive']}" if pad.way != "in" else ""
    buffer = f'IO_PORT "{pad.bit}" IO_TYPE={pad.standard} PULL_MODE={pad.pull.upper()}{drive};'
    return [f'IO_LOC "{pad.bit}" {pad.pin}; // {pad.where}', buffer]


def xdc(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for the Artix-7."""
    pull = {"up": " PULLUP TRUE", "down": " PULLDOWN TRUE", "none": ""}[pad.pull]
    words = f"PACKAGE_PIN {pad.pin:<3} IOSTANDARD {pad.standard}{pull}"
    return [f"set_property -dict {{{words}}} [get_ports {{{pad.bit}}}] ; # {pad.where}"]


def qsf(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for the Cyclone V."""
    lines = [
        f"set_location_assignment PIN_{pad.pin} -to {{{pad.bit}}}  ;# {pad.where}",
        f'set_instance_assignment -name IO_STANDARD "{pad.standard}" -to {{{pad.bit}}}',
    ]
    if pad.pull == "up":
        lines.append(f"set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {{{pad.bit}}}")
    return lines


def pdc(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad of the iCE40 for Radiant."""
    pull = " PULLMODE=100K" if pad.pull == "up" else ""
    return [
        f"ldc_set_location -site {{{pad.pin}}} [get_ports {{{pad.bit}}}] ;# {pad.where}",
        f"ldc_set_port -iobuf {{IO_TYPE={pad.standard}{pull}}} [get_ports {{{pad.bit}}}]",
    ]


def isf(fitted: Fitted, pad: Pad) -> list[str]:
    """Return the lines of a pad for the Trion: calls of Efinity's Interface Designer."""
    way = {"in": "input", "out": "output"}[pad.way]
    bits = fitted.bits(pad.port)
    lines = []
    if pad.bit == bits[0]:
        high, low = (re.sub(r"\D", "", bit.removeprefix(pad.port)) for bit in (bits[-1], bits[0]))
        bus = f", {high}, {low}" if low else ""
        lines.append(f'design.create_{way}_gpio("{pad.port}"{bus})')
    lines += [
        f'design.assign_pkg_pin("{pad.bit}", "{pad.pin}")  # {pad.where}',
        f'design.set_property("{pad.bit}", "IO_STANDARD", "{pad.standard}")',
    ]
    if pad.pull == "up":
        lines.append(f'design.set_property("{pad.bit}", "PULL_OPTION", "WEAK_PULLUP")')
    return lines


PADS = {"pcf": pcf, "lpf": lpf, "cst": cst, "xdc": xdc, "qsf": qsf, "pdc": pdc, "isf": isf}
COMMENT = dict.fromkeys(PADS, "#") | {"cst": "//"}
APART = ("cst", "qsf", "isf")
"""Formats without clock constraints: the clocks are in clocks.sdc."""


def preamble(fitted: Fitted, language: str) -> list[str]:
    """Return the lines that precede the pins: the board's own statements, and the device for Quartus."""
    board, lines = fitted.board, list[str]()
    mark = COMMENT[language]
    if board.statements:
        lines += ["", f"{mark} {board.statements['reason']}", *board.statements["lines"]]
    if language == "qsf":
        lines += [
            "",
            "# To be sourced into a project: device, top, pins. Also add the plain Verilog and clocks.sdc.",
            f'set_global_assignment -name FAMILY "{board.vendor["family"]}"',
            f"set_global_assignment -name DEVICE {board.vendor['device']}",
            f"set_global_assignment -name TOP_LEVEL_ENTITY {fitted.top}",
        ]
    return lines


def clock(fitted: Fitted, language: str) -> list[str]:
    """Return the constraint of the oscillator."""
    port, mhz = fitted.board.clock["port"], fitted.board.clock["mhz"]
    derived = "; the PLL's output follows from it" if "module" in fitted.board.clock else ""
    lines = [f"# oscillator{derived}"]
    if language == "pcf":
        return [*lines, f"set_frequency {port} {mhz}"]
    if language == "lpf":
        return [*lines, f'FREQUENCY PORT "{port}" {mhz} MHZ;']
    create = f"create_clock -name {port} -period {1000 / mhz:.3f} [get_ports {{{port}}}]"
    free = "# Every input is synchronised inside, and no output has a phase that matters outside."
    if language == "xdc":
        inputs = f"[get_ports -filter {{DIRECTION != OUT && NAME != {port}}}]"
        outputs = "[get_ports -filter {DIRECTION != IN}]"
        return [*lines, create, "", free, f"set_false_path -from {inputs}", f"set_false_path -to {outputs}"]
    if language == "qsf":
        inputs = f"[remove_from_collection [all_inputs] [get_ports {{{port}}}]]"
        derive = "derive_clock_uncertainty"
        paths = [f"set_false_path -from {inputs}", "set_false_path -to [all_outputs]"]
        return [*lines, create, derive, "", free, *paths]
    return [*lines, create]


def files(fitted: Fitted) -> dict[str, str]:
    """Return the texts of the constraint files of a board with a part, by name below constraints/."""
    return {
        name: text for language in fitted.board.languages for name, text in files_in(fitted, language).items()
    }


def files_in(fitted: Fitted, language: str) -> dict[str, str]:
    """Return the pin file in one format, and the file with the clocks if the format has one."""
    board, on, mark = fitted.board, fitted.on, COMMENT[language]
    about = f"{fitted.top}: {title(fitted)}. Wiring: docs/boards.md."
    lines = [*head(fitted, mark), *wrapped(mark, about, on.note)]
    lines += preamble(fitted, language)
    for group in fitted.groups:
        lines += ["", f"{mark} {group.title}"]
        lines += [line.rstrip() for pad in group.pads for line in PADS[language](fitted, pad)]
    name = board.constraints(on, language)
    if language not in APART:
        return {name: "\n".join([*lines, "", *clock(fitted, language), ""])}
    clocks = [*head(fitted, "#"), *wrapped("#", about), "", *clock(fitted, language), ""]
    return {name: "\n".join([*lines, ""]), f"{board.name}/{on.name}/clocks.sdc": "\n".join(clocks)}
