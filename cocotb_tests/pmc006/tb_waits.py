"""Timing of the user program: duration of instructions, WAIT and CMP with each source, concurrent frames and
motions.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .host import Host
from .moves import DECAY, FREE_RUN, after_steps, constant_speed_host, is_stopped, load, start, wait_stopped
from .programs import END, WAIT_REST, Op, goto, out, rot
from .tb_program import CMP, JEQ, JNE, SLOT, WAIT, go

HIGH = 0x1F


@directed("P006-PRG-16", "P006-PRG-15", "P006-PRG-17")
async def p006_time_of_instructions(dut: Any) -> None:
    """An instruction takes at most 64 cycles. ROT sets BUSY before the next instruction; a second ROT is
    ignored.
    """
    host = await constant_speed_host(dut)
    assert await go(host, out(1, 1), out(2, 1), rot(5), rot(100), out(3, 1), WAIT_REST, out(4, 1)) == 0b111
    times = [t for t, _ in host.edges("gpo")]
    assert times[1] - times[0] <= SLOT and times[2] - times[1] <= 3 * SLOT
    fall = await wait_stopped(host)
    await host.pause(2 * SLOT)
    assert host.edges("gpo")[-1][0] - fall <= 2 * SLOT and len(host.steps()) == 5


SOURCES = ((1, 0x1E), (2, 0x1D), (3, 0x1B), (4, 0x17), (5, 0x0F))


@directed("P006-PRG-16", "P006-BAD-19", "P006-BAD-17", "P006-CMD-31", "P006-IO-01")
async def p006_wait_for_pins(dut: Any) -> None:
    """WAIT works with each input and both levels; only bit 0 of the operand is used.

    A WAIT with an illegal option ends immediately.
    """
    host = await Host.start(dut)
    for option, low in SOURCES:
        program = (
            Op(WAIT, option, 0xFE),
            out(1, 1),
            Op(WAIT, option, 0xFF),
            out(2, 1),
            Op(WAIT, 0),
            Op(WAIT, 10),
        )
        await load(host, *program, Op(WAIT, 0x13, 0), out(3, 1))
        assert await host.status() == DECAY and not await host.out("gpo")
        for level, gpo in ((low, 0b001), (HIGH, 0b111)):
            await host.pins(gpi=level)
            edge = host.t
            await host.pause(8 * SLOT)
            assert await host.out("gpo") == gpo and host.edges("gpo", edge)[0][0] - edge <= 2 * SLOT
        await host.ok(y=0)


@directed("P006-PRG-16", "P006-BAD-19", "P006-CMD-04")
async def p006_wait_for_flags_and_the_motor(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(f=3)
    for option, pin, clear in ((6, "ext1", "b"), (7, "ext2", "l")):
        await load(host, Op(WAIT, option, 1), out(1, 1), Op(WAIT, option, 0), out(2, 1))
        await host.pause(2 * SLOT)
        await host.pins(**{pin: 0})
        await host.pause(3 * SLOT)
        assert await host.out("gpo") == 0b01
        assert await host.ask(clear) == 0
        assert await host.out("gpo") == 0b11
        await host.ok(y=0)
    await load(host, Op(WAIT, 8, 1), out(1, 1), Op(WAIT, 8, 0), out(2, 1))
    assert not await host.out("gpo")
    await start(host, 2)
    assert await host.out("gpo") == 0b01
    await wait_stopped(host)
    await host.pause(2 * SLOT)
    assert await host.out("gpo") == 0b11
    await load(host, Op(WAIT, 8, 1), END)
    await host.ok(F=0)
    assert await host.ask("z") == 1


@directed("P006-PRG-16", "P006-STL-02", "P006-STL-04")
async def p006_wait_for_a_stall(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(Y=1, Z=511, T=2)
    await load(host, rot(100_000), Op(WAIT, 9, 1), out(1, 1), Op(WAIT, 9, 0), out(2, 1))
    await after_steps(host, 5)
    for _ in range(2):
        assert not await host.out("gpo")
        await host.strobe(bemf_level=3)
        await host.pause(20)
    await host.pause(2 * SLOT)
    assert await host.out("gpo") == 1
    assert await host.ask("p") == 0
    assert await host.out("gpo") == 3
    assert await host.busy()


RIGHT = ((1, 0), (2, 1), (3, 1), (4, 0), (5, 1), (6, 1), (7, 0), (8, 0), (9, 0b10110))
WRONG = ((1, 1), (2, 0), (2, 0x80000001), (6, 0), (7, 1), (8, 1), (9, 0b110), (9, 0x100 | 0b10110))
BAD = ((0, 0), (10, 0), (0x18, 0), (0xFF, 1))


@cocotb.parametrize(case=[(RIGHT, 1), (WRONG, 0), (BAD, 0)])
@directed("P006-BAD-17", "P006-PRG-33", "P006-IO-01")
async def p006_compare(dut: Any, case: Any) -> None:
    """CMP compares all 32 bits of each source; with an illegal option it clears FLAG.

    The program stops at the first wrong result.
    """
    rows, expected = case
    host = await Host.start(dut)
    await host.ok(f=3)
    await host.pins(gpi=0b10110, ext1=0)
    await host.pause(10)
    program: list[Op] = []
    for option, operand in rows:
        before = [] if expected else [Op(CMP, 8, 0)]
        program += [
            *before,
            Op(CMP, option, operand),
            goto(len(program) + len(before) + 3, JEQ if expected else JNE),
        ]
        program += [END]
    await load(host, *program, out(1, 1))
    await host.pause(SLOT * (len(program) + 2))
    assert await host.out("gpo") == 1


@directed("P006-PRG-10", "P006-PRG-15", "P006-CMD-06", "P006-STA-10")
async def p006_abort_during_a_program(dut: Any) -> None:
    """Instruction I ends the motion, and the program continues after its WAIT."""
    host = await constant_speed_host(dut)
    await load(host, rot(100_000), WAIT_REST, out(1, 1), rot(3), WAIT_REST, out(2, 1))
    await after_steps(host, 5)
    assert await host.ask("I") == 0
    await wait_stopped(host)
    await host.pause(3 * SLOT)
    assert await host.out("gpo") == 0b11 and len(host.steps(host.edges("gpo")[0][0])) == 3


@directed("P006-PRG-14", "P006-CMD-04", "P006-MOT-52", "P006-CMD-43")
async def p006_offline_0_leaves_everything_else(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await load(host, out(1, 1), Op(0x08, 1, 3000), Op(0x08, 0, 3000), rot(100_000), goto(4))
    await after_steps(host, 4)
    await host.ok(F=0)
    assert not await is_stopped(host, host.us(2_000))
    assert await host.busy()
    assert await host.out("gpo") == 1
    assert await host.ask("q") == 3000
    assert await host.ask("z") == 1 and await host.ask("F", 0) == 0 and await host.ask("O") & FREE_RUN == 0


@directed("P006-PRG-15", "P006-PRG-16", "P006-CMD-52")
async def p006_frames_at_any_time_of_an_instruction(dut: Any) -> None:
    """Frames at any cycle of an instruction are executed; frames and program both execute complete
    instructions.
    """
    host = await Host.start(dut)
    await load(host, Op(0x0B), out(1, 1), out(1, 0), goto(0))
    for shift in range(0, 40):
        await host.pause(1 + shift % 5)
        assert await host.ask("i", shift) == shift
    assert await host.ask("c") == 39
