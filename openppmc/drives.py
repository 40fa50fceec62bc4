"""Axis of any part, for adapters to other control systems (`openppmc.linuxcnc`, `openppmc.positioner`).

Commanded values are mapped to the settings of a part as follows. A PMC006B4 gets the next lower speed and the
next lower acceleration that it supports. The other parts get the nearest speeds that they support
(`host.speeds`), and a length of the ramp that is calculated from the commanded speeds and rounded up. Units
are pulses (PMC006B4: steps) and s.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

from .host.axis import CCW, CW, OnProgress
from .host.capabilities import OWN_SETTINGS, SetupRequest
from .host.pmc006.axis import HOMING_SETTINGS
from .host.pmc006.settings import coefficient, mean_acceleration

SHORTEST_RAMP = 4
HOME_PPS, SLOW_PPS = 1000, 200
KEPT = ("stops", "start_speed", "stop_speed", "max_speed", "acceleration", "deceleration")
"""Settings of a PMC006B4 that are restored after its port was lost."""
TOLERANCE = 1e-6  # tolerance of a conversion of units, in pulses or steps


class Speeds(NamedTuple):
    """Speeds of moves.

    Attributes:
        base, top: speeds at the start and between the ramps in pps.
        seconds: duration of the acceleration in s.
    """

    base: float
    top: float
    seconds: float


class Drive:
    """Axis with the functions that differ between parts.

    This class is for parts whose set-up contains the ramp.
    """

    has_acceleration = False  # True if a setting of the part replaces the number of ramp pulses
    _prepared: object = None

    def __init__(self, axis: Any, request: SetupRequest | None) -> None:
        self.axis, self._request, self._active = axis, request, request

    def attach(self, axis: Any) -> None:
        """Replace the object of the axis after a lost port was opened again.

        A later call of `initialise` restores the settings.
        """
        self.axis, self._prepared = axis, None

    def initialise(self) -> None:
        """Initialise the axis with its set-up, if any; the axis must be stopped."""
        if self._active is not None:
            self._apply(self._active)

    def _apply(self, request: SetupRequest) -> None:
        self.axis.apply(self.axis.kind.plan(self.axis.link.identity.xtal_hz, request))
        self._active = request

    @property
    def speeds(self) -> Speeds:
        """Speeds that the set-up of the part reaches."""
        setup = self.axis.setup
        base, top = float(setup.start.reached), float(setup.high.reached)
        return Speeds(base, top, 2 * setup.ramp_pulses / (base + top))

    def set_speeds(self, start: float, velocity: float, acceleration: float) -> None:
        """Set the speeds; 0 selects the value of the set-up. The axis must be stopped. Raises OutOfRange."""
        if self._request is None:
            return
        high = float(velocity or self._request.high_pps)
        low = min(float(start or self._request.start_pps), high)
        ramp = self._request.ramp_pulses
        if acceleration:
            pulses = (high * high - low * low) / (2 * acceleration)
            ramp = max(SHORTEST_RAMP, math.ceil(pulses - TOLERANCE))
        self._apply(replace(self._request, start_pps=low, high_pps=high, ramp_pulses=ramp))

    def prepare(self, *speeds: float) -> None:
        """Call `set_speeds` unless these are the values of the last call."""
        if speeds != self._prepared:
            self.set_speeds(*speeds)
            self._prepared = speeds

    def home(self, sign: int, pps: float, progress: OnProgress) -> object:
        """Find the origin in this direction and set the position to 0 there (0 pps: default speed)."""
        return self.axis.home(CW if sign > 0 else CCW, pps or None, progress=progress)

    def clear(self) -> None:
        """Clear the fault flags of the part. The next `prepare` sets the speeds again."""
        self._prepared = None
        if hasattr(self.axis, "clear_alarm") and self.axis.status().in_alarm:
            self.axis.clear_alarm()

    def switches(self) -> tuple[bool, bool, bool]:
        """Return True for each active switch: limit CW, limit CCW, origin."""
        pins = self.axis.inputs()
        return pins.limit_cw, pins.limit_ccw, pins.origin

    def leave_limit(self, target: int) -> None:
        """Clear the flag of a limit switch if it prevents a move to `target`, away from this switch."""


class SettingsDrive(Drive):
    """Axis of a PMC006B4, whose speeds are settings.

    EXT1 is both limit switch and origin switch in direction backward, and EXT2 is both in direction forward.
    """

    has_acceleration = True

    _before: tuple[tuple[str, int], ...] = ()  # settings that `initialise` restores
    _kept: tuple[tuple[str, int], ...] = ()  # values of the settings at the last read of the speeds

    def attach(self, axis: Any) -> None:
        super().attach(axis)
        self.__dict__.pop("_rising", None)

    @cached_property
    def _rising(self) -> int:
        return self.axis.trigger  # type: ignore[no-any-return]

    def initialise(self) -> None:
        # The station may have been reset, so restore the settings that were read last as well.
        for name, value in (dict(self._kept) | dict(self._before)).items():
            setattr(self.axis, name, value)
        self._before = ()

    @property
    def speeds(self) -> Speeds:
        now = {name: getattr(self.axis, name) for name in KEPT}
        self._kept, base, top = tuple(now.items()), now["start_speed"], now["max_speed"]
        return Speeds(base, top, (top - base) / mean_acceleration(now["acceleration"]))

    def set_speeds(self, start: float, velocity: float, acceleration: float) -> None:
        chosen = coefficient(acceleration) if acceleration else None
        if velocity:
            self.axis.max_speed = math.floor(velocity + TOLERANCE)
        if start:
            self.axis.start_speed = self.axis.stop_speed = math.floor(start + TOLERANCE)
        if chosen is not None:
            self.axis.acceleration = self.axis.deceleration = chosen

    def prepare(self, *speeds: float) -> None:
        self.initialise()
        if self._prepared is None:
            self.axis.enable_stops()
        super().prepare(*speeds)

    def home(self, sign: int, pps: float, progress: OnProgress) -> object:
        speed, switch = round(pps) or HOME_PPS, 2 if sign > 0 else 1
        self._before = tuple((name, getattr(self.axis, name)) for name in HOMING_SETTINGS)
        end = self.axis.home(switch, sign, speed, min(speed, SLOW_PPS), progress=progress)
        self._before = ()
        return end

    def clear(self) -> None:
        super().clear()
        self.axis.clear_stops()
        self.axis.clear_stall()

    def switches(self) -> tuple[bool, bool, bool]:
        ports = self.axis.ports()
        ext1, ext2 = (ports.level(ext) is bool(self._rising >> ext - 1 & 1) for ext in (1, 2))
        return ext2, ext1, False

    def leave_limit(self, target: int) -> None:
        left = 1 if target > self.axis.position else 2
        if left in self.axis.flags().stops:
            self.axis.clear_stops((left,))


def drive_of(axis: Any, request: SetupRequest | None) -> Drive:
    """Return the drive of an axis or station; a PMC006B4 ignores the set-up."""
    return (SettingsDrive if OWN_SETTINGS in axis.kind.has else Drive)(axis, request)
