"""Conversion of a text with labels, constants and comments to a program, and of a program to a text.

>>> assemble("again: ROT 200 ; there\\nWAIT busy, 0\\nJMP again").words[:6]
(1, 200, 2064, 0, 13, 0)
>>> assemble("ROT 0")
Traceback (most recent call last):
openppmc.model.pmc006.program.assembler.AssemblyError: program:1: ROT 0: steps: 1 to 2147483647
"""

from __future__ import annotations

import re
from typing import NamedTuple

from ....errors import PpmcError
from .instructions import KINDS, MASK, Instruction, Kind, Operand, Place
from .program import INSTRUCTIONS, Program

WORD = ".WORD"
_NAME = r"[A-Za-z_][A-Za-z0-9_]*"
_LABEL = re.compile(rf"({_NAME})\s*:\s*(.*)$")
_CONSTANT = re.compile(rf"({_NAME})\s*=\s*(.*)$")


class AssemblyError(PpmcError, ValueError):  # noqa: N818 - part of the API
    """A line of the text is invalid; the message states the valid form."""

    def __init__(self, where: str, line: int, text: str) -> None:
        super().__init__(f"{where}:{line}: {text}")
        self.line = line


class _Line(NamedTuple):
    number: int
    name: str
    operands: list[str]


def assemble(text: str, where: str = "program") -> Program:
    """Return the program of a text.

    The text has one instruction per line, in upper or lower case; `;` and `#` begin comments. `name:` is a
    label of the next instruction; `name = value` defines a constant. The target of a jump is a label or the
    number of an instruction. `.word W0, W1` is an instruction as its two words.

    Args:
        where: file of the text, for messages.

    Raises:
        AssemblyError: the first error in the text.
    """
    return _Assembler(where).run(text)


class _Assembler:
    def __init__(self, where: str) -> None:
        self._where = where
        self._labels: dict[str, int] = {}
        self._constants: dict[str, int] = {}
        self._lines: list[_Line] = []

    def run(self, text: str) -> Program:
        """Assemble one text: process all names first, then the instructions."""
        number = 0
        for number, line in enumerate(text.splitlines(), 1):
            self._read(number, re.split("[;#]", line, maxsplit=1)[0].strip())
        if len(self._lines) > INSTRUCTIONS:
            first = self._lines[INSTRUCTIONS].number
            raise self._wrong(first, f"too long: a program has {INSTRUCTIONS} instructions at most")
        return Program.of([self._instruction(line) for line in self._lines])

    def _wrong(self, line: int, text: str) -> AssemblyError:
        return AssemblyError(self._where, line, text)

    # ------------------------------------------------------------------ names

    def _read(self, number: int, line: str) -> None:
        while match := _LABEL.match(line):
            self._name(number, match[1])
            self._labels[match[1]] = len(self._lines)
            line = match[2]
        if match := _CONSTANT.match(line):
            self._name(number, match[1])
            try:
                self._constants[match[1]] = self._number(match[2].strip())
            except ValueError:
                raise self._wrong(number, f"{match[1]} = {match[2]}: not a number") from None
        elif line:
            name, *rest = line.split(maxsplit=1)
            operands = [piece.strip() for piece in rest[0].split(",")] if rest else []
            self._lines.append(_Line(number, name.upper(), operands))

    def _name(self, number: int, name: str) -> None:
        if name in self._labels or name in self._constants:
            raise self._wrong(number, f"{name}: this name is taken already")
        if name.upper() in KINDS:
            raise self._wrong(number, f"{name}: an instruction, so no name")

    def _number(self, text: str) -> int:
        if text in self._constants:
            return self._constants[text]
        return int(text, 0)

    # ------------------------------------------------------------------ instructions

    def _instruction(self, line: _Line) -> Instruction:
        if line.name == WORD:
            return self._words(line)
        kind = KINDS.get(line.name)
        if kind is None:
            raise self._wrong(line.number, f"{line.name}: there are {', '.join(KINDS)} and .word")
        values = {Place.OPTION: 0, Place.OPERAND: 0}
        for operand, text in zip(kind.operands, self._texts(line, kind), strict=True):
            values[operand.place] = operand.default or 0 if text is None else self._value(line, operand, text)
        return Instruction(kind.opcode, values[Place.OPTION], values[Place.OPERAND] & MASK)

    def _texts(self, line: _Line, kind: Kind) -> list[str | None]:
        """Return the texts of all operands, `None` for an omitted operand."""
        most = len(kind.operands)
        least = sum(one.default is None for one in kind.operands)
        if not least <= len(line.operands) <= most or "" in line.operands:
            raise self._wrong(line.number, f"{line.name}: write {kind.usage}")
        return [*line.operands, *[None] * (most - len(line.operands))]

    def _value(self, line: _Line, operand: Operand, text: str) -> int:
        if operand.target and text in self._labels:
            value = self._labels[text]
        elif text.lower() in operand.names:
            value = operand.names[text.lower()]
        else:
            try:
                value = self._number(text)
            except ValueError:
                unknown = "no such label; " if operand.target else ""
                raise self._wrong(line.number, f"{line.name} {text}: {unknown}{operand.allowed}") from None
        if value not in operand.accepts:
            raise self._wrong(line.number, f"{line.name} {text}: {operand.allowed}")
        return value

    def _words(self, line: _Line) -> Instruction:
        try:
            first, second = (self._number(text) for text in line.operands)
        except ValueError:
            raise self._wrong(line.number, ".word: write .word W0, W1") from None
        if not (0 <= first <= MASK and 0 <= second <= MASK):
            raise self._wrong(line.number, f".word: words are 0 to 0x{MASK:X}")
        return Instruction.of(first, second)


# Conversion of a program to text. The text assembles to the same words.

_WIDTH = 8


def disassemble(program: Program, numbers: bool = False) -> str:
    """Return the text of a program.

    An instruction with illegal operands, or with set bits that the part ignores, is written as its two words.

    Args:
        numbers: True to add the number of each instruction as a comment.
    """
    used = program.used
    targets = {target for one in used for target in _targets(one) if target < len(used)}
    lines = []
    for place, one in enumerate(used):
        label = f"L{place}:" if place in targets else ""
        line = f"{label:{_WIDTH}}{_text(one, targets)}"
        lines.append(f"{line:40}; {place}" if numbers else line.rstrip())
    return "\n".join(lines) + "\n"


def _targets(one: Instruction) -> list[int]:
    """Return the numbers of the instructions to which this instruction refers."""
    if not one.plain or one.kind is None:
        return []
    return [one.value(operand) for operand in one.kind.operands if operand.target]


def _text(one: Instruction, targets: set[int]) -> str:
    if not one.plain or one.kind is None:
        first, second = one.words
        return f".word    0x{first:08X}, 0x{second:08X}"
    operands = [
        f"L{one.value(operand)}"
        if operand.target and one.value(operand) in targets
        else operand.text(one.value(operand))
        for operand in one.kind.operands
    ]
    return f"{one.kind.name:{_WIDTH}} {', '.join(operands)}".rstrip()
