"""Motions of the PMC006B4 at edges of `clk`: start, steps, updates, ends.

Rules: P006-MOT-04, -05, -50..-52.

`engine` contains the arithmetic. The model processes one event per update and per step. In this module, edge
t of a method is the edge at which the register concerned changes. A method reads the registers of other
blocks with their values before this edge.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Protocol

from ...chip import Phase
from ...clock import Callback, Event
from ..execution_context import ExecutionContext
from ..pins import Services
from .engine import UPDATE, Engine, LiveRegisters, MotionStart, Stage

# Stop monitor of the PMC006B4: emergency inputs and the stall detector (P006-EXT, P006-STL).

EXTS = ("ext1", "ext2")


class StopMonitor:
    """Emergency inputs and stall detector.

    Attributes:
        stall, stpos: flag STALL, and position at which it was set.
    """

    def __init__(self, context: ExecutionContext) -> None:
        self._context, self._queue, self._regs = context, context.services.queue, context.settings
        self._level = dict.fromkeys(EXTS, 1)
        self._set_at: dict[str, int] = {}
        self._flags = dict.fromkeys(EXTS, False)
        self._valid, self._bemf, self._sampled = False, 0, -1
        self._count = 0
        self.stall = False
        self.stpos = 0

    def latched(self, ext: str) -> bool:
        """Return the stop flag of "ext1" or "ext2"."""
        return self._flags[ext]

    @property
    def locked(self) -> bool:
        """True if a stop flag is set."""
        return any(self._flags.values())

    # ------------------------------------------------------------------ emergency inputs

    def on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        """Process synchronised levels at edge t; a change may set a stop flag (P006-EXT-04)."""
        for place, ext in enumerate(EXTS):
            before, self._level[ext] = self._level[ext], levels[ext]
            active_level = self._regs.trigm >> place & 1
            if levels[ext] != before and levels[ext] == active_level and self._regs.exten >> place & 1:
                self._context.stop(t)
                self._queue.at(t, Phase.FLAG, self._setter(ext))

    def _setter(self, ext: str) -> Callback:
        return lambda now: self._set(now, ext)

    def _set(self, t: int, ext: str) -> None:
        self._flags[ext], self._set_at[ext] = True, t

    # ------------------------------------------------------------------ stall

    @property
    def _is_monitoring(self) -> bool:
        """True if samples are evaluated (P006-STL-01)."""
        motion = self._context.motion
        return bool(self._regs.stcfg & 1) and not self.stall and motion.busy and motion.at_constant_speed

    def strobe(self, t: int, valid: int, level: int) -> None:
        """Process the levels of the pins that edge t samples."""
        self._valid, self._bemf = bool(valid), level
        if valid:
            self._sample(t)

    def _sample(self, t: int) -> None:
        """At edge t, compare the sampled back EMF with its limit. The result is evaluated one cycle later."""
        if self._sampled != t:
            self._sampled = t
            below = self._bemf < self._regs.stlvl
            self._queue.at(t + 1, Phase.COMMAND, lambda now: self._evaluate(now, below))

    def _evaluate(self, t: int, below: bool) -> None:
        monitoring = self._is_monitoring
        self._count = self._count + 1 if monitoring and below else 0
        if monitoring and self._count >= max(1, self._regs.stlen):
            position = self._context.position
            self._queue.at(t, Phase.FLAG, lambda now: self._stalled(now, position))
            if self._regs.stcfg & 2:
                self._context.stop(t)
        elif monitoring and self._valid:
            # While the strobe is high, every cycle is a sample.
            self._sample(t)

    def _stalled(self, t: int, position: int) -> None:
        self.stall, self.stpos, self._set_at["stall"] = True, position, t

    def evaluate(self, t: int) -> None:
        """Evaluate the state of the inputs and the motion after edge t."""
        if self._valid and self._sampled < t and self._is_monitoring:
            self._sample(t)
        if self.stall and self._regs.stcfg & 2 and self._context.motion.busy:
            self._queue.at(t + 1, Phase.QUEUE, self._context.stop)

    @property
    def pulls_gpo5(self) -> bool:
        """True if STALL drives GPO5."""
        return self.stall and bool(self._regs.stcfg & 4)

    # ------------------------------------------------------------------ executor

    def clear(self, t: int, latch: str) -> None:
        """Execute instruction b, l or p.

        If the set condition of the latch occurs in the same cycle, it stays set (P006-STA-14).
        """
        if self._set_at.get(latch) == t:
            return
        if latch == "stall":
            self.stall = False
        else:
            self._flags[latch] = False

    def started(self) -> None:
        """Process the start of a motion that was accepted (P006-STA-03, P006-STL-04)."""
        self.stall, self._count = False, 0


RB_FULL, MA_FULL = 255, 4000
ANALOG_UPDATES = 100


def drive_index(cur: int) -> int:
    """Return k for a requested current of 400..4000 mA (P006-EXC-20)."""
    return (cur - 325) // 150


@lru_cache
def base_code(cur: int) -> int:
    """Return RB for a requested current of 400..4000 mA (P006-EXC-20)."""
    return (RB_FULL * (400 + 150 * drive_index(cur)) + MA_FULL // 2) // MA_FULL


@lru_cache(maxsize=1 << 14)
def compensation(speed: int, mstep: int, cur: int, ccomp: int, scomp: int) -> tuple[int, int]:
    """Return the compensation B and the lead angle W at a speed (P006-EXC-21..23).

    B is the value that is added to the peak code.
    """
    full = speed // max(1, mstep)
    return base_code(cur) * ccomp * full // (1 << 22), min(64, scomp * full // (1 << 16))


class Listener(Protocol):
    """Members of the object that receives the events of a motion."""

    def moved(self, t: int, forward: bool, increment: int) -> None:
        """Process a step at edge t."""

    def changed(self, t: int) -> None:
        """Process new values of busy, current_comp or lead_angle at edge t."""


class Motion:
    """Motion of the motor.

    Args:
        stepped: stepped(t, forward) is called when mon_step rises at edge t.
        ended: ended(t) is called when BUSY has fallen at edge t without a stop.

    Attributes:
        busy, forward, current_comp, lead_angle: levels after the last edge that was simulated.
        increment: angle units that one step advances.
        at_constant_speed: True if the speed is constant (P006-STL-01).
        tick: number of the us tick at t = 0 of `engine`, `None` before the end of planning.
    """

    def __init__(
        self, services: Services, stepped: Callable[[int, bool], None], ended: Callable[[int], None]
    ) -> None:
        self._services, self._stepped, self._ended = services, stepped, ended
        self.listener: Listener | None = None
        self.busy = self.at_constant_speed = self._next_constant_speed = False
        self.forward = True
        self.increment, self.current_comp, self.lead_angle = 8, 0, 0
        self.engine: Engine | None = None
        self.tick: int | None = None
        self._speed_mode = False
        self._adc = self._adc_before = self._copy = 0
        self._adc_at = -1
        self._events: dict[int, Event] = {}
        self._serial = 0

    # ------------------------------------------------------------------ requests

    def start(self, t: int, count: int) -> None:
        """Start an accepted displacement of `count` >= 1 steps; BUSY rises at edge t."""
        self._start(t, count)

    def run(self, t: int) -> None:
        """Start the speed mode from standstill (IDLE); BUSY rises at edge t."""
        self._speed_mode = True
        self._start(t, None)

    def speed_mode(self, t: int, on: int) -> None:
        """Change the register SPEED_MODE at edge t. In speed mode, 0 requests the end of the motion.

        A 1 that is set before Phase.RUN is effective for an update at the same edge. A 0 must be set after
        Phase.RUN.
        """
        self._speed_mode = bool(on)

    def adc(self, t: int, data: int) -> None:
        """Process at edge t a strobe with the analogue value `data`, 0..1023."""
        self._adc_before, self._adc, self._adc_at = self._adc_read(t), data, t

    def halt(self, t: int) -> None:
        """Stop immediately: BUSY falls at edge t, and a step at this edge is suppressed (P006-STA-10)."""
        if self.busy:
            self._stop(t)

    # ------------------------------------------------------------------ start

    def _start(self, t: int, count: int | None) -> None:
        services, now = self._services, self._services.settings
        self._copy = self._adc_read(t)
        target = self._target()
        request = MotionStart(count, now.vstart, now.vstop, target, now.acc, now.dec)
        self.busy, self.forward = True, bool(now.dir)
        self._mstep = now.mstep
        self.increment = 128 // max(1, now.mstep)
        self._next_compensation = (0, 0)
        self._updates = 0
        tick = services.us.first(t + services.core_timing.plan)

        def begin(at: int) -> None:
            self.engine, self.tick = Engine(request), tick
            self._advance(at)
            self._plan_steps(0, UPDATE - 1)

        self._at(services.us.edge_of(tick), Phase.RUN, begin)
        self._notify(t)

    def _adc_read(self, t: int) -> int:
        return self._adc if t > self._adc_at else self._adc_before

    def _target(self) -> int:
        """Return the current target speed (P006-MOT-50, -51)."""
        now = self._services.settings
        if not now.analog:
            return now.vmax
        return now.vmax * (self._copy + (self._copy >> 9)) >> 10

    # ------------------------------------------------------------------ updates

    def _update(self, t: int) -> None:
        """Process the us tick of an update at edge t."""
        engine = self.engine
        assert engine is not None
        if engine.stage is Stage.END and not self._speed_mode:
            self._at(t + self._services.core_timing.run_end, Phase.PULSE, self._end)
            return
        engine.load()
        if self._next_compensation != (self.current_comp, self.lead_angle):
            self.current_comp, self.lead_angle = self._next_compensation
            self._notify(t)
        self._updates += 1
        if self._updates % ANALOG_UPDATES == 0:
            self._copy = self._adc_read(t)
        if self._plan_steps(UPDATE * self._updates - 1, UPDATE):
            self._advance(t)

    def _plan_steps(self, before: int, ticks: int) -> bool:
        """Schedule the steps of `ticks` us after t = `before`, and the next update.

        The result is False if the last step of the motion is in the first of these microseconds.
        """
        engine, us, lag = self.engine, self._services.us, self._services.core_timing.step
        assert engine is not None and self.tick is not None
        first = self.tick + before
        steps = engine.segment(ticks)
        for offset in steps:
            self._at(us.edge_of(first + offset) + lag, Phase.PULSE, self._step)
        if engine.finished:
            last = us.edge_of(first + steps[-1]) + lag + self._services.core_timing.move_end
            self._at(last, Phase.BASE, self._end)
            return steps[-1] > 1
        self._at(us.edge_of(first + ticks + 1), Phase.RUN, self._update)
        return True

    def _advance(self, t: int) -> None:
        """Calculate the values that the next update loads, from the register values before edge t."""
        engine, now = self.engine, self._services.settings
        assert engine is not None
        self._next_constant_speed = engine.stage is Stage.CRUISE and engine.speed > 0
        if self._next_constant_speed != self.at_constant_speed:
            self._at(t, Phase.STORE, self._update_constant_speed)
        engine.advance(LiveRegisters(self._target(), bool(now.analog), not self._speed_mode))
        self._next_compensation = compensation(engine.speed, self._mstep, now.cur, now.ccomp, now.scomp)

    def _update_constant_speed(self, t: int) -> None:
        self.at_constant_speed = self._next_constant_speed

    # ------------------------------------------------------------------ steps and ends

    def _step(self, t: int) -> None:
        if self.listener:
            self.listener.moved(t, self.forward, self.increment)
        self._stepped(t, self.forward)

    def _end(self, t: int) -> None:
        self._stop(t)
        self._ended(t)

    def _stop(self, t: int) -> None:
        for event in self._events.values():
            event.cancel()
        self._events.clear()
        self.busy = self.at_constant_speed = self._speed_mode = False
        self.current_comp = self.lead_angle = 0
        self.engine = self.tick = None
        self._notify(t)

    def _notify(self, t: int) -> None:
        if self.listener:
            self.listener.changed(t)

    def _at(self, t: int, phase: Phase, action: Callable[[int], None]) -> None:
        """Schedule an event that the end of the motion cancels."""
        self._serial += 1
        serial = self._serial

        def act(at: int) -> None:
            del self._events[serial]
            action(at)

        self._events[serial] = self._services.queue.at(t, phase, act)
