"""Which board a command talks to: the options in front of it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from ... import parts

if TYPE_CHECKING:
    from ...host.kind import Kind

USUAL = "ppmc104"
"""The part if the user names none: of plans, and of virtual boards."""
LINE_WORDS = "echo, rs485, rts=high, rts=low, sum=binary, sum=chars, patience=SECONDS, xtal=HZ"
"""All words of --line; each line takes some of them."""


class PartName(str, Enum):
    """The parts of the table that a computer can talk to: behind a bridge, or on a line."""

    _ignore_ = ["members", "row"]
    members = vars()
    for row in parts.PARTS.values():
        if row.number or row.line:
            members[row.name] = row.name


NAMES = frozenset(name.value for name in PartName)


@dataclass
class Board:
    """Which board, from the options in front of the command. baud: None: what is usual. part: its name in the
    table, None if the user named none. line: options of a line."""

    port: str = ""
    baud: int | None = None
    part: str | None = None
    line: str = ""

    @property
    def virtual(self) -> bool:
        """Whether the port is a virtual board."""
        from ...host.port import MODEL, SIM

        return self.port.startswith((MODEL, SIM))

    @property
    def spec(self) -> str:
        """The port with its part: a virtual board is built with the one that was named."""
        if self.part is None or not self.virtual:
            return self.port
        comma = "" if self.port.endswith(":") else ","
        return f"{self.port}{comma}part={self.part}"

    @property
    def planned(self) -> Kind:
        """The part for plans, which open no board: the one that was named, in the port's text if need be."""
        from ...host.kind import kind_of

        if self.part is not None:
            return kind_of(self.part)
        if not self.virtual:
            return kind_of(USUAL)
        words = self.port.replace(" ", "").lower().partition(":")[2].split(",")
        named = [word.removeprefix("part=") for word in words if word.startswith("part=")]
        return kind_of(named[-1] if named and named[-1] in NAMES else USUAL)


BOARD = Board()
