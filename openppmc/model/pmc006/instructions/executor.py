"""Executor of the PMC006B4: one instruction at a time, from a frame or from the program.

Rules: P006-FRM-02, -03, P006-CMD-52, -53, P006-PRG-15, -16.
"""

from __future__ import annotations

from collections.abc import Callable

from ...chip import Phase
from ...clock import Event
from ..codes import TABLE
from ..execution_context import Effect
from ..line import Command
from ..memory.eeprom import Engine
from ..motion.motion import Motion, StopMonitor
from ..pins import SYNCHRONISED, Services
from .operations import Outcome
from .processor import Processor

# Execution context: the state that instructions read and change.


class ExecutionContext:
    """Execution context of instructions. The part sets `motion`, `program` and `eeprom` after the creation.

    Args:
        echo: True if STEP_ACK is "ECHO".
        version: value of FW_VERSION.
        changed: changed(t) is called when registers have new values after edge t.

    Attributes:
        current_edge: edge of the current instruction.
        stepped_at: edge of the last step.
        speed_on: value of SPEED_MODE.
        running: True if the motion belongs to the speed mode.
    """

    motion: Motion
    program: Processor
    eeprom: Engine

    def __init__(self, services: Services, echo: bool, version: int, changed: Callable[[int], None]) -> None:
        self.services, self.echo, self.version, self._changed = services, echo, version, changed
        self.settings = services.settings
        self.levels = dict(SYNCHRONISED)
        self.stop_monitor = StopMonitor(self)
        self._position = 0
        self.stepped_at = self.current_edge = self._stopped_at = -1
        self.speed_on = self.running = False

    # ------------------------------------------------------------------ observable state

    @property
    def position(self) -> int:
        """POS, signed."""
        return self._position - (self._position >> 31 << 32)

    @property
    def locked(self) -> bool:
        """True if a cause other than BUSY prevents a start."""
        return bool(self.settings.free) or self.stop_monitor.locked or self._stopped_at == self.current_edge

    @property
    def gpo(self) -> int:
        """Levels for the pins GPO5..1."""
        return self.settings.gpo | (0x10 if self.stop_monitor.pulls_gpo5 else 0)

    @property
    def port_word(self) -> int:
        """Answer to instruction x (P006-IO-01)."""
        seen = self.levels
        gpi = seen["gpi"]
        return (
            gpi & 7
            | self.services.log.levels["gpo"] << 3
            | gpi >> 3 << 8
            | seen["ext1"] << 10
            | seen["ext2"] << 11
        )

    # ------------------------------------------------------------------ effects and events

    def execute(self, t: int, effect: Effect) -> None:
        """Apply the effects of an instruction that precede the processing of the motion at edge t."""
        if effect.halt:
            self.services.queue.at(t, Phase.GUARD, self._halt)
        if effect.early_action:
            early_action = effect.early_action
            self.services.queue.at(t, Phase.GUARD, lambda now: early_action(self, now))

    def commit(self, t: int, effect: Effect) -> None:
        """Apply the effects of an instruction that follow the processing of the motion at edge t."""
        self.settings.load(effect.registers or {})
        if effect.action:
            effect.action(self, t)
        if effect.registers:
            self._changed(t)

    def stop(self, t: int) -> None:
        """Process at edge t a cause that stops a motion (P006-STA-10).

        A start at this edge is rejected.
        """
        self._stopped_at = t
        self.services.queue.at(t, Phase.GUARD, self._halt)

    def _halt(self, t: int) -> None:
        if self.motion.busy:
            self.motion.halt(t)
            self.ended(t)

    def ended(self, t: int) -> None:
        """Process the end of a motion: BUSY is 0 after edge t."""
        self.speed_on = self.running = False

    def stepped(self, t: int, forward: bool) -> None:
        """Process a step at edge t (P006-MOT-05)."""
        self.stepped_at = t
        self._position = (self._position + (1 if forward else -1)) % (1 << 32)

    def load_position(self, position: int) -> None:
        """Execute instruction i."""
        self._position = position % (1 << 32)

    def start(self, t: int, count: int) -> None:
        """Execute instruction s or ROT."""
        self.stop_monitor.started()
        self.motion.start(t, count)

    def run(self, t: int) -> None:
        """Execute instruction N with data 1 at standstill (IDLE)."""
        self.stop_monitor.started()
        self.speed_on = self.running = True
        self.motion.run(t)

    def speed(self, t: int, on: bool) -> None:
        """Execute instruction N while the speed mode is running or ending."""
        if self.running:
            self.speed_on = on
            self.motion.speed_mode(t, on)


class Executor:
    """Executor of instructions.

    An instruction begins at an edge if its source (a frame or a running program) was present in the previous
    cycle.

    Args:
        answered: answered(t, data) is called with the data of the reply, which are sampled at edge t.
    """

    def __init__(self, context: ExecutionContext, answered: Callable[[int, int], None]) -> None:
        self._context, self._answered = context, answered
        self._queue, self._core_timing = context.services.queue, context.services.core_timing
        self._free: int | None = 0
        self._frame: tuple[int, Command] | None = None
        self._run: int | None = None
        self._begin: Event | None = None
        self._slot: Event | None = None
        self._next_slot = 0
        self._cancelled = -1
        self._wait_end_event: Event | None = None

    # ------------------------------------------------------------------ choice of the next instruction

    def frame(self, t: int, command: Command) -> None:
        """Process a command whose last byte is complete at edge t."""
        self._frame = (t + self._core_timing.frame, command)
        self._schedule_next(t)

    def resume(self, t: int, restart: bool = False) -> None:
        """Continue the program after edge t.

        Args:
            restart: True if the program has just been started.
        """
        if restart:
            self._next_slot = 0
        self._run = t + 1
        self._schedule_next(t)

    def cancel(self, t: int) -> None:
        """Process RESET at edge t: the program instruction that is being executed has no effect."""
        self._cancelled = t
        if self._slot:
            self._slot.cancel()
            self._slot, self._free = None, t + 1
        self._schedule_next(t)

    def _schedule_next(self, t: int) -> None:
        """Schedule the edge at which the next instruction begins."""
        if self._begin:
            self._begin.cancel()
            self._begin = None
        if self._free is None:
            return
        ready = []
        if self._frame:
            ready.append(max(self._free, self._frame[0]))
        if self._run is not None and self._context.program.runs:
            ready.append(max(self._free, self._run, self._next_slot))
        if ready:
            self._begin = self._queue.at(max(t, min(ready)), Phase.BEGIN, self._start)

    def _start(self, t: int) -> None:
        self._begin = None
        if self._frame and self._frame[0] <= t:
            command, self._frame = self._frame[1], None
            self._free = None
            self._queue.at(
                t + self._core_timing.effect, Phase.COMMAND, lambda now: self._execute_host(now, command)
            )
        elif self._context.program.runs and self._cancelled != t:
            self._next_slot = t + self._core_timing.slot
            self._free, self._run = t + self._core_timing.fetch + 1, t + self._core_timing.fetch + 1
            self._slot = self._queue.at(t + self._core_timing.fetch, Phase.COMMAND, self._execute_program)
            self._schedule_next(t)

    # ------------------------------------------------------------------ effects

    def _execute_host(self, t: int, command: Command) -> None:
        context = self._context
        context.current_edge = t
        effect = TABLE[command.code](context, command.data)
        context.execute(t, effect)
        self._queue.at(t, Phase.STORE, lambda now: self._commit_host(now, effect))

    def _commit_host(self, t: int, effect: Effect) -> None:
        if effect.excludes_step and self._context.stepped_at == t:
            self._queue.at(t + 1, Phase.STORE, lambda now: self._commit_host(now, effect))
            return
        self._context.commit(t, effect)
        self._queue.at(t + 1, Phase.QUEUE, lambda now: self._reply(now, effect))
        if effect.program_index is None:
            self._free = t + self._core_timing.after
        else:
            place = effect.program_index
            begin = t + 1
            self._free = begin + self._core_timing.fetch + 1
            self._queue.at(
                begin + self._core_timing.fetch, Phase.COMMAND, lambda now: self._execute_single(now, place)
            )
            self._next_slot = 0
        self._schedule_next(t)

    def _reply(self, t: int, effect: Effect) -> None:
        data = effect.reply
        self._answered(t, data if isinstance(data, int) else data(self._context))

    def _execute_single(self, t: int, place: int) -> None:
        """Execute the instruction that E selects."""
        self._context.current_edge = t
        effect = self._context.program.single_effect(place)
        self._context.execute(t, effect)
        self._queue.at(t, Phase.STORE, lambda now: self._context.commit(now, effect))

    def _execute_program(self, t: int) -> None:
        context = self._context
        context.current_edge, self._slot = t, None
        outcome = context.program.next()
        context.execute(t, outcome.effect)
        self._queue.at(t, Phase.STORE, lambda now: self._commit_program(now, outcome))

    def _commit_program(self, t: int, outcome: Outcome) -> None:
        self._context.commit(t, outcome.effect)
        self._context.program.advance(outcome)
        self._schedule_next(t)

    # ------------------------------------------------------------------ WAIT

    def check_wait(self, t: int) -> None:
        """Check at edge t if the condition of WAIT is met."""
        if not self._wait_end_event and self._context.program.wait_is_over():
            self._wait_end_event = self._queue.at(t, Phase.QUEUE, self._end_wait)

    def _end_wait(self, t: int) -> None:
        self._wait_end_event = None
        if self._context.program.wait_is_over():
            self._queue.at(t, Phase.STORE, self._context.program.end_wait)
