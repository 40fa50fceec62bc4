"""Protocols for the instructions of the PMC006B4, and the instructions as objects.

The desk is the execution context of instructions: everything that they read and change.

`instructions.executor.Desk` implements the protocols.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from .pins import Shared
from .settings import LEGAL, Settings


class Motion(Protocol):
    """Motor, as other blocks see it."""

    @property
    def busy(self) -> bool:
        """True while BUSY is set."""

    @property
    def steady(self) -> bool:
        """True at constant speed."""


class Guard(Protocol):
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
        """Execute instruction F 0."""

    def enable(self, name: str, on: int, target: int) -> None:
        """Execute RESET_EN or PAUSE_EN."""


class Eeprom(Protocol):
    """Engine of the EEPROM."""

    @property
    def state(self) -> int:
        """Answer to instruction V."""

    @property
    def busy(self) -> bool:
        """True if a job is running or waiting."""

    @property
    def burning(self) -> bool:
        """True while the program buffer is being written."""

    def begin(self, t: int, kind: str) -> None:
        """Start a job at edge t (t or B)."""


class Desk(Protocol):
    """Everything that instructions read and change.

    Attributes:
        echo: True if STEP_ACK is "ECHO".
        version: value of FW_VERSION.
    """

    shared: Shared
    settings: Settings
    levels: dict[str, int]
    echo: bool
    version: int
    speed_on: bool
    running: bool

    @property
    def motion(self) -> Motion:
        """Motor."""

    @property
    def guard(self) -> Guard:
        """Guard, which stops the motor."""

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
        """True if a start is blocked by a cause other than BUSY."""

    @property
    def port_word(self) -> int:
        """Answer to instruction x."""

    def stop(self, t: int) -> None:
        """Process a cause that stops a motion at edge t."""

    def load_position(self, position: int) -> None:
        """Execute instruction i."""

    def start(self, t: int, count: int) -> None:
        """Execute instruction s or ROT."""

    def run(self, t: int) -> None:
        """Execute instruction N=1 in IDLE."""

    def speed(self, t: int, on: bool) -> None:
        """Execute instruction N while the speed mode is running or ending."""


# Instructions of the PMC006B4 (P006 chapters 3.1, 3.2). An instruction is an object that reads the desk and
# its data and returns an `Effect`. Nothing changes before the executor applies the effect.


class Effect(NamedTuple):
    """Effect of an executed instruction in its cycle.

    Attributes:
        reply: data of the answer; a function is called one cycle later.
        put: registers.
        halt: True if the motor stops immediately.
        do: function for any other effect, called with the desk and the edge.
        early: the same, before the motion is processed at that edge.
        still: True if no step may be counted in that cycle.
        once: instruction of the program that E executes.
    """

    reply: int | Callable[[Desk], int] = 0
    put: dict[str, int] | None = None
    halt: bool = False
    do: Callable[[Desk, int], None] | None = None
    early: Callable[[Desk, int], None] | None = None
    still: bool = False
    once: int | None = None


class Instruction:
    """Instruction; an unknown one has no effect."""

    def __call__(self, desk: Desk, data: int) -> Effect:
        """Return the effect of `data`."""
        return Effect()


@dataclass
class Setting(Instruction):
    """Instruction that writes a register if the data is legal. Its answer is the value of the register.

    Attributes:
        also: other registers that it writes, with their values.
    """

    name: str
    legal: Container[int] | None = None
    also: dict[str, int] | None = None

    def __call__(self, desk: Desk, data: int) -> Effect:
        """Return the effect; rejected data changes nothing, and the answer is the active value."""
        if data in (LEGAL[self.name] if self.legal is None else self.legal):
            return Effect(self.now, {self.name: data, **(self.also or {})})
        return Effect(self.now)

    def now(self, desk: Desk) -> int:
        """Return the active value."""
        return int(getattr(desk.settings, self.name))


@dataclass
class Read(Instruction):
    """Instruction that answers with a value."""

    what: Callable[[Desk], int]

    def __call__(self, desk: Desk, data: int) -> Effect:
        """Return the effect, which does not depend on the data."""
        return Effect(self.what)


@dataclass
class Deed(Instruction):
    """Instruction of any other kind: a function that returns its effect."""

    what: Callable[[Desk, int], Effect]

    def __call__(self, desk: Desk, data: int) -> Effect:
        """Return the effect of `data`."""
        return self.what(desk, data)


def value(name: str) -> Read:
    """Return an instruction that reads a register."""
    return Read(lambda desk: int(getattr(desk.settings, name)))
