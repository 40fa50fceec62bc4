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
from ..motion.motion import Guard, Motion
from ..pins import SYNCHRONISED, Shared
from .operations import Outcome
from .processor import Processor

# Desk of the executor: everything that instructions read and change.


class Desk:
    """Execution context of instructions. The part sets motion, program and eeprom.

    Args:
        echo: True if STEP_ACK is "ECHO".
        version: value of FW_VERSION.
        changed: changed(t) is called when registers have new values after edge t.

    Attributes:
        judging: edge of the current instruction.
        stepped_at: edge of the last step.
        speed_on: value of SPEED_MODE.
        running: True if the motion belongs to the speed mode.
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

    # ------------------------------------------------------------------ observable state

    @property
    def position(self) -> int:
        """POS, signed."""
        return self._position - (self._position >> 31 << 32)

    @property
    def locked(self) -> bool:
        """True if a start is blocked by a cause other than BUSY."""
        return bool(self.settings.free) or self.guard.locked or self._stopped_at == self.judging

    @property
    def gpo(self) -> int:
        """Levels for the pins GPO5..1."""
        return self.settings.gpo | (0x10 if self.guard.pull else 0)

    @property
    def port_word(self) -> int:
        """Answer to instruction x (P006-IO-01)."""
        seen = self.levels
        gpi = seen["gpi"]
        return (
            gpi & 7
            | self.shared.log.levels["gpo"] << 3
            | gpi >> 3 << 8
            | seen["ext1"] << 10
            | seen["ext2"] << 11
        )

    # ------------------------------------------------------------------ effects and events

    def carry_out(self, t: int, effect: Effect) -> None:
        """Apply the first half of an effect, before the motion is processed at edge t."""
        if effect.halt:
            self.shared.queue.at(t, Phase.GUARD, self._halt)
        if effect.early:
            early = effect.early
            self.shared.queue.at(t, Phase.GUARD, lambda now: early(self, now))

    def commit(self, t: int, effect: Effect) -> None:
        """Apply the second half of an effect, after the first one."""
        self.settings.load(effect.put or {})
        if effect.do:
            effect.do(self, t)
        if effect.put:
            self._changed(t)

    def stop(self, t: int) -> None:
        """Process a cause that stops a motion at edge t (P006-STA-10).

        A start at this edge is rejected.
        """
        self._stopped_at = t
        self.shared.queue.at(t, Phase.GUARD, self._halt)

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
        self.guard.started()
        self.motion.start(t, count)

    def run(self, t: int) -> None:
        """Execute instruction N=1 in IDLE."""
        self.guard.started()
        self.speed_on = self.running = True
        self.motion.run(t)

    def speed(self, t: int, on: bool) -> None:
        """Execute instruction N while the speed mode is running or ending."""
        if self.running:
            self.speed_on = on
            self.motion.speed_mode(t, on)


class Executor:
    """Executor of instructions.

    answered(t, data): called with the data of the reply, sampled at edge t. An instruction begins at an edge
    whose previous cycle shows its source: a frame, or a running program.
    """

    def __init__(self, desk: Desk, answered: Callable[[int, int], None]) -> None:
        self._desk, self._answered = desk, answered
        self._queue, self._pace = desk.shared.queue, desk.shared.pace
        self._free: int | None = 0
        self._frame: tuple[int, Command] | None = None
        self._run: int | None = None
        self._begin: Event | None = None
        self._slot: Event | None = None
        self._next_slot = 0
        self._cancelled = -1
        self._leaving: Event | None = None

    # ------------------------------------------------------------------ choice of the next instruction

    def frame(self, t: int, command: Command) -> None:
        """Process a command whose last byte was complete at edge t."""
        self._frame = (t + self._pace.frame, command)
        self._look(t)

    def wake(self, t: int, afresh: bool = False) -> None:
        """Continue the program after edge t.

        Args:
            afresh: True if the program has just been started.
        """
        if afresh:
            self._next_slot = 0
        self._run = t + 1
        self._look(t)

    def cancel(self, t: int) -> None:
        """Process RESET at edge t: an instruction of the program that is in progress has no effect."""
        self._cancelled = t
        if self._slot:
            self._slot.cancel()
            self._slot, self._free = None, t + 1
        self._look(t)

    def _look(self, t: int) -> None:
        """Schedule the beginning of the next instruction."""
        if self._begin:
            self._begin.cancel()
            self._begin = None
        if self._free is None:
            return
        ready = []
        if self._frame:
            ready.append(max(self._free, self._frame[0]))
        if self._run is not None and self._desk.program.runs:
            ready.append(max(self._free, self._run, self._next_slot))
        if ready:
            self._begin = self._queue.at(max(t, min(ready)), Phase.BEGIN, self._start)

    def _start(self, t: int) -> None:
        self._begin = None
        if self._frame and self._frame[0] <= t:
            command, self._frame = self._frame[1], None
            self._free = None
            self._queue.at(t + self._pace.effect, Phase.COMMAND, lambda now: self._of_host(now, command))
        elif self._desk.program.runs and self._cancelled != t:
            self._next_slot = t + self._pace.slot
            self._free, self._run = t + self._pace.fetch + 1, t + self._pace.fetch + 1
            self._slot = self._queue.at(t + self._pace.fetch, Phase.COMMAND, self._of_program)
            self._look(t)

    # ------------------------------------------------------------------ effects

    def _of_host(self, t: int, command: Command) -> None:
        desk = self._desk
        desk.judging = t
        effect = TABLE[command.code](desk, command.data)
        desk.carry_out(t, effect)
        self._queue.at(t, Phase.STORE, lambda now: self._commit_host(now, effect))

    def _commit_host(self, t: int, effect: Effect) -> None:
        if effect.still and self._desk.stepped_at == t:
            self._queue.at(t + 1, Phase.STORE, lambda now: self._commit_host(now, effect))
            return
        self._desk.commit(t, effect)
        self._queue.at(t + 1, Phase.QUEUE, lambda now: self._reply(now, effect))
        if effect.once is None:
            self._free = t + self._pace.after
        else:
            place = effect.once
            begin = t + 1
            self._free = begin + self._pace.fetch + 1
            self._queue.at(begin + self._pace.fetch, Phase.COMMAND, lambda now: self._of_single(now, place))
            self._next_slot = 0
        self._look(t)

    def _reply(self, t: int, effect: Effect) -> None:
        data = effect.reply
        self._answered(t, data if isinstance(data, int) else data(self._desk))

    def _of_single(self, t: int, place: int) -> None:
        """Execute the instruction that E selects."""
        self._desk.judging = t
        effect = self._desk.program.once(place)
        self._desk.carry_out(t, effect)
        self._queue.at(t, Phase.STORE, lambda now: self._desk.commit(now, effect))

    def _of_program(self, t: int) -> None:
        desk = self._desk
        desk.judging, self._slot = t, None
        outcome = desk.program.next()
        desk.carry_out(t, outcome.effect)
        self._queue.at(t, Phase.STORE, lambda now: self._commit_program(now, outcome))

    def _commit_program(self, t: int, outcome: Outcome) -> None:
        self._desk.commit(t, outcome.effect)
        self._desk.program.advance(outcome)
        self._look(t)

    # ------------------------------------------------------------------ WAIT

    def look_at_wait(self, t: int) -> None:
        """Check at edge t whether the condition of WAIT is fulfilled."""
        if not self._leaving and self._desk.program.passes():
            self._leaving = self._queue.at(t, Phase.QUEUE, self._leave)

    def _leave(self, t: int) -> None:
        self._leaving = None
        if self._desk.program.passes():
            self._queue.at(t, Phase.STORE, self._desk.program.pass_on)
