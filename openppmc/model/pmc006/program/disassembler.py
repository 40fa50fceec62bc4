"""Program to text, which assembles to the same words again."""

from __future__ import annotations

from .instructions import Instruction
from .program import Program

_WIDTH = 8


def disassemble(program: Program, numbers: bool = False) -> str:
    """The text. numbers: with the number of each instruction as a comment.

    What has illegal operands, or bits that the part ignores, is written as its two words.
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
    """Numbers of instructions that it names."""
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
