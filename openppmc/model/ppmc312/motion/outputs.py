"""Terminal outputs of the PPMC-312 and their timers (P312-CMD-20..26, P312-OUT-01, -02)."""

from __future__ import annotations

from collections.abc import Callable

from ...common.blocks import Context, Phase
from ...common.scheduler import Event
from ..pace import CLEAR_PULSE, CURRENT_DOWN


class Outputs:
    """Internal levels behind the pins."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.exon_n = self.cclr_n = self.aclr_n = self.zclmp_n = self.cd_n = 1
        self.auxo_n = 0x3F
        self._timers: dict[str, Event] = {}

    def _after(self, name: str, t: int, cycles: int, action: Callable[[int], None]) -> None:
        self._cancel(name)
        # The last cycle is the one that the pin needs.
        at = t + self._context.timebase.cyc(cycles - 1) + 1
        self._timers[name] = self._context.queue.at(at, Phase.CHOPPER, action)

    def _cancel(self, name: str) -> None:
        event = self._timers.pop(name, None)
        if event:
            event.cancel()

    def counter_clear(self, t: int) -> None:
        """22: the pulse begins, again if it runs."""
        self.cclr_n = 0
        self._after("cclr", t, CLEAR_PULSE, self._counter_cleared)

    def _counter_cleared(self, t: int) -> None:
        self.cclr_n = 1

    def alarm_clear(self, t: int) -> None:
        """24."""
        self.aclr_n = 0
        self._after("aclr", t, CLEAR_PULSE, self._alarm_cleared)

    def _alarm_cleared(self, t: int) -> None:
        self.aclr_n = 1

    def clamp(self) -> None:
        """Zero clamp on."""
        self.zclmp_n = 0

    def begin(self) -> None:
        """t0."""
        self.zclmp_n = self.cd_n = 1
        self._cancel("cd")

    def pulses_ended(self, t: int) -> None:
        """The time to the current reduction starts."""
        self._after("cd", t, CURRENT_DOWN, self.reduce)

    def reduce(self, t: int) -> None:
        """Current reduction on: its time is over, or alm_n is low."""
        self.cd_n = 0

    @property
    def values(self) -> tuple[int, ...]:
        """The internal levels."""
        return self.exon_n, self.cclr_n, self.aclr_n, self.zclmp_n, self.cd_n, self.auxo_n

    def levels(self) -> dict[str, int]:
        """Pin names and internal levels."""
        names = ("exon_n", "cclr_n", "aclr_n", "zclmp_n", "cd_n", "auxo_n")
        return dict(zip(names, self.values, strict=True))
