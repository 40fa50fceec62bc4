"""What a part says about captures of it, and what a decoded capture consists of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from .pinmap import Pins
from .signals import BLOCK, Channel

if TYPE_CHECKING:
    from .signals import Column


class Access(NamedTuple):
    """A strobe on the bus: from begin to end in ps. reg: level of the address pins."""

    begin: int
    end: int
    write: bool
    reg: int
    byte: int


class Accesses:
    """Strobes in order, a column for each field of `Access`. mask: as of numpy."""

    __slots__ = ("begin", "byte", "end", "reg", "write")

    def __init__(self, begin: Column, end: Column, write: Column, reg: Column, byte: Column) -> None:
        self.begin, self.end, self.write, self.reg, self.byte = begin, end, write, reg, byte

    def __len__(self) -> int:
        return len(self.begin)

    def __getitem__(self, mask: Column) -> Accesses:
        return Accesses(*(getattr(self, name)[mask] for name in Access._fields))

    def __iter__(self) -> Iterator[Access]:
        for at in range(0, len(self), BLOCK):
            piece = (getattr(self, name)[at : at + BLOCK].tolist() for name in Access._fields)
            yield from map(Access._make, zip(*piece, strict=True))

    def without_polls(self, register: int) -> Accesses:
        """Return them without reads of this register that repeat the read before."""
        polls = ~self.write & (self.reg == register)
        polls[1:] &= polls[:-1] & (self.byte[1:] == self.byte[:-1])
        polls[:1] = False
        return self[~polls]


class Line(NamedTuple):
    """What was said, in words. t: ps of its beginning. data: the bytes, as they were on the bus or line.
    strange: this makes no sense for the part; initialises: from its end on the state of the part is known, or
    of this axis. end: ps at which the last of its bytes was over."""

    t: int
    data: str
    text: str
    strange: bool = False
    initialises: bool = False
    end: int = 0
    axis: int = 0


@dataclass
class Wires:
    """A capture by the names of the pins. ports: complete ones, as numbers. bits: single ones, by port and
    bit. end, sample: of the capture, ps."""

    ports: dict[str, Channel]
    bits: Mapping[str, Mapping[int, Channel]]
    end: int
    sample: int
    params: dict[str, object] = field(default_factory=dict)


class Train(NamedTuple):
    """Pulses of an axis: times in ps, with the direction of each (1 = CCW); None if it is not known."""

    axis: int
    times: Column
    ways: Column | None


class Needs(NamedTuple):
    """Pins without which nothing can be read, and the shortest strobe or bit on them, ps."""

    pins: tuple[str, ...]
    shortest: int


@dataclass(frozen=True)
class DecodeKind:
    """called: the part in messages. pins: names for the map; the data bus is `d` where it is one. inputs:
    those of the model, with the levels in which they rest.
    needs: what must be there. lines: what was said, in words. stimulus: what the host did, as (ps, levels) of
    pins of the model. trains: pulses per axis. host_pins: inputs of the model that `stimulus` and `straps`
    set. outputs: those that are compared. phases: among them, those whose place in the ring is not known when
    a capture begins in the middle. straps: levels that the model has from the beginning. parameters: of
    the model, that the capture tells. prelude: brings a
    fresh model to where a capture begins. axis_of: to which axis a bit of a port belongs, 0: to all.
    rests: levels of the outputs in a reset. initialised: without a reset or an initialisation nothing can
    be compared. pause: ps at a 16 MHz crystal between two moves (the slowest rate of a byte makes 2.05 ms);
    more if the pulses are that slow.
    """

    called: str
    pins: Pins
    inputs: Mapping[str, int]
    needs: Callable[[Wires], Needs]
    lines: Callable[[Wires], list[Line]]
    stimulus: Callable[[Wires], Iterable[tuple[int, dict[str, int]]]]
    trains: Callable[[Wires], list[Train]]
    host_pins: frozenset[str]
    outputs: tuple[str, ...]
    phases: tuple[str, ...] = ()
    straps: Callable[[Wires], dict[str, int]] = lambda wires: {}
    parameters: Callable[[Wires], dict[str, object]] = lambda wires: {}
    prelude: Callable[[Any, Wires], None] = lambda model, wires: None
    axis_of: Callable[[str, int], int] = lambda port, bit: 0
    initialised: bool = True
    pause: int = 2_200_000_000
    unnamed: str = "commands"
    rests: Mapping[str, int] = field(default_factory=dict)
