"""A part at the end of a link: opening, closing, and no motion of ours left running after an error."""

from __future__ import annotations

from types import TracebackType
from typing import TypeVar

from ..basis.arguments import Checked
from ..basis.errors import Disconnected, PpmcError
from ..basis.kind import Kind
from ..bridge.link import DEFAULT_BAUD, Link
from ..ports.transport import Port
from .axis import Axis

Self = TypeVar("Self", bound="Device")


class Device(Checked):
    """A context manager: leaving the block by an exception decelerates motions that this object started;
    leaving it normally lets them go on. Both close the port."""

    kind: Kind
    link: Link

    def __init__(self, link: Link) -> None:
        raise NotImplementedError

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Its axes, number 1 first."""
        raise NotImplementedError

    @classmethod
    def open(cls: type[Self], spec: str | Port, baud: int = DEFAULT_BAUD) -> Self:
        """Open a port (`/dev/ttyUSB0`, `COM3`, `sim:…`, `model:…`) and check what is there."""
        return cls.on(Link(spec, baud, cls.kind.number))

    @classmethod
    def on(cls: type[Self], link: Link) -> Self:
        """On an open link, which is closed if that fails."""
        try:
            return cls(link)
        except BaseException:
            link.close()
            raise

    def attend(self, seconds: float) -> None:
        """Let time of the board pass, and read what the part says by itself."""
        self.link.pause(seconds)

    def close(self) -> None:
        """Close the port; a motion goes on."""
        self.link.close()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None and not isinstance(error, Disconnected):
            for axis in self.axes:
                if axis.motion is not None and axis.motion.end is None:
                    try:
                        axis.brake()
                    except PpmcError:
                        pass  # the first error is the one to tell
        self.close()
