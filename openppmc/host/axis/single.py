"""What the drivers of the parts with one axis share."""

from __future__ import annotations

from ..basis import units
from ..bridge.link import Link
from ..bridge.script import Script
from .axis import Axis
from .kind import RateKind
from .part import Part
from .registers import Status


class OneAxis(Part, Axis):
    """Part and axis in one object; see `part.Part` and `axis.Axis`."""

    kind: RateKind
    link: Link

    def __init__(self, link: Link) -> None:
        Axis.__init__(self, link)

    @property
    def axes(self) -> tuple[Axis, ...]:
        return (self,)

    def straps(self, clock: units.BaseClock | None) -> Script:
        return Script()

    def apply(self, setup: units.Setup) -> units.Setup:
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
