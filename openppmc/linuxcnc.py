"""Axes as a HAL component of LinuxCNC: the logic between the pins and the library.

`openppmc hal` connects this logic to LinuxCNC's module `hal` and to a device; docs/coming_from.md describes
the pins. This module imports neither `hal` nor a driver, so it can be tested without LinuxCNC.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

from .drives import Drive
from .host.errors import CommandRefused, LinkError, NothingToStop, OutOfRange, PpmcError
from .host.motion import AnyMotion
from .host.motion_result import AlarmStop, Cause, EndUnknown, LimitReached, OriginNotFound, StoppedByCommand

INPUTS = {"position-cmd": "FLOAT", "enable": "BIT", "home": "BIT", "reset": "BIT", "arm": "BIT"}
OUTPUTS = {
    **{"position-fb": "FLOAT", "busy": "BIT", "in-position": "BIT", "homed": "BIT"},
    **{"limit-pos": "BIT", "limit-neg": "BIT", "fault": "BIT", "fault-code": "S32"},
}
RAMP = ("start-velocity", "velocity", "acceleration")
PARAMETERS = dict.fromkeys(("scale", *RAMP, "home-velocity"), "FLOAT")
"""Parameters.

The value 0 selects the default: 1 for the scale, and the value of the set-up for each other parameter.
"""
PERIOD = 0.02
"""Duration of the wait at the end of a cycle in s."""


class GroupEndedError(PpmcError):
    """A group was not started, or another axis of the group has ended early."""


FAULTS: tuple[type[PpmcError], ...] = (
    *(EndUnknown, LinkError, LimitReached, AlarmStop, StoppedByCommand),
    *(OutOfRange, OriginNotFound, CommandRefused, GroupEndedError, PpmcError),
)
"""Classes of errors, by number.

The pin `fault-code` is the position in this list, counted from 1, of the first class to which the error
belongs.
"""


class AbandonedError(Exception):
    """The axis is no longer enabled; this exception ends its homing."""


class Reading(NamedTuple):
    """State of an axis.

    `busy` is `None` if the state does not contain whether the axis moves; the motion object reports this.
    """

    position: int
    limit_cw: bool
    limit_ccw: bool
    busy: bool | None = None


@dataclass(frozen=True)
class Machine:
    """An open device, with its axes by number.

    Attributes:
        start: starts moves of several axes together; `None` if moves can only be started one after the other.
    """

    device: Any
    drives: Mapping[int, Drive]
    start: Callable[[Mapping[int, int]], Mapping[int, AnyMotion]] | None = None

    def read(self) -> Mapping[int, Reading]:
        """Read the states of all axes. For a bank, this requires only a few frames."""
        if not hasattr(self.device, "snapshot"):
            drives = self.drives.items()
            return {number: Reading(one.axis.position, *one.switches()[:2]) for number, one in drives}
        return {
            number: Reading(seen.position, seen.inputs.limit_cw, seen.inputs.limit_ccw, seen.status.busy)
            for number, seen in self.device.snapshot(self.drives).items()
        }

    def start_together(self, pulses: Mapping[int, int]) -> Mapping[int, AnyMotion]:
        """Start moves, in the same cycle if the part supports this."""
        if self.start and len(pulses) > 1:
            return self.start(pulses)
        return {number: self.drives[number].axis.start_move(count) for number, count in pulses.items()}


class Pins:
    """Pins and parameters of a component with a prefix; `types` is the module `hal`, for its constants."""

    def __init__(self, component: Any, types: Any, prefix: str) -> None:
        self._component, self._types, self._prefix = component, types, prefix
        self._levels: dict[str, bool] = {}

    def create(self, names: Mapping[str, str], side: str) -> None:
        """Create pins (`side` is `IN` or `OUT`) or parameters (`RW`).

        `names` maps their names to their types.
        """
        make = self._component.newparam if side == "RW" else self._component.newpin
        for name, kind in names.items():
            make(self._prefix + name, *(getattr(self._types, f"HAL_{word}") for word in (kind, side)))

    def __getitem__(self, name: str) -> Any:
        return self._component[self._prefix + name]

    def __setitem__(self, name: str, value: Any) -> None:
        self._component[self._prefix + name] = value

    def rose(self, name: str) -> bool:
        """Return True if the pin `name` is True, and was False at the last call or was not read before."""
        before, self._levels[name] = self._levels.get(name, False), bool(self[name])
        return self._levels[name] and not before


class HalAxis:
    """Pins and state of one axis.

    Attributes:
        seen: last value of `position-cmd`.
        pending: True if a move to `seen` has to be started.
        confirmed: True if the part has confirmed the end of the last motion.
        homing: True if homing is running or queued.
        on: True if the axis is enabled and has no fault.
        stopping: True if this component has stopped the motion of the axis.
        fault: fault code, 0 without a fault.
    """

    drive: Drive
    motion: AnyMotion | None = None
    reading = Reading(0, False, False)
    seen, fault = 0.0, 0
    pending = confirmed = homed = homing = on = stopping = False

    def __init__(self, component: Any, types: Any, number: int) -> None:
        self.number, self.pins = number, Pins(component, types, f"{number}.")
        for names, side in ((INPUTS, "IN"), (OUTPUTS, "OUT"), (PARAMETERS, "RW")):
            self.pins.create(names, side)

    @property
    def scale(self) -> float:
        """Pulses per unit."""
        return float(self.pins["scale"]) or 1.0

    @property
    def idle(self) -> bool:
        """True if neither a motion nor homing is in progress."""
        return self.motion is None and not self.homing

    @property
    def in_position(self) -> bool:
        """True if the part has confirmed that the motion ended at the position `position-cmd`."""
        target = self.pins["position-cmd"] * self.scale
        ready = self.on and self.confirmed and self.idle and not self.pending and math.isfinite(target)
        return ready and round(target) == self.reading.position

    def prepare(self) -> None:
        """Initialise the axis if the parameters have changed."""
        self.drive.prepare(*(abs(self.pins[name] * self.scale) for name in RAMP))

    def distance(self) -> int:
        """Prepare a move to `position-cmd`; return the number of its pulses, with sign."""
        target = self.pins["position-cmd"] * self.scale
        if not math.isfinite(target):
            raise OutOfRange(f"position-cmd times scale, {target}, is not a finite number")
        self.prepare()
        pulses: int = round(target) - self.drive.axis.position
        self.pending, self.stopping, self.confirmed = False, False, not pulses
        return pulses

    def start(self) -> None:
        """Start a move to `position-cmd`."""
        if pulses := self.distance():
            self.motion = self.drive.axis.start_move(pulses)

    def stop(self) -> None:
        """Decelerate the motion."""
        if self.motion and not self.stopping:
            self.stopping = True
            with suppress(NothingToStop):
                self.drive.axis.stop(wait=False)

    def adopt(self) -> None:
        """Decelerate a motion that the library started for this axis, and poll this motion from now on."""
        motion = self.drive.axis.motion
        if motion is not None and not motion.over:
            self.motion, self.stopping = motion, False
            self.stop()

    def write(self, waiting: bool) -> None:
        """Write the output pins."""
        cw, ccw = self.reading.limit_cw, self.reading.limit_ccw
        values = (
            *(self.reading.position / self.scale, waiting or self.pending or not self.idle),
            *(self.in_position, self.homed, *((cw, ccw) if self.scale > 0 else (ccw, cw))),
            *(bool(self.fault), self.fault),
        )
        for name, value in zip(OUTPUTS, values, strict=True):
            self.pins[name] = value


class Controller:
    """All axes of a component; the caller repeats `cycle`.

    Args:
        component: object with `newpin`, `newparam` and items, like a component of the module `hal`.
        types: the module `hal`, for its constants.
        report: function that prints a line about a fault.
        check: function that is called in each cycle, also during homing. It may raise an exception.

    Attributes:
        machine: open device, `None` after the port was lost.
        reopen: True if the pin `reset` has risen since the port was lost. The caller then opens the port
            again.
    """

    machine: Machine | None = None
    reopen = _waiting = False
    _homing: HalAxis | None = None
    _members: Sequence[HalAxis] = ()
    _last_error: PpmcError | None = None

    def __init__(
        self,
        component: Any,
        types: Any,
        numbers: Iterable[int],
        report: Callable[[str], None],
        check: Callable[[], None],
    ) -> None:
        self._report, self._check, self._common = report, check, Pins(component, types, "")
        self._common.create({"group-start": "BIT"}, "IN")
        self._common.create({"group-done": "BIT"}, "OUT")
        self._axes = {number: HalAxis(component, types, number) for number in numbers}

    def attach(self, machine: Machine) -> None:
        """Use an open device, and clear the faults of all axes."""
        self.machine, self.reopen = machine, False
        for number, axis in self._axes.items():
            axis.drive, axis.fault = machine.drives[number], 0

    def cycle(self) -> None:
        """Read device and inputs, start and stop motions, write the outputs, and wait."""
        try:
            self._cycle()
            for axis in self._axes.values():
                if axis.homing:
                    self._home(axis)
            if self.machine:
                self.machine.device.process_reports(PERIOD)
        except LinkError as error:
            self.machine = None
            for axis in self._axes.values():
                axis.motion, axis.homed, axis.homing = None, False, False
                self._fail(axis, error)
            self._cycle()

    def _cycle(self) -> None:
        self._check()
        for number, reading in self.machine.read().items() if self.machine else ():
            self._axes[number].reading = reading
        for axis in self._axes.values():
            self._poll(axis)
            self._read_pins(axis)
        self._start_group()
        for axis in self._axes.values():
            if axis.pending and axis.idle:
                self._attempt([axis], axis.start)
            axis.write(self._waiting and bool(axis.pins["arm"]))
        started = self._common["group-start"] and not self._waiting and bool(self._members)
        self._common["group-done"] = started and all(axis.in_position for axis in self._members)

    def _read_pins(self, axis: HalAxis) -> None:
        pins = axis.pins
        reset, enabled, home = (pins.rose(name) for name in ("reset", "enable", "home"))
        if reset and self.machine and axis.fault and axis.idle:
            axis.fault = 0
            self._attempt([axis], axis.drive.clear)
        self.reopen |= reset and not self.machine
        axis.on = bool(pins["enable"]) and not axis.fault
        if axis.on and axis.idle and (enabled or reset):
            self._attempt([axis], axis.prepare)
        changed, axis.seen = pins["position-cmd"] != axis.seen, pins["position-cmd"]
        axis.pending = axis.on and not axis.homing and not pins["arm"] and (axis.pending or changed)
        if axis.on:
            axis.homing |= home and axis.idle
        else:
            self._attempt([axis], axis.stop)
            axis.homing = axis is self._homing

    # ------------------------------------------------------------------ faults

    def _fail(self, axis: HalAxis, error: PpmcError) -> None:
        """Store a fault of an axis and print it."""
        axis.fault = next(code for code, kind in enumerate(FAULTS, 1) if isinstance(error, kind))
        axis.pending = axis.confirmed = axis.on = False
        axis.homed &= not isinstance(error, EndUnknown)
        if error is not self._last_error:
            text = str(error).removeprefix(f"axis {axis.number}: ")
            self._report(f"axis {axis.number}: fault {axis.fault}: {text}")
        self._last_error = error

    def _attempt(self, axes: Sequence[HalAxis], call: Callable[[], object]) -> None:
        """Call a function; an error becomes a fault of these axes, but LinkError (port lost) is raised."""
        try:
            call()
        except PpmcError as error:
            if isinstance(error, LinkError) and not isinstance(error, EndUnknown):
                raise
            for axis in axes:
                self._fail(axis, error)

    # ------------------------------------------------------------------ motions

    def _poll(self, axis: HalAxis) -> None:
        """Process the end of a motion."""
        motion = axis.motion
        if motion is None or axis.reading.busy:
            return
        self._attempt([axis], motion.poll)
        if not motion.over:
            return
        axis.motion, result = None, motion.result
        axis.confirmed = result is not None and result.complete
        if result is not None:
            axis.homed &= not result.cause & (Cause.LIMIT | Cause.ALARM)
            if not (axis.stopping and result.cause is Cause.STOP):
                self._attempt([axis], lambda: result.check(motion.requested))
            if result.position is not None:
                axis.reading = axis.reading._replace(position=result.position)
        if axis in self._members and not axis.confirmed:
            self._end_group(f"axis {axis.number} of the group has ended early")

    def _start_group(self) -> None:
        """Start the axes that are armed for a common start, as soon as all of them are at standstill."""
        self._waiting = self._common.rose("group-start") or (
            self._waiting and bool(self._common["group-start"])
        )
        armed = [axis for axis in self._axes.values() if axis.pins["arm"]]
        if self._waiting and all(axis.idle for axis in armed):
            self._waiting, self._members = False, armed
            self._attempt([axis for axis in armed if not axis.fault], self._start_members)
            if any(axis.fault for axis in armed):
                for axis in armed if self.machine else ():
                    self._attempt([axis], axis.adopt)
                self._members = ()

    def _start_members(self) -> None:
        if off := [str(axis.number) for axis in self._members if not axis.on]:
            raise GroupEndedError(f"a fault in the group, or not enabled: axis {', '.join(off)}")
        moves = {axis.number: pulses for axis in self._members if (pulses := axis.distance())}
        motions = self.machine.start_together(moves) if self.machine and moves else {}
        for number, motion in motions.items():
            self._axes[number].motion = motion

    def _end_group(self, reason: str) -> None:
        """Set a fault in each axis of a group that still moves.

        The fault clears `on`, so the next cycle stops the axis.
        """
        members, self._members, error = self._members, (), GroupEndedError(reason)
        for axis in members:
            if axis.motion and not axis.stopping:
                self._fail(axis, error)

    def _home(self, axis: HalAxis) -> None:
        """Home an axis. The cycles of the other axes continue, but only one axis homes at a time."""

        def progress(now: object) -> None:
            self._cycle()
            if not axis.on:
                raise AbandonedError

        def run() -> None:
            speed = axis.pins["home-velocity"] * axis.scale
            axis.prepare()
            axis.drive.home(1 if speed > 0 else -1, abs(speed), progress)
            axis.homed = axis.confirmed = True

        axis.homed = axis.confirmed = False
        self._homing = axis
        try:
            with suppress(AbandonedError):
                self._attempt([axis], run)
        finally:
            self._homing, axis.homing = None, False
        if not axis.homed:
            self._attempt([axis], axis.adopt)
