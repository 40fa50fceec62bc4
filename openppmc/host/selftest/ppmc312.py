"""Self-test of a board with a PPMC-312 on a bridge (`host.selftest`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ...model.ppmc312.codes import Code
from ..ppmc312 import blocks
from ..ppmc312.blocks import CCW, CW, WINDOW, block, bus_order, start_address
from ..ppmc312.window import ADDRESS, CONTROL, CSR, EMPTY, ERIRQ, READ, WRITE
from ..script import Identity, Script
from .plan import COMMANDS, MOVES, REGISTERS, SWITCHES, PartAccess, Section, Wire, timed

LAYOUT = (
    *(("rst_n", 1), ("rs", 3), ("cs_n", 1), ("oe_n", 1), ("we_n", 1), ("d_i", 8)),
    *(("fl_n", 1), ("bl_n", 1), ("fhl_n", 1), ("bhl_n", 1), ("org_n", 1), ("index_n", 1)),
    *(("alm_n", 1), ("end_n", 1), ("epin", 1), ("epdir", 1), ("run", 1), ("evt0_n", 1), ("evt1_n", 1)),
    *(("extck", 1), ("auxi", 8)),
    *(("d_o", 8), ("d_oe", 1), ("wrq_n", 1), ("irq_n", 1), ("auxo_n", 6), ("exon_n", 1), ("cclr_n", 1)),
    *(("aclr_n", 1), ("zclmp_n", 1), ("cd_n", 1), ("pout", 1), ("dir", 1), ("intlk_n", 1), ("out_oe", 1)),
)
SETTING = blocks.free_curve(3, [200, 300, 400], [6, 5, 4])
"""A free curve from 2500 to 5000 pps in 15 pulses. A linear table would require several hundred pulses."""
LINEAR = [blocks.initial_setting(0, 2000, 800, 1000)]
PULSES = 40
END_S = 3.0
"""Longest time until the end of a motion in s."""
MOST_RESPONSES = 4
CODES_A_SECTION = 32


def execute(access: PartAccess, instruction: bytes, seconds: float = 0.05) -> None:
    """Write an instruction, and read all responses that arrive within the given time."""
    access.link.forget_events()
    access.write(CONTROL, [WINDOW])
    access.write(ADDRESS, [start_address(instruction)])
    access.write(WRITE, bus_order(instruction))
    read_responses(access, seconds)


def read_responses(access: PartAccess, seconds: float) -> None:
    """Wait for a response; read it and all responses that follow within the given time."""
    access.until_interrupt(seconds)
    for _ in range(MOST_RESPONSES):
        access.read(CSR)
        left = EMPTY - access.read(ADDRESS)[0]
        if not 0 < left <= WINDOW:
            return
        access.link.forget_events()  # discard this event; the next response causes another one
        access.read(READ, left)
        access.pause(0.001)


def prepare(access: PartAccess, setting: Sequence[bytes] = SETTING) -> None:
    """Enable the interrupt on responses, and load the ramps."""
    access.pause(0.005)
    access.run(Script().write(CSR, ERIRQ))
    for instruction in setting:
        execute(access, instruction, 0.3)


def play_motions(
    *instructions: bytes, stop: bytes = b"", after: float = 0.02, setting: Sequence[bytes] = SETTING
) -> Callable[[PartAccess], None]:
    """Return a function that starts a motion with each instruction and waits for its end.

    Args:
        stop: instruction that stops each motion.
        after: seconds from the start of a motion to its stop.
    """

    def play(access: PartAccess) -> None:
        prepare(access, setting)
        for instruction in instructions:
            execute(access, instruction, 0.01)
            if stop:
                access.pause(after)
                execute(access, stop, 0.01)
            read_responses(access, END_S)

    return play


def registers(access: PartAccess) -> None:
    """Read every register of the bus before and after an instruction."""
    for _ in range(2):
        for register in range(8):
            access.read(register)
        prepare(access)
    for code in (Code.VERSION, Code.POSITION_READ, Code.RUN_MONITOR, Code.STATUS):
        execute(access, blocks.read_position() if code is Code.POSITION_READ else block(code))


SETTINGS = (
    blocks.in_position(False, 0),
    blocks.encoder_watch(False, 0),
    blocks.interlock_position(1000),
    blocks.speed_limit(700),
    blocks.end_terminal(False),
    blocks.input_mask(0xFF),
    blocks.outputs(0x15),
    blocks.outputs(0x00),
    *(block(code) for code in (Code.EXCITATION_ON, Code.EXCITATION_OFF, Code.COUNTER_CLEAR, Code.ZERO_CLAMP)),
    *(block(code) for code in (Code.ALARM_CLEAR, Code.INPUT, Code.TERMINALS, Code.VERSION, Code.TABLE_READ)),
    blocks.read_position(),
    blocks.read_position(encoder=True),
    blocks.set_position(-7),
    blocks.set_position(-7, encoder=True),
    *(block(code) for code in (Code.INTERLOCK, Code.RUN_MONITOR, Code.STATUS)),
    blocks.event_register(1, blocks.immediate_stop()),
    blocks.event_read(1),
    blocks.event_delete(1),
    *blocks.free_curve(1, [100, 200, 400], [5, 4, 3]),
    *LINEAR,
)


def settings(access: PartAccess) -> None:
    """Execute valid instructions that start no motion."""
    prepare(access)
    for instruction in SETTINGS:
        execute(access, instruction)


def codes(first: int) -> Callable[[PartAccess], None]:
    """Return a function that writes a range of codes without parameters; the part rejects most of them."""

    def play(access: PartAccess) -> None:
        prepare(access)
        for code in range(first, first + CODES_A_SECTION):
            execute(access, block(code), 0.02)
            if code in (Code.RESET, Code.STOP, Code.SLOW_STOP):
                access.pause(0.01)

    return play


class Plan312:
    """Plan of a PPMC-312; see `plan.Plan`."""

    part = "ppmc312"
    jumpers = (Wire("auxo_n[0]", "fl_n", "limit CW"), Wire("auxo_n[1]", "org_n", "origin"))

    def layout(self, width: int) -> tuple[tuple[str, int], ...]:
        return LAYOUT

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        return [timed(identity)]

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        rate = 300
        slow, now = blocks.slow_stop(), blocks.immediate_stop()
        moves = {
            "single steps": play_motions(blocks.single_step(CW), blocks.single_step(CCW)),
            "ramp CW": play_motions(blocks.acceleration(CW, 3 * PULSES)),
            "ramp CCW": play_motions(blocks.acceleration(CCW, 2 * PULSES)),
            "linear ramp": play_motions(blocks.acceleration(CW, 2 * PULSES), setting=LINEAR),
            "triangles": play_motions(blocks.acceleration(CW, 7), blocks.acceleration(CCW, 1)),
            "constant speed": play_motions(
                blocks.constant(CW, PULSES, rate), blocks.constant(CCW, PULSES, rate)
            ),
            "run, slowed down": play_motions(blocks.run(CW, ramped=True), stop=slow),
            "run CCW, stopped": play_motions(blocks.run(CCW, rate), stop=now),
            "search for an origin, stopped": play_motions(blocks.origin_search(CW, rate), stop=now),
            "zero return": play_motions(blocks.acceleration(CW, PULSES), blocks.zero_return(CCW)),
            "another speed during the motion": play_motions(
                blocks.run(CW, rate), stop=blocks.change(220), after=0.005
            ),
        }
        return [
            Section("registers", REGISTERS, registers),
            Section("settings and read-outs", COMMANDS, settings),
            *(
                Section(f"codes {first:02X} to {first + CODES_A_SECTION - 1:02X}", COMMANDS, codes(first))
                for first in range(0, 256, CODES_A_SECTION)
            ),
            *(Section(title, MOVES, play) for title, play in moves.items()),
        ]

    def switches(self, identity: Identity, width: int) -> list[Section]:
        def by_output(bit: int, motion: bytes) -> Callable[[PartAccess], None]:
            def play(access: PartAccess) -> None:
                prepare(access)
                execute(access, blocks.outputs(0))
                execute(access, motion, 0.01)
                execute(access, blocks.outputs(bit))
                read_responses(access, END_S)

            return play

        return [
            Section("limit CW by AUXO1*", SWITCHES, by_output(1, blocks.run(CW, 300))),
            Section("origin by AUXO2*", SWITCHES, by_output(2, blocks.origin_search(CW, 300))),
        ]


PLAN = Plan312()
