"""User programs of the PMC006, and the content of its EEPROM (docs/pmc006/README.md, 13 and 14)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

FACTORY_PAGE = bytes.fromhex("503601FF1000000001010000580258022C01E2042003") + bytes(9) + b"\x82"


class Op(NamedTuple):
    """Instruction of a user program: opcode, option, operand."""

    code: int
    option: int = 0
    operand: int = 0

    @property
    def words(self) -> tuple[int, int]:
        """Words W0 and W1 of the instruction."""
        return self.code | self.option << 8, self.operand & 0xFFFFFFFF


END = Op(0x00)
WAIT_REST = Op(0x10, 8, 0)


def rot(count: int) -> Op:
    """Return a ROT instruction."""
    return Op(0x01, 0, count)


def out(number: int, level: int) -> Op:
    """Return an OUT instruction that sets GPO `number` to a level."""
    return Op(0x11, number, level)


def goto(target: int, code: int = 0x0D) -> Op:
    """Return a JMP instruction to `target`; with `code` 0x0E a JNE, with 0x0F a JEQ."""
    return Op(code, 0, target)


P1 = (
    Op(0x03, 0, 1),
    Op(0x08, 0, 3200),
    Op(0x0C),
    rot(200),
    WAIT_REST,
    Op(0x0B),
    Op(0x12, 8, 3),
    goto(3, 0x0E),
    out(1, 1),
    END,
)
"""Program P1, which is the program in docs/pmc006/README.md, 13."""


def words(program: Iterable[Op]) -> list[int]:
    """Return all words of a program."""
    return [word for op in program for word in op.words]


def image(page: bytes = FACTORY_PAGE, program: Iterable[Op] = (), mark: int = 0x5A) -> bytes:
    """Return the content of an EEPROM with a parameter page and a program; `mark` is the byte at 0x342, which
    is 5A if the program is complete.
    """
    code = b"".join(word.to_bytes(4, "little") for word in words(program)).ljust(800, b"\0")
    return page + code + (sum(code) & 0xFFFF).to_bytes(2, "little") + bytes([mark])


def page(**changes: int) -> bytes:
    """Return the factory page with the bytes at some addresses (a00 to a1e) replaced; its checksum is
    correct.
    """
    content = bytearray(FACTORY_PAGE)
    for name, value in changes.items():
        content[int(name[1:], 16)] = value
    content[31] = sum(content[:31]) & 0xFF
    return bytes(content)
