"""What a program opens: parts behind a UART bridge, of any kind (`open_part`), with one axis
(`OneAxis`)."""

from __future__ import annotations

from types import TracebackType
from typing import Any, Protocol, TypeVar, cast

from ..parts import by_number, having
from . import speeds
from .axis import Axis, OnProgress
from .check import Checked
from .ending import End
from .errors import Disconnected, PpmcError, WrongDevice
from .kind import AnySetup, Kind, RateKind, name_of
from .link import DEFAULT_BAUD, Link, Talk
from .motion import AnyMotion
from .port import Port
from .registers import Status
from .script import Script

# What a program holds open: closing it, and no motion of ours left running after an error.

DeviceT = TypeVar("DeviceT", bound="Device")


class Way(Protocol):
    """The way to the hardware: a bridge's link or the master's end of a line."""

    @property
    def name(self) -> str: ...
    def clock(self) -> float: ...
    def pause(self, seconds: float) -> None: ...
    def close(self) -> None: ...


class Turning(Protocol):
    """An axis of any part, as far as it takes to bring it to rest."""

    @property
    def who(self) -> str: ...
    @property
    def position(self) -> int: ...
    @property
    def motion(self) -> AnyMotion | None: ...
    def stop(self, wait: bool = True) -> End | None: ...
    def halt(self, wait: bool = True) -> End | None: ...
    def brake(self, now: bool = False) -> None: ...


class Device(Checked):
    """A context manager: leaving the block by an exception decelerates motions that this object started;
    leaving it normally lets them go on. Both close the port."""

    kind: Kind
    link: Way

    @property
    def axes(self) -> tuple[Turning, ...]:
        """Its axes, number 1 first."""
        raise NotImplementedError

    def attend(self, seconds: float) -> None:
        """Let time of the board pass, and read what the part says by itself."""
        self.link.pause(seconds)

    def close(self) -> None:
        """Close the port; a motion goes on."""
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
                        axis.brake()
                    except PpmcError:
                        pass  # the first error is the one to tell
        self.close()


PartT = TypeVar("PartT", bound="Part")


class AnyInputs(Protocol):
    """Switches; True: active."""

    @property
    def origin(self) -> bool: ...
    @property
    def active(self) -> list[str]: ...


class AnyAxis(Turning, Protocol):
    """An axis behind a bridge; see `axis.Axis`."""

    @property
    def number(self) -> int: ...
    @property
    def busy(self) -> int:
        """Its bits in the raw status of the part: it moves."""

    @property
    def kind(self) -> Kind: ...
    @property
    def link(self) -> Talk: ...
    def apply(self, setup: Any) -> AnySetup:
        """Initialise with a plan of the part's own kind."""

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
    def step(self, direction: int) -> End: ...
    def home(
        self,
        direction: int = 1,
        search_pps: speeds.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
    ) -> End: ...
    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End: ...
    def move_to(self, position: int, progress: OnProgress | None = None) -> End: ...
    def move_constant(self, pulses: int, pps: speeds.Number, progress: OnProgress | None = None) -> End: ...


class Part(Device):
    """A part behind a bridge; see `device.Device`."""

    link: Link

    def __init__(self, link: Link) -> None:
        raise NotImplementedError

    @property
    def axes(self) -> tuple[AnyAxis, ...]:
        raise NotImplementedError

    @classmethod
    def open(cls: type[PartT], spec: str | Port, baud: int = DEFAULT_BAUD) -> PartT:
        """Open a port (`/dev/ttyUSB0`, `COM3`, `sim:…`, `model:…`) and check what is there."""
        return cls.on(Link(spec, baud, cls.kind.number))

    @classmethod
    def on(cls: type[PartT], link: Link) -> PartT:
        """On an open link, which is closed if that fails."""
        try:
            return cls(link)
        except BaseException:
            link.close()
            raise

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, nothing initialised."""
        raise NotImplementedError


# What the drivers of the parts with one axis share.


class OneAxis(Part, Axis):
    """Part and axis in one object; see `part.Part` and `axis.Axis`."""

    kind: RateKind
    link: Link

    def __init__(self, link: Link) -> None:
        Axis.__init__(self, link)

    @property
    def axes(self) -> tuple[Axis, ...]:
        return (self,)

    def straps(self, clock: speeds.BaseClock | None) -> Script:
        return Script()

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise with a setup that was planned before."""
        self.link.execute(self.straps(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, coils off, nothing initialised."""
        self.link.execute(Script().reset())
        self.forget()

    def status(self) -> Status:
        """Status register; allowed at any time."""
        return Status.parse(self.link.execute(Script().read(1)).byte(0))

    def pins(self) -> int:
        """The bridge's view of interrupt, HOLD and switches; allowed at any time."""
        return self.link.execute(Script().pins()).byte(0)


def driver_of(number: int, where: str = "") -> type[Part]:
    """The driver of the part with this number; WrongDevice if there is none."""
    row = by_number(number)
    if row is None or not row.driver:
        *most, last = (one.title for one in having("number", "driver"))
        raise WrongDevice(
            f"{where}: the part is a {name_of(number)}; there are drivers for {', '.join(most)} and {last}: "
            "renew the package"
        )
    return cast("type[Part]", row.load("driver"))


def open_part(spec: str | Port, baud: int = DEFAULT_BAUD, number: int | None = None) -> Part:
    """Open a port and take the driver of the part that is there (IDENT). number: the part that it must be.

    Raises WrongDevice for another part, or one without a driver.
    """
    link = Link(spec, baud, number)
    try:
        driver = driver_of(link.identity.part, link.name)
    except BaseException:
        link.close()
        raise
    return driver.on(link)
