"""Filtered input levels and the generalized input of the PPMC-312: P312-INP-01, P312-MON-10.

Decisions use the filtered levels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...chip import Context, Phase
from ...clock import Callback, Event
from ..front.responses import Responses
from ..timing import CLEAR_PULSE, CURRENT_DOWN, EVT_LOW, PIN_LOW, SAMPLE

SLOW_PINS = ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n")
EVENT_PINS = ("evt0_n", "evt1_n")


class Filters:
    """Filters of the guarded pins; changed(t, pin) is called when the filtered level of a pin has changed.

    Attributes:
        levels: filtered levels. With DATASHEET timing, a low level is accepted after the filter time, a high
            level immediately.
    """

    def __init__(self, context: Context, changed: Callable[[int, str], None]) -> None:
        self._context, self._changed = context, changed
        self._plain = dict.fromkeys((*SLOW_PINS, *EVENT_PINS), 1)
        self.levels = dict(self._plain)
        self._pending: dict[str, Event] = {}

    def on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        """Process synchronised levels from edge t on."""
        changed_pins = [pin for pin in self._plain if levels[pin] != self._plain[pin]]
        for pin in changed_pins:
            self._plain[pin] = levels[pin]
        for pin in changed_pins:
            if not levels[pin] and self._context.datasheet:
                at = t + self._context.timebase.cyc(EVT_LOW if pin in EVENT_PINS else PIN_LOW)
                self._pending[pin] = self._context.queue.at(at, Phase.LEVELS, self._low(pin))
            else:
                self._set(t, pin, levels[pin])

    def _low(self, pin: str) -> Callback:
        return lambda now: self._set(now, pin, 0)

    def _set(self, t: int, pin: str, level: int) -> None:
        pending = self._pending.pop(pin, None)
        if pending:
            pending.cancel()
        if self.levels[pin] != level:
            self.levels[pin] = level
            # All pins that change at the same edge are updated before any of them causes an action.
            self._context.queue.at(t, Phase.QUEUE, lambda now: self._changed(now, pin))


class InputChange:
    """Monitor that samples auxi with a mask every 50 us."""

    def __init__(self, context: Context, responses: Responses) -> None:
        self._context, self._responses = context, responses
        self._mask = self._last_level = 0
        self._auto = False
        self._since = 0
        self._next: Event | None = None

    def set_up(self, t: int, mask: int, auto: bool) -> None:
        """Execute instruction 28."""
        self._mask, self._auto, self._since = mask, auto, t
        self._last_level = self._context.levels["auxi"]
        if self._next:
            self._next.cancel()
            self._next = None

    def on_change(self, t: int) -> None:
        """Process a change of auxi at edge t. The next sample compares the new levels."""
        if not self._mask or self._next:
            return
        timebase = self._context.timebase
        number = max(1, (t - self._since) * timebase.xtal_hz // (SAMPLE * timebase.clk_hz))
        while self._since + timebase.cyc(SAMPLE * number) < t:
            number += 1
        at = self._since + timebase.cyc(SAMPLE * number)
        self._next = self._context.queue.at(at, Phase.RUN, self._sample)

    def _sample(self, t: int) -> None:
        self._next = None
        level = self._context.levels["auxi"]
        data, self._last_level = (self._last_level ^ level) & self._mask, level
        if data:
            self._responses.input_change(t, data)
            if not self._auto:
                self._mask = 0


# Terminal outputs of the PPMC-312 and their timers (P312-CMD-20..26, P312-OUT-01, -02).


class Outputs:
    """Terminal outputs: internal levels of the pins."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.exon_n = self.cclr_n = self.aclr_n = self.zclmp_n = self.cd_n = 1
        self.auxo_n = 0x3F
        self._timers: dict[str, Event] = {}

    def _after(self, name: str, t: int, cycles: int, action: Callable[[int], None]) -> None:
        self._cancel(name)
        # The pin register adds the last cycle of the time.
        at = t + self._context.timebase.cyc(cycles - 1) + 1
        self._timers[name] = self._context.queue.at(at, Phase.CHOPPER, action)

    def _cancel(self, name: str) -> None:
        event = self._timers.pop(name, None)
        if event:
            event.cancel()

    def counter_clear(self, t: int) -> None:
        """Execute instruction 22: start the pulse; a pulse that is already active starts again."""
        self.cclr_n = 0
        self._after("cclr", t, CLEAR_PULSE, self._counter_cleared)

    def _counter_cleared(self, t: int) -> None:
        self.cclr_n = 1

    def alarm_clear(self, t: int) -> None:
        """Execute instruction 24."""
        self.aclr_n = 0
        self._after("aclr", t, CLEAR_PULSE, self._alarm_cleared)

    def _alarm_cleared(self, t: int) -> None:
        self.aclr_n = 1

    def clamp(self) -> None:
        """Activate the zero clamp."""
        self.zclmp_n = 0

    def begin(self) -> None:
        """Process t0, the start of a motion."""
        self.zclmp_n = self.cd_n = 1
        self._cancel("cd")

    def pulses_ended(self, t: int) -> None:
        """Start the timer of the current reduction."""
        self._after("cd", t, CURRENT_DOWN, self.reduce)

    def reduce(self, t: int) -> None:
        """Activate the current reduction, because its timer has expired or alm_n is low."""
        self.cd_n = 0

    @property
    def values(self) -> tuple[int, ...]:
        """Internal levels of all outputs, in the order of `levels`."""
        return self.exon_n, self.cclr_n, self.aclr_n, self.zclmp_n, self.cd_n, self.auxo_n

    def levels(self) -> dict[str, int]:
        """Return the internal level of each pin, by its name."""
        names = ("exon_n", "cclr_n", "aclr_n", "zclmp_n", "cd_n", "auxo_n")
        return dict(zip(names, self.values, strict=True))
