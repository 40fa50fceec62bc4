"""Moves and speed mode: intervals, planning, changes of the target, ends of motions.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import cocotb

from .builds import directed
from .host import EXECUTE, START, Host
from .moves import (
    DECAY,
    after_steps,
    constant_speed_host,
    cruise,
    is_stopped,
    move,
    run,
    set_constant_speed,
    start,
    wait_stopped,
)


class Move(NamedTuple):
    """A move whose intervals are known: count, settings, time of the last step, first and last intervals in
    us.
    """

    count: int
    settings: tuple[int, int, int, int, int]
    end: int
    head: tuple[int, ...]
    tail: tuple[int, ...]


MOVES = (
    Move(1, (600, 600, 3200, 3, 3), 1667, (1667,), (1667,)),
    Move(2, (600, 600, 3200, 3, 3), 3334, (1667, 1667), (1667, 1667)),
    Move(3, (600, 600, 3200, 3, 3), 5000, (1667, 1667, 1666), (1667, 1667, 1666)),
    Move(10, (600, 600, 3200, 3, 3), 16667, (1667, 1667, 1666, 1667), (1667, 1666, 1667)),
    Move(1, (3000, 65, 3200, 3, 3), 460, (460,), (460,)),
    Move(4, (3000, 65, 3200, 3, 3), 44509, (460, 13279, 15385, 15385), (13279, 15385, 15385)),
    Move(50, (3000, 600, 5000, 3, 5), 30915, (335, 338, 342, 345), (1662, 1667, 1667)),
    Move(256, (600, 600, 16000, 3, 3), 121101, (1661, 1621, 1551, 1467), (1667, 1667, 1666)),
)
PLANNING = tuple(f"P006-MOT-{n}" for n in ("10", "11", "12", "13", "14", "15", "16", "17", "20", "22", "23"))


@cocotb.parametrize(row=MOVES)
@directed(*PLANNING, "P006-MOT-01", "P006-MOT-02", "P006-MOT-03", "P006-MOT-04", "P006-MOT-05")
async def p006_moves_of_the_table(dut: Any, row: Move) -> None:
    host = await Host.start(dut)
    low, high, limit, acc, dec = row.settings
    await host.ok(L=low, S=high, v=limit, u=acc, o=dec)
    await start(host, row.count)
    e = host.e
    fall = await wait_stopped(host)
    steps = host.steps()
    gaps = (row.head[0], *host.intervals())
    assert len(steps) == row.count
    assert gaps[: len(row.head)] == row.head
    assert gaps[-len(row.tail) :] == row.tail
    assert host.in_us(steps[-1] - steps[0]) == row.end - row.head[0] and 0 <= fall - steps[-1] <= 2
    assert 0 <= steps[0] - host.us(row.head[0]) - e <= EXECUTE + START + host.us(1)


@directed("P006-MOT-04", "P006-STA-18", "P006-CMD-53")
async def p006_when_a_motion_begins(dut: Any) -> None:
    """BUSY is set before the reply; the first interval begins at t = 0, at most 1024 cycles later."""
    for count, speed in ((1, 3000), (255, 3000), (256, 3000), (100_000, 16_000), (0x7FFFFFFF, 16_000)):
        host = await Host.start(dut)
        await host.ok(L=3000, S=3000, v=speed, u=5, o=5)
        await start(host, count)
        e = host.e
        assert 0 < host.edges("mon_busy", host.mark)[0][0] - e <= EXECUTE
        await after_steps(host, 1)
        assert 0 <= host.steps()[0] - host.us(333) - e <= EXECUTE + START + host.us(2)
        assert await host.ask("I") == 0


@directed("P006-MOT-03", "P006-MOT-40", "P006-MOT-01")
async def p006_constant_speeds_have_no_jitter(dut: Any) -> None:
    """At a constant speed, each step occurs at the first whole us after its exact time."""
    for speed in (2999, 1601, 700):
        host = await constant_speed_host(dut, speed)
        await run(host)
        await after_steps(host, 21)
        whole = [-(-number * 1_000_000 // speed) for number in range(1, 22)]
        assert host.intervals() == [b - a for a, b in zip(whole, whole[1:], strict=False)]


@directed("P006-MOT-01", "P006-MOT-03", "P006-MOT-13", "P006-MOT-14", "P006-MOT-40")
async def p006_the_highest_speed(dut: Any) -> None:
    host = await Host.start(dut)
    await host.ok(L=3000, S=3000, v=16_000, u=5, o=5)
    await run(host)
    mark = host.mark
    await cruise(host, 62.5)
    await host.ms(20)
    gaps = host.intervals(mark)
    assert gaps[-4:] in ([63, 62, 63, 62], [62, 63, 62, 63])
    assert all(b <= a + 1 for a, b in zip(gaps, gaps[1:], strict=False)), "the speed falls"
    assert await host.ask("I") == 0 and await host.position() == host.step_count(mark)


@directed("P006-MOT-40", "P006-MOT-41", "P006-MOT-15", "P006-STA-13")
async def p006_stop_in_the_middle_of_the_ramp(dut: Any) -> None:
    """Worked example W10: if N 0 takes effect at t = 100,000, the speed mode stops as calculated."""
    host = await Host.start(dut)
    await host.ok(e=1000, u=3, o=3, v=3200)
    await run(host)
    mark = host.mark
    first = await after_steps(host, 1)
    origin = first - host.us(1667)
    await host.go(origin + host.us(99_950) - int(80 * host.bit))
    assert await host.ask("N", 0) == 0
    assert origin + host.us(99_900) < host.e < origin + host.us(99_999)
    fall = await wait_stopped(host)
    gaps = host.intervals(mark)
    assert len(gaps) == 243 and gaps[:4] == [1663, 1657, 1647, 1636] and gaps[-3:] == [1633, 1649, 1660]
    assert abs(fall - origin - host.us(202_300)) <= host.us(2) + 8


@directed("P006-MOT-41", "P006-MOT-40", "P006-STA-02")
async def p006_stop_when_already_slow(dut: Any) -> None:
    """Worked examples W8 and W14: without a ramp, the motion ends at the next update tick."""
    for speed, stop in ((50, 600), (2500, 2500)):
        host = await Host.start(dut)
        await host.ok(v=speed, S=stop, L=max(65, speed))
        await run(host)
        mark = host.mark
        await after_steps(host, 2)
        assert await host.ask("N", 0) == 0
        fall = await wait_stopped(host)
        assert fall - host.e <= host.us(200) + EXECUTE
        assert set(host.intervals(mark)) == {1_000_000 // speed}


@directed("P006-MOT-30", "P006-MOT-50", "P006-CMD-43", "P006-CMD-54")
async def p006_retargets(dut: Any) -> None:
    """A new VMAX, higher or lower, is the target from the next update on, in a ramp and at constant speed."""
    host = await Host.start(dut)
    await host.ok(L=2000, S=2000, v=2200, u=5, o=5)
    await run(host)
    mark = host.mark
    await cruise(host, 1_000_000 / 2200)
    await host.ok(v=2400)
    await after_steps(host, host.step_count() + 2)
    await host.ok(v=2100)
    await cruise(host, 1_000_000 / 2100)
    await host.ms(3)
    await host.ok(v=2500)
    await cruise(host, 400)
    assert await host.ask("N", 0) == 0
    await wait_stopped(host)
    assert await host.position() == host.step_count(mark)


@directed("P006-MOT-30", "P006-MOT-15", "P006-MOT-20")
async def p006_retargets_of_a_move(dut: Any) -> None:
    """A move makes exactly N steps regardless of changes of VMAX.

    If the target is below VSTOP, the motion keeps the target speed until its last step.
    """
    host = await Host.start(dut)
    await host.ok(L=2000, S=2000, v=2600, u=5, o=5)
    await start(host, 300)
    mark = host.mark
    await after_steps(host, 30)
    await host.ok(v=3000)
    await after_steps(host, host.step_count() + 20)
    await host.ok(v=2300)
    await wait_stopped(host)
    gaps = host.intervals(mark)
    assert host.step_count(mark) == 300 and max(gaps) <= 500 and gaps[-1] >= 490
    await host.ok(L=3000, S=3000, v=3000)
    await start(host, 256)
    mark = host.mark
    await after_steps(host, 150)
    await host.ok(v=2500)
    await wait_stopped(host)
    gaps = host.intervals(mark)
    assert host.step_count(mark) == 256 and set(gaps[-5:]) == {400}


@directed("P006-MOT-30", "P006-MOT-23")
async def p006_motions_that_ignore_a_retarget(dut: Any) -> None:
    """A short move, and the last deceleration of a long move, ignore a new VMAX."""
    host = await constant_speed_host(dut, 2500)
    await start(host, 60)
    mark = host.mark
    await host.ok(v=16_000)
    await wait_stopped(host)
    assert set(host.intervals(mark)) == {400}
    await host.ok(L=2500, S=1500, v=2600, u=5, o=5)
    await start(host, 256)
    mark = host.mark
    await after_steps(host, 256 - 12)
    await host.ok(v=10_000)
    await wait_stopped(host)
    gaps = host.intervals(mark)[-11:]
    assert host.step_count(mark) == 256 and gaps[-1] in (666, 667)
    assert all(b >= a - 1 for a, b in zip(gaps, gaps[1:], strict=False))


@directed("P006-MOT-42", "P006-STA-16", "P006-CMD-11")
async def p006_speed_mode_switched_on_again(dut: Any) -> None:
    """Instruction N 1 during STOPPING returns to the target speed, both during the ramp and after its end."""
    host = await Host.start(dut)
    await host.ok(L=2800, S=2800, v=3000, u=5, o=5)
    await run(host)
    mark = host.mark
    await cruise(host, 1_000_000 / 3000)
    assert await host.ask("N", 0) == 0
    off = host.e
    assert await host.ask("N", 1) == 1 and host.e - off < host.us(3_600) and await host.busy()
    await cruise(host, 1_000_000 / 3000)
    for gap in (2_600, 2_900, 3_000, 3_600):
        assert await host.ask("N", 0) == 0
        await host.go(host.e + host.us(gap) - int(80 * host.bit))
        answer = await host.ask("N", 1)
        assert answer == 1 and await host.busy()
        await cruise(host, 1_000_000 / 3000)
    assert max(host.intervals(mark)) <= 358
    await host.ask("I")


@directed("P006-MOT-05", "P006-STA-19", "P006-CMD-40")
async def p006_position_wraps_and_long_moves(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await host.ok(i=0x7FFFFFFE, d=1)
    assert len(await move(host, 3)) == 2 and await host.ask("c") == 0x80000001
    await host.ok(d=0)
    assert len(await move(host, 3)) == 2 and await host.ask("c") == 0x7FFFFFFE
    await start(host, 0x7FFFFFFF)
    assert set(host.intervals()) <= {333, 334}
    await host.ms(10)
    assert await host.busy() and set(host.intervals()) == {333, 334} and await host.ask("I") == 0
    assert not await host.out("mon_dir")


@directed("P006-MOT-23", "P006-MOT-20", "P006-STA-01", "P006-STA-04")
async def p006_the_border_of_short_moves(dut: Any) -> None:
    """A move of 255 steps does not use VMAX; a move of 256 steps does."""
    host = await Host.start(dut)
    await host.ok(L=3000, S=3000, v=3300, u=5, o=5)
    await start(host, 255)
    mark = host.mark
    await after_steps(host, 40)
    assert set(host.intervals(mark)) == {333, 334}
    await host.ask("I")
    made = host.step_count(mark)
    await start(host, 256)
    mark = host.mark
    await wait_stopped(host)
    assert min(host.intervals(mark)) == 303 and host.step_count(mark) == 256
    assert await host.position() == 256 + made and await host.status() == DECAY


@directed("P006-STA-14", "P006-STA-10", "P006-MOT-04")
async def p006_stop_before_the_first_step(dut: Any) -> None:
    """A stop between acceptance and t = 0, or in the first interval, cancels the motion without a step."""
    host = await set_constant_speed(await Host.start(dut), 3000, f=1)
    for after in (1, 20, 300, 1000, 2000):
        await host.send_frame("s", 1000)
        await host.go(host.e + EXECUTE + after)
        await host.pins(ext1=0)
        assert await host.receive_reply() == host.accepted(1000)
        assert host.step_count() == 0 and not await host.busy() and await is_stopped(host, 3000)
        await host.pins(ext1=1)
        assert await host.ask("b") == 0
    await start(host, 2)
    await wait_stopped(host)
    assert await host.position() == 2
