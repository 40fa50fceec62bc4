"""User programs of the PMC006B4: text, instructions, words, bytes in the EEPROM. Pure.

    program = assemble(Path("shuttle.asm").read_text(), "shuttle.asm")
    print(disassemble(program))
    Path("shuttle.bin").write_bytes(program.image())

`instructions` contains the table of instructions; `assembler` converts text to programs and back.
"""

from .assembler import AssemblyError, assemble, disassemble
from .instructions import Instruction, harmless
from .program import INSTRUCTIONS, WORDS, BadImage, Program

__all__ = [
    "INSTRUCTIONS",
    "WORDS",
    "AssemblyError",
    "BadImage",
    "Instruction",
    "Program",
    "assemble",
    "disassemble",
    "harmless",
]
