"""What instructions and rooms of the PMC006B4 need of its desk and of what stands on it.

`instructions.desk.Desk` is it. Nothing here is looked at when the model runs.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from .pins import Shared
from .settings import LEGAL, Settings


class Motion(Protocol):
    """The motor as others see it."""

    @property
    def busy(self) -> bool:
        """BUSY."""

    @property
    def steady(self) -> bool:
        """At constant speed."""


class Guard(Protocol):
    """Latches of the emergency inputs and of the stall detector."""

    stall: bool
    stpos: int

    def latched(self, ext: str) -> bool:
        """Stop flag of "ext1" or "ext2"."""

    def clear(self, t: int, latch: str) -> None:
        """b, l, p."""


class Program(Protocol):
    """The user program and its processor."""

    words: list[int]
    counter: int
    flag: int

    @property
    def halted(self) -> bool:
        """No program runs."""

    def write(self, place: int, word: int) -> None:
        """W."""

    def start(self, t: int, pc: int) -> None:
        """z or autostart."""

    def quit(self, t: int) -> None:
        """F 0."""

    def enable(self, name: str, on: int, target: int) -> None:
        """RESET_EN, PAUSE_EN."""


class Eeprom(Protocol):
    """The engine of the EEPROM."""

    @property
    def state(self) -> int:
        """What V answers."""

    @property
    def busy(self) -> bool:
        """A job runs or waits."""

    @property
    def burning(self) -> bool:
        """The program buffer is being written."""

    def begin(self, t: int, kind: str) -> None:
        """t, B: a job from edge t on."""


class Desk(Protocol):
    """Everything that instructions look at and change. echo: STEP_ACK is "ECHO". version: FW_VERSION."""

    shared: Shared
    settings: Settings
    levels: dict[str, int]
    echo: bool
    version: int
    speed_on: bool
    running: bool

    @property
    def motion(self) -> Motion:
        """The motor."""

    @property
    def guard(self) -> Guard:
        """What stops it."""

    @property
    def program(self) -> Program:
        """The user program."""

    @property
    def eeprom(self) -> Eeprom:
        """The engine of the EEPROM."""

    @property
    def position(self) -> int:
        """POS, signed."""

    @property
    def locked(self) -> bool:
        """Whatever blocks a start but BUSY."""

    @property
    def port_word(self) -> int:
        """x."""

    def stop(self, t: int) -> None:
        """A cause that stops a motion at edge t."""

    def load_position(self, position: int) -> None:
        """i."""

    def start(self, t: int, count: int) -> None:
        """s, ROT."""

    def run(self, t: int) -> None:
        """N=1 from IDLE."""

    def speed(self, t: int, on: bool) -> None:
        """N while the speed mode runs or ends."""


# What an instruction of the PMC006B4 is: an object that says what is to happen (P006 chapters 3.1, 3.2).
#
# It looks at the desk and at its data and returns an `Effect`. Nothing changes before the executor carries
# that out.


class Effect(NamedTuple):
    """What an executed instruction does in its clk.

    reply: data of the answer; a function is asked a clk later. put: registers. halt: stop at once. do:
    anything else; it gets the desk and the edge. early: the same before the motion works on that edge. still:
    no step may be counted in that clk. once: instruction of the program that E executes.
    """

    reply: int | Callable[[Desk], int] = 0
    put: dict[str, int] | None = None
    halt: bool = False
    do: Callable[[Desk, int], None] | None = None
    early: Callable[[Desk, int], None] | None = None
    still: bool = False
    once: int | None = None


class Instruction:
    """An instruction: whatever it does not know is none."""

    def __call__(self, desk: Desk, data: int) -> Effect:
        """What `data` asks for."""
        return Effect()


@dataclass
class Setting(Instruction):
    """Writes a register if the data is legal, answers with the register. also: registers that go with it."""

    name: str
    legal: Container[int] | None = None
    also: dict[str, int] | None = None

    def __call__(self, desk: Desk, data: int) -> Effect:
        """Refused data changes nothing; the answer is the value in force."""
        if data in (LEGAL[self.name] if self.legal is None else self.legal):
            return Effect(self.now, {self.name: data, **(self.also or {})})
        return Effect(self.now)

    def now(self, desk: Desk) -> int:
        """Value in force."""
        return int(getattr(desk.settings, self.name))


@dataclass
class Read(Instruction):
    """Answers with something."""

    what: Callable[[Desk], int]

    def __call__(self, desk: Desk, data: int) -> Effect:
        """The data is not looked at."""
        return Effect(self.what)


@dataclass
class Deed(Instruction):
    """Anything else: a function that says what is to happen."""

    what: Callable[[Desk, int], Effect]

    def __call__(self, desk: Desk, data: int) -> Effect:
        """What `data` asks for."""
        return self.what(desk, data)


def value(name: str) -> Read:
    """Reads a register."""
    return Read(lambda desk: int(getattr(desk.settings, name)))
