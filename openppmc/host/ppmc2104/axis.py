"""Axis of a PPMC-2104."""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

from ...model.motion.codes import ORIGIN
from ...model.ppmc2104.codes import BUSY, CMND
from .. import speeds
from ..axis import CCW, Axis
from ..capabilities import AXIS_BIT
from ..errors import AlreadyDecelerating, NothingToStop, NotInitialised, StartRefused, Timeout
from ..link import Link
from ..motion import Motion, MotionRequest
from ..motion_result import Cause, MotionResult
from ..registers import Inputs
from ..script import Script
from . import registers
from .registers import CAPABILITIES, IncompleteCommand, Status

SWITCHING, HOLD_DELAY = 0x84, 0x85
_SETUP_SECONDS = 10.0
"""Time limit of an initialisation in s with a 16 MHz crystal.

A part needs 0.15 s for both axes, but a virtual board may be slow.
"""


class PeerAxis(Protocol):
    """Members of an axis that the other axis needs."""

    def _resolve(self, status: int) -> None: ...


class TwoAxisPart(Protocol):
    """Members of a part (`part.Ppmc2104`) that an axis needs."""

    @property
    def link(self) -> Link: ...
    def status(self) -> Status: ...
    def _strap_script(self, number: int, clock: speeds.BaseClock | None) -> Script: ...
    def _select_pins(self, number: int) -> Script: ...
    def _other_axis(self, number: int) -> PeerAxis: ...
    def _set_idle(self, number: int) -> None: ...
    def _resolve_foreign(self, number: int) -> None: ...


class Axis2104(Axis):
    """Axis 1 or 2 of a PPMC-2104; see `axis.Axis` for the motions.

    The attribute `part` has the functions that concern both axes.

    Limits of `initialise` for a 16 MHz crystal: start_pps from 488.3; high_pps up to 250 000, with a rate
    byte that is at least 2 lower than the rate byte of start_pps; ramp_pulses 4 to 11 220; base_clock 500 000
    or 125 000 Hz. positive_logic and long_intervals are not supported. On an initialised axis, phases,
    half_step, chop and the choice of an external clock are unchanged until `excitation_off` or `reset`
    (P2104-INI-05).
    """

    kind = CAPABILITIES
    part: TwoAxisPart

    def __init__(self, part: TwoAxisPart, number: int) -> None:
        super().__init__(part.link)
        self.part = part
        self.number = self.kind.check_axis(number)
        self._code_bits = (number - 1) * AXIS_BIT
        self._busy_mask = BUSY[number - 1]
        self._zero_mask = 0x40

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise the axis with a set-up planned earlier for this axis, and wait for its ramp."""
        self.link.execute(Script().call(setup.code, *setup.data))
        clock = self.link.clock
        end = clock() + _SETUP_SECONDS * 16e6 / self.link.identity.xtal_hz
        while self.part.status().raw & CMND[self.number - 1]:
            if clock() >= end:
                raise Timeout(
                    f"{self.link.name}: {self._message_prefix}the initialisation does not end: reset the part"
                )
            self.link.pause(0.002)
        self.setup = setup
        return setup

    # ------------------------------------------------------------------ differences to other parts

    def _strap_script(self, clock: speeds.BaseClock | None) -> Script:
        return self.part._strap_script(self.number, clock)

    def _motion_started(self, request: MotionRequest, begin: int) -> Motion:
        self.part._set_idle(self.number)
        return super()._motion_started(request, begin)

    def _on_status(self, status: int) -> None:
        # While the end status of the other axis is unread, int_n stays low. Then the end of this motion
        # sends no message. Therefore, read the end status of the other axis first.
        self.part._other_axis(self.number)._resolve(status)

    def _resolve(self, status: int) -> None:
        """Process a value of the status register. If BUSY = 0, read how the motion ended."""
        if self._motion is not None and not self._motion.over:
            self._motion._on_status(status)
        elif not status & self._busy_mask:
            self.part._resolve_foreign(self.number)

    def _start_motion(self, request: MotionRequest) -> Motion:
        """Start a motion. If the part rejects it because of a switch, return a motion without pulses."""
        try:
            return super()._start_motion(request)
        except StartRefused as refused:
            return self._refused_start_motion(request, refused)

    def _refused_start_motion(self, request: MotionRequest, refused: StartRefused) -> Motion:
        """Return a motion that a switch ended before its first pulse.

        If no switch is active when the inputs are read, the exception of the rejection is raised instead.
        """
        inputs = self.inputs()
        cause = Cause.COMPLETE
        if inputs.alarm:
            cause |= Cause.ALARM
        if inputs.limit_ccw if request.direction == CCW else inputs.limit_cw:
            cause |= Cause.LIMIT
        if not cause and request.operation == ORIGIN and inputs.origin:
            cause = Cause.ORIGIN
        if not cause:
            raise refused
        position = self._count()
        motion = self._motion_started(request, position)
        remaining = request.requested or speeds.LONGEST_MOVE
        motion.result = self._annotate(MotionResult(cause, 0, remaining, self._position_of(position), 0))
        return motion

    def _send_stop(self, now: bool) -> None:
        try:
            super()._send_stop(now)
        except NotInitialised as error:
            raise NothingToStop(
                error.status, f"{self._message_prefix}nothing to stop: it is not initialised"
            ) from None
        except IncompleteCommand:
            # The part reports this error because the stop has ended a command that was waiting for data. The
            # stop itself has been executed (P2104-STP-07).
            pass

    def _request_stop(self, now: bool = False) -> None:
        """Request a stop of the motion that this object started, without waiting.

        The part rejects a stop with a ramp in a motion at constant speed, and while it waits for RUN
        (P2104-STP-03). In both cases, it accepts an immediate stop.
        """
        motion = self._motion
        try:
            self._send_stop(now or (motion is not None and not motion.ramped))
        except NothingToStop:
            pass
        except AlreadyDecelerating:
            if motion is not None and motion.begin == self._count():
                self._request_stop(now=True)

    # ------------------------------------------------------------------ registers and settings

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self.link.execute(self.part._select_pins(self.number).pins()).byte(0))

    def switching(self, on_us: speeds.Number, off_us: speeds.Number) -> tuple[Fraction, Fraction]:
        """Set the chopper times at standstill in us; return the times that are reached.

        The range of each time is 32 to 127.5 us at 16 MHz.

        The call is not allowed during a motion.
        """
        on = registers.half_us_byte(self.link.identity.xtal_hz, on_us, "on")
        off = registers.half_us_byte(self.link.identity.xtal_hz, off_us, "off")
        self.link.execute(Script().call(SWITCHING | self._code_bits, on[0], off[0]))
        return on[1], off[1]

    def hold_delay(self, microseconds: speeds.Number) -> Fraction:
        """Set the time from the end of a motion to HOLD in us; return the time that is reached.

        The range is 128 to 32 768 us at 16 MHz.

        The call is not allowed during a motion.
        """
        byte, reached = registers.hold_byte(self.link.identity.xtal_hz, microseconds)
        self.link.execute(Script().call(HOLD_DELAY | self._code_bits, byte))
        return reached
