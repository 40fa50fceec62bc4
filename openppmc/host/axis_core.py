"""What an axis is without its motions: set-up, speeds, registers."""

from __future__ import annotations

from . import units
from .errors import NotWhileBusy, OutOfRange, ProtocolError
from .kinds import Kind
from .link import Link
from .motion import READ_REMAINING, Motion
from .registers104 import Inputs, Outputs
from .script import Script

READ_OUTPUTS, EXCITATION_OFF = 0x82, 0xC0


class AxisCore:
    """See `axis.Axis`. `setup`: the initialisation this object made, if any. number: of the axis; bit: what
    its command codes have set; busy: its bit in the status register.
    """

    kind: Kind
    number = 1
    bit = 0
    busy = 0x04

    def __init__(self, link: Link) -> None:
        self.link = link
        self.setup: units.Setup | None = None
        self._motion: Motion | None = None

    @property
    def motion(self) -> Motion | None:
        """The motion that was started last, None before the first."""
        return self._motion

    @property
    def who(self) -> str:
        """Begins a message about this axis, if the part has several."""
        return f"axis {self.number}: " if self.kind.axes > 1 else ""

    # ------------------------------------------------------------------ for the parts

    def straps(self, clock: units.BaseClock | None) -> Script:
        """Levels of the strap pins for a motion with this base clock; None: it does not matter."""
        raise NotImplementedError

    def inputs(self) -> Inputs:
        """Switches; allowed at any time."""
        raise NotImplementedError

    def apply(self, setup: units.Setup) -> units.Setup:
        """Initialise with a setup that was planned before for this axis."""
        raise NotImplementedError

    @property
    def search_speed(self) -> units.Number:
        """Speed of searches and jogs that name none: the start speed, in pps. OutOfRange without a setup."""
        if self.setup is None:
            raise OutOfRange("no speed given, and no initialisation to take it from: name a speed in pps")
        return self.setup.start.reached

    def _rate(self, pps: units.Number | None) -> tuple[units.BaseClock, int]:
        """Base clock and rate byte of a constant speed; the other internal base clock if it must be."""
        xtal_hz = self.link.identity.xtal_hz
        clock = self.setup.clock if self.setup else self.kind.internal(xtal_hz)
        if pps is None:
            pps = self.search_speed
        if not clock.external:
            clock = self.kind.any_clock(xtal_hz, pps, clock.vsel, clock.csel)
        return clock, clock.choose(pps).rate

    # ------------------------------------------------------------------ registers

    def outputs(self) -> Outputs:
        """Motor outputs; only at rest (NotWhileBusy)."""
        return Outputs.parse(self.link.execute(Script().call(READ_OUTPUTS | self.bit).get(1)).byte(1))

    def remaining(self) -> int:
        """Remaining-pulse register of the last motion (pulses left - 1, at least 0); only at rest."""
        return self.link.execute(Script().call(READ_REMAINING | self.bit).get(3)).number(1)

    @property
    def position(self) -> int:
        """Pulse counter of the bridge, CW positive; allowed at any time."""
        position = self.counted(self._count())
        if position is None:
            raise ProtocolError(f"{self.link.name}: this board has no pulse counter, so no position")
        return position

    def counted(self, count: int) -> int | None:
        """A reading of the counter, None if the bridge has no counter."""
        return count if self.link.identity.counter else None

    def _count(self) -> int:
        return self.link.execute(Script().count(self.number)).number(0, signed=True)

    def zero(self) -> None:
        """Here is position 0."""
        self.link.execute(Script().zero(self.number))

    def excitation_off(self) -> None:
        """All coils off; the axis must be initialised anew. During a motion nothing is sent: on a PPMC-104
        the code would mean something else then (P104-AUX-05): NotWhileBusy."""
        self._at_rest(Script().call(EXCITATION_OFF | self.bit))

    def forget(self) -> None:
        """The part was reset."""
        self.setup = self._motion = None

    def _at_rest(self, script: Script) -> None:
        """Run a script only if BUSY is 0, decided by the bridge itself."""
        answer = self.link.attempt(Script().timeout(0).wait(1, self.busy, 0).timeout(250).extend(script))
        if answer.failed is not None and answer.failed.name == "WAIT":
            raise NotWhileBusy(answer.last)
        self.link.judge(answer)
