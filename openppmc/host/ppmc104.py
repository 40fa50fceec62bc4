"""Driver of a PPMC-104 behind a UART bridge."""

from __future__ import annotations

from fractions import Fraction

from . import units
from .axis import Axis
from .device import Device
from .errors import OutOfRange
from .kinds import PPMC104
from .link import Link
from .registers104 import Inputs, Status
from .script import Script

SWITCHING, READ_AUXI, AUX_OUTPUT, AUX_ON, AUX_OFF = 0x84, 0x85, 0x86, 0xC1, 0xC2
_OTHER_STRAPS = 0xFC


class Ppmc104(Device, Axis):
    """One axis: part and axis in one object; see `device.Device` and `axis.Axis`."""

    kind = PPMC104

    def __init__(self, link: Link) -> None:
        Axis.__init__(self, link)

    @property
    def axes(self) -> tuple[Axis, ...]:
        return (self,)

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
        motor = (phases, half_step, positive_logic, chop)
        clocks = (base_clock, external_clock, long_intervals)
        speeds = (start_pps, high_pps, ramp_pulses)
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, *speeds, *motor, *clocks))

    def apply(self, setup: units.Setup) -> units.Setup:
        """Initialise with a setup that was planned before."""
        self.link.execute(self.straps(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    def straps(self, clock: units.BaseClock | None) -> Script:
        script = Script()
        return script if clock is None else script.straps(_OTHER_STRAPS | clock.vsel << 1 | clock.csel)

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, coils off, nothing initialised."""
        self.link.execute(Script().reset())
        self.forget()

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """Status register; allowed at any time."""
        return Status.parse(self.link.execute(Script().read(1)).byte(0))

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self.link.execute(Script().pins()).byte(0))

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
