"""Axis of the bank: the blocks of a PPMC-104, processed at the visits of the axis.

The bank processes its axes in turn. A visit is an edge of `clk` at which it processes this axis.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..chip import Context, Phase
from ..clock import Callback, Event, QuantumCounter, Scheduler
from ..motion.codes import IBF, OBF
from ..motion.excitation import Excitation
from ..ppmc104 import ChopperTimes
from ..single.codes import Error
from .chopper import CONFIG_LEAD, SWITCH_LEAD, Chopper, VisitSchedule
from .commands import Builder, CommandUnit, Mailbox
from .group import SWITCHES, Group
from .motion import Motion

CONFIG_RESET = 0b11


class AxisScheduler(Scheduler):
    """Event queue of the part for the blocks of one axis.

    Each event that runs adds the axis to `changed_axes`.
    """

    def __init__(self, queue: Scheduler, changed_axes: set[int], axis: int) -> None:
        super().__init__()
        self._shared, self._changed_axes, self._axis = queue, changed_axes, axis

    def at(self, t: int, phase: int, action: Callback, kind: type[Event] = Event) -> Event:
        """Schedule an event in the queue of the part."""

        def run(now: int) -> None:
            self._changed_axes.add(self._axis)
            action(now)

        return self._shared.at(t, phase, run, kind)


@dataclass
class AxisContext(Context):
    """Context of one axis. The interrupt of each axis is a bit of the interrupt map."""

    interrupt: bool = False

    def drive(self, t: int, signal: str, value: int) -> None:
        """Store the level of the interrupt; `int_n` is the only host-side output that the blocks drive."""
        assert signal == "int_n"
        self.interrupt = not value


class Axis:
    """Axis of the bank.

    Args:
        number: number of the axis.
        shared: services of the bank that all its axes use.
        changed_axes: set of the axes in which something may have changed.

    Attributes:
        config: content of the CONFIG register.
    """

    def __init__(
        self,
        number: int,
        shared: Context,
        changed_axes: set[int],
        visits: VisitSchedule,
        group: Group,
        builder: Builder,
        phase_idle: int,
    ) -> None:
        self.visits = visits
        self.config = CONFIG_RESET
        self._go_visit = -1
        self._switches = dict.fromkeys(SWITCHES, 1)
        self.context = context = AxisContext(
            shared.timebase,
            shared.latency,
            False,
            AxisScheduler(shared.queue, changed_axes, number),
            shared.log,
            QuantumCounter(shared.timebase, visits.first(0)),
            {**self._switches, "csel": 1, "vsel": 1},
        )
        self.excitation = Excitation(phase_idle)
        chopper_times = ChopperTimes(context)
        self.chopper = Chopper(context, chopper_times, visits)
        self.mailbox = Mailbox(context, visits, self._take, self._retry_edge)
        self.motion = Motion(
            context, self.mailbox, self.excitation, self.chopper, visits, self._switches, group, number
        )
        self.commands = CommandUnit(
            context,
            self.mailbox,
            self.motion,
            self.excitation,
            self.chopper,
            chopper_times,
            visits,
            builder,
            number,
        )

    # ------------------------------------------------------------------ visits

    def _take(self, t: int, byte: int, command: bool) -> None:
        self.commands.take(t, byte, command, t)

    def _retry_edge(self, t: int, command: bool) -> int | None:
        """Return the first edge at which the axis may check the waiting byte again.

        The result is `None` if visit t may accept the byte (BANK-HSK-02, -05).
        """
        if t in (self.motion.ended, self.commands.completed, self._go_visit) or self.chopper.schedules_edge(
            t
        ):
            return t + 1
        edge = self.commands.builder_free_from(command)
        return edge if t < edge else None

    def go(self, t: int, go: int) -> None:
        """Process at visit t the GO that was written at edge `go` (BANK-GRP-02)."""
        motion, commands = self.motion, self.commands
        if not motion.in_group:
            return
        self._go_visit = t
        if motion.waits_for_go:
            motion.release(go)
        elif motion.busy:
            commands.reject(Error.NOT_WHILE_BUSY)
        else:
            commands.reject(Error.UNDEFINED if commands.was_initialised(t) else Error.NOT_INITIALISED)
        self.mailbox.retry(t)

    def halt(self, t: int) -> None:
        """Process STOP at edge t."""
        self.motion.halt(t)

    # ------------------------------------------------------------------ inputs

    def write_config(self, t: int, byte: int) -> None:
        """Process a write event of CONFIG at edge t (BANK-WIN-02, BANK-GEN-04)."""
        self.config = config = byte & CONFIG_RESET
        levels = {"csel": config & 1, "vsel": config >> 1}
        self.context.queue.at(t + CONFIG_LEAD, Phase.LEVELS, lambda now: self.context.levels.update(levels))

    def on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        """Process new levels of the switches at edge t."""
        self._switches.update(levels)
        queue = self.context.queue
        queue.at(t, Phase.GUARD, self.motion.check_stops)
        queue.at(t + SWITCH_LEAD, Phase.LEVELS, lambda now: self._update_visit_levels(now, levels))

    def _update_visit_levels(self, t: int, levels: Mapping[str, int]) -> None:
        self.context.levels.update(levels)
        self.motion.schedule_slow_check(t)

    # ------------------------------------------------------------------ observable state

    @property
    def status(self) -> int:
        """Status register."""
        box = self.mailbox
        return self.commands.state() | (IBF if box.ibf else 0) | (OBF if box.obf else 0)

    def pins(self) -> tuple[int, int, int, int]:
        """Return the levels of pout_n, dir, hold and s."""
        motion, excitation = self.motion, self.excitation
        phases = excitation.pattern if self.chopper.on else excitation.chopped
        return int(not motion.low), motion.direction, motion.hold, phases
