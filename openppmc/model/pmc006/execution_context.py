"""Protocols for the instructions of the PMC006B4, and the instructions as objects.

The execution context contains all state that instructions read and change.

`instructions.executor.ExecutionContext` implements the protocols.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from .pins import Services
from .settings import LEGAL, Settings


class Motion(Protocol):
    """Members of the motion control that other blocks use."""

    @property
    def busy(self) -> bool:
        """True while BUSY is set."""

    @property
    def at_constant_speed(self) -> bool:
        """True at constant speed."""


class StopMonitor(Protocol):
    """Latches of the emergency inputs and of the stall detector."""

    stall: bool
    stpos: int

    def latched(self, ext: str) -> bool:
        """Return the stop flag of "ext1" or "ext2"."""

    def clear(self, t: int, latch: str) -> None:
        """Execute instruction b, l or p."""


class Program(Protocol):
    """User program and its processor."""

    words: list[int]
    counter: int
    flag: int

    @property
    def halted(self) -> bool:
        """True if no program runs."""

    def write(self, place: int, word: int) -> None:
        """Execute instruction W."""

    def start(self, t: int, pc: int) -> None:
        """Start the program by instruction z or by autostart."""

    def quit(self, t: int) -> None:
        """Execute instruction F with data 0."""

    def enable(self, name: str, on: int, target: int) -> None:
        """Execute RESET_EN or PAUSE_EN."""


class Eeprom(Protocol):
    """Engine of the EEPROM."""

    @property
    def state(self) -> int:
        """Data of the answer to instruction V."""

    @property
    def busy(self) -> bool:
        """True if a job is running or waiting."""

    @property
    def burning(self) -> bool:
        """True while the program buffer is being written."""

    def begin(self, t: int, kind: str) -> None:
        """Start a job for instruction t or B at edge t."""


class ExecutionContext(Protocol):
    """State that instructions read and change.

    Attributes:
        echo: True if STEP_ACK is "ECHO".
        version: value of FW_VERSION.
    """

    services: Services
    settings: Settings
    levels: dict[str, int]
    echo: bool
    version: int
    speed_on: bool
    running: bool

    @property
    def motion(self) -> Motion:
        """Motion control."""

    @property
    def stop_monitor(self) -> StopMonitor:
        """Monitor of emergency inputs and stall, which stops the motor."""

    @property
    def program(self) -> Program:
        """User program."""

    @property
    def eeprom(self) -> Eeprom:
        """Engine of the EEPROM."""

    @property
    def position(self) -> int:
        """POS, signed."""

    @property
    def locked(self) -> bool:
        """True if a cause other than BUSY prevents a start."""

    @property
    def port_word(self) -> int:
        """Data of the answer to instruction x."""

    def stop(self, t: int) -> None:
        """Process at edge t a cause that stops a motion."""

    def load_position(self, position: int) -> None:
        """Execute instruction i."""

    def start(self, t: int, count: int) -> None:
        """Execute instruction s or ROT."""

    def run(self, t: int) -> None:
        """Execute instruction N with data 1 at standstill (IDLE)."""

    def speed(self, t: int, on: bool) -> None:
        """Execute instruction N while the speed mode is running or ending."""


# Instructions of the PMC006B4 (docs/pmc006/README.md, 4 Instructions). An instruction is an object. It reads
# the execution context and its data, and returns an `Effect`, but it changes no state. The executor applies
# the effect.


class Effect(NamedTuple):
    """Effect of an instruction in the cycle in which it is executed.

    Attributes:
        reply: data of the answer, or a function that returns them and is called one cycle later.
        registers: registers that change, with their new values.
        halt: True if the motor stops immediately.
        action: function for any other effect, called with the context and the edge.
        early_action: as `action`, but called before the motion is processed at this edge.
        excludes_step: True if the motion may not count a step in this cycle.
        program_index: number of the program instruction that instruction E executes.
    """

    reply: int | Callable[[ExecutionContext], int] = 0
    registers: dict[str, int] | None = None
    halt: bool = False
    action: Callable[[ExecutionContext, int], None] | None = None
    early_action: Callable[[ExecutionContext, int], None] | None = None
    excludes_step: bool = False
    program_index: int | None = None


class Instruction:
    """Instruction. An object of this base class is an unknown instruction, which has no effect."""

    def __call__(self, context: ExecutionContext, data: int) -> Effect:
        """Return the effect of `data`."""
        return Effect()


@dataclass
class Setting(Instruction):
    """Instruction that writes a register if the data are legal. Its answer is the value of the register.

    Attributes:
        also: further registers that the instruction writes, with their new values.
    """

    name: str
    legal: Container[int] | None = None
    also: dict[str, int] | None = None

    def __call__(self, context: ExecutionContext, data: int) -> Effect:
        """Return the effect. Illegal data change no register; the answer is the active value."""
        if data in (LEGAL[self.name] if self.legal is None else self.legal):
            return Effect(self.now, {self.name: data, **(self.also or {})})
        return Effect(self.now)

    def now(self, context: ExecutionContext) -> int:
        """Return the active value."""
        return int(getattr(context.settings, self.name))


@dataclass
class Read(Instruction):
    """Instruction whose answer is a value."""

    get: Callable[[ExecutionContext], int]

    def __call__(self, context: ExecutionContext, data: int) -> Effect:
        """Return the effect, which does not depend on the data."""
        return Effect(self.get)


@dataclass
class ActionInstruction(Instruction):
    """Any other instruction, defined by a function that returns its effect."""

    action: Callable[[ExecutionContext, int], Effect]

    def __call__(self, context: ExecutionContext, data: int) -> Effect:
        """Return the effect of `data`."""
        return self.action(context, data)


def value(name: str) -> Read:
    """Return an instruction that reads a register."""
    return Read(lambda context: int(getattr(context.settings, name)))
