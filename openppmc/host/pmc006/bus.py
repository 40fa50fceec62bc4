"""Several PMC006B4 on one line.

with Pmc006Bus.open("/dev/ttyUSB0") as bus:
    x, y = bus.axis(1), bus.axis(2)
    bus.wait([x.start_move(3200), y.start_move(-1600)])
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ..line.bus import LineBus
from ..line.errors import GarbledReply, StationSilent
from ..line.faults import Counters
from ..line.master import PATIENCE
from ..ports.transport import Port
from .codes import Flags, Modes
from .driver import Pmc006, scan
from .kind import KIND
from .line import BAUD, Line
from .wire import ADDRESSES, address_number

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings


@dataclass(frozen=True)
class Found:
    """A controller that `scan` has found; version, flags, modes and position are None if its replies are
    garbled, which `trouble` tells. counters: of the master."""

    address: int
    version: str | None
    flags: Flags | None
    modes: Modes | None
    position: int | None
    counters: Counters = field(repr=False)
    trouble: str = ""


class Pmc006Bus(LineBus[Line, Pmc006]):
    """A line (`line.Line`) with controllers; see `host.line.bus.LineBus`. `axis(5)` is the `Pmc006` with
    that address, whether it is there or not."""

    kind = KIND

    @classmethod
    def open(
        cls,
        spec: str | Port,
        baud: int = BAUD,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
    ) -> Pmc006Bus:
        """Open a port; arguments as those of `line.Line`. Says nothing on the line."""
        return cls(Line(spec, baud, rs485, patience))

    def make(self, station: int) -> Pmc006:
        return Pmc006(self.line, address_number(station), alone=False)

    def look_at(self, axis: Pmc006) -> None:
        """They report nothing by themselves, but a move that is being stopped needs care."""
        if axis.motion is not None and not axis.motion.over:
            axis.motion.look()

    def scan(
        self, addresses: Iterable[int] = ADDRESSES, progress: Callable[[int], None] | None = None
    ) -> list[Found]:
        """Who is there; progress: called with each address before it is asked. Takes the patience for each
        address without a controller."""
        return [self.look(self.axis(address)) for address in scan(self.line, addresses, progress)]

    def look(self, axis: Pmc006) -> Found:
        """A controller that answers."""
        try:
            seen = axis.version(), axis.flags(), axis.modes(), axis.position
        except (GarbledReply, StationSilent) as error:
            return Found(axis.address, None, None, None, None, axis.counters, str(error))
        return Found(axis.address, *seen, axis.counters)

    def check(self, addresses: Iterable[int]) -> None:
        """All of these answer. Raises StationSilent, GarbledReply."""
        for address in addresses:
            self.axis(address).flags()
