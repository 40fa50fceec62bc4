"""Processor of the PMC006B4's user program: its states, and the keys (P006-PRG)."""

from __future__ import annotations

from enum import Enum, auto
from typing import Protocol

from ...chip import Phase
from ..execution_context import Effect, ExecutionContext
from .operations import COUNT, NextAction, Operation, Outcome, decode, wait_source

WORDS = 2 * COUNT


class State(Enum):
    """States of the processor (P006-PRG-10); PAUSED is an additional flag in RUN and WAIT."""

    HALT = auto()
    RUN = auto()
    WAIT = auto()
    HELD = auto()


class ProgramExecutor(Protocol):
    """Members of the executor of instructions that the processor uses."""

    def resume(self, t: int, restart: bool = False) -> None:
        """Continue the program after edge t."""

    def cancel(self, t: int) -> None:
        """Cancel the instruction that is in progress."""


class Processor:
    """Processor of the user program.

    The executor calls `next` while `runs` is true.

    Attributes:
        words: words of the program, two per instruction.
    """

    def __init__(self, context: ExecutionContext, executor: ProgramExecutor) -> None:
        self._context, self._executor = context, executor
        self.words = [0] * WORDS
        self.state = State.HALT
        self.paused = False
        self.pc = self.counter = self.flag = 0
        self.rsten = self.pauen = self.target = 0

    @property
    def halted(self) -> bool:
        """True if no program runs."""
        return self.state is State.HALT

    @property
    def runs(self) -> bool:
        """True if there are instructions to execute."""
        return self.state is State.RUN and not self.paused

    def write(self, place: int, word: int) -> None:
        """Execute instruction W."""
        self.words[place] = word & 0xFFFF_FFFF

    def start(self, t: int, pc: int) -> None:
        """Start the program by instruction z or by autostart."""
        self.pc, self.state, self.paused = pc, State.RUN, False
        self.counter = self.flag = self.rsten = self.pauen = 0
        self._executor.resume(t, restart=True)

    def quit(self, t: int) -> None:
        """Execute instruction F with data 0."""
        self.state, self.paused = State.HALT, False
        self.rsten = self.pauen = 0

    # ------------------------------------------------------------------ instructions

    def fetch(self, place: int) -> tuple[Operation, int, int]:
        """Return (operation, option, operand) of the program instruction with number `place`."""
        return decode(self.words[2 * place], self.words[2 * place + 1])

    def next(self) -> Outcome:
        """Return the outcome of the instruction at PC."""
        operation, option, operand = self.fetch(self.pc)
        return operation(self._context, option, operand)

    def single_effect(self, place: int) -> Effect:
        """Return the effect of program instruction `place`, which instruction E executes."""
        operation, option, operand = self.fetch(place)
        return operation(self._context, option, operand).effect if operation.single else Effect()

    def advance(self, outcome: Outcome) -> None:
        """Continue after the instruction at PC was executed."""
        if outcome.next_action is NextAction.HALT:
            self.state = State.HALT
        elif outcome.next_action is NextAction.WAIT:
            self.state = State.WAIT
        elif outcome.next_action is NextAction.JUMP:
            self.pc = outcome.target
        else:
            self._step()

    def _step(self) -> None:
        """Advance to the next instruction; halt after the last one."""
        if self.pc + 1 == COUNT:
            self.state = State.HALT
        else:
            self.pc += 1

    def wait_is_over(self) -> bool:
        """Return True if the condition of WAIT is met."""
        if self.state is not State.WAIT or self.paused:
            return False
        _, option, operand = self.fetch(self.pc)
        return wait_source(self._context, option) == operand & 1

    def end_wait(self, t: int) -> None:
        """End the state WAIT, unless another event has already changed the state."""
        if self.state is State.WAIT:
            self.state = State.RUN
            self._step()
            self._executor.resume(t)

    # ------------------------------------------------------------------ keys

    def enable(self, name: str, on: int, target: int) -> None:
        """Execute RESET_EN or PAUSE_EN."""
        setattr(self, name, on)
        if name == "rsten":
            self.target = target

    def reset_key(self, t: int) -> None:
        """Process a press of GPI1 (P006-PRG-31)."""
        if not self.rsten or self.state is State.HELD:
            return
        self._context.stop(t)
        if self.state is not State.HALT:
            self._executor.cancel(t)
            self._context.services.queue.at(t, Phase.END, self._hold)

    def _hold(self, t: int) -> None:
        """Change to the state HELD.

        The caller schedules the call after all other events of this edge.
        """
        if self.state is not State.HALT:
            self.pc, self.state, self.paused = self.target, State.HELD, False

    def release_key(self, t: int) -> None:
        """Process the release of GPI1."""
        if self.state is State.HELD:
            self.state = State.RUN
            self._executor.resume(t)

    def pause_key(self, t: int) -> None:
        """Process a press of GPI2 (P006-PRG-32)."""
        if self.pauen and self.state in (State.RUN, State.WAIT):
            self._context.services.queue.at(t, Phase.END, self._pause)

    def _pause(self, t: int) -> None:
        """Toggle PAUSED.

        The caller schedules the call after all other events of this edge.
        """
        if self.state in (State.RUN, State.WAIT):
            self.paused = not self.paused
            self._executor.resume(t)
