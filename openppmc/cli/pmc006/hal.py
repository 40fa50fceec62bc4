"""The command `hal` for PMC006B4: controllers as a component of LinuxCNC's HAL."""

from __future__ import annotations

from ...host import BACKWARD, FORWARD, OutOfRange, Pmc006
from ...host.axis import OnProgress
from ...host.pmc006.settings import LEAST_ACCELERATION, mean_acceleration
from ...linuxcnc import Machine, Reading
from ..common.hal import Axes, Name, closed_on_error, serve
from .session import open_bus, parse_addresses

HOME_PPS, SLOW_PPS = 1000, 200
SPEEDS = ("stops", "direction", "start_speed", "stop_speed", "max_speed")
"""Settings that homing changes."""


class Pmc006Drive:
    """Axis of a PMC006B4. EXT1 is the limit backward and the origin, EXT2 the limit forward."""

    def __init__(self, axis: Pmc006) -> None:
        self.axis = axis
        self._rising = axis.trigger
        self._applied: object = None
        self._before: dict[str, int] = {}

    def prepare(self, start: float, velocity: float, acceleration: float) -> None:
        for name, value in self._before.items():
            setattr(self.axis, name, value)
        self._before = {}
        if self._applied == (start, velocity, acceleration):
            return
        self.axis.enable_stops()
        if velocity:
            self.axis.max_speed = round(velocity)
        if start:
            self.axis.start_speed = self.axis.stop_speed = round(start)
        if acceleration:
            codes = [code for code in range(6) if mean_acceleration(code) <= acceleration]
            if not codes:
                raise OutOfRange(f"acceleration {acceleration:g} steps/s² is below {LEAST_ACCELERATION}")
            self.axis.acceleration = self.axis.deceleration = codes[-1]
        self._applied = start, velocity, acceleration

    def home(self, sign: int, pps: float, progress: OnProgress) -> object:
        speed = round(pps) or HOME_PPS
        self._before = {name: getattr(self.axis, name) for name in SPEEDS}
        end = self.axis.home(
            1, FORWARD if sign > 0 else BACKWARD, speed, min(speed, SLOW_PPS), progress=progress
        )
        self._before = {}
        return end

    def clear(self) -> None:
        self._applied = None
        self.axis.clear_stops()
        self.axis.clear_stall()

    def read(self) -> Reading:
        """Read position and switches."""
        ports = self.axis.ports()
        backward, forward = (ports.level(ext) is bool(self._rising >> ext - 1 & 1) for ext in (1, 2))
        return Reading(self.axis.position, forward, backward)


def hal(axes: Axes = None, name: Name = "openppmc") -> None:
    """Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W."""
    numbers = None if axes is None else parse_addresses(axes)

    def connect() -> Machine:
        nonlocal numbers
        with closed_on_error(open_bus()) as bus:
            numbers = numbers or [one.address for one in bus.scan()]
            bus.check(numbers)
            return Machine(bus, {number: Pmc006Drive(bus.axis(number)) for number in numbers})

    serve(name, connect)
