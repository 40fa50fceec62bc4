"""Instructions of the PMC006B4's user program as objects (P006-PRG)."""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from enum import Enum, auto
from typing import NamedTuple

from ...chip import Phase
from ...clock import Event
from ..codes import LETTERS
from ..execution_context import Effect, ExecutionContext
from ..pins import Services
from ..settings import BOTH

# Filters of the keys of the PMC006B4: GPI1, GPI2 and FSET (P006-PRG-30, P006-EEP-20).


class KeyFilter:
    """Filter of an active-low input: a level is accepted after it was stable for a number of µs ticks.

    Args:
        low_ticks, high_ticks: number of ticks for a low level, and for a high level. With high_ticks = 0, a
            high level is accepted immediately.
        pressed: pressed(t) is called when a low level is accepted while the filter is armed.
        released: released(t) is called when a high level is accepted, which also arms the filter.
        armed: True if the filter is armed from the beginning.
    """

    def __init__(
        self,
        services: Services,
        low_ticks: int,
        high_ticks: int,
        pressed: Callable[[int], None],
        released: Callable[[int], None] | None = None,
        armed: bool = False,
    ) -> None:
        self._services, self._ticks = services, (low_ticks, high_ticks)
        self._pressed, self._released = pressed, released
        self.armed = armed
        self._level: int | None = None
        self._pending: Event | None = None

    def on_level(self, t: int, level: int) -> None:
        """Process a synchronised level that is present from edge t on."""
        if level == self._level:
            return
        self._level = level
        if self._pending:
            self._pending.cancel()
            self._pending = None
        ticks = self._ticks[level]
        if not ticks:
            self._elapsed(t)
            return
        us = self._services.us
        at = us.edge_of(us.first(t) + ticks - 1)
        self._pending = self._services.queue.at(at, Phase.QUEUE, self._elapsed)

    def _elapsed(self, t: int) -> None:
        self._pending = None
        if self._level:
            self.armed = True
            if self._released:
                self._released(t)
        elif self.armed:
            self.armed = False
            self._pressed(t)


COUNT = 100
TARGETS = range(COUNT)


class NextAction(Enum):
    """Next action of the processor after an instruction."""

    NEXT = auto()
    JUMP = auto()
    WAIT = auto()
    HALT = auto()


class Outcome(NamedTuple):
    """Effect of a program instruction on the part, and the next action of the processor.

    Attributes:
        target: target of a jump.
    """

    effect: Effect = Effect()
    next_action: NextAction = NextAction.NEXT
    target: int = 0


NOTHING = Outcome()


class Operation:
    """Instruction of the program.

    Attributes:
        single: True if the host instruction E can also execute this instruction.
    """

    single = True

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome of the instruction with these fields; `operand` is signed."""
        return Outcome(next_action=NextAction.HALT)


class End(Operation):
    """Instruction END, and every undefined opcode."""

    single = False


@dataclass
class HostInstruction(Operation):
    """Host instruction as an instruction of the program.

    The data of the host instruction are the operand; if `data` is given, they are the entry of `data` for
    this operand.
    """

    letter: str
    data: dict[int, int] | None = None

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome. The instruction may be rejected, as if the host had sent it."""
        if self.data is None:
            return Outcome(LETTERS[self.letter](context, operand))
        if operand not in self.data:
            return NOTHING
        return Outcome(LETTERS[self.letter](context, self.data[operand]))


class Speed(Operation):
    """Instruction VSET."""

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome; in contrast to instruction v, 0 is legal."""
        if option not in BOTH or operand not in range(16001):
            return NOTHING
        return Outcome(Effect(registers={"vmax": operand, "analog": option}))


@dataclass
class Counter(Operation):
    """Instructions CNTI and CNTC."""

    up: bool

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome; the counter has 32 bits."""
        new_count = (context.program.counter + 1) % (1 << 32) if self.up else 0
        return Outcome(Effect(action=lambda context, t: setattr(context.program, "counter", new_count)))


@dataclass
class Jump(Operation):
    """Instructions JMP, JNE and JEQ.

    Attributes:
        on: values of FLAG for which the instruction jumps.
    """

    on: Container[int]
    single = False

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome. If the jump is taken, an illegal target halts the program."""
        if context.program.flag not in self.on:
            return NOTHING
        if operand not in TARGETS:
            return Outcome(next_action=NextAction.HALT)
        return Outcome(next_action=NextAction.JUMP, target=operand)


class Wait(Operation):
    """Instruction WAIT."""

    single = False

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome. If the condition is met, the program continues immediately."""
        source = wait_source(context, option)
        return NOTHING if source in (None, operand & 1) else Outcome(next_action=NextAction.WAIT)


class Out(Operation):
    """Instruction OUT."""

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome: one bit of GPO is written."""
        if option not in range(1, 6):
            return NOTHING
        mask = 1 << option - 1
        gpo = context.settings.gpo & ~mask | (mask if operand & 1 else 0)
        return Outcome(Effect(registers={"gpo": gpo}))


class Compare(Operation):
    """Instruction CMP."""

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome; an illegal option clears FLAG."""
        flag = int(compare_source(context, option) == operand & 0xFFFF_FFFF)
        return Outcome(Effect(action=lambda context, t: setattr(context.program, "flag", flag)))


@dataclass
class Key(Operation):
    """Instructions RESET_EN and PAUSE_EN.

    Attributes:
        name: name of the setting, RESET_EN or PAUSE_EN.
    """

    name: str
    single = False

    def __call__(self, context: ExecutionContext, option: int, operand: int) -> Outcome:
        """Return the outcome.

        An illegal target makes RESET_EN illegal, even if the instruction switches the function off.
        """
        if option not in BOTH or (self.name == "rsten" and operand not in TARGETS):
            return NOTHING
        return Outcome(Effect(action=lambda context, t: context.program.enable(self.name, option, operand)))


def pin(context: ExecutionContext, option: int) -> int | None:
    """Return the level of the input or EXT flag that is source 1..7 of WAIT and CMP."""
    if option in range(1, 6):
        return context.levels["gpi"] >> option - 1 & 1
    return int(context.stop_monitor.latched(f"ext{option - 5}")) if option in (6, 7) else None


def wait_source(context: ExecutionContext, option: int) -> int | None:
    """Return the value of the source of WAIT, `None` for an illegal option."""
    if option == 8:
        return int(context.motion.busy)
    return int(context.stop_monitor.stall) if option == 9 else pin(context, option)


def compare_source(context: ExecutionContext, option: int) -> int | None:
    """Return the value of the source of CMP, `None` for an illegal option."""
    if option == 8:
        return int(context.program.counter)
    return context.levels["gpi"] if option == 9 else pin(context, option)


END = End()
TABLE: dict[int, Operation] = {
    0x00: END,
    0x01: HostInstruction("s"),
    0x02: HostInstruction("m"),
    0x03: HostInstruction("d"),
    0x04: HostInstruction("f", {0: 0, 1: 3}),
    0x05: HostInstruction("g"),
    0x06: HostInstruction("l"),
    0x07: HostInstruction("b"),
    0x08: Speed(),
    0x09: HostInstruction("u", {given: min(given, 5) for given in range(7)}),
    0x0A: HostInstruction("J"),
    0x0B: Counter(True),
    0x0C: Counter(False),
    0x0D: Jump((0, 1)),
    0x0E: Jump((0,)),
    0x0F: Jump((1,)),
    0x10: Wait(),
    0x11: Out(),
    0x12: Compare(),
    0x13: Key("rsten"),
    0x14: Key("pauen"),
}
"""Operation of each opcode; all other opcodes are END."""


def decode(word0: int, word1: int) -> tuple[Operation, int, int]:
    """Return operation, option and signed operand of an instruction."""
    operand = word1 - (word1 >> 31 << 32)
    return TABLE.get(word0 & 0xFF, END), word0 >> 8 & 0xFF, operand
