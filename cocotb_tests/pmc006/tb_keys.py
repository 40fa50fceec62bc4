"""Keys of a user program on GPI1 and GPI2: filters, and effect in each state.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .host import Host
from .moves import after_steps, constant_speed_host, is_stopped, load, start, wait_stopped
from .programs import END, Op, out, rot

RESET_TO = 3
HIGH, KEY1, KEY2, BOTH = 0x1F, 0x1E, 0x1D, 0x1C
FILTER = 1000
"""The filter time of a key in us; the event occurs 0 to 2 us later."""
LATE = 60
"""Maximum number of cycles from an event to the effect of the instruction that the event starts."""


def reset_en(target: int, on: int = 1) -> Op:
    """Return a RESET_EN instruction."""
    return Op(0x13, on, target)


PAUSE_EN = Op(0x14, 1)
WAIT_GPI3 = Op(0x10, 3, 0)


async def level(host: Host, gpi: int) -> int:
    """Set the inputs; return the edge that samples them."""
    await host.pins(gpi=gpi)
    return host.t - 1


async def press(host: Host, gpi: int, us: int = FILTER + 10) -> int:
    """Press a key for `us` microseconds, release it, and wait for the filter; return the edge of the fall."""
    edge = await level(host, gpi)
    await host.wait_us(us)
    await level(host, HIGH)
    await host.wait_us(FILTER + 100)
    return edge


async def armed(dut: Any, **options: Any) -> Host:
    """Return a host whose program has armed the keys."""
    host = await constant_speed_host(dut, 2500, **options)
    await host.wait_us(FILTER + 10)
    return host


@directed("P006-PRG-30", "P006-PRG-31")
async def p006_length_of_the_filter(dut: Any) -> None:
    """A press of 999 us is not an event. A press of 1003 us is one event, on whose edge the motion stops."""
    host = await armed(dut)
    await load(host, reset_en(RESET_TO), rot(100_000), END, out(1, 1), END)
    await after_steps(host, 2)
    for us in (1, 500, FILTER - 1, FILTER - 1):
        await level(host, KEY1)
        await host.wait_us(us)
        await level(host, HIGH)
        await host.pause(1)
    await host.wait_us(FILTER + 10)
    assert await host.busy() and not await host.out("gpo")
    edge = await level(host, KEY1)
    await host.wait_us(FILTER + 3)
    await level(host, HIGH)
    fall = host.edges("mon_busy", edge)[0][0]
    assert host.us(FILTER) <= fall - edge <= host.us(FILTER + 2) + 8 and not host.steps(fall + 1)
    await host.wait_us(2 * FILTER)
    assert not await host.out("gpo"), "the program had ended"


@directed("P006-PRG-31", "P006-PRG-30", "P006-CMD-55")
async def p006_reset_moves_to_its_target_after_the_release(dut: Any) -> None:
    host = await armed(dut)
    await load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), rot(5), END)
    await after_steps(host, 3)
    edge = await level(host, KEY1)
    await host.wait_us(5 * FILTER)
    assert not await host.busy() and await is_stopped(host, 100) and not await host.out("gpo")
    # The key bounces when it is released.
    for us in (300, FILTER - 1):
        await level(host, HIGH)
        await host.wait_us(us)
        await level(host, KEY1)
        await host.pause(2)
    assert not host.edges("gpo", edge)
    release = await level(host, HIGH)
    await host.wait_us(FILTER + 100)
    up = host.edges("gpo", release)[0][0]
    assert host.us(FILTER) <= up - release <= host.us(FILTER + 2) + LATE
    await wait_stopped(host)
    assert len(host.steps(up)) == 5 and await host.ask("z") == 1


@directed("P006-PRG-31")
async def p006_reset_keeps_counter_flag_and_keys(dut: Any) -> None:
    """RESET restarts the program; the counter and FLAG keep their values, and the keys stay armed.

    Therefore the counter is 1 at the start of the second iteration, and FLAG has the value of the first one.
    """
    program = (
        reset_en(4),
        Op(0x0B),
        Op(0x12, 8, 1),
        WAIT_GPI3,
        Op(0x0E, 0, 0),
        out(1, 1),
        Op(0x0B),
        Op(0x12, 8, 2),
        Op(0x0F, 0, 10),
        END,
        out(2, 1),
        rot(100_000),
        WAIT_GPI3,
    )
    host = await armed(dut)
    await load(host, *program)
    await press(host, KEY1)
    assert await host.out("gpo") == 0b11 and await host.busy()
    await press(host, KEY1)
    # CNTI now increments the counter to 3, and CMP clears FLAG.
    assert await host.out("gpo") == 0b11 and not await host.busy() and await host.ask("z") == 1


@directed("P006-PRG-30")
async def p006_a_key_active_at_power_up_has_no_effect(dut: Any) -> None:
    """A key that is already pressed at reset, or when it is enabled, has no effect until it is released."""
    host = await constant_speed_host(dut, 2500, levels={"sda_i": 0, "gpi": KEY1})
    await host.wait_us(3 * FILTER)
    await load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), END)
    await host.wait_us(3 * FILTER)
    assert await host.busy()
    await level(host, HIGH)
    await host.wait_us(FILTER - 2)
    # A release of less than 1 ms does not arm the key, either.
    await press(host, KEY1, 2 * FILTER)
    assert await host.busy() and not await host.out("gpo")
    await press(host, KEY1)
    assert not await host.busy() and await host.out("gpo") == 1


@cocotb.parametrize(held=[False, True])
@directed("P006-PRG-30")
async def p006_enabling_after_the_event(dut: Any, held: bool) -> None:
    """A key event before RESET_EN has no effect, even if the key is still pressed at RESET_EN."""
    host = await armed(dut)
    await level(host, KEY1)
    await host.wait_us(2 * FILTER)
    await load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), END)
    if not held:
        await level(host, HIGH)
    await host.wait_us(2 * FILTER)
    assert await host.busy() and not await host.out("gpo")


@directed("P006-PRG-32", "P006-PRG-14")
async def p006_pause(dut: Any) -> None:
    """Each PAUSE event toggles the pause. During a pause a motion continues, no WAIT ends, and no instruction
    starts.
    """
    host = await armed(dut)
    await load(host, PAUSE_EN, rot(30), Op(0x10, 8, 0), out(1, 1), Op(0x10, 3, 0), out(2, 1), END)
    edge = await press(host, KEY2)
    await wait_stopped(host)
    assert len(host.steps()) == 30
    await host.wait_us(FILTER)
    assert not await host.out("gpo")
    # The second press continues the program.
    await level(host, KEY2)
    await host.wait_us(FILTER + 20)
    assert await host.out("gpo") == 1
    await level(host, HIGH)
    await host.wait_us(FILTER + 20)
    await press(host, KEY2)
    await level(host, HIGH & ~0b100)
    await host.wait_us(100)
    await level(host, HIGH)
    assert await host.out("gpo") == 1
    await press(host, KEY2)
    await host.wait_us(100)
    assert await host.out("gpo") == 1, "what was right meanwhile is over"
    await level(host, HIGH & ~0b100)
    await host.wait_us(50)
    assert await host.out("gpo") == 0b11 and edge


@directed("P006-PRG-32", "P006-PRG-12", "P006-CMD-04")
async def p006_frames_while_paused(dut: Any) -> None:
    """A paused program is not halted: instructions z, E and W are rejected.

    F 0 ends the program; a program that is started afterwards is not paused.
    """
    host = await armed(dut)
    await load(host, PAUSE_EN, WAIT_GPI3, out(1, 1), END)
    await press(host, KEY2)
    assert [await host.ask(code) for code in "zEW"] == [0, 0, 0]
    await level(host, HIGH & ~0b100)
    await host.wait_us(100)
    assert not await host.out("gpo")
    await host.ok(F=0)
    assert await host.ask("z") == 1
    await host.wait_us(100)
    assert await host.out("gpo") == 1


@directed("P006-PRG-32", "P006-BAD-23", "P006-PRG-31")
async def p006_both_keys(dut: Any) -> None:
    """RESET has priority and discards the event of PAUSE; while the RESET key is pressed, PAUSE is
    ignored.
    """
    host = await armed(dut)
    await load(host, reset_en(4), PAUSE_EN, rot(100_000), WAIT_GPI3, out(1, 1), END)
    edge = await level(host, BOTH)
    await host.wait_us(FILTER + 10)
    assert not await host.busy()
    for gpi in (KEY1, BOTH, KEY1):
        await level(host, gpi)
        await host.wait_us(FILTER + 10)
    await level(host, HIGH)
    await host.wait_us(FILTER + 50)
    assert await host.out("gpo") == 1 and edge


@directed("P006-PRG-31", "P006-PRG-32")
async def p006_reset_ends_a_pause(dut: Any) -> None:
    host = await armed(dut)
    await load(host, reset_en(4), PAUSE_EN, rot(100_000), WAIT_GPI3, out(1, 1), END)
    await press(host, KEY2)
    await press(host, KEY1)
    assert not await host.busy() and await host.out("gpo") == 1


@directed("P006-PRG-31", "P006-PRG-14")
async def p006_reset_in_halt_stops_every_motion(dut: Any) -> None:
    """While the program is halted, the RESET key stops every motion, also one that the host has started.

    The program stays halted. Instruction F 0 disarms the key.
    """
    host = await armed(dut)
    await load(host, reset_en(2), END, out(1, 1), END)
    await start(host, 100_000)
    await press(host, KEY1)
    assert not await host.busy() and not await host.out("gpo")
    assert await host.ask("N", 1) == 1
    await press(host, KEY1)
    assert not await host.busy() and await host.ask("O") & 0x08 == 0
    await host.ok(F=0)
    await start(host, 100_000)
    await press(host, KEY1)
    assert await host.busy() and not await host.out("gpo")


@directed("P006-PRG-10", "P006-PRG-30")
async def p006_keys_are_off_after_a_start_and_when_switched_off(dut: Any) -> None:
    host = await armed(dut)
    await load(host, reset_en(0), PAUSE_EN, END)
    await host.ok(A=6)
    load_rest = (rot(100_000), WAIT_GPI3, out(1, 1), END)
    for number, word in enumerate(word for op in load_rest for word in op.words):
        assert await host.ask("W", word) == word and number < 8
    await host.ok(A=6)
    assert await host.ask("z") == 1
    await press(host, KEY1)
    await press(host, KEY2)
    assert await host.busy()
    await host.ok(F=0)
    assert await host.ask("I") == 0
    await host.ok(A=0)
    await load(host, reset_en(5), PAUSE_EN, reset_en(5, 0), Op(0x14, 0), rot(100_000), out(1, 1), WAIT_GPI3)
    await press(host, KEY1)
    await press(host, KEY2)
    assert await host.busy() and await host.out("gpo") == 1


@directed("P006-PRG-33", "P006-PRG-30")
async def p006_key_pins_are_inputs_as_before(dut: Any) -> None:
    """WAIT, CMP and instruction x sample the key pins directly, without the filter."""
    host = await armed(dut)
    await load(
        host, reset_en(0), PAUSE_EN, Op(0x10, 1, 0), out(1, 1), Op(0x10, 2, 0), out(2, 1), Op(0x12, 9, BOTH)
    )
    await level(host, KEY1)
    await host.wait_us(20)
    assert await host.out("gpo") == 1
    await level(host, BOTH)
    await host.wait_us(20)
    assert await host.out("gpo") == 0b11
    await level(host, HIGH)
    assert await host.ask("x") & 7 == 7
