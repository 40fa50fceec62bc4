"""One axis of a device in engineering units, for adapters to control systems.

The adapters `openppmc.ophyd` and `openppmc.epics` use this class. Several threads may use the positioners of
one device.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from numbers import Real
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

from .drives import Speeds, drive_of
from .host.capabilities import SetupRequest
from .host.errors import NothingToStop, OutOfRange, WrongDevice
from .host.motion import AnyMotion, Progress
from .host.motion_result import Cause, MotionResult
from .host.part import Device

POLL = 0.03
"""Time between two polls of a motion, in seconds of the board's clock.

If n axes of a device move, the pause after each poll is this time divided by n.
"""
FREE = 0.01
"""Pause in seconds after each poll, so that other threads can use the port.

Without the pause, the same thread could get the lock again before threads that wait for the lock.
"""


class _Access:
    """The access of threads to a device.

    Attributes:
        lock: held during each exchange with the device.
        moving: number of motions that threads follow.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.moving = 0


_accesses: WeakKeyDictionary[Device, _Access] = WeakKeyDictionary()


class Switches(NamedTuple):
    """Hard limit switches at the low and high end of the positions, and origin switch; True = active."""

    low: bool
    high: bool
    origin: bool


class Positioner:
    """One axis of a part or of a bank, or a station of a line.

    A position is pulses / `pulses_per_unit` + `offset`. Other code must not use the device while a thread
    uses a positioner.

    Args:
        device: the opened device.
        axis: number of the axis from 1 on, or the station.
        pulses_per_unit: negative if the position decreases with CW.
        request: set-up of the axis for `initialise` and `set_speeds`; a PMC006B4 needs no set-up.

    Attributes:
        stop_requested: True after `stop`. No motion starts until the caller resets it.

    Raises:
        OutOfRange: the axis does not exist, or the scale is 0 or not finite.
    """

    def __init__(
        self, device: Device, axis: int = 1, pulses_per_unit: float = 1, request: SetupRequest | None = None
    ) -> None:
        self.pulses_per_unit = finite(pulses_per_unit, "pulses_per_unit")
        if not pulses_per_unit:
            raise OutOfRange("pulses_per_unit 0: not supported; use the number of pulses in a unit")
        self.offset = 0.0
        self.device, self.axis, self._number = device, _axis(device, axis), axis
        self._drive = drive_of(self.axis, request)
        self.stop_requested = False
        self._access = _accesses.setdefault(device, _Access())
        self._stopped: AnyMotion | None = None

    def attach(self, device: Device) -> None:
        """Replace the object of the device after a lost port was opened again; keep scale and offset.

        The part may have lost its set-up, which `initialise` restores. No thread may use the positioner.

        Raises:
            WrongDevice: another kind of part is connected.
            OutOfRange: the axis does not exist.
        """
        if type(device) is not type(self.device):
            raise WrongDevice(f"{device.link.name}: another part is connected than before")
        self.device, self.axis = device, _axis(device, self._number)
        self._drive.attach(self.axis)
        self._access = _accesses.setdefault(device, _Access())
        self._stopped = None

    @property
    def lock(self) -> threading.RLock:
        """The lock of the device."""
        return self._access.lock

    @property
    def position(self) -> float:
        """Position, read from the part."""
        with self.lock:
            return self.to_units(self.axis.position)

    def to_units(self, pulses: int) -> float:
        """Return a pulse count as a position."""
        return pulses / self.pulses_per_unit + self.offset

    def to_pulses(self, position: float) -> int:
        """Return the pulse count nearest to a position."""
        return round((position - self.offset) * self.pulses_per_unit)

    def switches(self) -> Switches:
        """Read the switches.

        On a PMC006B4, EXT1 is the limit switch in direction backward (CCW), and EXT2 is the limit switch in
        direction forward (CW).
        """
        with self.lock:
            cw, ccw, origin = self._drive.switches()
        return Switches(ccw, cw, origin) if self.pulses_per_unit > 0 else Switches(cw, ccw, origin)

    # ------------------------------------------------------------------ set-up

    def initialise(self) -> None:
        """Initialise the axis with its set-up; the axis must be stopped."""
        with self.lock:
            self._drive.initialise()

    def speeds(self) -> Speeds:
        """Return the speeds that the set-up of the part reaches."""
        with self.lock:
            return self._drive.speeds

    def set_speeds(self, speeds: Speeds, new_time: bool = True) -> None:
        """Initialise the axis with other speeds; the axis must be stopped.

        Args:
            new_time: False to keep the acceleration of a PMC006B4, whose ramps then have another duration.

        Raises:
            OutOfRange: the part does not support these speeds; the former speeds are kept.
        """
        base, top, seconds = (finite(value, name) for name, value in speeds._asdict().items())
        if not 0 < base <= top or seconds < 0:
            text = f"speeds {base:g} to {top:g} pps in {seconds:g} s: use 0 < base <= top and 0 s or more"
            raise OutOfRange(text)
        acceleration = (top - base) / seconds if seconds else math.inf
        if self._drive.has_acceleration and not new_time:
            acceleration = 0
        with self.lock:
            self._drive.set_speeds(base, top, acceleration)

    # ------------------------------------------------------------------ motions

    def start_move(self, position: float) -> AnyMotion | None:
        """Start a move with ramps to the pulse nearest to a position.

        The call returns None if the motor is already at this pulse.

        Raises:
            StoppedByCommand: `stop_requested` is True.
        """
        with self.lock:
            begin = self.axis.position
            pulses = self.to_pulses(position) - begin
            if not pulses:
                return None
            self._check_stop(begin, abs(pulses))
            return self.axis.start_move(pulses)  # type: ignore[no-any-return]

    def leave_limit(self, position: float) -> None:
        """On a PMC006B4, clear the flag of the EXT input that a move to this position leaves.

        The limits of the other parts do not prevent such a move.
        """
        with self.lock:
            self._drive.leave_limit(self.to_pulses(position))

    def follow(self, motion: AnyMotion, report: Callable[[float], None]) -> None:
        """Report the position until the motion has ended, and at its end.

        Args:
            report: called about ten times a second. An exception that it raises ends the call; the motion
                continues.

        Raises:
            MotionError: the motion ended differently from its request.
            EndUnknown: the part does not confirm how the motion ended.
        """
        with self.lock:
            self._access.moving += 1
        try:
            while True:
                with self.lock:
                    now = motion.poll()
                    if now is None:
                        break
                    self.device.process_reports(POLL / max(1, self._access.moving))
                report(self.to_units(now.position))
                time.sleep(FREE)
        finally:
            with self.lock:
                self._access.moving -= 1
        report(self.position)
        assert motion.result is not None
        motion.result.check(motion.requested)

    def home(self, forward: bool, report: Callable[[float], None]) -> None:
        """Find the origin switch in the direction of increasing or decreasing positions.

        The edge of the switch becomes pulse 0.

        A PMC006B4 searches EXT2 in direction forward (CW), and EXT1 in direction backward (CCW).

        Args:
            report: called about ten times a second, as in `follow`.

        Raises:
            OriginNotFound, LimitReached, AlarmStop, StoppedByCommand: homing did not succeed.
        """
        cw = forward is (self.pulses_per_unit > 0)

        def progress(now: Progress) -> None:
            report(self.to_units(now.position))
            self.send_stop()
            self.lock.release()
            time.sleep(FREE)
            self.lock.acquire()

        with self.lock:
            self._check_stop(self.axis.position, 0)
            self._drive.home(1 if cw else -1, 0, progress)

    def stop(self) -> None:
        """Decelerate the motion in progress, if any, and prevent the start of further motions."""
        self.stop_requested = True
        self.send_stop()

    def send_stop(self) -> None:
        """Stop the motion in progress if `stop_requested` is True.

        Each motion receives only one stop.

        Homing consists of several motions, and each of them must be stopped.
        """
        with self.lock:
            motion = self.axis.motion
            if not self.stop_requested or motion is None or motion.over or motion is self._stopped:
                return
            self._stopped = motion
            try:
                self.axis.stop(wait=False)
            except NothingToStop:
                pass  # the motor has just stopped

    def _check_stop(self, position: int, pulses: int) -> None:
        """Raise StoppedByCommand if a stop has been requested, so that no motion starts."""
        if self.stop_requested:
            MotionResult(Cause.STOP, 0, pulses, position, 0).check(pulses)


def finite(value: Any, what: str) -> float:
    """Return a number as float. Raises OutOfRange if it is not a finite number."""
    if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
        raise OutOfRange(f"{what} {value!r} is not a finite number")
    return float(value)


def _axis(device: Device, number: int) -> Any:
    """Return an axis of a part by its number, or a station of a line."""
    station = getattr(device, "axis", None)
    if callable(station):
        return station(number)
    if not 1 <= number <= len(device.axes):
        raise OutOfRange(f"axis {number}: {device.link.name} has axes 1 to {len(device.axes)}")
    return device.axes[number - 1]
