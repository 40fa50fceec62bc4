"""User program as stored in the part: 100 instructions, 200 words, 803 bytes of the EEPROM.

>>> program = Program.of([Instruction(3, 0, 1), Instruction(0)])
>>> program.words[:4], len(program.image()), Program.from_image(program.image()) == program
((3, 1, 0, 0), 803, True)
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ....errors import PpmcError
from .instructions import Instruction

INSTRUCTIONS, WORDS = 100, 200
PLACE = 0x20
"""Address of the program in the EEPROM."""
_BYTES, _COMPLETE = 4 * WORDS, 0x5A


class BadImage(PpmcError, ValueError):  # noqa: N818 - names the invalid object
    """The bytes are not a valid program."""


@dataclass(frozen=True)
class Program:
    """User program.

    Attributes:
        words: 200 words of 32 bits, two per instruction; any other number raises ValueError.
    """

    words: tuple[int, ...] = (0,) * WORDS

    def __post_init__(self) -> None:
        if len(self.words) != WORDS or not all(0 <= word < 1 << 32 for word in self.words):
            raise ValueError(f"a program has {WORDS} words of 32 bits")

    @classmethod
    def of(cls, instructions: Iterable[Instruction]) -> Program:
        """Create a program, with END after the last instruction.

        Raises ValueError for more than 100 instructions.
        """
        words = [word for one in instructions for word in one.words]
        return cls((*words, *[0] * (WORDS - len(words))))

    @property
    def instructions(self) -> tuple[Instruction, ...]:
        """All 100 instructions."""
        pairs = zip(self.words[::2], self.words[1::2], strict=True)
        return tuple(Instruction.of(first, second) for first, second in pairs)

    @property
    def used(self) -> tuple[Instruction, ...]:
        """Instructions up to and including the END after the last instruction that is not END.

        The result contains at least one instruction.
        """
        last = max((place for place, word in enumerate(self.words) if word), default=-1) // 2
        return self.instructions[: last + 2]

    def image(self) -> bytes:
        """Return the bytes that are stored in the EEPROM from address 0x0020 on.

        They consist of the words, their sum, and the mark of a complete program.
        """
        data = b"".join(word.to_bytes(4, "little") for word in self.words)
        return data + (sum(data) & 0xFFFF).to_bytes(2, "little") + bytes([_COMPLETE])

    @classmethod
    def from_image(cls, image: bytes) -> Program:
        """Create a program from these 803 bytes, or from a whole EEPROM.

        Raises BadImage if they are damaged.
        """
        if len(image) > PLACE + _BYTES + 3:
            image = image[PLACE : PLACE + _BYTES + 3]
        if len(image) != _BYTES + 3:
            raise BadImage(f"{len(image)} bytes: a program has {_BYTES + 3}, an EEPROM 4096")
        data = image[:_BYTES]
        if image[-1] != _COMPLETE:
            raise BadImage(f"its end mark is {image[-1]:02X}, not {_COMPLETE:02X}: there is no whole program")
        if sum(data) & 0xFFFF != int.from_bytes(image[_BYTES:-1], "little"):
            raise BadImage("its sum is wrong: it is damaged")
        return cls(tuple(int.from_bytes(data[at : at + 4], "little") for at in range(0, _BYTES, 4)))
