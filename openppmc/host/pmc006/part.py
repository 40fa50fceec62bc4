"""Driver of the PMC006B4.

with Pmc006.open("/dev/ttyUSB0") as motor:
    motor.microsteps, motor.current = 32, 1500
    motor.home(switch=1, direction=BACKWARD)
    motor.move(6400, speed=8000)

Several on one line:

with Pmc006Bus.open("/dev/ttyUSB0") as bus:
    x, y = bus.axis(1), bus.axis(2)
    bus.wait([x.start_move(3200), y.start_move(-1600)])
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from ..axis import OnProgress
from ..check import within
from ..errors import OutOfRange
from ..line import PATIENCE, DuplicateAddress, GarbledReply, StationSilent
from ..line_port import Miss
from ..part import Device
from ..port import Port
from .axis import BACKWARD, Homing
from .memory import Memory
from .motion import End
from .talk import ATTEMPTS, BAUD, Line, Talk
from .wire import ADDRESSES, KIND, LAST, Code

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings
from dataclasses import dataclass, field

from ..line import LineBus
from ..line_port import Counters
from .wire import Flags, Modes, address_number

OUTPUTS = 5


class Pmc006(Memory, Device):
    """One controller. `open` takes a line for it alone; `bus.Pmc006Bus` gives several.

    Settings are properties (`settings.SETTINGS` lists them). Instructions whose reply is lost are repeated
    only where that does no harm: a start is looked for in status and position first, so nothing moves twice;
    LostReply where nobody can know. Leaving a `with` block by an exception stops a motion that this object
    started.
    """

    kind = KIND
    link: Line

    @classmethod
    def open(
        cls,
        spec: str | Port,
        address: int | None = None,
        baud: int = BAUD,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
    ) -> Pmc006:
        """Open a port; arguments as those of `line.Line`. address: None looks for a controller: 255,
        then 1 to 120. Raises StationSilent if there is none."""
        line = Line(spec, baud, rs485, patience)
        try:
            return cls(line, find(line) if address is None else address)
        except BaseException:
            line.close()
            raise

    @property
    def number(self) -> int:
        """Its address."""
        return self.address

    @property
    def axes(self) -> tuple[Pmc006, ...]:
        """Itself."""
        return (self,)

    # ------------------------------------------------------------------ reference point

    def home(
        self,
        switch: int = 1,
        direction: int = BACKWARD,
        speed: int = 1000,
        slow: int = 200,
        off: int = 100,
        progress: OnProgress | None = None,
    ) -> End:
        """Find the edge of EXT1 or EXT2 and make the place `off` steps away from it position 0.

        direction: towards the switch. speed: until it stops the motor, slow: for the second, exact approach,
        both 65 to 3000 steps/s and so low that the motor may stop at once. Works from the switch too. Both
        stops are enabled meanwhile; EXT flags are cleared; speeds, direction and enabled stops are as before
        afterwards. Raises OriginNotFound, also if the other switch comes first.
        """
        return Homing(self, switch, direction, speed, slow, off, progress).run()

    # ------------------------------------------------------------------ outputs, stall

    @property
    def outputs(self) -> int:
        """Levels of GPO5 to GPO1 (bit 4 to 0), with the pull of a stall; assigned as a whole."""
        return self.ports().outputs

    @outputs.setter
    def outputs(self, levels: int) -> None:
        levels = within(levels, "outputs", 0, (1 << OUTPUTS) - 1)
        self.ask(Code.WRITE_IO, levels << 3, good=lambda value: value == levels << 3)

    def set_output(self, number: int, on: bool) -> None:
        """One of GPO1 to GPO5; the others stay."""
        if number not in range(1, OUTPUTS + 1):
            raise OutOfRange(f"GPO{number}: there are GPO1 to GPO{OUTPUTS}")
        bit = 1 << number - 1
        self.outputs = self.outputs | bit if on else self.outputs & ~bit

    def watch_stall(self, level: int, length: int, stop: bool = True, output: bool = False) -> None:
        """Detect stalls: back-EMF below `level` (0 to 511) in so many samples (0 to 63) at constant speed.
        stop: the motor stops; output: GPO5 is raised."""
        self.stall_level, self.stall_length = level, length
        self.stall_config = 1 | stop << 1 | output << 2

    @property
    def stall_position(self) -> int:
        """Where the last stall was; 0 if there was none."""
        return self.ask(Code.STALL_POSITION)

    # ------------------------------------------------------------------ address

    def set_address(self, address: int) -> None:
        """Give it another address, 1 to 120, at once; `save` keeps it. Raises DuplicateAddress if somebody
        has that already."""
        within(address, "address", 1, LAST)
        if address == self.address:
            return
        if Pmc006(self.line, address).is_there():
            raise DuplicateAddress(f"{self.line.name}: address {address} is taken: choose another one")
        # The reply comes from the new address already.
        for _ in range(ATTEMPTS):
            got = self.line.exchange(self.address, Code.ADDRESS, address, answers=address)
            if not isinstance(got, Miss) or Pmc006(self.line, address).is_there():
                self.address = address
                return
            self.line.settle()
        raise StationSilent(f"{self.where}: no reply to {ATTEMPTS} frames: is it there and powered?")


def find(line: Line, progress: Callable[[int], None] | None = None) -> int:
    """The first address that answers: 255, then 1 to 120. StationSilent if none does."""
    for found in scan(line, progress=progress):
        return found
    raise StationSilent(
        f"{line.name}: no controller replies: are they powered, are baud rate and the wires right?"
    )


def scan(
    line: Line, addresses: Iterable[int] = ADDRESSES, progress: Callable[[int], None] | None = None
) -> Iterator[int]:
    """Addresses that answer, as they are found. progress: called with each before it is asked."""
    for address in addresses:
        if progress is not None:
            progress(address)
        try:
            if Talk(line, address).is_there():
                yield address
        except GarbledReply:
            yield address


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
