"""What a program holds open: closing it, and no motion of ours left running after an error."""

from __future__ import annotations

from types import TracebackType
from typing import Protocol, TypeVar

from ..basis.arguments import Checked
from ..basis.ending import End
from ..basis.errors import Disconnected, PpmcError
from ..basis.kind import Kind
from .motion import AnyMotion

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
