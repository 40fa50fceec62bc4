"""What the shared commands need of a part and of its axes. Every driver behind the bridge has it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from ...host.axis.motion import Progress
from ...host.basis.ending import End
from ...host.basis.kind import Kind
from ...host.bridge.link import Link

OnProgress = Callable[[Progress], None]


class Motion(Protocol):
    """A motion that was started."""

    @property
    def end(self) -> End | None:
        """Why and where it ended, None while it runs."""

    def poll(self) -> Progress | None:
        """Where the motor is, None when it rests."""

    def wait(self, timeout: float | None = None, progress: OnProgress | None = None) -> End:
        """Wait for the end, without judging it; timeout in s."""


class Mover(Protocol):
    """What moves, and can be brought to rest."""

    @property
    def who(self) -> str:
        """Begins a message about it."""

    @property
    def position(self) -> int:
        """In pulses."""

    @property
    def motion(self) -> Motion | None:
        """The one that was started last."""

    def stop(self, wait: bool = True) -> End | None:
        """Stop with a ramp."""

    def halt(self, wait: bool = True) -> End | None:
        """Stop at once."""


class Axis(Mover, Protocol):
    """One axis. Pulses are signed, CW positive; speeds in pps; directions 0 (CW) and 1 (CCW)."""

    @property
    def number(self) -> int:
        """From 1 on."""

    @property
    def busy(self) -> int:
        """Its bits in the raw status of the part: it moves."""

    def inputs(self) -> object:
        """A dataclass of switches, True: active."""

    def apply(self, setup: Any) -> Any:
        """Initialise with what the kind of this part has planned; returns what is reached."""

    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End:
        """Move with ramps, and wait."""

    def move_constant(self, pulses: int, pps: float, progress: OnProgress | None = None) -> End:
        """Move at constant speed, and wait."""

    def jog(self, direction: int, speed: float | None = None, high: bool = False) -> Motion:
        """Run until a stop."""

    def step(self, direction: int) -> End:
        """One pulse."""

    def home(
        self,
        direction: int,
        search_pps: float | None = None,
        fast: bool = False,
        to_limit: bool = False,
        *,
        progress: OnProgress | None = None,
    ) -> End:
        """Find the origin switch, and call it position 0."""

    def zero(self) -> None:
        """Here is position 0."""

    def excitation_off(self) -> None:
        """All coils off."""


class Moving(Protocol):
    """A part, or a line of several."""

    @property
    def axes(self) -> tuple[Mover, ...]:
        """Its axes, or the stations in use."""


class Clock(Protocol):
    """A way to the board, with the time that passes there."""

    def clock(self) -> float:
        """In s."""


class Attended(Protocol):
    """What must be listened to while time passes."""

    @property
    def link(self) -> Clock:
        """The way to it."""

    def attend(self, seconds: float) -> None:
        """Let time of the board pass, and read what the part says by itself."""


class Part(Attended, Protocol):
    """A part at the end of a link; what its status says, its view knows."""

    @property
    def kind(self) -> Kind:
        """What it can do."""

    @property
    def link(self) -> Link:
        """The way to it."""

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Number 1 first."""
