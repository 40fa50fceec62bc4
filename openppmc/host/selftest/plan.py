"""Sections of a self-test, and the accesses of a section to the part.

Every access of a section is recorded, cycle by cycle. To save records, a section does not poll the part: it
writes, waits without an access, and then reads.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ..link import Link
from ..script import Identity, Script

REGISTERS, COMMANDS, MOVES, SWITCHES = "registers", "commands", "moves", "switches"
_GAP = 4
"""Number of NOP operations between two bytes.

With FAST timing, they last long enough for the part to accept the first byte.
"""
_SLOW_BYTE = 0.003
"""Time in s between two bytes with DATASHEET timing.

It exceeds all processing times, except the build time of a ramp table.
"""


class PartAccess:
    """Accesses to a part through a link.

    Attributes:
        slow: True with DATASHEET timing, which requires a separate frame for each byte.
    """

    def __init__(self, link: Link) -> None:
        self.link = link
        self.slow = link.identity.datasheet

    def write(self, register: int, data: Sequence[int]) -> None:
        """Write bytes one after the other to a register."""
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
        """Read a register `count` times, with the same gap as between two writes."""
        script = Script()
        for _ in range(count):
            script.read(register)
            for _ in range(_GAP):
                script.nop()
        return b"".join(self.run(script))

    def run(self, script: Script) -> tuple[bytes, ...]:
        """Execute a script and return its values."""
        return self.link.execute(script).values

    def pause(self, seconds: float) -> None:
        """Wait for a number of seconds, measured with the clock of the port (virtual time for `model:`)."""
        self.link.pause(seconds)

    def until_interrupt(self, seconds: float) -> bool:
        """Wait for the interrupt of the part; return False if it did not occur."""
        return self.link.wait_event(seconds) is not None


@dataclass(frozen=True)
class Section:
    """A test that is recorded and compared as a unit; it begins with a reset of the part.

    Attributes:
        what: REGISTERS, COMMANDS, MOVES or SWITCHES.
        play: function that plays the section.
        straps: levels of the strap pins during the section.
    """

    title: str
    what: str
    play: Callable[[PartAccess], None]
    straps: int = 0xFF

    @property
    def folder(self) -> str:
        """Title as a valid name of a folder."""
        return "-".join(re.findall(r"\w+", self.title))


@dataclass(frozen=True)
class Wire:
    """Jumper wire that the sections about switches require.

    Attributes:
        output, input: ports of the carrier, with the number of the bit if the port has several.
        what: purpose of the wire.
    """

    output: str
    input: str
    what: str

    def __str__(self) -> str:
        return f"{self.output} to {self.input} ({self.what})"


def timed(identity: Identity) -> dict[str, Any]:
    """Return clk_hz, xtal_hz and timing of the golden model, with the values that the board reports."""
    timing = "DATASHEET" if identity.datasheet else "FAST"
    return {"CLK_HZ": identity.clk_hz, "XTAL_HZ": identity.xtal_hz, "TIMING": timing}


def recorded(
    inputs: Iterable[str], outputs: Iterable[str], widths: Mapping[str, int]
) -> tuple[tuple[str, int], ...]:
    """Return the pins in a record and their widths, lowest bit first.

    The pins are the inputs and outputs of the golden model.
    """
    return tuple((pin, widths.get(pin, 1)) for pin in (*inputs, *outputs))


class Plan(Protocol):
    """Members of the `selftest` module of a part."""

    part: str
    """Name of the part in the table of parts. Its golden model has the same name."""
    jumpers: Sequence[Wire]
    """Wires that the sections about switches need."""

    def layout(self, width: int) -> Sequence[tuple[str, int]]:
        """Return the pins in a record of `width` levels, and their widths, lowest bit first."""

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        """Return the sets of parameters of the golden model that match the levels of the outputs in reset.

        If there are several such sets, the comparison determines the correct one.
        """

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        """Return all sections except those about switches.

        Args:
            records: number of records that fit into the recorder.
        """

    def switches(self, identity: Identity, width: int) -> list[Section]:
        """Return the sections that need the jumper wires."""
