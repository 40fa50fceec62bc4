"""Axis of a bank."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...model.motion.codes import CONTINUOUS
from .. import speeds
from ..axis import CW, Axis
from ..capabilities import RateCapabilities
from ..check import within
from ..errors import NotCalledError, ProtocolError
from ..link import Link
from ..motion import Motion, MotionRequest, Progress
from ..motion_result import MotionResult
from ..registers import Inputs, Status
from ..script import Script
from .registers import CONFIG, POSITION, POSITION_BYTES, STATUS, Config
from .window import AxisLink

_HALF = 1 << 31


class BankAccess(Protocol):
    """Members of a bank (`part.PpmcBank`) that an axis needs."""

    @property
    def link(self) -> Link: ...
    @property
    def kind(self) -> RateCapabilities: ...
    def _is_in_group(self, number: int) -> bool: ...
    def _axis_started(self, number: int) -> None: ...
    def _resolve_others(self, number: int) -> None: ...


class BankMotion(Motion):
    """Motion of an axis of a bank; see `Motion`."""

    def __init__(self, axis: BankAxis, request: MotionRequest, begin: int) -> None:
        super().__init__(axis, request, begin)
        self._bank_axis = axis

    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult:
        """Wait as `Motion.wait` does.

        Raises:
            NotCalledError: the motion belongs to a group that is still open, so the wait would never end.
        """
        if not self.over and self._bank_axis._in_open_group:
            raise NotCalledError(
                f"{self._bank_axis._message_prefix}its group holds this motion until the end of the with "
                "block: start it there with "
                "start_move, start_constant, jog or search, and wait after the block"
            )
        return super().wait(timeout, progress)


class BankAxis(Axis):
    """Axis of a bank. Axis 1 is axis 0 of the window. See `axis.Axis` for the motions.

    `initialise` accepts the arguments of the PPMC-104 except external_clock. The bank itself counts the
    position; a reset sets it to 0. `zero` and `home` only store an offset in this object, because the counter
    is read-only (BANK-WIN-07).
    """

    def __init__(self, bank: BankAccess, number: int) -> None:
        super().__init__(AxisLink(bank.link, number))
        self.kind = bank.kind
        self.number = number
        self._bank = bank
        self._origin = 0

    @property
    def _in_open_group(self) -> bool:
        """True if an open group holds the motion of this axis (BANK-GRP-01)."""
        return self._bank._is_in_group(self.number)

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise the axis with a set-up planned earlier."""
        self.link.execute(self._strap_script(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    # ------------------------------------------------------------------ differences to other parts

    def _strap_script(self, clock: speeds.BaseClock | None) -> Script:
        script = Script()
        return script if clock is None else script.write(CONFIG, clock.vsel << 1 | clock.csel)

    def _motion_started(self, request: MotionRequest, begin: int) -> Motion:
        self._bank._axis_started(self.number)
        self._motion = BankMotion(self, request, begin)
        return self._motion

    def _foreign_result(self) -> MotionResult:
        """Return the result of a motion that another program started; its interrupt is pending."""
        motion = Motion(self, MotionRequest(CONTINUOUS, CW), 0, ours=False)
        motion._on_status(0)
        if not motion.over:
            raise ProtocolError(
                f"{self.link.name}: {self._message_prefix}its interrupt is pending while it moves"
            )
        self._motion = motion
        return motion.wait()

    def _on_status(self, status: int) -> None:
        # While the finish status of another axis is unread, int_n stays low. Then the end of this motion
        # sends no message. Therefore, read the finish statuses of other axes first.
        self._bank._resolve_others(self.number)

    def _add_position_read(self, script: Script) -> Script:
        return script.read_number(POSITION, POSITION_BYTES)

    def _position_of(self, count: int) -> int:
        return (count - self._origin + _HALF) % (2 * _HALF) - _HALF

    def zero(self) -> None:
        """Set the current position to 0, for this object only."""
        self._origin = self._known_count = self._check_count(self._count())

    def _on_reset(self) -> None:
        super()._on_reset()
        self._origin = 0

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """Return the status register. The call is allowed at any time."""
        return Status.parse(self.link.execute(Script().read(STATUS)).byte(0))

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self.link.execute(Script().pins()).byte(0))

    def config(self) -> Config:
        """Return the CONFIG register. The call is allowed at any time."""
        return Config.parse(self.link.execute(Script().read(CONFIG)).byte(0))

    def configure(self, csel: int = 1, vsel: int = 1) -> None:
        """Write CONFIG; csel and vsel are 0 or 1. The next operation uses the new values (BANK-GEN-04).

        `initialise`, and motions with a known speed, write the values that they require.
        """
        csel, vsel = within(csel, "csel", 0, 1), within(vsel, "vsel", 0, 1)
        self.link.execute(Script().write(CONFIG, vsel << 1 | csel))
