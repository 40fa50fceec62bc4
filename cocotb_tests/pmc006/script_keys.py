"""Scripts: the keys of a user program on GPI1 and GPI2, their filters, what they do in each state (12.7)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import END, Op, after_steps, load, out, quick, rest, rot, start, still
from .script_host import Host

RESET_TO = 3
HIGH, KEY1, KEY2, BOTH = 0x1F, 0x1E, 0x1D, 0x1C
FILTER = 1000
"""us of a key's filter; the event comes 0 .. 2 us later."""
LATE = 60
"""clk from an event to the effect of the instruction that it lets start."""


def reset_en(target: int, on: int = 1) -> Op:
    """RESET_EN."""
    return Op(0x13, on, target)


PAUSE_EN = Op(0x14, 1)
WAIT_GPI3 = Op(0x10, 3, 0)


def level(host: Host, gpi: int) -> int:
    """Set the inputs; returns the edge that samples them."""
    host.pins(gpi=gpi)
    return host.t - 1


def press(host: Host, gpi: int, us: int = FILTER + 10) -> int:
    """Press for so long, then release and let the filter see that; returns the edge of the fall."""
    edge = level(host, gpi)
    host.wait_us(us)
    level(host, HIGH)
    host.wait_us(FILTER + 100)
    return edge


def armed(**given: object) -> Host:
    """A host whose keys are armed by now."""
    host = quick(2500, **given)
    host.wait_us(FILTER + 10)
    return host


@verifies("P006-PRG-30", "P006-PRG-31")
def test_length_of_the_filter() -> None:
    """999 us are none, however often; 1000 us and 3 more are one, and the stop comes on its edge."""
    host = armed()
    load(host, reset_en(RESET_TO), rot(100_000), END, out(1, 1), END)
    after_steps(host, 2)
    for us in (1, 500, FILTER - 1, FILTER - 1):
        level(host, KEY1)
        host.wait_us(us)
        level(host, HIGH)
        host.pause(1)
    host.wait_us(FILTER + 10)
    assert host.busy and not host.out("gpo")
    edge = level(host, KEY1)
    host.wait_us(FILTER + 3)
    level(host, HIGH)
    fall = host.edges("mon_busy", edge)[0][0]
    assert host.us(FILTER) <= fall - edge <= host.us(FILTER + 2) + 8 and not host.steps(fall + 1)
    host.wait_us(2 * FILTER)
    assert not host.out("gpo"), "the program had ended"


@verifies("P006-PRG-31", "P006-PRG-30", "P006-CMD-55")
def test_reset_goes_to_its_target_after_the_release() -> None:
    host = armed()
    load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), rot(5), END)
    after_steps(host, 3)
    edge = level(host, KEY1)
    host.wait_us(5 * FILTER)
    assert not host.busy and still(host, 100) and not host.out("gpo")
    # Bounces while it is released.
    for us in (300, FILTER - 1):
        level(host, HIGH)
        host.wait_us(us)
        level(host, KEY1)
        host.pause(2)
    assert not host.edges("gpo", edge)
    release = level(host, HIGH)
    host.wait_us(FILTER + 100)
    up = host.edges("gpo", release)[0][0]
    assert host.us(FILTER) <= up - release <= host.us(FILTER + 2) + LATE
    rest(host)
    assert len(host.steps(up)) == 5 and host.ask("z") == 1


@verifies("P006-PRG-31")
def test_reset_keeps_counter_flag_and_keys() -> None:
    """The second round finds the counter at 1 and FLAG set by the first."""
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
    host = armed()
    load(host, *program)
    press(host, KEY1)
    assert host.out("gpo") == 0b11 and host.busy
    press(host, KEY1)
    # CNTI makes it 3 now, and CMP clears FLAG.
    assert host.out("gpo") == 0b11 and not host.busy and host.ask("z") == 1


@verifies("P006-PRG-30")
def test_a_key_held_from_the_beginning_counts_for_nothing() -> None:
    """At reset, and when it is enabled; it has to be released first."""
    host = quick(2500, levels={"sda_i": 0, "gpi": KEY1})
    host.wait_us(3 * FILTER)
    load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), END)
    host.wait_us(3 * FILTER)
    assert host.busy
    level(host, HIGH)
    host.wait_us(FILTER - 2)
    # Not armed by less than 1 ms either.
    press(host, KEY1, 2 * FILTER)
    assert host.busy and not host.out("gpo")
    press(host, KEY1)
    assert not host.busy and host.out("gpo") == 1


@pytest.mark.parametrize("held", [False, True])
@verifies("P006-PRG-30")
def test_enabling_behind_the_event(held: bool) -> None:
    """The event was before RESET_EN: nothing, though the key is still down."""
    host = armed()
    level(host, KEY1)
    host.wait_us(2 * FILTER)
    load(host, reset_en(RESET_TO), rot(100_000), WAIT_GPI3, out(1, 1), END)
    if not held:
        level(host, HIGH)
    host.wait_us(2 * FILTER)
    assert host.busy and not host.out("gpo")


@verifies("P006-PRG-32", "P006-PRG-14")
def test_pause() -> None:
    """It toggles; a motion goes on, no WAIT ends, no instruction starts."""
    host = armed()
    load(host, PAUSE_EN, rot(30), Op(0x10, 8, 0), out(1, 1), Op(0x10, 3, 0), out(2, 1), END)
    edge = press(host, KEY2)
    rest(host)
    assert len(host.steps()) == 30
    host.wait_us(FILTER)
    assert not host.out("gpo")
    # The second press lets it go on.
    level(host, KEY2)
    host.wait_us(FILTER + 20)
    assert host.out("gpo") == 1
    level(host, HIGH)
    host.wait_us(FILTER + 20)
    press(host, KEY2)
    level(host, HIGH & ~0b100)
    host.wait_us(100)
    level(host, HIGH)
    assert host.out("gpo") == 1
    press(host, KEY2)
    host.wait_us(100)
    assert host.out("gpo") == 1, "what was right meanwhile is over"
    level(host, HIGH & ~0b100)
    host.wait_us(50)
    assert host.out("gpo") == 0b11 and edge


@verifies("P006-PRG-32", "P006-PRG-12", "P006-CMD-04")
def test_frames_while_paused() -> None:
    """The program is not halted: z, E, W are refused; F 0 ends it, and a new start is not paused."""
    host = armed()
    load(host, PAUSE_EN, WAIT_GPI3, out(1, 1), END)
    press(host, KEY2)
    assert [host.ask(code) for code in "zEW"] == [0, 0, 0]
    level(host, HIGH & ~0b100)
    host.wait_us(100)
    assert not host.out("gpo")
    host.ok(F=0)
    assert host.ask("z") == 1
    host.wait_us(100)
    assert host.out("gpo") == 1


@verifies("P006-PRG-32", "P006-BAD-23", "P006-PRG-31")
def test_both_keys() -> None:
    """RESET wins, the other event is gone; while RESET is held PAUSE does nothing."""
    host = armed()
    load(host, reset_en(4), PAUSE_EN, rot(100_000), WAIT_GPI3, out(1, 1), END)
    edge = level(host, BOTH)
    host.wait_us(FILTER + 10)
    assert not host.busy
    for gpi in (KEY1, BOTH, KEY1):
        level(host, gpi)
        host.wait_us(FILTER + 10)
    level(host, HIGH)
    host.wait_us(FILTER + 50)
    assert host.out("gpo") == 1 and edge


@verifies("P006-PRG-31", "P006-PRG-32")
def test_reset_ends_a_pause() -> None:
    host = armed()
    load(host, reset_en(4), PAUSE_EN, rot(100_000), WAIT_GPI3, out(1, 1), END)
    press(host, KEY2)
    press(host, KEY1)
    assert not host.busy and host.out("gpo") == 1


@verifies("P006-PRG-31", "P006-PRG-14")
def test_reset_in_halt_stops_every_motion() -> None:
    """Also one that the host has started; the program stays where it is until F 0 disarms the key."""
    host = armed()
    load(host, reset_en(2), END, out(1, 1), END)
    start(host, 100_000)
    press(host, KEY1)
    assert not host.busy and not host.out("gpo")
    assert host.ask("N", 1) == 1
    press(host, KEY1)
    assert not host.busy and host.ask("O") & 0x08 == 0
    host.ok(F=0)
    start(host, 100_000)
    press(host, KEY1)
    assert host.busy and not host.out("gpo")


@verifies("P006-PRG-10", "P006-PRG-30")
def test_keys_are_off_after_a_start_and_when_switched_off() -> None:
    host = armed()
    load(host, reset_en(0), PAUSE_EN, END)
    host.ok(A=6)
    load_rest = (rot(100_000), WAIT_GPI3, out(1, 1), END)
    for number, word in enumerate(word for op in load_rest for word in op.words):
        assert host.ask("W", word) == word and number < 8
    host.ok(A=6)
    assert host.ask("z") == 1
    press(host, KEY1)
    press(host, KEY2)
    assert host.busy
    host.ok(F=0)
    assert host.ask("I") == 0
    host.ok(A=0)
    load(host, reset_en(5), PAUSE_EN, reset_en(5, 0), Op(0x14, 0), rot(100_000), out(1, 1), WAIT_GPI3)
    press(host, KEY1)
    press(host, KEY2)
    assert host.busy and host.out("gpo") == 1


@verifies("P006-PRG-33", "P006-PRG-30")
def test_key_pins_are_inputs_as_before() -> None:
    """WAIT, CMP and x see them at once, without the filter."""
    host = armed()
    load(host, reset_en(0), PAUSE_EN, Op(0x10, 1, 0), out(1, 1), Op(0x10, 2, 0), out(2, 1), Op(0x12, 9, BOTH))
    level(host, KEY1)
    host.wait_us(20)
    assert host.out("gpo") == 1
    level(host, BOTH)
    host.wait_us(20)
    assert host.out("gpo") == 0b11
    level(host, HIGH)
    assert host.ask("x") & 7 == 7
