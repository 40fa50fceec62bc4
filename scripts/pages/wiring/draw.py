"""Draw the wiring of a board with a part (schemdraw): headers left, machine or old host right."""

from __future__ import annotations

from typing import Any

import schemdraw
import schemdraw.elements as elm

from scripts.fpga.boards.pads import Fitted, Pad
from scripts.pages.wiring.circuits import Use, text, uses

ROW = 0.62
GAP = 1.0
HEAD = 0.9
BOARD, WIRE, CHIP, OUT, FAR, END = 0.0, 5.6, 8.4, 13.4, 15.2, 23.6
"""Left edges of the columns in units of schemdraw."""
INK, PALE, FIVE, LOW = "#1b2733", "#eef2f6", "#c0392b", "#0b6fb8"
TINY, SMALL, TEXT, TITLE = 8, 9.5, 10, 11.5
DRAWN = 2
"""Largest number of motors for which each driver carrier is drawn separately."""
BEHIND = {
    "MAX3485": ("A and B: the line's pair, grounds joined", FIVE),
    "24LC32A": ("", LOW),
    "power stage": ("windings A and B, motor supply", FIVE),
    "DRV8825 carrier": ("A1, A2, B1, B2: motor; VMOT: supply", FIVE),
}
"""Text about the connections of each module at the end of a drawing, and colour of the wire to this text."""


def draw(fitted: Fitted) -> bytes:
    """Return the drawing as SVG."""
    schemdraw.use("svg")
    with schemdraw.Drawing(
        show=False, unit=1.6, inches_per_unit=0.42, fontsize=TEXT, color=INK, lw=1.2, margin=0.4
    ) as sheet:
        y = 0.0
        title = f"{fitted.board.title}: {fitted.on.row.title}"
        _text(sheet, BOARD, y, title, 14)
        _text(sheet, BOARD, y - 0.75, "blue: 3.3 V at most; red: 5 V or more", SMALL)
        y -= 1.9
        for use in uses(fitted):
            y = _use(sheet, use, y)
    data: bytes = sheet.get_imagedata("svg")
    return data


def _use(sheet: Any, use: Use, y: float) -> float:
    """Draw one circuit; return the y coordinate below it."""
    _text(sheet, BOARD, y, use.circuit.title, TITLE)
    y -= HEAD
    if use.circuit.chip.startswith("opto"):
        return _opto(sheet, use, y)
    groups = _chips(use)
    for number, pads in enumerate(groups):
        y = _chip(sheet, use, pads, y, number if len(groups) > 1 else -1)
    return _note(sheet, use, y)


def _chips(use: Use) -> list[tuple[Pad, ...]]:
    """Return the pins of each chip. With more than DRAWN motors, all drivers share one box."""
    size = use.circuit.channels if use.circuit.channels > 1 else len(use.pads)
    if use.circuit.key == "steps":
        motors = sum(pad.port == "pout_n" for pad in use.pads)
        size = len(use.pads) // motors if motors <= DRAWN else len(use.pads)
    return [use.pads[at : at + size] for at in range(0, len(use.pads), size)]


def _chip(sheet: Any, use: Use, pads: tuple[Pad, ...], y: float, number: int) -> float:
    """Draw a chip with its pins on both sides; return the y coordinate below it."""
    height = ROW * len(pads) + 0.35
    name = use.circuit.chip + (f" {number + 1}" if number >= 0 else "")
    plain = use.circuit.chip in ("jumper", "header", "microcontroller")
    if use.circuit.chip in BEHIND:
        return _last(sheet, use, pads, y, height, name)
    _box(sheet, BOARD, y, WIRE - BOARD, height, _near_colour(use, pads[0]))
    _box(sheet, FAR, y, END - FAR, height, _far_colour(use))
    if not plain:
        _box(sheet, CHIP, y, OUT - CHIP, height, INK)
        _text(sheet, (CHIP + OUT) / 2, y + 0.32, name, TEXT, "center")
    for row, pad in enumerate(pads):
        at = y - 0.45 - row * ROW
        _pin(sheet, pad, at)
        _wire(sheet, WIRE, at, FAR if plain else CHIP, at, _near_colour(use, pad))
        if not plain:
            _channel(sheet, use, pad, row, at)
        _pull(sheet, use, pad, at)
        if pad.port != "d_oe":
            _text(sheet, FAR + 0.25, at, text(use.circuit.far, pad), SMALL)
    return y - height - (0.95 if number >= 0 else 0.75)


def _last(sheet: Any, use: Use, pads: tuple[Pad, ...], y: float, height: float, name: str) -> float:
    """Draw a module at the end of the wiring; return the y coordinate below it."""
    _box(sheet, BOARD, y, WIRE - BOARD, height, _near_colour(use, pads[0]))
    _box(sheet, CHIP, y, FAR + 0.6 - CHIP, height, INK)
    _text(sheet, CHIP + 0.2, y + 0.32, name, TEXT)
    for row, pad in enumerate(pads):
        at = y - 0.45 - row * ROW
        _pin(sheet, pad, at)
        _wire(sheet, WIRE, at, CHIP, at, _near_colour(use, pad))
        _pull(sheet, use, pad, at)
        _text(sheet, CHIP + 0.2, at, text(use.circuit.far, pad), SMALL)
    behind, level = BEHIND[use.circuit.chip]
    middle = y - height / 2
    if behind:
        _wire(sheet, FAR + 0.6, middle, FAR + 1.8, middle, level)
        _text(sheet, FAR + 2.0, middle, behind, SMALL)
    return y - height - 0.95


def _channel(sheet: Any, use: Use, pad: Pad, row: int, at: float) -> None:
    """Draw the pins of a channel, and the wire on the side of the machine or old host."""
    chip = use.circuit.chip
    if pad.port == "d_oe":
        _text(sheet, CHIP + 0.2, at, "DIR", SMALL)
        return
    near, far = {
        "74LVC8T245": (f"A{row + 1}", f"B{row + 1}"),
        "ULN2003A": (f"IN{row + 1}", f"OUT{row + 1}"),
    }.get(chip, ("", ""))
    inward = pad.way == "in"
    if chip.startswith("74LVC245"):
        near, far = f"B{row + 1}", f"A{row + 1}"
    elif chip.startswith(("74HCT244", "74LVC1G07")):
        near, far = "A", "Y"
    _text(sheet, CHIP + 0.2, at, near, SMALL)
    _text(sheet, OUT - 0.2, at, far, SMALL, "right")
    if use.circuit.key == "control":
        _text(sheet, (OUT + FAR) / 2, at + 0.2, "33 Ω", TINY, "center")
    arrow = "◂" if inward else "▸" if pad.way == "out" else "◂▸"
    _text(sheet, (CHIP + OUT) / 2, at, arrow, SMALL, "center")
    _wire(sheet, OUT, at, FAR, at, _far_colour(use))


def _pull(sheet: Any, use: Use, pad: Pad, at: float) -> None:
    """Write the values of the resistors on the FPGA's side on their wires; symbols would be too many."""
    to = use.pull(pad)
    if to:
        x = (WIRE + CHIP) / 2
        sheet.add(elm.Dot(radius=0.05).theta(0).at((x - 0.95, at)).color(LOW))
        _text(sheet, x - 0.85, at + 0.2, f"{use.resistor} to {to}", TINY)


def _opto(sheet: Any, use: Use, y: float) -> float:
    """Draw one optocoupler channel completely, as an example for all pins with such a channel."""
    failsafe = use.circuit.chip == "opto"
    height = max(4.5, ROW * len(use.pads) + 0.35)
    _box(sheet, BOARD, y, WIRE - BOARD, height, LOW)
    _box(sheet, FAR, y, END - FAR, height, _far_colour(use))
    for row, pad in enumerate(use.pads):
        at = y - 0.45 - row * ROW
        _pin(sheet, pad, at)
        _text(sheet, FAR + 0.25, at, text(use.circuit.far, pad), SMALL)
    top = y - 1.0
    opto = sheet.add(elm.Optocoupler().theta(0).reverse().at((OUT - 0.6, top)).anchor("anode"))
    anode, cathode = opto.absanchors["anode"], opto.absanchors["cathode"]
    collector, emitter = opto.absanchors["collector"], opto.absanchors["emitter"]
    if collector[1] < emitter[1]:
        collector, emitter = emitter, collector
    sheet.add(elm.Resistor().at(anode).to((FAR, anode[1])).label("2.2 kΩ", fontsize=TINY).color(FIVE))
    _wire(sheet, cathode[0], cathode[1], FAR - 0.5, cathode[1], FIVE)
    _text(sheet, FAR - 0.45, cathode[1] - 0.35, "0 V of the 24 V", TINY, "right")
    pin = emitter if failsafe else collector
    other = collector if failsafe else emitter
    _wire(sheet, WIRE, pin[1], pin[0], pin[1], LOW)
    if failsafe:
        sheet.add(elm.Vdd().theta(0).at(other).label("3.3 V", fontsize=TINY).color(LOW))
        for element, x, value in ((elm.Resistor, 1.0, "1 kΩ"), (elm.Capacitor, 2.6, "10 nF")):
            wired = element().at((WIRE + x, pin[1])).down().length(1.1)
            sheet.add(wired.label(value, loc="bottom", fontsize=TINY).color(LOW))
            sheet.add(elm.Ground().theta(0).color(LOW))
    else:
        wired = elm.Resistor().at((WIRE + 1.4, pin[1])).up().length(1.0)
        sheet.add(wired.label(use.resistor, loc="bottom", fontsize=TINY).color(LOW))
        sheet.add(elm.Vdd().theta(0).label("3.3 V", fontsize=TINY).color(LOW))
        sheet.add(elm.Ground().theta(0).at(other).color(LOW))
    return _note(sheet, use, y - height - 0.75)


def _note(sheet: Any, use: Use, y: float) -> float:
    if use.circuit.note:
        _text(sheet, BOARD, y + 0.2, use.circuit.note, SMALL)
        y -= 0.5
    return y - GAP


def _near_colour(use: Use, pad: Pad) -> str:
    return LOW if use.level(pad) == "3.3 V" else FIVE


def _far_colour(use: Use) -> str:
    return LOW if use.circuit.level.startswith(("3.3 V", "GND")) else FIVE


def _pin(sheet: Any, pad: Pad, at: float) -> None:
    """Write the header pin and the signal."""
    where = pad.where.split(",")[0]
    _text(sheet, BOARD + 0.25, at, where, SMALL)
    _text(sheet, WIRE - 0.2, at, pad.bit, SMALL, "right")


def _box(sheet: Any, x: float, y: float, width: float, height: float, colour: str) -> None:
    sheet.add(elm.Rect(corner1=(0, 0), corner2=(width, -height), fill=PALE).theta(0).at((x, y)).color(colour))


def _wire(sheet: Any, x: float, y: float, to_x: float, to_y: float, colour: str) -> None:
    sheet.add(elm.Line().at((x, y)).to((to_x, to_y)).color(colour))


def _text(sheet: Any, x: float, y: float, text: str, size: float, align: str = "left") -> None:
    sheet.add(
        elm.Label()
        .theta(0)
        .at((x, y))
        .label(text, fontsize=size, halign=align, valign="center", loc="center", ofst=0)
    )
