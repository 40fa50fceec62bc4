"""Test bench for motion and drive of the PMC006B4 without the rest of the part."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from openppmc.model.chip import Phase
from openppmc.model.clock import EdgeLog, Scheduler
from openppmc.model.pmc006.drive.drive import Drive
from openppmc.model.pmc006.motion.engine import UPDATE, Engine, LiveRegisters, MotionStart, Stage
from openppmc.model.pmc006.motion.motion import Motion
from openppmc.model.pmc006.pins import OUTPUTS, CoreTiming, Services, Ticks
from openppmc.model.pmc006.settings import Settings

SETUP = {"cur": 1000, "acc": 3, "dec": 3, "vmax": 3200}


class Bench:
    """Motion and drive at clk_hz, with factory values in all registers that are not given. BOOT ends at edge
    0.

    Attributes:
        steps: edges of mon_step.
        ends: edges at which a motion has ended without a stop.
        position: position in steps, signed.
    """

    def __init__(self, clk_hz: int = 16_000_000, t_off_ns: int = 20_000, **registers: int) -> None:
        self.settings = Settings()
        self.settings.load(registers)
        self.queue, self.log = Scheduler(), EdgeLog(OUTPUTS)
        self.us = Ticks(clk_hz, 1_000_000)
        self.shared = Services(self.queue, self.log, clk_hz, self.us, CoreTiming(), self.settings)
        self.steps: list[int] = []
        self.ends: list[int] = []
        self.position = 0
        self.motion = Motion(self.shared, self._stepped, self.ends.append)
        self.drive = Drive(self.shared, self.motion, t_off_ns)
        self.per_us = clk_hz // 1_000_000
        self.do(self.drive.booted)

    def _stepped(self, t: int, forward: bool) -> None:
        self.steps.append(t)
        self.position += 1 if forward else -1

    @property
    def t(self) -> int:
        """The next edge."""
        return self.queue.now + 1

    def run(self, t: int) -> None:
        """Run all edges up to and including t."""
        while (edge := self.queue.next_edge()) is not None and edge <= t:
            self.queue.now = edge - 1
            self.queue.run_edge(edge)
        self.queue.now = t

    def wait(self, us: float) -> None:
        """Run for `us` microseconds."""
        self.run(self.queue.now + round(us * self.per_us))

    def rest(self) -> None:
        """Run until the current motion has ended without a stop."""
        while self.motion.busy:
            edge = self.queue.next_edge()
            assert edge is not None
            self.run(edge)

    def do(self, action: Callable[[int], None], phase: Phase = Phase.STORE) -> int:
        """Call action(t) at the next edge t, then run this edge."""
        t = self.t
        self.queue.at(t, phase, action)
        self.run(t)
        return t

    def change(self, **registers: int) -> int:
        """Set registers at the next edge; return this edge."""

        def write(t: int) -> None:
            self.settings.load(registers)
            self.drive.settings_changed(t)

        return self.do(write)

    def start(self, count: int | None) -> int:
        """Start a move of `count` steps, or the speed mode if `count` is None; return the edge of t = 0."""
        motion = self.motion
        t = self.do(motion.run if count is None else lambda t: motion.start(t, count))
        return self.us.edge_of(self.us.first(t + self.shared.core_timing.plan))

    def halt(self) -> int:
        """Stop the motion immediately at the next edge."""
        return self.do(self.motion.halt, Phase.GUARD)

    def references(self) -> tuple[int, int, int, int]:
        """Return phase_a_ref and its sign, then phase_b_ref and its sign."""
        levels = self.log.levels
        a, b = (levels[f"phase_{x}_ref"] for x in "ab")
        return a, levels["phase_a_sign"], b, levels["phase_b_sign"]


@dataclass
class Made:
    """A recorded motion: steps as (us, speed, stage), updates as (us, speed), and the us of its end.

    Attributes:
        goal: target of the first ramp.
        braked_at: us of the update that began the final deceleration.
    """

    engine: Engine
    goal: int
    steps: list[tuple[int, int, Stage]] = field(default_factory=list)
    updates: list[tuple[int, int]] = field(default_factory=list)
    end: int = 0
    braked_at: int | None = None

    @property
    def intervals(self) -> list[int]:
        """Intervals between the steps in us; the first begins at t = 0."""
        times = [0, *(t for t, *_ in self.steps)]
        return [b - a for a, b in zip(times, times[1:], strict=False)]


def undisturbed(target: int) -> Callable[[int], LiveRegisters]:
    """Return a function that returns constant registers with this target at any time."""
    return lambda t: LiveRegisters(target)


def make(
    order: MotionStart, live: Callable[[int], LiveRegisters] | None = None, updates: int = 1 << 40
) -> Made:
    """Run a motion to its end and return its record; live(t) returns the registers at t us.

    After `updates` updates, the motion is cut off.
    """
    live = live or undisturbed(order.target)
    engine = Engine(order)
    made = Made(engine, engine.goal, updates=[(0, engine.speed)])
    engine.advance(live(0))

    def go(before: int, ticks: int) -> bool:
        first = engine.stage
        offsets = engine.segment(ticks)
        if not (engine.finished and offsets[-1] == 1):
            braked = engine.decel_start
            if before:
                engine.advance(live(before + 1))
            made.braked_at = made.braked_at if engine.decel_start is braked else before + 1
        for offset in offsets:
            stage = first if offset == 1 and before else engine.stage
            made.steps.append((before + offset, engine.speed, stage))
        return not engine.finished

    t = UPDATE - 1
    going = go(0, t)
    while going and len(made.updates) <= updates:
        if engine.stage is Stage.END and live(t + 1).stop:
            made.end = t + 1
            return made
        engine.load()
        made.updates.append((t + 1, engine.speed))
        going = go(t, UPDATE)
        t += UPDATE
    made.end = made.steps[-1][0] if made.steps else t
    return made
