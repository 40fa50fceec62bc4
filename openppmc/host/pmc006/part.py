"""Driver of the PMC006B4.

One controller:

    with Pmc006.open("/dev/ttyUSB0") as motor:
        motor.microsteps, motor.current = 32, 1500
        motor.home(switch=1, direction=BACKWARD)
        motor.move(6400, speed=8000)

Several controllers on one line:

    with Pmc006Bus.open("/dev/ttyUSB0") as bus:
        x, y = bus.axis(1), bus.axis(2)
        bus.wait([x.start_move(3200), y.start_move(-1600)])
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from ...lazy import Renamed
from ..axis import OnProgress
from ..check import within
from ..errors import OutOfRange
from ..line import PATIENCE, CorruptReply, DuplicateAddress, StationNotResponding
from ..line_port import MissingReply
from ..part import Device
from ..port import Port
from .axis import BACKWARD, Homing
from .memory import Memory
from .motion import MotionResult
from .station_link import ATTEMPTS, BAUD, Line, StationLink
from .wire import ADDRESSES, CAPABILITIES, LAST, Code

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings
from dataclasses import dataclass, field

from ..line import LineBus
from ..line_port import Counters
from .wire import Flags, Modes, address_number

OUTPUTS = 5


class Pmc006(Memory, Device):
    """One controller with its line; `Pmc006Bus` is a line with several controllers.

    Settings are properties (listed in `settings.SETTINGS`). After a lost reply, an instruction is repeated
    only if the repetition has no side effect. After a lost reply to a start, the driver reads status and
    position, so that no motion is executed twice. It raises LostReply if it cannot determine whether the
    instruction was executed. If an exception leaves a `with` block, a motion that this object started is
    stopped.
    """

    kind = CAPABILITIES
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
        """Open a port; the other arguments are those of `Line`.

        Args:
            address: address of the controller. For `None`, the first address that replies is used; the search
                begins with 255 and continues with 1 to 120.

        Raises:
            StationNotResponding: no controller replies.
        """
        line = Line(spec, baud, rs485, patience)
        try:
            return cls(line, find(line) if address is None else address)
        except BaseException:
            line.close()
            raise

    @property
    def number(self) -> int:
        """Address of the controller."""
        return self.address

    @property
    def axes(self) -> tuple[Pmc006, ...]:
        """The controller itself."""
        return (self,)

    # ------------------------------------------------------------------ homing

    def home(
        self,
        switch: int = 1,
        direction: int = BACKWARD,
        speed: int = 1000,
        slow: int = 200,
        off: int = 100,
        progress: OnProgress | None = None,
    ) -> MotionResult:
        """Find the switching point of EXT1 or EXT2; position 0 is `off` steps from it.

        The start position is arbitrary; the switch may be active. Both stops are enabled during homing, and
        EXT flags are cleared. Afterwards speeds, direction and enabled stops are restored.

        Args:
            switch: 1 (EXT1) or 2 (EXT2).
            direction: direction towards the switch.
            speed: speed until the switch stops the motor, 65 to 3000 steps/s. At this speed, the motor must
                be able to stop immediately.
            slow: speed of the second, exact approach, with the same limits.
            off: distance of position 0 from the switch in steps.

        Raises:
            OriginNotFound: the switch was not found, or the other switch was reached first.
        """
        return Homing(self, switch, direction, speed, slow, off, progress).run()

    # ------------------------------------------------------------------ outputs, stall

    @property
    def outputs(self) -> int:
        """Levels of GPO5 to GPO1 (bits 4 to 0).

        A stall may have set GPO5. An assignment writes all five levels.
        """
        return self.ports().outputs

    @outputs.setter
    def outputs(self, levels: int) -> None:
        levels = within(levels, "outputs", 0, (1 << OUTPUTS) - 1)
        self.execute(Code.WRITE_IO, levels << 3, good=lambda value: value == levels << 3)

    def set_output(self, number: int, on: bool) -> None:
        """Set one of GPO1 to GPO5; the others are unchanged."""
        if number not in range(1, OUTPUTS + 1):
            raise OutOfRange(f"GPO{number}: there are GPO1 to GPO{OUTPUTS}")
        bit = 1 << number - 1
        self.outputs = self.outputs | bit if on else self.outputs & ~bit

    def watch_stall(self, level: int, length: int, stop: bool = True, output: bool = False) -> None:
        """Detect stalls at constant speed.

        Args:
            level: a sample of the back-EMF below this level indicates a stall, 0 to 511.
            length: number of consecutive samples that are required for a stall, 0 to 63.
            stop: True if a stall stops the motor.
            output: True if a stall sets GPO5 high.
        """
        self.stall_level, self.stall_length = level, length
        self.stall_config = 1 | stop << 1 | output << 2

    @property
    def stall_position(self) -> int:
        """Position of the last stall, 0 if there was no stall."""
        return self.execute(Code.STALL_POSITION)

    # ------------------------------------------------------------------ address

    def set_address(self, address: int) -> None:
        """Set another address, 1 to 120, effective immediately; `save` stores it.

        Raises:
            DuplicateAddress: another controller has this address.
        """
        within(address, "address", 1, LAST)
        if address == self.address:
            return
        if Pmc006(self.line, address)._is_connected():
            raise DuplicateAddress(f"{self.line.name}: address {address} is taken: choose another one")
        # The reply to the instruction already contains the new address.
        for _ in range(ATTEMPTS):
            got = self.line.exchange(self.address, Code.ADDRESS, address, answers=address)
            if not isinstance(got, MissingReply) or Pmc006(self.line, address)._is_connected():
                self.address = address
                return
            self.line.wait_until_idle()
        raise StationNotResponding(
            f"{self._location}: no reply to {ATTEMPTS} frames: is it there and powered?"
        )


def find(line: Line, progress: Callable[[int], None] | None = None) -> int:
    """Return the first address that replies.

    The search begins with 255 and continues with 1 to 120.

    Raises StationNotResponding if no controller replies.
    """
    for found in scan(line, progress=progress):
        return found
    raise StationNotResponding(
        f"{line.name}: no controller replies: are they powered, are baud rate and the wires right?"
    )


def scan(
    line: Line, addresses: Iterable[int] = ADDRESSES, progress: Callable[[int], None] | None = None
) -> Iterator[int]:
    """Yield addresses that reply.

    Args:
        progress: called with each address before it is polled.
    """
    for address in addresses:
        if progress is not None:
            progress(address)
        try:
            if StationLink(line, address)._is_connected():
                yield address
        except CorruptReply:
            yield address


@dataclass(frozen=True)
class ScanResult:
    """Controller found by `scan`.

    Attributes:
        version, flags, modes, position: `None` if the replies are corrupt.
        problem: description of the problem if the replies are corrupt.
        counters: counters of the master.
    """

    address: int
    version: str | None
    flags: Flags | None
    modes: Modes | None
    position: int | None
    counters: Counters = field(repr=False)
    problem: str = ""
    trouble = Renamed("problem")


class Pmc006Bus(LineBus[Line, Pmc006]):
    """Line with controllers; see `host.line.LineBus`.

    `axis(5)` is the `Pmc006` with address 5. The controller does not have to be connected.
    """

    kind = CAPABILITIES

    @classmethod
    def open(
        cls,
        spec: str | Port,
        baud: int = BAUD,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
    ) -> Pmc006Bus:
        """Open a port without sending anything; the arguments are those of `Line`."""
        return cls(Line(spec, baud, rs485, patience))

    def _make_station(self, station: int) -> Pmc006:
        return Pmc006(self.line, address_number(station), alone=False)

    def _collect_reports(self, axis: Pmc006) -> None:
        """Poll a move that is being stopped; controllers send no unsolicited reports."""
        if axis.motion is not None and not axis.motion.over:
            axis.motion._update()

    def scan(
        self, addresses: Iterable[int] = ADDRESSES, progress: Callable[[int], None] | None = None
    ) -> list[ScanResult]:
        """Return the controllers of the line.

        For each address without a controller, the scan waits for the time `patience`.

        Args:
            progress: called with each address before it is polled.
        """
        return [self._probe(self.axis(address)) for address in scan(self.line, addresses, progress)]

    def _probe(self, axis: Pmc006) -> ScanResult:
        """Read the state of a controller that replies."""
        try:
            seen = axis.version(), axis.flags(), axis.modes(), axis.position
        except (CorruptReply, StationNotResponding) as error:
            return ScanResult(axis.address, None, None, None, None, axis.counters, str(error))
        return ScanResult(axis.address, *seen, axis.counters)

    def check(self, addresses: Iterable[int]) -> None:
        """Check that all these addresses reply. Raises StationNotResponding or CorruptReply."""
        for address in addresses:
            self.axis(address).flags()
