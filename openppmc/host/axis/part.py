"""What the drivers of all parts behind a UART bridge have in common, whatever part it is."""

from __future__ import annotations

from typing import Any, Protocol, TypeVar

from ..basis import units
from ..basis.ending import End
from ..basis.kind import AnySetup, Kind
from ..bridge.link import DEFAULT_BAUD, Link, Talk
from ..ports.transport import Port
from .device import Device, Turning
from .motion import AnyMotion
from .moves import OnProgress

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
    def start_constant(self, pulses: int, pps: units.Number) -> AnyMotion: ...
    def jog(
        self,
        direction: int,
        speed: units.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> AnyMotion: ...
    def search(self, direction: int, pps: units.Number | None = None) -> AnyMotion: ...
    def step(self, direction: int) -> End: ...
    def home(
        self,
        direction: int = 1,
        search_pps: units.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
    ) -> End: ...
    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End: ...
    def move_to(self, position: int, progress: OnProgress | None = None) -> End: ...
    def move_constant(self, pulses: int, pps: units.Number, progress: OnProgress | None = None) -> End: ...


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
