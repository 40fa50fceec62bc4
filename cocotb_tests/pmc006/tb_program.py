"""User program: download, each opcode with legal and illegal operands, jumps, E (P006-PRG).

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import cocotb

from .builds import directed
from .host import Host
from .moves import DECAY, EXT1, EXT2, OFFLINE, constant_speed_host, download, load, wait_stopped
from .programs import END, WAIT_REST, Op, goto, out, rot

JMP, JNE, JEQ, WAIT, OUT, CMP = 0x0D, 0x0E, 0x0F, 0x10, 0x11, 0x12
HIGH = 0x1F
SLOT = 64
"""Maximum duration of an instruction, and maximum time until WAIT samples its source, both in cycles."""


async def go(host: Host, *program: Op) -> int:
    """Load and run a short program to its end; return GPO."""
    await load(host, *program)
    await host.pause(SLOT * (len(program) + 2))
    return await host.out("gpo")


class Case(NamedTuple):
    """An instruction, and the value that its register has after it (for OUT, the level of the outputs)."""

    op: Op
    after: int


READ = {0x02: "k", 0x03: "O", 0x04: "O", 0x05: "O", 0x08: "q", 0x09: "r", 0x0A: "K", OUT: "y"}
RESTORE = {0x02: ("m", 16), 0x03: ("d", 1), 0x04: ("f", 0), 0x05: ("g", 0), 0x08: ("v", 1000)}
RESTORE |= {0x09: ("u", 0), 0x0A: ("J", 0), OUT: ("y", 0)}
"""`READ`: opcode -> code that reads the register of the instruction. `RESTORE`: opcode -> code and data that
set this register to its factory value.
"""


def cases(opcode: int, *rows: tuple[int, int], option: int = 0) -> list[Case]:
    """Return the cases of an opcode for pairs (operand, reply)."""
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


@cocotb.parametrize(part=range(2))
@directed("P006-BAD-17", "P006-PRG-20", "P006-CMD-03", "P006-BAD-09", "P006-BAD-08")
async def p006_operands(dut: Any, part: int) -> None:
    """If instruction E executes an instruction with an illegal operand, nothing changes; the reply to E is
    1.
    """
    host = await Host.start(dut)
    chosen = CASES[part::2]
    await download(host, [case.op for case in chosen])
    for place, case in enumerate(chosen):
        await host.ok(A=2 * place)
        assert await host.ask("E") == 1
        seen = await host.out("gpo") if case.op.code == OUT else await host.ask(READ[case.op.code])
        assert seen == case.after, case
        if seen != {0x02: 16, 0x03: 0x10, 0x04: 0x10, 0x05: 0x10, 0x08: 1000}.get(case.op.code, 0):
            code, value = RESTORE[case.op.code]
            assert await host.ask(code, value) == value


@directed("P006-PRG-01", "P006-PRG-02", "P006-CMD-01", "P006-CMD-05", "P006-CMD-18", "P006-BAD-11")
async def p006_words_and_pointer(dut: Any) -> None:
    """After reset all words are 0. The pointer is incremented automatically and stops after the last word."""
    host = await Host.start(dut)
    values = {0: 0x12345678, 1: 0xFFFFFFFF, 2: 0x80000000, 199: 0xA5A5A5A5}
    for place in (0, 1, 100, 199):
        await host.ok(A=place)
        assert await host.ask("G", -1) == 0
    for place, value in values.items():
        await host.ok(A=place)
        assert await host.ask("W", value) == value
        assert await host.ask("A", -1) == place + 1
    for code in "GW":
        assert await host.ask(code, 7) == 0 and await host.ask("A", 200) == 200
    for code in "Ez":
        assert await host.ask(code, 7) == 0
    for place, value in values.items():
        await host.ok(A=place)
        assert await host.ask("G") == value and await host.ask("A", 1000) == place + 1
    await host.ok(A=3)
    assert await host.ask("G") == 0


@directed("P006-BAD-11", "P006-CMD-03", "P006-CMD-47", "P006-PRG-12", "P006-PRG-20", "P006-BAD-18")
async def p006_what_is_refused_while_a_program_runs(dut: Any) -> None:
    """While a program jumps to itself, instructions W, E and z are rejected, G and A work, and F 0 ends the
    program.
    """
    host = await Host.start(dut)
    await load(host, goto(0))
    for code in "WEz":
        assert await host.ask(code, 1) == 0
    assert await host.ask("G") == JMP and await host.ask("A", 5) == 5
    await host.ok(m=4, v=2000, i=-3)
    assert await host.status() == DECAY and await host.ask("F", 2) == 0 and await host.ask("z") == 0
    await host.ok(F=1)
    assert await host.ask("z") == 0 and await host.ask("O") & OFFLINE
    await host.ok(F=0)
    await host.ok(A=0)
    assert await host.ask("W", 0x0B) == 0x0B


@directed("P006-PRG-10", "P006-PRG-13", "P006-CMD-47", "P006-PRG-14")
async def p006_jumps(dut: Any) -> None:
    host = await Host.start(dut)
    assert await go(host, goto(2), END, out(1, 1), goto(5, JEQ), goto(6, JNE), END, out(2, 1)) == 0b00011
    assert await go(host, Op(CMP, 8, 0), goto(3, JNE), goto(4, JEQ), END, out(3, 1), END) == 0b00111
    await host.ok(y=0)
    # FLAG is 0 at the start, regardless of its previous value.
    assert await go(host, goto(3, JEQ), out(1, 1), END, out(2, 1)) == 0b00001


@cocotb.parametrize(code=[JMP, JNE, JEQ])
@directed("P006-BAD-16", "P006-PRG-14")
async def p006_bad_targets(dut: Any, code: int) -> None:
    """If a jump to an illegal target is taken, it halts the program; a motion continues."""
    host = await constant_speed_host(dut)
    flag = Op(CMP, 8, int(code == JNE))
    against = Op(CMP, 8, int(code == JEQ))
    for target in (100, 128, -1):
        assert await go(host, flag, rot(100_000), goto(target, code), out(1, 1)) == 0
        assert await host.busy() and await host.ask("z") == 1 and await host.ask("I") == 0
        await host.ok(F=0)
    if code != JMP:
        assert await go(host, against, goto(100, code), out(1, 1), END) == 1


@cocotb.parametrize(opcode=[0x15, 0x73, 0x80, 0x91, 0xFF])
@directed("P006-BAD-16", "P006-PRG-20")
async def p006_bad_opcodes(dut: Any, opcode: int) -> None:
    host = await constant_speed_host(dut)
    assert await go(host, rot(100_000), Op(opcode, 1, 1), out(1, 1)) == 0
    assert await host.busy() and await host.ask("z") == 1
    await download(host, [Op(opcode, 1, 1)])
    assert await host.ask("E") == 1 and await host.busy() and not await host.out("gpo")


@directed("P006-PRG-13", "P006-BAD-16", "P006-PRG-12", "P006-CMD-47")
async def p006_after_the_last_instruction(dut: Any) -> None:
    """Instruction z starts the program at instruction number PP >> 1; the program halts after number 99."""
    host = await Host.start(dut)
    await download(host, [out(1, 1), out(2, 1)], first=98)
    await host.ok(A=199)
    assert await host.ask("z") == 1
    await host.pause(2 * SLOT)
    assert await host.out("gpo") == 0b10
    await host.ok(A=197)
    assert await host.ask("z") == 1
    await host.pause(3 * SLOT)
    assert await host.out("gpo") == 0b11
    await host.ok(A=0)
    assert await host.ask("z") == 1, "it has halted"


@directed("P006-PRG-02", "P006-BAD-17")
async def p006_spare_fields_are_ignored(dut: Any) -> None:
    host = await Host.start(dut)
    await host.ok(A=0)
    for word in (0xFFFF0111, 1, 0x00FF00FF, 0):
        assert await host.ask("W", word) == word
    await host.ok(A=0)
    assert await host.ask("z") == 1
    await host.pause(3 * SLOT)
    assert await host.out("gpo") == 1
    # These instructions have no option, but the option field of their word is not 0.
    assert await go(host, Op(0x0C, 0xFF), Op(0x0B, 7, 99), Op(CMP, 8, 1), goto(5, JNE), out(2, 1)) == 0b11


@directed("P006-PRG-10", "P006-PRG-20")
async def p006_counter_and_flag_between_single_tries(dut: Any) -> None:
    """Counter and flag keep their values from one instruction E to the next; instruction z clears them.

    Instructions that control the program have no effect if instruction E executes them.
    """
    host = await Host.start(dut)
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
    await download(host, program)
    for _ in range(3):
        assert await host.ask("E") == 1
    await host.ok(A=2)
    assert await host.ask("E") == 1 and await host.ask("A", -1) == 2
    for place in (4, 5, 6, 7, 8):
        await host.ok(A=2 * place)
        assert await host.ask("E") == 1 and await host.ask("A", 200) == 2 * place
    # FLAG is 1 now. CMP with an illegal option clears FLAG, which only a conditional jump in a program can
    # show.
    await download(
        host, [Op(CMP, 8, 3), goto(12, JNE), out(1, 1), Op(CMP, 8, 0), goto(14, JNE), out(2, 1)], first=10
    )
    await host.ok(A=20)
    assert await host.ask("z") == 1
    await host.pause(8 * SLOT)
    assert await host.out("gpo") == 0b11


@directed("P006-PRG-20", "P006-CMD-03", "P006-STA-01", "P006-PRG-17")
async def p006_single_tries_of_the_rest(dut: Any) -> None:
    host = await constant_speed_host(dut)
    program = (rot(7), Op(0x04, 0, 1), Op(0x07), Op(0x06), out(3, 1), out(3, 0), Op(0x08, 1, 5))
    await download(host, program)
    assert await host.ask("E") == 1
    await wait_stopped(host)
    assert await host.position() == 7
    await host.ok(A=2)
    assert await host.ask("E") == 1
    await host.pins(ext1=0)
    await host.pins(ext2=0)
    await host.pause(20)
    assert await host.status() == DECAY | EXT1 | EXT2
    for place, status in ((2, EXT2), (3, 0)):
        await host.ok(A=2 * place)
        assert await host.ask("E") == 1 and await host.status() == DECAY | status
    for place, gpo in ((4, 4), (5, 0)):
        await host.ok(A=2 * place + 1)
        assert await host.ask("E") == 1 and await host.out("gpo") == gpo
    await host.ok(A=12)
    assert await host.ask("E") == 1 and await host.ask("q") == 5
