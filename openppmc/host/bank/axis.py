"""One axis of a bank."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...model.motion.codes import CONTINUOUS
from .. import speeds
from ..axis import CW, Axis, Chopping
from ..check import within
from ..ending import End
from ..errors import Misused, ProtocolError
from ..kind import RateKind
from ..link import Link
from ..motion import Motion, Order, Progress
from ..registers import Inputs, Status
from ..script import Script
from .window import AxisLink
from .words import CONFIG, POSITION, POSITION_BYTES, STATUS, Config

_HALF = 1 << 31


class Whole(Protocol):
    """What an axis needs of its bank, which is a `driver.PpmcBank`."""

    @property
    def link(self) -> Link: ...
    @property
    def kind(self) -> RateKind: ...
    def holds(self, number: int) -> bool: ...
    def started(self, number: int) -> None: ...
    def settle(self, number: int) -> None: ...


class BankMotion(Motion):
    """A motion of an axis of a bank; see `Motion`."""

    def __init__(self, axis: BankAxis, order: Order, begin: int) -> None:
        super().__init__(axis, order, begin)
        self._of = axis

    def wait(self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None) -> End:
        """As `Motion.wait`. Misused while the group that holds the motion is open: it would never end."""
        if not self.over and self._of.held:
            raise Misused(
                f"{self._of.who}its group holds it until the end of the with block: start it there with "
                "start_move, start_constant, jog or search, and wait behind the block"
            )
        return super().wait(timeout, progress)


class BankAxis(Chopping, Axis):
    """An axis of a bank, 1 the first (axis 0 of the window); see `axis.Axis` for the motions.

    `initialise`: figures of the PPMC-104, no external_clock. The position is counted by the bank itself, from
    0 at its reset; `zero` and `home` are remembered by this object only (BANK-WIN-07: read only).
    """

    def __init__(self, bank: Whole, number: int) -> None:
        super().__init__(AxisLink(bank.link, number))
        self.kind = bank.kind
        self.number = number
        self._bank = bank
        self._origin = 0

    @property
    def held(self) -> bool:
        """A group that is open holds its motion (BANK-GRP-01)."""
        return self._bank.holds(self.number)

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise with a setup that was planned before."""
        self.link.execute(self.straps(setup.clock).call(setup.code, *setup.data))
        self.setup = setup
        return setup

    # ------------------------------------------------------------------ what differs from other parts

    def straps(self, clock: speeds.BaseClock | None) -> Script:
        script = Script()
        return script if clock is None else script.write(CONFIG, clock.vsel << 1 | clock.csel)

    def started(self, order: Order, begin: int) -> Motion:
        self._bank.started(self.number)
        self._motion = BankMotion(self, order, begin)
        return self._motion

    def foreign_end(self) -> End:
        """The end of a motion of another program, whose interrupt is pending."""
        motion = Motion(self, Order(CONTINUOUS, CW), 0, ours=False)
        motion.look(0)
        if not motion.over:
            raise ProtocolError(f"{self.link.name}: {self.who}its interrupt is pending while it moves")
        self._motion = motion
        return motion.wait()

    def look(self, status: int) -> None:
        # The end of another axis's motion would keep int_n low, and this one's would send no message.
        self._bank.settle(self.number)

    def where(self, script: Script) -> Script:
        return script.read_number(POSITION, POSITION_BYTES)

    def counted(self, count: int) -> int:
        return (count - self._origin + _HALF) % (2 * _HALF) - _HALF

    def zero(self) -> None:
        """Here is position 0, for this object."""
        self._origin = self._count()

    def forget(self) -> None:
        super().forget()
        self._origin = 0

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """Status register; allowed at any time."""
        return Status.parse(self.link.execute(Script().read(STATUS)).byte(0))

    def inputs(self) -> Inputs:
        return Inputs.of_pins(self.link.execute(Script().pins()).byte(0))

    def config(self) -> Config:
        """CONFIG; allowed at any time."""
        return Config.parse(self.link.execute(Script().read(CONFIG)).byte(0))

    def configure(self, csel: int = 1, vsel: int = 1) -> None:
        """Write CONFIG, 0 or 1 each; the next operation takes it (BANK-GEN-04). `initialise` and motions at a
        known speed write what they need."""
        csel, vsel = within(csel, "csel", 0, 1), within(vsel, "vsel", 0, 1)
        self.link.execute(Script().write(CONFIG, vsel << 1 | csel))
