"""Interface of the capture functions of a part, and the types of a decoded capture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from .pinmap import Pins
from .signals import BLOCK, Channel

if TYPE_CHECKING:
    from .signals import Column


class Access(NamedTuple):
    """Strobe on the bus from `begin` to `end` in ps.

    Attributes:
        reg: level of the address pins, which select a register.
    """

    begin: int
    end: int
    write: bool
    reg: int
    byte: int


class Accesses:
    """Strobes in order of time, with a column for each field of `Access`.

    An index that is a numpy mask selects strobes.
    """

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
        """Return the strobes without repeated polls.

        A read of this register is a repeated poll if the strobe before it is a read of the same register with
        the same byte.
        """
        polls = ~self.write & (self.reg == register)
        polls[1:] &= polls[:-1] & (self.byte[1:] == self.byte[:-1])
        polls[:1] = False
        return self[~polls]


class Line(NamedTuple):
    """Line of text of a capture.

    Attributes:
        t: time of its beginning in ps.
        data: bytes in the order in which they were on the bus or line.
        invalid: True if the line is invalid for the part.
        initialises: True if the state of the part (or of the axis) is known after this line.
        end: time of the end of its last byte in ps.
    """

    t: int
    data: str
    text: str
    invalid: bool = False
    initialises: bool = False
    end: int = 0
    axis: int = 0


@dataclass
class Wires:
    """Channels of a capture by the names of the pins.

    Attributes:
        ports: channels of the ports of which all bits were captured; the level of such a channel is a number.
        bits: channels of single bits, by port and bit number.
        end, sample: time of the end of the capture, and its sample period, in ps.
    """

    ports: dict[str, Channel]
    bits: Mapping[str, Mapping[int, Channel]]
    end: int
    sample: int
    params: dict[str, object] = field(default_factory=dict)


class PulseTrain(NamedTuple):
    """Pulses of an axis.

    Attributes:
        times: time of each pulse in ps.
        directions: direction of each pulse (1 = CCW), `None` if it is unknown.
    """

    axis: int
    times: Column
    directions: Column | None


class Needs(NamedTuple):
    """Pins that a part requires, and the shortest strobe or bit on these pins in ps."""

    pins: tuple[str, ...]
    shortest: int


@dataclass(frozen=True)
class PartDecoder:
    """Capture functions of a part.

    Attributes:
        title: name of the part in messages.
        pins: names for the pin map; a bidirectional data bus is `d`.
        inputs: inputs of the model with their idle levels.
        needs: returns the required pins.
        lines: returns the content of a capture as lines of text.
        stimulus: returns the actions of the host as (ps, levels) of pins of the model.
        trains: returns the pulses per axis.
        host_pins: inputs of the model that `stimulus` and `straps` set.
        outputs: outputs that are compared.
        phases: outputs whose first pattern is unknown if the capture begins during operation.
        straps: returns the levels of strap pins, which the model has from the beginning.
        parameters: returns the parameters of the model that are known from the capture.
        prelude: function that brings a new model to the state of the part at the beginning of the capture.
        axis_of: returns the axis of a bit of a port; 0 = all axes.
        reset_levels: levels of the outputs during a reset.
        initialised: True if a comparison requires a reset or an initialisation in the capture.
        pause: shortest time between two moves in ps with a 16 MHz crystal; after slow pulses, it is longer.
            The default exceeds 2.05 ms, the longest pulse interval that a rate byte can select.
    """

    title: str
    pins: Pins
    inputs: Mapping[str, int]
    needs: Callable[[Wires], Needs]
    lines: Callable[[Wires], list[Line]]
    stimulus: Callable[[Wires], Iterable[tuple[int, dict[str, int]]]]
    trains: Callable[[Wires], list[PulseTrain]]
    host_pins: frozenset[str]
    outputs: tuple[str, ...]
    phases: tuple[str, ...] = ()
    straps: Callable[[Wires], dict[str, int]] = lambda wires: {}
    parameters: Callable[[Wires], dict[str, object]] = lambda wires: {}
    prelude: Callable[[Any, Wires], None] = lambda model, wires: None
    axis_of: Callable[[str, int], int] = lambda port, bit: 0
    initialised: bool = True
    pause: int = 2_200_000_000
    row_noun: str = "commands"
    reset_levels: Mapping[str, int] = field(default_factory=dict)
