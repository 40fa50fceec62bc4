"""What an axis is without its motions: set-up, speeds, registers."""

from __future__ import annotations

from dataclasses import replace

from ..basis import units
from ..basis.arguments import Checked
from ..basis.ending import End
from ..basis.errors import OutOfRange, ProtocolError
from ..basis.kind import COILS_OFF, Wanted
from ..basis.refusals import NotWhileBusy
from ..bridge.link import Talk
from ..bridge.script import Script
from .kind import RateKind
from .motion import Motion
from .registers import FAMILY, Outputs, ReadCodes, Switches

EXCITATION_OFF = 0xC0


class AxisCore(Checked):
    """See `axis.Axis`. `setup`: the initialisation this object made, if any. number: of the axis; bit: what
    its command codes have set; busy: its bit in the status register; unused: bits of that which read as 0.
    """

    kind: RateKind
    number = 1
    bit = 0
    busy = 0x04
    unused = 0x08
    link: Talk
    setup: units.Setup | None

    def __init__(self, link: Talk) -> None:
        self.link = link
        self.setup = None
        self._motion: Motion | None = None

    @property
    def motion(self) -> Motion | None:
        """The motion that was started last, None before the first."""
        return self._motion

    @property
    def codes(self) -> ReadCodes:
        """Of the read commands that differ from part to part."""
        return FAMILY

    @property
    def who(self) -> str:
        """Begins a message about this axis, if the part has several."""
        return f"axis {self.number}: " if self.kind.axes > 1 else ""

    def told(self, end: End) -> End:
        """The end with the words of this axis and its part."""
        return replace(end, who=self.who, alarm=self.kind.alarm)

    # ------------------------------------------------------------------ initialisation

    def initialise(
        self,
        start_pps: units.Number = 1000,
        high_pps: units.Number = 5000,
        ramp_pulses: int = 200,
        phases: int = 4,
        half_step: bool = False,
        positive_logic: bool | None = None,
        chop: bool = False,
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
        long_intervals: bool = False,
    ) -> units.Setup:
        """Speeds, ramp and motor of this axis; returns what is really reached.

        start_pps, high_pps: what the part can do, high_pps not below start_pps. ramp_pulses: from start to
        high speed. phases: 3, 4, 5. positive_logic: a high level switches a coil on (the default, where the
        part has both). chop: the coils are switched at rest. base_clock: one of those that the part has, in
        Hz, None to choose by start_pps. external_clock: frequency at the part's clock pin in Hz.
        long_intervals: vsel low, 7.5 us more an interval. The driver of each part has its figures, and says
        what stays as it is until `reset`. Raises OutOfRange, also for what the part does not have, and
        NotWhileBusy.
        """
        wanted = Wanted(
            start_pps,
            high_pps,
            ramp_pulses,
            phases,
            half_step,
            positive_logic,
            chop,
            base_clock,
            external_clock,
            long_intervals,
            self.number,
        )
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, wanted))

    # ------------------------------------------------------------------ for the parts

    def straps(self, clock: units.BaseClock | None) -> Script:
        """Levels of the strap pins for a motion with this base clock; None: it does not matter."""
        raise NotImplementedError

    def inputs(self) -> Switches:
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
        if pps is None:
            pps = self.search_speed
        ramp = self.setup.clock if self.setup else None
        clock = self.kind.constant_clock(self.link.identity.xtal_hz, ramp, pps)
        return clock, clock.choose(pps).rate

    # ------------------------------------------------------------------ registers

    def outputs(self) -> Outputs:
        """Motor outputs; only at rest (NotWhileBusy)."""
        return Outputs.parse(self.link.execute(Script().call(self.codes.outputs | self.bit).get(1)).byte(1))

    def remaining(self) -> int:
        """Remaining-pulse register of the last motion (pulses left - 1, at least 0); only at rest."""
        return self.link.execute(Script().call(self.codes.remaining | self.bit).get(3)).number(1)

    @property
    def position(self) -> int:
        """Pulse counter of the bridge, CW positive; allowed at any time."""
        position = self.counted(self._count())
        if position is None:
            raise ProtocolError(f"{self.link.name}: this board has no pulse counter, so no position")
        return position

    def where(self, script: Script) -> Script:
        """Adds what reads the counter of this axis; gives one value of 4 bytes."""
        return script.count(self.number)

    def counted(self, count: int) -> int | None:
        """The position that a reading of the counter means, None if there is no counter."""
        return count if self.link.identity.counter else None

    def _count(self) -> int:
        return self.link.execute(self.where(Script())).number(0, signed=True)

    def zero(self) -> None:
        """Make the present position 0. Raises NotWhileBusy while a motion of this object is running: its end
        is compared with the pulse counter."""
        motion = self._motion
        if motion is not None and not motion.over and motion.poll() is not None:
            raise NotWhileBusy(self.busy)
        self.link.execute(Script().zero(self.number))

    def excitation_off(self) -> None:
        """All coils off; the axis must be initialised anew. During a motion nothing is sent: on a PPMC-104
        the code would mean something else then (P104-AUX-05): NotWhileBusy. OutOfRange on an STMC."""
        self.kind.need(COILS_OFF)
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
