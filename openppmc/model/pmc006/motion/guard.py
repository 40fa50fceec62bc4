"""What stops the PMC006B4: emergency inputs and the stall detector (P006 chapters 4.3, 7.1, 7.2)."""

from __future__ import annotations

from collections.abc import Mapping

from ...common.blocks import Phase
from ...common.scheduler import Callback
from ..desk import Desk

EXTS = ("ext1", "ext2")


class Guard:
    """stall, stpos: STALL and the position where it was set."""

    def __init__(self, desk: Desk) -> None:
        self._desk, self._queue, self._regs = desk, desk.shared.queue, desk.settings
        self._level = dict.fromkeys(EXTS, 1)
        self._set_at: dict[str, int] = {}
        self._flags = dict.fromkeys(EXTS, False)
        self._valid, self._bemf, self._sampled = False, 0, -1
        self._count = 0
        self.stall = False
        self.stpos = 0

    def latched(self, ext: str) -> bool:
        """Stop flag of "ext1" or "ext2"."""
        return self._flags[ext]

    @property
    def locked(self) -> bool:
        """Any of the two."""
        return any(self._flags.values())

    # ------------------------------------------------------------------ emergency inputs

    def see(self, t: int, levels: Mapping[str, int]) -> None:
        """Synchronised levels that edge t compares with those of one clk before (P006-EXT-04)."""
        for place, ext in enumerate(EXTS):
            before, self._level[ext] = self._level[ext], levels[ext]
            wanted = self._regs.trigm >> place & 1
            if levels[ext] != before and levels[ext] == wanted and self._regs.exten >> place & 1:
                self._desk.stop(t)
                self._queue.at(t, Phase.FLAG, self._setter(ext))

    def _setter(self, ext: str) -> Callback:
        return lambda now: self._set(now, ext)

    def _set(self, t: int, ext: str) -> None:
        self._flags[ext], self._set_at[ext] = True, t

    # ------------------------------------------------------------------ stall

    @property
    def _watches(self) -> bool:
        """A sample is evaluated (P006-STL-01)."""
        motion = self._desk.motion
        return bool(self._regs.stcfg & 1) and not self.stall and motion.busy and motion.steady

    def strobe(self, t: int, valid: int, level: int) -> None:
        """Levels of the pins that edge t samples."""
        self._valid, self._bemf = bool(valid), level
        if valid:
            self._sample(t)

    def _sample(self, t: int) -> None:
        """The level is compared at edge t, the outcome evaluated one clk later."""
        if self._sampled != t:
            self._sampled = t
            below = self._bemf < self._regs.stlvl
            self._queue.at(t + 1, Phase.COMMAND, lambda now: self._evaluate(now, below))

    def _evaluate(self, t: int, below: bool) -> None:
        watches = self._watches
        self._count = self._count + 1 if watches and below else 0
        if watches and self._count >= max(1, self._regs.stlen):
            position = self._desk.position
            self._queue.at(t, Phase.FLAG, lambda now: self._stalled(now, position))
            if self._regs.stcfg & 2:
                self._desk.stop(t)
        elif watches and self._valid:
            # A strobe that lasts is a sample in every clk.
            self._sample(t)

    def _stalled(self, t: int, position: int) -> None:
        self.stall, self.stpos, self._set_at["stall"] = True, position, t

    def look(self, t: int) -> None:
        """Everything as it is after edge t."""
        if self._valid and self._sampled < t and self._watches:
            self._sample(t)
        if self.stall and self._regs.stcfg & 2 and self._desk.motion.busy:
            self._queue.at(t + 1, Phase.QUEUE, self._desk.stop)

    @property
    def pull(self) -> bool:
        """STALL pulls GPO5."""
        return self.stall and bool(self._regs.stcfg & 4)

    # ------------------------------------------------------------------ executor

    def clear(self, t: int, latch: str) -> None:
        """b, l, p; a latch that is set in the same clk stays (P006-STA-14)."""
        if self._set_at.get(latch) == t:
            return
        if latch == "stall":
            self.stall = False
        else:
            self._flags[latch] = False

    def started(self) -> None:
        """A motion has been accepted (P006-STA-03, P006-STL-04)."""
        self.stall, self._count = False, 0
