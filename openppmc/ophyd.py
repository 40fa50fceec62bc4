"""An axis of any part as a positioner of ophyd, for plans of bluesky.

Requires the extra `ophyd`.

from openppmc.host import open_part
from openppmc.ophyd import PpmcPositioner

part = open_part("/dev/ttyUSB0")
part.axes[0].initialise(start_pps=1000, high_pps=8000, ramp_pulses=400)
theta = PpmcPositioner(part, name="theta", pulses_per_unit=400, egu="deg", limits=(-5, 90))
RE(scan([detector], theta, 0, 30, 61))
"""

from __future__ import annotations

import math
import threading
import time
from numbers import Real
from typing import Any
from weakref import WeakKeyDictionary

from .errors import needs
from .host.errors import AxisBusy, LinkError, NothingToStop, OutOfRange, PpmcError
from .host.motion import AnyMotion
from .host.motion_result import StoppedByCommand
from .host.part import Device

needs("ophyd", "openppmc.ophyd", "ophyd")

from ophyd import SoftPositioner  # noqa: E402

POLL = 0.03
"""Time between two polls of a motion, in seconds of the board."""
FREE = 0.01
"""Pause in s after each poll, so that other threads can use the port.

The pause is necessary because a lock does not serve waiting threads in order.
"""

_locks: WeakKeyDictionary[Device, threading.RLock] = WeakKeyDictionary()


class PpmcPositioner(SoftPositioner):  # type: ignore[misc]
    """One axis of a part or of a bank, or a station of a line.

    `set` returns a Status immediately. The Status fails with the error of the driver: LimitReached,
    AlarmStop, StoppedByCommand, Disconnected and others. Positioners of one device can move at the same time,
    and any thread can call them. Other code must not use the device during this time.

    Args:
        device: open device whose axis is initialised; it must exist as long as the positioner.
        axis: number of the axis from 1 on, or the station.
        pulses_per_unit: pulses per `egu`; negative if the position decreases in direction CW.
        limits: soft limits in `egu`, (0, 0) for no limits. Limit switches of the machine also end a motion.
        others: arguments of ophyd.

    Raises:
        OutOfRange: the axis does not exist, or a number is not finite.
    """

    def __init__(
        self,
        device: Device,
        axis: int = 1,
        *,
        name: str,
        pulses_per_unit: float = 1,
        egu: str = "pulses",
        limits: tuple[float, float] = (0, 0),
        **others: Any,
    ) -> None:
        _number(pulses_per_unit, "pulses_per_unit")
        if not pulses_per_unit:
            raise OutOfRange("pulses_per_unit 0: not supported; use the number of pulses in a unit")
        self._scale = pulses_per_unit
        self._device, self._axis = device, _axis(device, axis)
        self._lock = _locks.setdefault(device, threading.RLock())
        self._stopped_well = False
        super().__init__(
            name=name, egu=egu, limits=limits, source=f"{device.link.name}, axis {axis}", **others
        )

    @property
    def position(self) -> float:
        """Position of the axis in `egu`, read from the part.

        If the port is lost, the value is the last known position.
        """
        try:
            return self._ask()
        except LinkError:
            if self._position is None:
                raise
            return float(self._position)

    def read(self) -> Any:
        """Read the values as ophyd defines it; the port must be connected."""
        self._ask()
        return super().read()

    @property
    def moving(self) -> bool:
        """True while a motion of this positioner is in progress."""
        return bool(self._moving)

    def check_value(self, pos: float) -> None:
        """Check a position.

        Raises:
            OutOfRange: the position is not a finite number.
            LimitError: the position is outside the soft limits (error of ophyd).
        """
        super().check_value(_number(pos, "position"))

    def move(
        self, position: float, wait: bool = True, timeout: float | None = None, moved_cb: Any = None
    ) -> Any:
        """Move with ramps to the pulse nearest to a position in `egu`; return a Status of ophyd.

        Raises:
            AxisBusy: another move of this positioner is in progress.
        """
        if self._moving:
            raise AxisBusy(0, f"{self.name} is moving; wait for its Status or stop it")
        return super().move(position, wait=wait, timeout=timeout, moved_cb=moved_cb)

    def stop(self, *, success: bool = False) -> None:
        """Decelerate, if a move of this positioner is in progress.

        Args:
            success: True if the Status of the move must succeed.
        """
        self._stopped_well = success
        with self._lock:
            if self._moving:
                try:
                    self._axis.stop(wait=False)
                except NothingToStop:
                    pass  # the motor has just stopped

    # ------------------------------------------------------------------ internal

    def _ask(self) -> float:
        with self._lock:
            self._position = self._axis.position / self._scale
        return float(self._position)

    def _setup_move(self, position: float, status: Any) -> None:
        self._moving, self._stopped_well = True, False
        try:
            with self._lock:
                pulses = round(position * self._scale) - round(self._ask() * self._scale)
                motion = self._axis.start_move(pulses) if pulses else None
        except PpmcError as error:
            self._over(status, error)
            return
        self._run_subs(sub_type=self.SUB_START, timestamp=time.time())
        if motion is None:
            self._over(status)
        else:
            threading.Thread(target=self._watch, args=(motion, status), name=self.name, daemon=True).start()

    def _watch(self, motion: AnyMotion, status: Any) -> None:
        """Report the position until the motion has ended."""
        try:
            while True:
                with self._lock:
                    now = motion.poll()
                    if now is None:
                        break
                    self._device.process_reports(POLL)
                self._set_position(now.position / self._scale)
                time.sleep(FREE)
            self._ask()
            assert motion.result is not None
            motion.result.check(motion.requested)
        except StoppedByCommand as error:
            self._over(status, None if self._stopped_well else error)
        except Exception as error:
            self._over(status, error)
        else:
            self._over(status)

    def _over(self, status: Any, error: Exception | None = None) -> None:
        """Finish the move.

        The Status is set last, because its callbacks may begin the next move immediately.
        """
        self._reset_sub(self._SUB_REQ_DONE)
        if error is not None:
            self._moving = False
            status.set_exception(error)
            return
        self._set_position(self._position)
        self._moving = False
        self._run_subs(sub_type=self.SUB_DONE, timestamp=time.time())
        status.set_finished()


def _axis(device: Device, number: int) -> Any:
    """Return an axis of a part by its number, or a station of a line."""
    station = getattr(device, "axis", None)
    if callable(station):
        return station(number)
    if not 1 <= number <= len(device.axes):
        raise OutOfRange(f"axis {number}: {device.link.name} has axes 1 to {len(device.axes)}")
    return device.axes[number - 1]


def _number(value: Any, what: str) -> float:
    if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
        raise OutOfRange(f"{what} {value!r} is not a finite number")
    return float(value)
