"""The board that a command uses, from the options before the command."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from ... import parts

if TYPE_CHECKING:
    from ...host.capabilities import Capabilities

USUAL = "ppmc104"
"""Part of a plan or a virtual board if the user names no part."""
LINE_WORDS = "echo, rs485, rts=high, rts=low, sum=binary, sum=chars, patience=SECONDS, xtal=HZ"
"""All option names that --line may contain. Each kind of line supports only some of these names."""


class PartName(str, Enum):
    """Parts that a computer can access: through the UART bridge, or on a serial line."""

    _ignore_ = ["members", "row"]
    members = vars()
    for row in parts.PARTS.values():
        if row.number or row.line:
            members[row.name] = row.name


NAMES = frozenset(name.value for name in PartName)


@dataclass
class Board:
    """The board, from the options before the command.

    Attributes:
        baud: line rate in bit/s; None for the default rate.
        part: name of the part in the table; None without --part.
        line: options of a serial line.
    """

    port: str = ""
    baud: int | None = None
    part: str | None = None
    line: str = ""

    @property
    def virtual(self) -> bool:
        """True if the port is a virtual board."""
        from ...host.port import virtual

        return ":" in virtual(self.port)

    @property
    def spec(self) -> str:
        """Port. For a virtual board, it includes the part that --part names."""
        if self.part is None or not self.virtual:
            return self.port
        comma = "" if self.port.endswith(":") else ","
        return f"{self.port}{comma}part={self.part}"

    @property
    def planned(self) -> Capabilities:
        """Part for a plan, which needs no board: from --part, from a virtual port, or USUAL."""
        from ...host.capabilities import capabilities_of
        from ...host.port import virtual

        if self.part is not None:
            return capabilities_of(self.part)
        words = virtual(self.port).replace(" ", "").lower().partition(":")[2].split(",")
        named = [word.removeprefix("part=") for word in words if word.startswith("part=")]
        return capabilities_of(named[-1] if named and named[-1] in NAMES else USUAL)


BOARD = Board()
