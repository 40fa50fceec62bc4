"""Instructions of user programs: names, codes, operands and their ranges.

>>> Instruction(0x12, 8, 3).words, Instruction.of(0x0812, 3)
((2066, 3), Instruction(opcode=18, option=8, operand=3, spare=0))
>>> Instruction(0x12, 8, 3).kind.name
'CMP'
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import partial

MASK = 0xFFFFFFFF
LAST = 99
_SWITCH = {"off": 0, "on": 1}
_LEVEL = {"low": 0, "high": 1, **_SWITCH}
_INPUTS = {**{f"gpi{number}": number for number in range(1, 6)}, "ext1": 6, "ext2": 7}


class Place(Enum):
    """Field of the instruction words that holds an operand."""

    OPTION = "option"
    OPERAND = "operand"


@dataclass(frozen=True)
class Operand:
    """One operand.

    Attributes:
        accepts: valid values.
        span: valid values as text.
        names: words that a text may contain in place of a number, with their values. If several words have
            the same value, the first word is printed.
        target: True if a text may contain a label for this operand.
        default: value if the operand is omitted; `None` if it must not be omitted.
    """

    place: Place
    what: str
    accepts: Container[int]
    span: str
    names: Mapping[str, int] = field(default_factory=dict)
    target: bool = False
    default: int | None = None

    @property
    def allowed(self) -> str:
        """Valid values, for messages.

        >>> KINDS["DIR"].operands[0].allowed
        'direction: backward, forward, 0 or 1'
        """
        words = list(dict.fromkeys(self.names))
        return f"{self.what}: {', '.join([*words, self.span])}"

    def text(self, value: int) -> str:
        """Return a value as text."""
        return next((word for word, number in self.names.items() if number == value), str(value))


_operand, _option = partial(Operand, Place.OPERAND), partial(Operand, Place.OPTION)
_BIT = range(2), "0 or 1"
_TARGET = _operand("target", range(LAST + 1), f"a label or 0 to {LAST}", target=True)
_FAR = _operand("target", range(LAST + 1), f"a label or 0 to {LAST}", target=True, default=0)


@dataclass(frozen=True)
class Kind:
    """Kind of instruction: name, opcode, operands."""

    name: str
    opcode: int
    operands: tuple[Operand, ...] = ()

    @property
    def usage(self) -> str:
        """Text form of the instruction, with its operands.

        >>> KINDS["WAIT"].usage
        'WAIT source, level'
        """
        words = ", ".join(one.what if one.default is None else f"[{one.what}]" for one in self.operands)
        return f"{self.name} {words}".strip()


KINDS: dict[str, Kind] = {
    kind.name: kind
    for kind in (
        Kind("END", 0x00),
        Kind("ROT", 0x01, (_operand("steps", range(1, 1 << 31), "1 to 2147483647"),)),
        Kind(
            "MIC",
            0x02,
            (
                _operand(
                    "microsteps",
                    (0, 2, 4, 8, 16, 32, 64, 128),
                    "0 (full steps), 2, 4, 8, 16, 32, 64 or 128",
                ),
            ),
        ),
        Kind("DIR", 0x03, (_operand("direction", *_BIT, names={"backward": 0, "forward": 1}),)),
        Kind("EXTEN", 0x04, (_operand("both stops", *_BIT, names=_SWITCH),)),
        Kind("FREE", 0x05, (_operand("free", *_BIT, names=_SWITCH),)),
        Kind("CLR2", 0x06),
        Kind("CLR1", 0x07),
        Kind(
            "VSET",
            0x08,
            (
                _option("source", *_BIT, names={"fixed": 0, "analog": 1}),
                _operand("speed", range(16_001), "0 to 16000 steps/s"),
            ),
        ),
        Kind("ACC", 0x09, (_operand("coefficient", range(7), "0 to 6"),)),
        Kind("TRIG", 0x0A, (_operand("edges", range(4), "0 to 3"),)),
        Kind("CNTI", 0x0B),
        Kind("CNTC", 0x0C),
        Kind("JMP", 0x0D, (_TARGET,)),
        Kind("JNE", 0x0E, (_TARGET,)),
        Kind("JEQ", 0x0F, (_TARGET,)),
        Kind(
            "WAIT",
            0x10,
            (
                _option("source", range(1, 10), "1 to 9", names={**_INPUTS, "busy": 8, "stall": 9}),
                _operand("level", *_BIT, names={"0": 0, "1": 1, **_LEVEL}),
            ),
        ),
        Kind(
            "OUT",
            0x11,
            (
                _option("output", range(1, 6), "1 to 5", names={f"gpo{n}": n for n in range(1, 6)}),
                _operand("level", *_BIT, names={"0": 0, "1": 1, **_LEVEL}),
            ),
        ),
        Kind(
            "CMP",
            0x12,
            (
                _option("source", range(1, 10), "1 to 9", names={**_INPUTS, "counter": 8, "inputs": 9}),
                _operand("value", range(-(1 << 31), 1 << 32), "32 bits"),
            ),
        ),
        Kind("RESET_EN", 0x13, (_option("key", *_BIT, names=_SWITCH), _FAR)),
        Kind("PAUSE_EN", 0x14, (_option("key", *_BIT, names=_SWITCH),)),
    )
}
"""All instructions by name."""
BY_OPCODE = {kind.opcode: kind for kind in KINDS.values()}
_DO_NOTHING = frozenset(
    KINDS[name].opcode for name in ("END", "JMP", "JNE", "JEQ", "WAIT", "RESET_EN", "PAUSE_EN")
)


@dataclass(frozen=True)
class Instruction:
    """One instruction as stored in the part.

    Attributes:
        spare: the two bytes that the part ignores.
    """

    opcode: int
    option: int = 0
    operand: int = 0
    spare: int = 0

    @classmethod
    def of(cls, first: int, second: int) -> Instruction:
        """Create an instruction from its two words."""
        return cls(first & 0xFF, first >> 8 & 0xFF, second & MASK, first >> 16 & 0xFFFF)

    @property
    def words(self) -> tuple[int, int]:
        """Both words of the instruction."""
        return self.opcode | self.option << 8 | self.spare << 16, self.operand & MASK

    @property
    def kind(self) -> Kind | None:
        """Kind of the instruction, `None` for an opcode that halts the program."""
        return BY_OPCODE.get(self.opcode)

    def value(self, operand: Operand) -> int:
        """Return the value of an operand."""
        return self.option if operand.place is Place.OPTION else self.operand

    @property
    def plain(self) -> bool:
        """True if the text form can represent both words: all operands are legal, and unused fields are 0."""
        if self.kind is None or self.spare:
            return False
        used = {one.place for one in self.kind.operands}
        return all(self.value(one) in one.accepts for one in self.kind.operands) and not (
            (self.option and Place.OPTION not in used) or (self.operand and Place.OPERAND not in used)
        )


def harmless(first: int) -> bool:
    """Return True if instruction E has no effect on an instruction with this first word."""
    opcode = first & 0xFF
    return opcode in _DO_NOTHING or opcode not in BY_OPCODE
