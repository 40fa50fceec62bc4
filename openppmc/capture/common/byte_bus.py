"""Shared capture code of the parts with two registers.

The address pin A0 selects register 0 (data) or register 1 (command and status).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from ...model.motion.codes import Command, Kind
from .bus import Strobe, accesses
from .mnemonics import CommandDecoder, Exchange
from .part_decoder import Access, Accesses, Line, Needs, PartDecoder, PulseTrain, Wires
from .pinmap import Pins
from .registers import DecodedAccess, cycle, decoded_byte_lines

SHORTEST = 250_000
"""Shortest strobe of an old host in ps; the sample period of the analyser must not be longer."""
STEADY = ("busc", "aen")
"""Strobe pins that may be missing in a capture, because their levels do not change."""


def byte_part(
    called: str,
    model: tuple[Mapping[str, int], Mapping[str, int], Mapping[str, int]],
    strobe_pins: tuple[str, ...],
    strobes: Strobe,
    decoder: CommandDecoder | Callable[[Wires], CommandDecoder],
    code: Callable[[int, Wires], Command],
    levels: Callable[[Access, Wires], dict[str, int]],
    trains: Callable[[Wires], list[PulseTrain]],
    lowest: Mapping[str, int],
    phases: tuple[str, ...],
    axis_of: Callable[[str, int], int] = lambda port, bit: 0,
    address: str = "a0",
    bus: str = "d",
    aliases: Mapping[str, str] | None = None,
) -> PartDecoder:
    """Return the capture functions of a part on a byte bus.

    Args:
        model: inputs, outputs, widths of the golden model.
        strobe_pins: pins that form a strobe.
        decoder: decoder of bytes to text, or a function that returns the decoder for a capture.
        code: decodes a command byte.
        levels: returns the levels of the strobe pins and of the address during an access.
        address: port whose bit 0 selects the register.
        bus: name of the data bus.
        aliases: other names of pins.
    """
    inputs, outputs, widths = model

    def seen(wires: Wires) -> Accesses:
        found = accesses(wires, strobe_pins, address, inputs, strobes, bus)
        found.reg &= 1
        return found

    def lines(wires: Wires) -> list[Line]:
        def judge(row: Exchange) -> DecodedAccess:
            if not row.sent:
                return DecodedAccess(bool(row.answer))
            command = code(row.sent[0], wires)
            whole = len(row.sent) - 1 == command.parameters
            first = whole and command.kind is Kind.INITIALISE
            return DecodedAccess(not whole or command.kind is Kind.UNDEFINED, first, command.axis)

        return decoded_byte_lines(seen(wires), decoder(wires) if callable(decoder) else decoder, judge)

    def stimulus(wires: Wires) -> Iterator[tuple[int, dict[str, int]]]:
        for access in seen(wires):
            yield from cycle(access, levels(access, wires), f"{bus}_i")

    def needs(wires: Wires) -> Needs:
        data = bus if bus in wires.bits else f"{bus}_i"
        return Needs((*(pin for pin in strobe_pins if pin not in STEADY), address, data), SHORTEST)

    names = {name: widths.get(name, 1) for name in (*inputs, *outputs)} | {bus: 8, "clk": 1}
    return PartDecoder(
        called,
        Pins(names, lowest, aliases or {}),
        inputs,
        needs,
        lines,
        stimulus,
        trains,
        frozenset((*strobe_pins, address, f"{bus}_i")),
        tuple(name for name in outputs if name not in (f"{bus}_o", f"{bus}_oe")),
        phases,
        axis_of=axis_of,
        reset_levels=outputs,
    )
