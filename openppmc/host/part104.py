"""The PPMC-104 behind a UART bridge without its motions: set-up, registers, auxiliary outputs."""

from __future__ import annotations

from fractions import Fraction

from ..model.codes104 import BUSY
from . import units
from .errors import NotWhileBusy, OutOfRange, ProtocolError
from .link import Link
from .registers104 import Inputs, Outputs, Status
from .script import Script

READ_REMAINING, READ_OUTPUTS, SWITCHING, READ_AUXI, AUX_OUTPUT = 0x83, 0x82, 0x84, 0x85, 0x86
EXCITATION_OFF, AUX_ON, AUX_OFF = 0xC0, 0xC1, 0xC2
_OTHER_STRAPS = 0xFC


class Part104:
    """See `ppmc104.Ppmc104`, which adds the motions. `setup`: the initialisation this object made, if any."""

    def __init__(self, link: Link) -> None:
        self.link = link
        self.setup: units.Setup | None = None

    # ------------------------------------------------------------------ initialisation

    def initialise(
        self,
        start_pps: units.Number = 1000,
        high_pps: units.Number = 5000,
        ramp_pulses: int = 200,
        phases: int = 4,
        half_step: bool = False,
        positive_logic: bool = True,
        chop: bool = False,
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
        long_intervals: bool = False,
    ) -> units.Setup:
        """Speeds, ramp and motor; returns what is really reached.

        start_pps: 488.3 to 500 000. high_pps: start_pps to 500 000. ramp_pulses: 4 to 11 220, from start to
        high speed. phases: 3, 4, 5. positive_logic: a high level switches a coil on. chop: the coils are
        switched at rest. base_clock: 500 000 or 125 000 Hz, None to choose by start_pps. external_clock:
        frequency at the `clock` pin in Hz. long_intervals: vsel low, 7.5 us more an interval. (Figures for a
        16 MHz crystal.) phases, half_step and positive_logic of an initialised part stay until
        `excitation_off` or `reset`. Raises OutOfRange, NotWhileBusy.
        """
        if external_clock is not None:
            clock = units.BaseClock.external_pin(external_clock)
        else:
            vsel = int(not long_intervals)
            clock = units.choose_clock(self.link.identity.xtal_hz, start_pps, base_clock, vsel)
        code = units.initialisation_code(phases, half_step, positive_logic, clock.external, chop)
        return self.apply(units.plan_setup(clock, start_pps, high_pps, ramp_pulses, code))

    def apply(self, setup: units.Setup) -> units.Setup:
        """Initialise with a setup that was planned before."""
        self.link.execute(self._straps(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    def _straps(self, clock: units.BaseClock) -> Script:
        return Script().straps(_OTHER_STRAPS | clock.vsel << 1 | clock.csel)

    @property
    def search_speed(self) -> units.Number:
        """Speed of searches and jogs that name none: the start speed, in pps. OutOfRange without a setup."""
        if self.setup is None:
            raise OutOfRange("no speed given, and no initialisation to take it from: name a speed in pps")
        return self.setup.start.reached

    def _rate(self, pps: units.Number | None) -> tuple[units.BaseClock, int]:
        """Base clock and rate byte of a constant speed; the other internal base clock if it must be."""
        xtal_hz = self.link.identity.xtal_hz
        clock = self.setup.clock if self.setup else units.BaseClock.internal(xtal_hz)
        if pps is None:
            pps = self.search_speed
        if not clock.external:
            clock = units.any_clock(xtal_hz, pps, clock.vsel, clock.csel)
        return clock, clock.choose(pps).rate

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """Status register; allowed at any time."""
        return Status.parse(self.link.execute(Script().read(1)).byte(0))

    def inputs(self) -> Inputs:
        """Switches; allowed at any time."""
        return Inputs.of_pins(self.link.execute(Script().pins()).byte(0))

    def outputs(self) -> Outputs:
        """Motor outputs; only at rest (NotWhileBusy)."""
        return Outputs.parse(self.link.execute(Script().call(READ_OUTPUTS).get(1)).byte(1))

    def remaining(self) -> int:
        """Remaining-pulse register of the last motion (pulses left - 1, at least 0); only at rest."""
        return self.link.execute(Script().call(READ_REMAINING).get(3)).number(1)

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
        return self.link.execute(Script().count()).number(0, signed=True)

    def zero(self) -> None:
        """Here is position 0."""
        self.link.execute(Script().zero())

    # ------------------------------------------------------------------ auxiliary

    def aux(self, on: bool) -> None:
        """AUX output (on: pin low)."""
        self.link.execute(Script().call(AUX_ON if on else AUX_OFF))

    def auxo(self, value: int) -> None:
        """The four auxiliary outputs, 0 to 15; a 1 makes a pin low."""
        if not 0 <= value <= 15:
            raise OutOfRange(f"auxiliary outputs {value} are outside 0 to 15")
        self.link.execute(Script().call(AUX_OUTPUT, value))

    def auxi(self) -> int:
        """The four auxiliary inputs, pin levels; only at rest."""
        return self.link.execute(Script().call(READ_AUXI).get(1)).byte(1)

    def switching(self, on_us: units.Number, off_us: units.Number) -> tuple[Fraction, Fraction]:
        """Times of the chopper at rest in us (16 MHz: on 27 to 792, off 33 to 798); returns those reached."""
        vsel = self.setup.clock.vsel if self.setup else 1
        on = units.chop_byte(self.link.identity.xtal_hz, on_us, "on", vsel)
        off = units.chop_byte(self.link.identity.xtal_hz, off_us, "off", vsel)
        self.link.execute(Script().call(SWITCHING, on[0], off[0]))
        return on[1], off[1]

    def excitation_off(self) -> None:
        """All coils off; the part must be initialised anew. During a motion the code would mean something
        else (P104-AUX-05), so then nothing is sent: NotWhileBusy."""
        self._at_rest(Script().call(EXCITATION_OFF))

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, coils off, nothing initialised."""
        self.link.execute(Script().reset())
        self.setup = None

    def _at_rest(self, script: Script) -> None:
        """Run a script only if BUSY is 0, decided by the bridge itself."""
        answer = self.link.attempt(Script().timeout(0).wait(1, BUSY, 0).timeout(250).extend(script))
        if answer.failed is not None and answer.failed.name == "WAIT":
            raise NotWhileBusy(answer.last)
        self.link.judge(answer)
