"""Base classes of drivers for parts on a UART bridge.

`open_part` opens any part. `OneAxis` is the base class of parts with one axis.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from types import TracebackType
from typing import Any, Protocol, TypeVar, cast

from ..lazy import Renamed
from ..parts import by_number, having
from . import speeds
from .axis import Axis, OnProgress
from .capabilities import AnySetup, Capabilities, RateCapabilities, name_of
from .check import Checked
from .errors import Disconnected, PpmcError, WrongDevice
from .link import DEFAULT_BAUD, Link, LinkProtocol
from .motion import AnyMotion
from .motion_result import MotionResult
from .port import Port
from .registers import Status
from .script import Script

# Base class of open devices. At the end of its `with` block, the port is closed. If an error ends the block,
# the motions of the device are stopped first.

DeviceT = TypeVar("DeviceT", bound="Device")


class Transport(Protocol):
    """The transport to the hardware: the link of a bridge, or the master of a line."""

    @property
    def name(self) -> str: ...
    def clock(self) -> float: ...
    def pause(self, seconds: float) -> None: ...
    def close(self) -> None: ...


class Stoppable(Protocol):
    """Members of an axis that a device needs to stop it."""

    @property
    def _message_prefix(self) -> str: ...
    @property
    def position(self) -> int: ...
    @property
    def motion(self) -> AnyMotion | None: ...
    def stop(self, wait: bool = True) -> MotionResult | None: ...
    def halt(self, wait: bool = True) -> MotionResult | None: ...
    def _request_stop(self, now: bool = False) -> None: ...


class Device(Checked):
    """Context manager for an open device; on exit it closes the port.

    If an exception leaves the `with` block, motions that this object started decelerate. At a normal end of
    the block, they continue.
    """

    kind: Capabilities
    link: Transport
    attend = Renamed("process_reports")

    @property
    def axes(self) -> tuple[Stoppable, ...]:
        """Axes of the device; axis 1 is first."""
        raise NotImplementedError

    def process_reports(self, seconds: float) -> None:
        """Process unsolicited reports of the part for `seconds`, measured with the clock of the port."""
        self.link.pause(seconds)

    def close(self) -> None:
        """Close the port; a running motion continues."""
        self.link.close()

    def __enter__(self: DeviceT) -> DeviceT:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None and not isinstance(error, Disconnected):
            for axis in self.axes:
                if axis.motion is not None and not axis.motion.over:
                    try:
                        axis._request_stop()
                    except PpmcError:
                        pass  # the caller receives the first error
        self.close()


PartT = TypeVar("PartT", bound="Part")


class AnyInputs(Protocol):
    """States of the switches; True = active."""

    @property
    def origin(self) -> bool: ...
    @property
    def active(self) -> list[str]: ...


class AnyAxis(Stoppable, Protocol):
    """Axis accessed through a bridge; see `axis.Axis`."""

    @property
    def number(self) -> int: ...
    @property
    def _busy_mask(self) -> int:
        """Mask of the bits of the part's status byte that are set while this axis moves."""

    @property
    def kind(self) -> Capabilities: ...
    @property
    def link(self) -> LinkProtocol: ...
    def apply(self, setup: Any) -> AnySetup:
        """Initialise the axis with a set-up of the part's own type."""

    def inputs(self) -> AnyInputs: ...
    def zero(self) -> None: ...
    def excitation_off(self) -> None: ...
    def start_move(self, pulses: int, pulse_only: bool = False) -> AnyMotion: ...
    def start_constant(self, pulses: int, pps: speeds.Number) -> AnyMotion: ...
    def jog(
        self,
        direction: int,
        speed: speeds.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> AnyMotion: ...
    def search(self, direction: int, pps: speeds.Number | None = None) -> AnyMotion: ...
    def step(self, direction: int) -> MotionResult: ...
    def home(
        self,
        direction: int = 1,
        search_pps: speeds.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
    ) -> MotionResult: ...
    def move(
        self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False
    ) -> MotionResult: ...
    def move_to(self, position: int, progress: OnProgress | None = None) -> MotionResult: ...
    def move_constant(
        self, pulses: int, pps: speeds.Number, progress: OnProgress | None = None
    ) -> MotionResult: ...
    def moves(self, pulses: Iterable[int], pps: speeds.Number | None = None) -> Iterator[MotionResult]: ...


class Part(Device):
    """Part accessed through a bridge; see `Device`."""

    link: Link

    def __init__(self, link: Link) -> None:
        raise NotImplementedError

    @property
    def axes(self) -> tuple[AnyAxis, ...]:
        raise NotImplementedError

    @classmethod
    def open(cls: type[PartT], spec: str | Port, baud: int = DEFAULT_BAUD) -> PartT:
        """Open a port (`/dev/ttyUSB0`, `COM3`, `sim:…`, `model:…`) and check which part is connected."""
        return cls.on(Link(spec, baud, cls.kind.number))

    @classmethod
    def on(cls: type[PartT], link: Link) -> PartT:
        """Create the driver for an open link; close the link if the driver cannot be created."""
        try:
            return cls(link)
        except BaseException:
            link.close()
            raise

    def reset(self) -> None:
        """Reset the part in any state.

        The pulses end immediately. After the reset no axis is initialised.
        """
        raise NotImplementedError


# The base class of drivers for parts with one axis.


class OneAxis(Part, Axis):
    """Part and axis in one object; see `Part` and `axis.Axis`."""

    kind: RateCapabilities
    link: Link

    def __init__(self, link: Link) -> None:
        Axis.__init__(self, link)

    @property
    def axes(self) -> tuple[Axis, ...]:
        return (self,)

    def _strap_script(self, clock: speeds.BaseClock | None) -> Script:
        return Script()

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise the axis with a set-up planned earlier."""
        self.link.execute(self._strap_script(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    def reset(self) -> None:
        """Reset the part in any state.

        The pulses end immediately. After the reset all coils are off, and the part is not initialised.
        """
        self.link.execute(Script().reset())
        self._on_reset()

    def status(self) -> Status:
        """Return the status register. The call is allowed at any time."""
        return Status.parse(self.link.execute(Script().read(1)).byte(0))

    def _pins(self) -> int:
        """Return the PINS byte of the bridge: interrupt, HOLD, switches. The call is allowed at any time."""
        return self.link.execute(Script().pins()).byte(0)


def driver_of(number: int, where: str = "") -> type[Part]:
    """Return the driver class of the part with this number.

    Raises:
        WrongDevice: no driver exists for this part.
    """
    row = by_number(number)
    if row is None or not row.driver:
        *most, last = (one.title for one in having("number", "driver"))
        raise WrongDevice(
            f"{where}: the part is a {name_of(number)}; there are drivers for {', '.join(most)} and {last}: "
            "renew the package"
        )
    return cast("type[Part]", row.load("driver"))


def open_part(spec: str | Port, baud: int = DEFAULT_BAUD, number: int | None = None) -> Part:
    """Open a port and return the driver of the part that IDENT reports.

    Args:
        number: number of the only part to accept, `None` for any.

    Raises:
        WrongDevice: another part is connected, or no driver exists for it.
    """
    link = Link(spec, baud, number)
    try:
        driver = driver_of(link.identity.part, link.name)
    except BaseException:
        link.close()
        raise
    return driver.on(link)
