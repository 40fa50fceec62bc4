"""Scripts: the user program: download, every opcode with good and bad operands, jumps, E (chapter 12)."""

from __future__ import annotations

from typing import NamedTuple

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import (
    DECAY,
    END,
    EXT1,
    EXT2,
    OFFLINE,
    WAIT_REST,
    Op,
    download,
    goto,
    load,
    out,
    quick,
    rest,
    rot,
)
from .script_host import Host

JMP, JNE, JEQ, WAIT, OUT, CMP = 0x0D, 0x0E, 0x0F, 0x10, 0x11, 0x12
HIGH = 0x1F
SLOT = 64
"""clk that an instruction takes at most, and until WAIT sees its source."""


def go(host: Host, *program: Op) -> int:
    """Load and run a short program to its end; returns GPO."""
    load(host, *program)
    host.pause(SLOT * (len(program) + 2))
    return host.out("gpo")


class Case(NamedTuple):
    """An instruction, and what the code that reads its register says behind it."""

    op: Op
    after: int


READ = {0x02: "k", 0x03: "O", 0x04: "O", 0x05: "O", 0x08: "q", 0x09: "r", 0x0A: "K", OUT: "y"}
RESTORE = {0x02: ("m", 16), 0x03: ("d", 1), 0x04: ("f", 0), 0x05: ("g", 0), 0x08: ("v", 1000)}
RESTORE |= {0x09: ("u", 0), 0x0A: ("J", 0), OUT: ("y", 0)}
"""By opcode: the code that shows the register, and the one that makes it what it was."""


def cases(opcode: int, *rows: tuple[int, int], option: int = 0) -> list[Case]:
    """From (operand, answer)."""
    return [Case(Op(opcode, option, operand), after) for operand, after in rows]


CASES = (
    *cases(0x02, *((data, data) for data in (0, 2, 4, 8, 32, 64, 128)), option=9),
    *cases(0x02, *((data, 16) for data in (1, 6, 129, 256, -2, 0x10000))),
    *cases(0x03, (0, 0), (1, 0x10), (2, 0x10), (-1, 0x10)),
    *cases(0x04, (1, 0x16), (2, 0x10), (3, 0x10), (0x10001, 0x10)),
    *cases(0x05, (1, 0x11), (2, 0x10), (0, 0x10)),
    *cases(0x08, (0, 0), (1, 1), (16_000, 16_000), (16_001, 1000), (-1, 1000), (0x10001, 1000)),
    *cases(0x08, (0, 0), (16_000, 16_000), option=1),
    *cases(0x08, (5, 1000), option=2),
    *cases(0x08, (5, 1000), option=0x10),
    *cases(0x09, *((data, min(data, 5)) for data in range(1, 7)), (7, 0), (-1, 0), (0x101, 0)),
    *cases(0x0A, (1, 1), (3, 3), (4, 0), (-1, 0)),
    *(Case(Op(OUT, number, level), 0) for number, level in ((0, 1), (6, 1), (0x11, 1), (2, 2))),
)


@pytest.mark.parametrize("part", range(2))
@verifies("P006-BAD-17", "P006-PRG-20", "P006-CMD-03", "P006-BAD-09", "P006-BAD-08")
def test_operands(part: int) -> None:
    """Each instruction by E: a bad operand changes nothing, and the reply is 1 all the same."""
    host = Host()
    chosen = CASES[part::2]
    download(host, [case.op for case in chosen])
    for place, case in enumerate(chosen):
        host.ok(A=2 * place)
        assert host.ask("E") == 1
        seen = host.out("gpo") if case.op.code == OUT else host.ask(READ[case.op.code])
        assert seen == case.after, case
        if seen != {0x02: 16, 0x03: 0x10, 0x04: 0x10, 0x05: 0x10, 0x08: 1000}.get(case.op.code, 0):
            code, value = RESTORE[case.op.code]
            assert host.ask(code, value) == value


@verifies("P006-PRG-01", "P006-PRG-02", "P006-CMD-01", "P006-CMD-05", "P006-CMD-18", "P006-BAD-11")
def test_words_and_pointer() -> None:
    """All zero after reset; the pointer goes on by itself and stops behind the last word."""
    host = Host()
    values = {0: 0x12345678, 1: 0xFFFFFFFF, 2: 0x80000000, 199: 0xA5A5A5A5}
    for place in (0, 1, 100, 199):
        host.ok(A=place)
        assert host.ask("G", -1) == 0
    for place, value in values.items():
        host.ok(A=place)
        assert host.ask("W", value) == value
        assert host.ask("A", -1) == place + 1
    for code in "GW":
        assert host.ask(code, 7) == 0 and host.ask("A", 200) == 200
    for code in "Ez":
        assert host.ask(code, 7) == 0
    for place, value in values.items():
        host.ok(A=place)
        assert host.ask("G") == value and host.ask("A", 1000) == place + 1
    host.ok(A=3)
    assert host.ask("G") == 0


@verifies("P006-BAD-11", "P006-CMD-03", "P006-CMD-47", "P006-PRG-12", "P006-PRG-20", "P006-BAD-18")
def test_what_is_refused_while_a_program_runs() -> None:
    """A jump to itself; G and A work, everything is answered, F 0 ends it."""
    host = Host()
    load(host, goto(0))
    for code in "WEz":
        assert host.ask(code, 1) == 0
    assert host.ask("G") == JMP and host.ask("A", 5) == 5
    host.ok(m=4, v=2000, i=-3)
    assert host.status() == DECAY and host.ask("F", 2) == 0 and host.ask("z") == 0
    host.ok(F=1)
    assert host.ask("z") == 0 and host.ask("O") & OFFLINE
    host.ok(F=0)
    host.ok(A=0)
    assert host.ask("W", 0x0B) == 0x0B


@verifies("P006-PRG-10", "P006-PRG-13", "P006-CMD-47", "P006-PRG-14")
def test_jumps() -> None:
    host = Host()
    assert go(host, goto(2), END, out(1, 1), goto(5, JEQ), goto(6, JNE), END, out(2, 1)) == 0b00011
    assert go(host, Op(CMP, 8, 0), goto(3, JNE), goto(4, JEQ), END, out(3, 1), END) == 0b00111
    host.ok(y=0)
    # FLAG is 0 at a start, whatever it was.
    assert go(host, goto(3, JEQ), out(1, 1), END, out(2, 1)) == 0b00001


@pytest.mark.parametrize("code", [JMP, JNE, JEQ])
@verifies("P006-BAD-16", "P006-PRG-14")
def test_bad_targets(code: int) -> None:
    """Taken: the program halts. Not taken: it goes on. A motion is not touched."""
    host = quick()
    flag = Op(CMP, 8, int(code == JNE))
    against = Op(CMP, 8, int(code == JEQ))
    for target in (100, 128, -1):
        assert go(host, flag, rot(100_000), goto(target, code), out(1, 1)) == 0
        assert host.busy and host.ask("z") == 1 and host.ask("I") == 0
        host.ok(F=0)
    if code != JMP:
        assert go(host, against, goto(100, code), out(1, 1), END) == 1


@pytest.mark.parametrize("opcode", [0x15, 0x73, 0x80, 0x91, 0xFF])
@verifies("P006-BAD-16", "P006-PRG-20")
def test_bad_opcodes(opcode: int) -> None:
    host = quick()
    assert go(host, rot(100_000), Op(opcode, 1, 1), out(1, 1)) == 0
    assert host.busy and host.ask("z") == 1
    download(host, [Op(opcode, 1, 1)])
    assert host.ask("E") == 1 and host.busy and not host.out("gpo")


@verifies("P006-PRG-13", "P006-BAD-16", "P006-PRG-12", "P006-CMD-47")
def test_behind_the_last_instruction() -> None:
    """z starts at PP >> 1; behind instruction 99 there is none."""
    host = Host()
    download(host, [out(1, 1), out(2, 1)], first=98)
    host.ok(A=199)
    assert host.ask("z") == 1
    host.pause(2 * SLOT)
    assert host.out("gpo") == 0b10
    host.ok(A=197)
    assert host.ask("z") == 1
    host.pause(3 * SLOT)
    assert host.out("gpo") == 0b11
    host.ok(A=0)
    assert host.ask("z") == 1, "it has halted"


@verifies("P006-PRG-02", "P006-BAD-17")
def test_spare_fields_are_ignored() -> None:
    host = Host()
    host.ok(A=0)
    for word in (0xFFFF0111, 1, 0x00FF00FF, 0):
        assert host.ask("W", word) == word
    host.ok(A=0)
    assert host.ask("z") == 1
    host.pause(3 * SLOT)
    assert host.out("gpo") == 1
    # The option of an instruction that has none.
    assert go(host, Op(0x0C, 0xFF), Op(0x0B, 7, 99), Op(CMP, 8, 1), goto(5, JNE), out(2, 1)) == 0b11


@verifies("P006-PRG-10", "P006-PRG-20")
def test_counter_and_flag_between_single_tries() -> None:
    """They last from E to E and are cleared by z; what steers the program does nothing."""
    host = Host()
    program = (
        Op(0x0B),
        Op(CMP, 8, 3),
        Op(0x0C),
        Op(CMP, 8, 0),
        goto(0, JMP),
        WAIT_REST,
        END,
        Op(0x13, 1, 0),
        Op(0x14, 1),
    )
    download(host, program)
    for _ in range(3):
        assert host.ask("E") == 1
    host.ok(A=2)
    assert host.ask("E") == 1 and host.ask("A", -1) == 2
    for place in (4, 5, 6, 7, 8):
        host.ok(A=2 * place)
        assert host.ask("E") == 1 and host.ask("A", 200) == 2 * place
    # FLAG is 1 now: a bad option of CMP clears it, which JEQ shows only in a program; z clears both.
    download(
        host, [Op(CMP, 8, 3), goto(12, JNE), out(1, 1), Op(CMP, 8, 0), goto(14, JNE), out(2, 1)], first=10
    )
    host.ok(A=20)
    assert host.ask("z") == 1
    host.pause(8 * SLOT)
    assert host.out("gpo") == 0b11


@verifies("P006-PRG-20", "P006-CMD-03", "P006-STA-01", "P006-PRG-17")
def test_single_tries_of_the_rest() -> None:
    host = quick()
    program = (rot(7), Op(0x04, 0, 1), Op(0x07), Op(0x06), out(3, 1), out(3, 0), Op(0x08, 1, 5))
    download(host, program)
    assert host.ask("E") == 1
    rest(host)
    assert host.position() == 7
    host.ok(A=2)
    assert host.ask("E") == 1
    host.pins(ext1=0)
    host.pins(ext2=0)
    host.pause(20)
    assert host.status() == DECAY | EXT1 | EXT2
    for place, status in ((2, EXT2), (3, 0)):
        host.ok(A=2 * place)
        assert host.ask("E") == 1 and host.status() == DECAY | status
    for place, gpo in ((4, 4), (5, 0)):
        host.ok(A=2 * place + 1)
        assert host.ask("E") == 1 and host.out("gpo") == gpo
    host.ok(A=12)
    assert host.ask("E") == 1 and host.ask("q") == 5
