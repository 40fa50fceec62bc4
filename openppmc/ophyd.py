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

import threading
import time
from typing import Any

from .errors import needs
from .host.errors import AxisBusy, LinkError, PpmcError, ProtocolError
from .host.motion import AnyMotion
from .host.motion_result import StoppedByCommand
from .host.part import Device
from .positioner import Positioner, finite

needs("ophyd", "openppmc.ophyd", "ophyd")

from ophyd import SoftPositioner  # noqa: E402


class PpmcPositioner(SoftPositioner):  # type: ignore[misc]
    """One axis of a part or of a bank, or a station of a line.

    `set` returns a Status immediately. The Status fails with the error of the driver: LimitReached,
    AlarmStop, StoppedByCommand, Disconnected and others. Positioners of one device can move at the same time,
    and any thread can call them. Other code must not use the device during this time.

    Args:
        device: open device whose axis is initialised. The device must exist as long as the positioner.
        axis: number of the axis from 1 on, or the station.
        pulses_per_unit: pulses per `egu`; negative if the position decreases in direction CW.
        limits: soft limits in `egu`, (0, 0) for no limits. Limit switches of the machine also end a motion.
        others: further arguments, which are passed to ophyd.

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
        self._positioner = Positioner(device, axis, pulses_per_unit)
        self._stopped_well = False
        super().__init__(
            name=name, egu=egu, limits=limits, source=f"{device.link.name}, axis {axis}", **others
        )

    @property
    def position(self) -> float:
        """Position of the axis in `egu`, read from the part.

        If the port is lost, the value is the last known position. If the part was reset, the first read
        raises ProtocolError.
        """
        try:
            return self._ask()
        except LinkError as error:
            if self._position is None or isinstance(error, ProtocolError):
                raise
            return float(self._position)

    def read(self) -> Any:
        """Read the values in the form that ophyd defines; the port must be connected."""
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
        super().check_value(finite(pos, "position"))

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
        if self._moving:
            self._positioner.stop()

    # ------------------------------------------------------------------ internal

    def _ask(self) -> float:
        self._position = self._positioner.position
        return float(self._position)

    def _setup_move(self, position: float, status: Any) -> None:
        self._moving, self._stopped_well, self._positioner.stop_requested = True, False, False
        try:
            with self._positioner.lock:
                self._ask()
                motion = self._positioner.start_move(position)
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
            self._positioner.follow(motion, self._set_position)
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
