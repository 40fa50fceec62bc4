"""What an instruction of the PMC006B4 is: an object that says what is to happen (P006 chapters 3.1, 3.2).

It looks at the desk and at its data and returns an `Effect`. Nothing changes before the executor carries that
out.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from typing import NamedTuple

from .desk import Desk
from .settings import LEGAL


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
