"""Drive of the PMC006B4 (P006-EXC).

The drive consists of the angle, the current references with their bit streams, the idle current, and the
bridges.

The model is event driven. In this module, edge t of a method is the edge at which the register concerned
changes.
"""

from __future__ import annotations

from functools import partial

from ...chip import Phase
from ...clock import Event
from ..motion.motion import Motion, base_code
from ..pins import Services
from .angle import CYCLE, HOME, OFF, References, peak_code, references
from .angle import Phase as Reference
from .chopper import Chopper, Times

IDLE_US = 100_000
PINS = {"a": ("m10", "m11"), "b": ("m20", "m21")}
MODULUS = 256


class Stream:
    """Bit stream of a reference: the carry of an accumulator that adds the reference every cycle.

    Rule: P006-EXC-40.

    The level is calculated only when it is requested.
    """

    def __init__(self, t: int) -> None:
        self._since, self._sum, self._before, self._ref = t, 0, 0, 0

    def change(self, t: int, ref: int) -> None:
        """Change the reference register at edge t. At this edge, the accumulator adds the old value."""
        self._before, self._sum = self._total(t - 1), self._total(t)
        self._since, self._ref = t, ref

    def _total(self, t: int) -> int:
        """Return the sum of all references added up to edge t."""
        return self._sum + (t - self._since) * self._ref if t >= self._since else self._before

    def level(self, t: int) -> int:
        """Return the level after edge t.

        Raises ValueError if t is before the last change of the reference.
        """
        if t < self._since:
            raise ValueError(f"level({t}): the reference has changed at edge {self._since}")
        return self._total(t) // MODULUS - self._total(t - 1) // MODULUS


class Drive:
    """Drive of both phases.

    The log contains the outputs phase_*, bridge_* and m10 .. m21. `level` returns pwm_*.

    Args:
        t_off_ns, t_blank_ns: off time and blanking time of the chopper.
        origin: first internal edge after the reset.

    Attributes:
        angle: electrical angle TH, 0..511.
        decayed: True if the idle timer has expired.
    """

    def __init__(
        self,
        services: Services,
        motion: Motion,
        t_off_ns: int = 20_000,
        t_blank_ns: int = 1_000,
        origin: int = 0,
    ) -> None:
        self._services, self._motion = services, motion
        motion.listener = self
        self.angle = HOME
        self.decayed = False
        self.enabled = False
        self._booted = False
        self._evaluation_at = -1
        self._compared = dict.fromkeys(PINS, 0)
        self._origin = origin + services.core_timing.grid_from
        self._output_references: References = OFF
        self._references: References = OFF
        self._timer: Event | None = None
        times = Times.of(services.clk_hz, t_off_ns, t_blank_ns, services.core_timing.force)
        self.choppers = {name: Chopper(services.queue, times, partial(self._bridge, name)) for name in PINS}
        self.streams = {name: Stream(origin) for name in PINS}

    # ------------------------------------------------------------------ causes

    def booted(self, t: int) -> None:
        """Process the end of BOOT at edge t."""
        if not self._booted:
            self._booted = True
            self._start_idle(t)
        self.settings_changed(t)

    def settings_changed(self, t: int) -> None:
        """Process new values of cur, autodec, att or free after edge t."""
        on = self._booted and not self._services.settings.free
        if on != self.enabled:
            self.enabled = on
            self._services.queue.at(
                t + self._services.core_timing.enable, Phase.PIN, lambda at: self._enable(at, on)
            )
        self._schedule_evaluation(t)

    def compare(self, t: int, a: int, b: int) -> None:
        """Process new levels of cmp_a and cmp_b; edge t is the first edge that samples them."""
        for name, level in zip(PINS, (a, b), strict=True):
            if level == self._compared[name]:
                continue
            self._compared[name] = level
            on_level = partial(self.choppers[name].compare, level=level)
            self._services.queue.at(t + self._services.core_timing.cmp, Phase.LEVELS, on_level)

    def moved(self, t: int, forward: bool, increment: int) -> None:
        """Process a step at edge t (P006-EXC-02)."""
        self.angle = (self.angle + (increment if forward else -increment)) % CYCLE
        self._schedule_evaluation(t)

    def changed(self, t: int) -> None:
        """Process new values of busy, current_comp or lead_angle of the motion at edge t."""
        if self._motion.busy:
            self._stop_idle()
        elif self._booted and self._timer is None and not self.decayed:
            self._start_idle(t)
        self._schedule_evaluation(t)

    # ------------------------------------------------------------------ idle timer

    def _start_idle(self, t: int) -> None:
        """Start the idle timer when BUSY or BOOT falls at edge t (P006-EXC-31)."""
        us = self._services.us
        over = us.edge_of(us.first(t + 1) + IDLE_US - 1) + self._services.core_timing.idle
        self._timer = self._services.queue.at(over, Phase.STORE, self._decay)

    def _stop_idle(self) -> None:
        self.decayed = False
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _decay(self, t: int) -> None:
        self.decayed, self._timer = True, None
        self._schedule_evaluation(t)

    # ------------------------------------------------------------------ references

    def _schedule_evaluation(self, t: int) -> None:
        """Schedule the next evaluation of the references; a value that they use changes at edge t."""
        grid = self._services.core_timing.grid
        at = t + grid - (t - self._origin) % grid
        if self._evaluation_at != at:
            self._evaluation_at = at
            self._services.queue.at(at, Phase.PINS, self._evaluate)

    def _evaluate(self, t: int) -> None:
        """Evaluate the references from the levels before edge t (P006-EXC-12, -30, P006-STA-12)."""
        motion, now = self._motion, self._services.settings
        refs = OFF
        if self.enabled:
            lead = motion.lead_angle if motion.forward else -motion.lead_angle
            decayed = self.decayed and bool(now.autodec)
            peak = peak_code(base_code(now.cur), motion.current_comp, motion.busy, decayed, now.att)
            refs = references((self.angle + lead) % CYCLE, peak)
        if refs != self._references:
            self._references = refs
            self._services.queue.at(
                t + self._services.core_timing.refs, Phase.PIN, lambda at: self._output(at, refs)
            )

    def _output(self, t: int, refs: References) -> None:
        for name, old, new in zip(PINS, self._output_references, refs, strict=True):
            if old != new:
                self._set_reference(t, name, new)
        self._output_references = refs

    def _set_reference(self, t: int, name: str, new: Reference) -> None:
        log = self._services.log
        log.set(t, f"phase_{name}_ref", new.ref)
        log.set(t, f"phase_{name}_sign", new.sign)
        self.streams[name].change(t, new.ref)
        self.choppers[name].reference(t, new.ref, new.sign)

    # ------------------------------------------------------------------ bridges

    def _enable(self, t: int, on: bool) -> None:
        for name, chopper in self.choppers.items():
            self._services.log.set(t, f"bridge_{name}_en", int(on))
            chopper.enable(t, on)

    def _bridge(self, name: str, t: int, plus: int, minus: int) -> None:
        for pin, level in zip(PINS[name], (plus, minus), strict=True):
            self._services.log.set(t, pin, level)

    def level(self, t: int, name: str) -> int:
        """Return pwm_a_ref ("a") or pwm_b_ref ("b") after edge t.

        Edge t must not be before the last change of the reference.
        """
        return self.streams[name].level(t)
