"""The circuit of each pin of a board, and its components. Reasons: docs/boards.md, sections 4 to 9."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import yaml

from scripts.fpga.boards.pads import Fitted, Pad

WEAK, STRONG = "2.2 kΩ", "1 kΩ"
STRONG_FPGA = ("artix7", "cyclone5")
"""FPGA families with stronger internal pull-ups, which need the resistor STRONG."""
Choice = str | Mapping[str, str]
"""One text for all ports, or a text for each pattern of port names."""


@dataclass(frozen=True)
class Circuit:
    """The circuit of a group of pins, from circuits.yml; comments there explain the values.

    Attributes:
        chip: name of the chip in the drawing; it has `channels` channels.
        level: signal level on the side of the circuit that faces the machine or the old host.
        note: text below the drawing.
    """

    key: str
    title: str
    ports: str
    chip: str
    far: Choice
    level: str
    channels: int = 1
    pull: Choice = ""
    items: Sequence[tuple[str, str, int | str]] = ()
    modules: Sequence[tuple[str, str, str]] = ()
    note: str = ""


def _idle(pad: Pad) -> str:
    """Return the level to which the resistor pulls an output: "3.3 V" if it is active low, else "GND"."""
    return "3.3 V" if pad.port.endswith("_n") else "GND"


FROM_ONE = ("gpi", "gpo")
"""Ports whose bit 0 has the number 1 in the data sheet of the old chip."""


def _old(pad: Pad) -> str:
    """Return the name in the data sheet of the old chip."""
    name, bracket, bit = pad.bit.partition("[")
    star = "*" if name.endswith("_n") else ""
    number = bit.rstrip("]")
    if name in ("s1", "s2"):
        return f"S{number}{name[1]}"  # phase and axis, as in the data sheet of the PPMC-2104
    if bracket and name in FROM_ONE:
        number = str(int(number) + 1)
    return f"{name.removesuffix('_n').upper()}{number}{star}"


CIRCUITS = [
    Circuit(**entry)
    for entry in yaml.safe_load(Path(__file__).with_suffix(".yml").read_text(encoding="utf-8"))
]


def text(choice: Choice, pad: Pad) -> str:
    """Return the text for a pin from `far` or `pull` of its circuit; "" if no pattern fits."""
    texts = {"*": choice} if isinstance(choice, str) else choice
    found = next((value for pattern, value in texts.items() if fnmatch(pad.port, pattern)), "")
    return found.format(old=_old(pad), pin=pad.port.removesuffix("_n").upper(), idle=_idle(pad))


@dataclass(frozen=True)
class Use:
    """A circuit with all pins that use it."""

    circuit: Circuit
    pads: tuple[Pad, ...]
    strong: bool
    buffered: str = ""  # level of the outputs, if the board has buffers before its headers

    @property
    def resistor(self) -> str:
        """Value of the resistors on the FPGA's side."""
        return STRONG if self.strong else WEAK

    def pull(self, pad: Pad) -> str:
        """Return the level to which a resistor pulls the header pin; "" without one.

        A buffer of the board always drives its outputs, so that a resistor has no effect.
        """
        return "" if self.buffered and pad.way == "out" else text(self.circuit.pull, pad)

    def level(self, pad: Pad) -> str:
        """Return the level at the header pin."""
        return self.buffered if self.buffered and pad.way == "out" else "3.3 V"

    def number(self, of: int | str) -> int:
        """Return a quantity of circuits.yml as a number; a word represents the number of pins or of chips."""
        pins = sum(pad.port != "d_oe" for pad in self.pads)
        counts = {"pin": pins, "chip": -(-pins // self.circuit.channels)}
        return of if isinstance(of, int) else counts.get(of, sum(pad.port == of for pad in self.pads))


def _circuit_of(fitted: Fitted, pad: Pad) -> str:
    """Return the key of a pin's circuit; raise ValueError if the pin has no circuit."""
    servo = fitted.on.row.folder == "ppmc312"
    port = pad.port
    if port == "dir" and servo:
        return "drive"
    if port == "hold" and not any(other.port == "pout_n" for other in fitted.pads):
        return "outputs"
    if port == "int_n" and "spi" in fitted.on.hosts:
        return "spi"
    found = next((one.key for one in CIRCUITS if port in one.ports.split()), None)
    if found == "outputs" and fitted.board.buffers:
        return "outputs_buffered"
    if found is None:
        raise ValueError(
            f"{fitted.board.name} {fitted.on.name}: {pad.bit} has no circuit; add it to scripts/pages/wiring"
        )
    return found


def uses(fitted: Fitted) -> list[Use]:
    """Return the circuits of a part on a board in order; raise ValueError for a pin without a circuit."""
    own = {pad.bit for group in fitted.groups if group.title == "Board" for pad in group.pads}
    own |= {"uart_rxd", "uart_txd"}
    pads: dict[str, list[Pad]] = {}
    for pad in fitted.pads:
        if pad.bit not in own:
            pads.setdefault(_circuit_of(fitted, pad), []).append(pad)
    if "steps" in pads:
        # Step pins are sorted by motor, because the driver carrier of a motor is one chip.
        pads["steps"].sort(
            key=lambda pad: int(pad.bit.rstrip("]").rpartition("[")[2]) if "[" in pad.bit else 0
        )
    strong = fitted.board.family in STRONG_FPGA
    level = fitted.board.buffers.get("level", "")
    return [Use(one, tuple(pads[one.key]), strong, level) for one in CIRCUITS if one.key in pads]


def order(found: list[Use]) -> list[tuple[int, str, str]]:
    """Return (quantity, description, order number) of each item; the quantities of all circuits are added."""
    lines = Counter[tuple[str, str]]()
    for use in found:
        value = "2K2" if not use.strong else "1K"
        resistor = (f"{use.resistor}, at the FPGA's side (see the drawing)", f"CFR-25JB-52-{value}")
        pulls = sum(bool(use.pull(pad)) for pad in use.pads)
        for what, which, of in (*use.circuit.items, (*resistor, pulls), *use.circuit.modules):
            if number := use.number(of):
                lines[what, which] += number
    return [(number, *key) for key, number in lines.items()]
