"""Chopper of one phase of the PMC006B4 (P006-CHP-02..06).

After each off time, which is fixed, the bridge is on or in fast decay.

The model is driven by events: timers, and changes of the comparator, the reference and the enable. In this
module, edge t of a method is the edge at which the half-bridge commands change.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from ...chip import Phase
from ...clock import Event, Scheduler


class State(Enum):
    """States of the bridge.

    OFF: both low sides are on. ON: the supply is connected in the direction of the sign. FAST: the supply is
    connected against the sign.
    """

    OFF = "off"
    ON = "on"
    FAST = "fast"


@dataclass(frozen=True)
class Times:
    """Times of a chopper in cycles.

    They are the off time, the blanking time, the longest fast decay, and the delay from a change of the sign
    to the state OFF.
    """

    off: int
    blank: int
    fast: int
    force: int = 1

    @classmethod
    def of(cls, clk_hz: int, t_off_ns: int, t_blank_ns: int, force: int = 1) -> Times:
        """Return the off time, the blanking time and the fast-decay time.

        See docs/pmc006/README.md, 9 Chopper and bridges.
        """
        off, blank = (-(-ns * clk_hz // 1_000_000_000) for ns in (t_off_ns, t_blank_ns))
        return cls(off, blank, max(blank, off // 2), force)


class Chopper:
    """Chopper of one phase.

    Args:
        set_bridge: set_bridge(t, m_plus, m_minus) sets the half-bridge commands (m10, m11 or m20, m21) at
            edge t.
    """

    def __init__(self, queue: Scheduler, times: Times, set_bridge: Callable[[int, int, int], None]) -> None:
        self._queue, self._times, self._set_bridge = queue, times, set_bridge
        self.state = State.OFF
        self._on = False
        self._ref = self._sign = self._cmp = 0
        self._armed = False
        self._events: list[Event] = []

    # ------------------------------------------------------------------ causes

    def enable(self, t: int, on: bool) -> None:
        """Process a change of the bridge enable at edge t.

        If the bridge is disabled, the commands are low from edge t at least until it is enabled again.
        """
        self._on = on
        if not on:
            self._enter(t, State.OFF)
        else:
            self._start_off_time(t)

    def reference(self, t: int, ref: int, sign: int) -> None:
        """Process a change of the reference outputs at edge t."""
        reversed_sign = sign != self._sign
        self._ref, self._sign = ref, sign
        if reversed_sign and self._on:
            self._cancel_events()
            self._at(t + self._times.force, self._forced)

    def compare(self, t: int, level: int) -> None:
        """Process a synchronised comparator level, which is used from edge t on."""
        self._cmp = level
        if self._armed and level == (self.state is State.ON):
            self._at(t, self._end_phase)

    # ------------------------------------------------------------------ states

    def _forced(self, t: int) -> None:
        self._enter(t, State.OFF)

    def _enter(self, t: int, state: State) -> None:
        self._cancel_events()
        self.state = state
        if state is State.OFF:
            self._set_bridge(t, 0, 0)
            self._start_off_time(t)
            return
        forward = (state is State.ON) != bool(self._sign)
        self._set_bridge(t, int(forward), int(not forward))
        self._at(t + self._times.blank, self._arm)
        if state is State.FAST:
            self._at(t + self._times.fast, self._end_phase)

    def _start_off_time(self, t: int) -> None:
        """Start the off time at edge t if the bridge is enabled."""
        self._cancel_events()
        if self._on:
            self._at(t + self._times.off, self._decide)

    def _decide(self, t: int) -> None:
        """Select the state after the off time, from the comparator level.

        The state is FAST if the level is 1. Otherwise, it is ON, or OFF if the reference is 0, because then
        the current must not rise.
        """
        if self._cmp:
            self._enter(t, State.FAST)
        else:
            self._enter(t, State.ON if self._ref else State.OFF)

    def _arm(self, t: int) -> None:
        """Process the end of the blanking."""
        self._armed = True
        if self._cmp == (self.state is State.ON):
            self._end_phase(t)

    def _end_phase(self, t: int) -> None:
        if self._armed:
            self._enter(t, State.OFF)

    # ------------------------------------------------------------------ events

    def _at(self, t: int, action: Callable[[int], None]) -> None:
        self._events.append(self._queue.at(t, Phase.CHOPPER, action))

    def _cancel_events(self) -> None:
        self._armed = False
        for event in self._events:
            event.cancel()
        self._events.clear()
