"""Two events in the same cycle or some cycles apart: stops, starts, flags, keys, frames, the program.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from math import ceil
from typing import Any

from .builds import directed
from .frames import command
from .host import ACT, EXECUTE, Host
from .moves import (
    DECAY,
    EXT1,
    after_steps,
    constant_speed_host,
    download,
    load,
    run,
    set_constant_speed,
    start,
)
from .programs import Op, goto, out

NEAR = range(-3, 4)
"""Distances of two events in cycles."""
TICKS = 1001
"""Number of microsecond ticks in the filter time of a key."""
HIGH, KEY1, KEY2 = 0x1F, 0x1E, 0x1D


async def collide(host: Host, code: str, data: int, shift: int, **levels: int) -> int:
    """Send a frame; pins change so that they take effect `shift` cycles after the frame. Return the reply."""
    begin = host.t
    await host.send_frame(code, data)
    await host.at(begin + frame_clk(host) + ACT + shift - 2, **levels)
    return await host.receive_reply()


def frame_clk(host: Host) -> int:
    """Return the cycles from the start of a frame to e (its last stop-bit sample), including the
    synchronisers.
    """
    return 7 * ceil(10 * host.bit) + 2 + ceil(9.5 * host.bit) - 1


async def say_at(host: Host, t: int, code: str, data: int = 0) -> int:
    """Send a frame that takes effect at edge t if no instruction is in progress then; return the reply."""
    await host.go(t - ACT - frame_clk(host))
    await host.send_frame(code, data)
    return await host.receive_reply()


def key_event(host: Host, edge: int) -> int:
    """Return the edge of a key event if edge `edge` is the first that samples the key low."""
    first = -(-(edge + 2 - 1) * 1_000_000 // host.clk_hz)
    return 1 - (-(first + TICKS - 1) * host.clk_hz // 1_000_000)


@directed("P006-STA-14", "P006-STA-10", "P006-EXT-02", "P006-STA-01", "P006-STA-18")
async def p006_start_and_emergency_stop(dut: Any) -> None:
    """An emergency stop near a start always sets the flag of its EXT pin and stops the motor.

    The reply to the start is either 0 or that to an accepted start.
    """
    host = await constant_speed_host(dut)
    await host.ok(f=1)
    replies = []
    for code, data, good in (("s", 100, host.accepted(100)), ("N", 1, 1)):
        for shift in NEAR:
            reply = await collide(host, code, data, shift, ext1=0)
            assert not await host.busy() and reply in (0, good) and await host.status() == DECAY | EXT1
            replies.append(bool(reply))
            assert await host.ask("b") == 0
            # EXT1 stays active. A change of another pin does not count as another edge of EXT1.
            await host.pins(gpi=KEY1)
            await host.pins(gpi=HIGH)
            assert await host.status() == DECAY
            await host.pins(ext1=1)
            assert await host.ask("b") == 0 and await host.ask("O") & 8 == 0
    assert replies[0] is False and replies[len(NEAR) - 1] is True and await host.position() == 0


@directed(
    "P006-STA-14",
    "P006-EXT-08",
    "P006-CMD-23",
    "P006-CMD-27",
    exact="a pin must be sampled once in each cycle around an instruction",
)
async def p006_flag_and_its_clearing(dut: Any) -> None:
    """If the flag of an EXT pin is set and cleared in the same cycle, it is set afterwards.

    An edge in the cycle in which its input is enabled is detected, too.
    """
    host = await Host.start(dut)
    await host.ok(f=1)
    left = []
    for shift in NEAR:
        assert await collide(host, "b", 0, shift, ext1=0) == 0
        left.append(await host.status() & EXT1)
        await host.pins(ext1=1)
        assert await host.ask("b") == 0
    assert left == [0] * 3 + [EXT1] * 4
    for code, data, back, expected in (("f", 1, 0, 3), ("J", 1, 0, 3)):
        await host.ok(f=int(code == "J"), J=0)
        seen = []
        for shift in NEAR:
            # The test enables the input, or selects its rising edge, near a falling edge.
            assert await collide(host, code, data, shift, ext1=0) == data
            seen.append(bool(await host.status() & EXT1))
            assert await host.ask("f", 0) == 0
            await host.pins(ext1=1)
            assert await host.ask("b") == 0
            await host.ok(f=int(code == "J"), J=back)
        assert sum(seen) in (expected, expected + 1) and len(set(seen)) == 2


@directed(
    "P006-STA-15",
    "P006-CMD-30",
    "P006-CMD-52",
    exact="an instruction must be executed in each cycle around a step",
)
async def p006_position_and_step(dut: Any) -> None:
    """No step is missed if the position is set a few cycles before, at or after a step."""
    host = await constant_speed_host(dut, 2500)
    await run(host)
    await after_steps(host, 3)
    period = host.us(400)
    for shift in range(-3, 4):
        due = host.edges("mon_step")[-2][0] + 20 * period + shift
        assert await say_at(host, due, "i", 1 << 30) == 1 << 30
        later = [t for t, level in host.edges("mon_step", due + 1) if level]
        assert (due - shift in [t for t, _ in host.edges("mon_step")]) and len(later) >= (shift < 0)
        position = await host.position()
        assert position == (1 << 30) + sum(due < t <= host.e + ACT for t in host.steps())
    assert await host.ask("I") == 0


@directed(
    "P006-MOT-42",
    "P006-STA-14",
    "P006-CMD-11",
    "P006-MOT-41",
    exact="an instruction must be executed in each cycle around the end of a motion",
)
async def p006_speed_mode_restarted_at_its_end(dut: Any) -> None:
    """If N 1 is sent before or at the edge at which the speed mode would end, the motion continues; after
    this edge, N 1 starts another motion.
    """
    host = await Host.start(dut)
    await host.ok(v=300, L=300, S=65, o=5)
    length = 0
    for shift in (None, *NEAR):
        begin = -(-(host.t + frame_clk(host) + 20) // 8) * 8
        assert await say_at(host, begin, "N", 1) == 1 and host.edges("mon_busy")[-1] == (begin, 1)
        assert await say_at(host, begin + host.us(5_000), "N", 0) == 0 and await host.busy()
        if shift is None:
            length = await host.until("mon_busy", 0) - begin
            continue
        assert await say_at(host, begin + length + shift, "N", 1) == 1
        again = [(begin + length, 0), (begin + length + shift, 1)] if shift > 0 else []
        assert host.edges("mon_busy", begin + 1) == again, shift
        assert await host.ask("O") & 8 and await host.ask("I") == 0


async def ready_for_reset(host: Host) -> int:
    """Run the program from its first instruction and press GPI1; return the edge of the key event."""
    await host.ok(A=0)
    assert await host.ask("z") == 1
    await host.pins(gpi=KEY1)
    return key_event(host, host.t - 1)


@directed("P006-PRG-31", "P006-STA-14", "P006-PRG-15", "P006-BAD-23")
async def p006_reset_key_and_frames(dut: Any) -> None:
    """Starts and instruction F 0 near the event of the RESET key have valid replies, and RESET is
    executed.
    """
    host = await constant_speed_host(dut, 2500)
    await host.wait_us(1_010)
    await download(host, [Op(0x13, 1, 3), Op(0x10, 3, 0), goto(1), out(1, 1), goto(4)])
    for code, data in (("s", 50), ("N", 1), ("F", 0), ("I", 0), ("i", 9)):
        for shift in (-2, -1, 0, 1, 2):
            event = await ready_for_reset(host)
            reply = await say_at(host, event + shift, code, data)
            assert not await host.busy() or (code in "sN" and reply)
            assert reply in (0, data, host.accepted(data), 1)
            await host.pins(gpi=HIGH)
            await host.wait_us(1_100)
            assert await host.out("gpo") == (code != "F")
            await host.ok(F=0, y=0)
            assert await host.ask("I") == 0
            await host.wait_us(100)


@directed("P006-PRG-31", "P006-PRG-15", "P006-PRG-16", "P006-PRG-32")
async def p006_keys_in_every_clk_of_an_instruction(dut: Any) -> None:
    """RESET cancels the instruction in progress or is executed after it; PAUSE lets the instruction
    complete.
    """
    host = await constant_speed_host(dut, 2500)
    await host.wait_us(1_010)
    loop = (Op(0x13, 1, 5), Op(0x14, 1, 0), out(1, 1), out(1, 0), goto(2), goto(5))
    await download(host, loop)
    for gpi in (KEY1, KEY2):
        for _ in range(8):
            await host.ok(A=0)
            assert await host.ask("z") == 1
            await host.pause(7)
            await host.pins(gpi=gpi)
            await host.wait_us(1_010)
            seen = await host.out("gpo")
            await host.pause(300)
            assert await host.out("gpo") == seen
            await host.pins(gpi=HIGH)
            await host.wait_us(1_100)
            await host.ok(F=0, y=0)


@directed("P006-PRG-15", "P006-PRG-16", "P006-FRM-03", "P006-CMD-46")
async def p006_frames_in_every_clk_of_the_program(dut: Any) -> None:
    """In any cycle of a program of OUT instructions, instruction y sets the outputs in time; those that the
    program does not address keep these levels.
    """
    host = await Host.start(dut)
    await load(host, out(1, 1), out(2, 1), out(1, 0), out(2, 0), goto(0))
    begin = host.t + frame_clk(host) + 100
    for shift in range(0, 49, 2):
        assert await say_at(host, begin + shift, "y", 0xE0) == 0xE0
        edges = host.edges("gpo", host.e)
        assert edges and edges[0][0] - host.e <= EXECUTE + 1 and await host.out("gpo") & 0b11100 == 0b11100
        await host.ok(y=0)
        begin = host.t + frame_clk(host) + 100 + 48 - (host.t + frame_clk(host) + 100 - begin) % 48


@directed("P006-PRG-20", "P006-CMD-03", "P006-STA-14")
async def p006_single_try_and_emergency_stop(dut: Any) -> None:
    """If a stop occurs before the ROT that instruction E executes, the ROT is rejected; a later stop ends its
    motion. No step is made.
    """
    host = await constant_speed_host(dut)
    await host.ok(f=1)
    await download(host, [Op(1, 0, 50)])
    for shift in range(-1, 10):
        assert await collide(host, "E", 0, shift, ext1=0) == 1
        assert not await host.busy() and await host.status() == DECAY | EXT1 and not host.steps(0)
        await host.pins(ext1=1)
        assert await host.ask("b") == 0


@directed(
    "P006-BAD-12",
    "P006-EEP-22",
    "P006-EEP-20",
    exact="an instruction must be executed in each cycle around an event",
)
async def p006_restore_and_save(dut: Any) -> None:
    """If the FSET event occurs near instruction t (save), either the save and the factory restore are both
    executed, or t is rejected.
    """
    host = await Host.start(dut)
    await host.wait_us(100)
    replies = []
    for shift in range(-3, 4):
        await host.pins(fset_n=0)
        first = -(-(host.t - 1 + 2 - 1) * 1_000_000 // host.clk_hz)
        event = 1 - (-(first + 20_000) * host.clk_hz // 1_000_000)
        replies.append(await say_at(host, event + shift, "t"))
        await host.pins(fset_n=1)
        await host.ms(2)
        assert await host.ask("t") == 1
        await host.ms(1)
    assert replies == sorted(replies, reverse=True) and set(replies) == {0, 1}


@directed("P006-FRM-07", "P006-BAD-06", "P006-FRM-10")
async def p006_bytes_about_the_end_of_a_reply(dut: Any) -> None:
    """If a byte begins before the middle of the last stop bit of a reply, it is ignored; a later byte is
    received.

    The line need not be idle before this byte.
    """
    host = await Host.start(dut)
    heard = []
    for shift in range(-4, 9):
        await host.send_frame("j")
        middle = host.e + -(-(163 * host.clk_hz) // (2 * host.baud))
        await host.go(middle - 30)
        host.back_to(middle + shift)
        await host.send(command(0xFF, "k"))
        await host.pause(int(host.bit * 90))
        edges = [t for t, level in host.edges("de", host.e) if level]
        heard.append(len(edges))
        await host.pause(int(host.bit * 220))
        await host.ignore_replies()
        assert await host.ask("k") == 16
    assert set(heard) <= {0, 1} and heard[-1] == 1 and heard[0] == 0


@directed("P006-STA-10", "P006-MOT-05", "P006-EXT-02", "P006-STA-14")
async def p006_emergency_stop_and_step(dut: Any) -> None:
    """If an emergency stop occurs some cycles before or after a step (also the last step), the position is
    exact.
    """
    host = await Host.start(dut)
    await set_constant_speed(host, 3000, f=1)
    for count in (1, 3):
        for shift in NEAR:
            await start(host, count)
            period = host.clk_hz // 3000
            begin = host.edges("mon_busy")[-1][0]
            tick = -(-(begin + 800 - 1) // 8) * 8 + 1
            step = tick + -(-1_000_000 // 3000) * 8 + 2
            assert step - period < host.t + 10**6
            if host.t < step + shift - 2:
                await host.at(step + shift - 2, ext1=0)
                await host.go(step + 100)
            else:
                await host.pins(ext1=0)
            await host.wait_us(1_500)
            assert not await host.busy() and await host.position() == len(host.steps(0))
            await host.pins(ext1=1)
            assert await host.ask("b") == 0
