"""Sections of a self-test, and the talk of a section with the part.

Whatever a section does is recorded, cycle by cycle: so nothing is polled. A section writes, lets time pass on
the PC's side, and looks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ..link import Link
from ..script import Identity, Script

REGISTERS, COMMANDS, MOVES, SWITCHES = "registers", "commands", "moves", "switches"
_GAP = 4
"""NOPs between two bytes: in FAST timing the part has taken the first one by then."""
_SLOW_BYTE = 0.003
"""Seconds between two bytes in DATASHEET timing, above all processing times but that of a table."""


class Talk:
    """The part behind a link. slow: DATASHEET timing, one byte a frame."""

    def __init__(self, link: Link) -> None:
        self.link = link
        self.slow = link.identity.datasheet

    def write(self, register: int, data: Sequence[int]) -> None:
        """Bytes one behind the other into a register."""
        for byte in data if self.slow else ():
            self.run(Script().write(register, byte))
            self.pause(_SLOW_BYTE)
        if not self.slow and data:
            script = Script()
            for byte in data:
                script.write(register, byte)
                for _ in range(_GAP):
                    script.nop()
            self.run(script)

    def read(self, register: int, count: int = 1) -> bytes:
        """So many reads of a register, with a gap as between two writes."""
        script = Script()
        for _ in range(count):
            script.read(register)
            for _ in range(_GAP):
                script.nop()
        return b"".join(self.run(script))

    def run(self, script: Script) -> tuple[bytes, ...]:
        """A script as it is; its values."""
        return self.link.execute(script).values

    def pause(self, seconds: float) -> None:
        """Let time of the board pass."""
        self.link.pause(seconds)

    def until_interrupt(self, seconds: float) -> bool:
        """Wait for the part's interrupt; False if none came."""
        return self.link.wait_event(seconds) is not None


@dataclass(frozen=True)
class Section:
    """What is recorded and compared in one go; it begins with a reset of the part.

    what: REGISTERS, COMMANDS, MOVES or SWITCHES. play: does it. straps: levels meanwhile.
    """

    title: str
    what: str
    play: Callable[[Talk], None]
    straps: int = 0xFF

    @property
    def folder(self) -> str:
        """Its title as the name of a folder."""
        return "-".join(re.findall(r"\w+", self.title))


@dataclass(frozen=True)
class Wire:
    """A jumper wire for the sections about switches. output, input: ports of the carrier, with their bit."""

    output: str
    input: str
    what: str

    def __str__(self) -> str:
        return f"{self.output} to {self.input} ({self.what})"


def timed(identity: Identity) -> dict[str, Any]:
    """Clock, crystal and TIMING of the golden model, as the board tells them."""
    timing = "DATASHEET" if identity.datasheet else "FAST"
    return {"CLK_HZ": identity.clk_hz, "XTAL_HZ": identity.xtal_hz, "TIMING": timing}


class Plan(Protocol):
    """What a part's own `selftest` has."""

    part: str
    """Its name in the table, and that of its golden model."""
    jumpers: Sequence[Wire]
    """The wires that the sections about switches want."""

    def layout(self, width: int) -> Sequence[tuple[str, int]]:
        """Pins of the golden model in a record of so many levels, from the lowest bit on, with their bits."""

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        """Parameters of the golden model, by the levels of its outputs in reset; several if that does not
        tell: whichever fits is right."""

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        """All but those about switches. records: room of the recorder."""

    def switches(self, identity: Identity, width: int) -> list[Section]:
        """Those that want the wires."""
