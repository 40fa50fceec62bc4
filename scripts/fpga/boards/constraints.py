"""Constraint files in the formats of nextpnr (.pcf, .lpf, .cst), Vivado (.xdc) and Quartus (.qsf)."""

from __future__ import annotations

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
        f"set_location_assignment PIN_{pad.pin} -to {pad.bit}  ;# {pad.where}",
        f'set_instance_assignment -name IO_STANDARD "{pad.standard}" -to {pad.bit}',
    ]
    if pad.pull == "up":
        lines.append(f"set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {pad.bit}")
    return lines


PADS = {"pcf": pcf, "lpf": lpf, "cst": cst, "xdc": xdc, "qsf": qsf}
COMMENT = {"pcf": "#", "lpf": "#", "cst": "//", "xdc": "#", "qsf": "#"}
APART = ("cst", "qsf")
"""Formats without clock constraints: the clocks are in clocks.sdc."""


def preamble(fitted: Fitted) -> list[str]:
    """Return the lines before the pins: the board's own statements, and the device for Quartus."""
    board, lines = fitted.board, list[str]()
    mark = COMMENT[board.language]
    if board.statements:
        lines += ["", f"{mark} {board.statements['reason']}", *board.statements["lines"]]
    if board.language == "qsf":
        lines += [
            "",
            "# To be sourced into a project: device, top, pins. The sources are listed by rtl/files.yml.",
            f'set_global_assignment -name FAMILY "{board.vendor["family"]}"',
            f"set_global_assignment -name DEVICE {board.vendor['device']}",
            f"set_global_assignment -name TOP_LEVEL_ENTITY {fitted.top}",
            "set_global_assignment -name SDC_FILE clocks.sdc",
        ]
    return lines


def clock(fitted: Fitted) -> list[str]:
    """Return the constraint of the oscillator."""
    port, mhz = fitted.board.clock["port"], fitted.board.clock["mhz"]
    language = fitted.board.language
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
    """Return the constraint files of a board with a part: name below constraints/ -> text."""
    board, on = fitted.board, fitted.on
    language = board.language
    mark = COMMENT[language]
    about = f"{fitted.top}: {title(fitted)}. Wiring: docs/boards.md."
    lines = [*head(fitted, mark), *wrapped(mark, about, on.note)]
    lines += preamble(fitted)
    for group in fitted.groups:
        lines += ["", f"{mark} {group.title}"]
        lines += [line.rstrip() for pad in group.pads for line in PADS[language](fitted, pad)]
    name = board.constraints(on)
    if language not in APART:
        return {name: "\n".join([*lines, "", *clock(fitted), ""])}
    clocks = [*head(fitted, "#"), *wrapped("#", about), "", *clock(fitted), ""]
    return {name: "\n".join([*lines, ""]), f"{board.name}/{on.name}/clocks.sdc": "\n".join(clocks)}
