"""The desk of the PMC006B4's executor: everything that instructions look at and change."""

from __future__ import annotations

from collections.abc import Callable

from ...common.blocks import Phase
from ..effects import Effect
from ..memory.eeprom import Engine
from ..motion.guard import Guard
from ..motion.motion import Motion
from ..pins import SYNCHRONISED, Shared
from .processor import Processor


class Desk:
    """echo: STEP_ACK is "ECHO". version: FW_VERSION. changed(t): registers are new after edge t.

    motion, program and eeprom are set by the part. judging: edge of the instruction that is being judged;
    stepped_at: of the last step. speed_on: SPEED_MODE; running: the motion is one of the speed mode.
    """

    motion: Motion
    program: Processor
    eeprom: Engine

    def __init__(self, shared: Shared, echo: bool, version: int, changed: Callable[[int], None]) -> None:
        self.shared, self.echo, self.version, self._changed = shared, echo, version, changed
        self.settings = shared.settings
        self.levels = dict(SYNCHRONISED)
        self.guard = Guard(self)
        self._position = 0
        self.stepped_at = self.judging = self._stopped_at = -1
        self.speed_on = self.running = False

    # ------------------------------------------------------------------ what there is to see

    @property
    def position(self) -> int:
        """POS, signed."""
        return self._position - (self._position >> 31 << 32)

    @property
    def locked(self) -> bool:
        """Whatever blocks a start but BUSY."""
        return bool(self.settings.free) or self.guard.locked or self._stopped_at == self.judging

    @property
    def gpo(self) -> int:
        """Levels for the pins GPO5..1."""
        return self.settings.gpo | (0x10 if self.guard.pull else 0)

    @property
    def port_word(self) -> int:
        """x (P006-IO-01)."""
        seen = self.levels
        gpi = seen["gpi"]
        return (
            gpi & 7
            | self.shared.log.levels["gpo"] << 3
            | gpi >> 3 << 8
            | seen["ext1"] << 10
            | seen["ext2"] << 11
        )

    # ------------------------------------------------------------------ what happens

    def carry_out(self, t: int, effect: Effect) -> None:
        """The first half of an effect, before the motion has worked on edge t."""
        if effect.halt:
            self.shared.queue.at(t, Phase.GUARD, self._halt)
        if effect.early:
            early = effect.early
            self.shared.queue.at(t, Phase.GUARD, lambda now: early(self, now))

    def commit(self, t: int, effect: Effect) -> None:
        """The second half, behind it."""
        self.settings.load(effect.put or {})
        if effect.do:
            effect.do(self, t)
        if effect.put:
            self._changed(t)

    def stop(self, t: int) -> None:
        """A cause that stops a motion at edge t, and refuses a start there (P006-STA-10)."""
        self._stopped_at = t
        self.shared.queue.at(t, Phase.GUARD, self._halt)

    def _halt(self, t: int) -> None:
        if self.motion.busy:
            self.motion.halt(t)
            self.ended(t)

    def ended(self, t: int) -> None:
        """BUSY is 0 after edge t."""
        self.speed_on = self.running = False

    def stepped(self, t: int, forward: bool) -> None:
        """A step at edge t (P006-MOT-05)."""
        self.stepped_at = t
        self._position = (self._position + (1 if forward else -1)) % (1 << 32)

    def load_position(self, position: int) -> None:
        """i."""
        self._position = position % (1 << 32)

    def start(self, t: int, count: int) -> None:
        """s, ROT."""
        self.guard.started()
        self.motion.start(t, count)

    def run(self, t: int) -> None:
        """N=1 from IDLE."""
        self.guard.started()
        self.speed_on = self.running = True
        self.motion.run(t)

    def speed(self, t: int, on: bool) -> None:
        """N while the speed mode runs or ends."""
        if self.running:
            self.speed_on = on
            self.motion.speed_mode(t, on)
