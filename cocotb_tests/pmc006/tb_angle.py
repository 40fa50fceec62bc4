"""Electrical angle, references, currents, compensation, hold and decay.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .host import EXECUTE, Host
from .moves import after_steps, constant_speed_host, move, run, set_constant_speed, start, wait_stopped
from .reference import HOME, boost, code, increment, lead, sines

COMPUTATION = 25
"""Number of cycles from the beginning of a computation to the new references."""
REFS = 64
"""Maximum number of cycles from a cause to the change of the references."""
NAMES = ("phase_a_ref", "phase_a_sign", "phase_b_ref", "phase_b_sign")


def references_at(host: Host, t: int) -> tuple[int, ...]:
    """Return the references after edge t."""
    return tuple(host.level_at(name, t) for name in NAMES)


@cocotb.parametrize(m=[0, 2, 4, 8, 16, 32, 64, 128])
@directed(
    "P006-EXC-01", "P006-EXC-02", "P006-EXC-10", "P006-EXC-11", "P006-EXC-12", "P006-EXC-13", "P006-EXC-15"
)
async def p006_angle_of_every_step(dut: Any, m: int) -> None:
    """The references follow each step within 64 cycles; the two references and their two signs change in the
    same cycle.

    The test makes 9 steps in each direction.
    """
    host = await set_constant_speed(
        await Host.start(dut), 1000 if m > 1 else 600, m=m, a=0, e=4000, M=100, P=300
    )
    angle = HOME
    for direction in (1, 0):
        await host.ok(d=direction)
        await start(host, 9)
        mark = host.mark
        await wait_stopped(host)
        await host.pause(REFS)
        for edge in host.steps(mark):
            angle += increment(m) if direction else -increment(m)
            ahead = lead(1000 if m > 1 else 600, m, 300) * (1 if direction else -1)
            after = edge + REFS
            raised = min(255, 255 + boost(4000, 1000, m, 100))
            expected = {sines(angle, 255), sines(angle + ahead, raised)}
            assert references_at(host, after) in expected, f"angle {angle}"
            assert len({t for name in NAMES for t, _ in host.edges(name, edge) if t <= after}) <= 1
        assert await host.refs() == sines(angle, 255)


@directed("P006-EXC-14", "P006-EXC-10", "P006-EXC-11")
async def p006_table_of_angles(dut: Any) -> None:
    table = {
        (0, 64): (64, 0, 0, 0),
        (32, 64): (59, 0, 25, 0),
        (128, 64): (0, 0, 64, 0),
        (192, 64): (45, 1, 45, 0),
        (256, 64): (64, 1, 0, 0),
        (320, 64): (45, 1, 45, 1),
        (384, 64): (0, 0, 64, 1),
        (448, 64): (45, 0, 45, 1),
        (96, 255): (98, 0, 236, 0),
        (320, 255): (180, 1, 180, 1),
    }
    assert all(sines(angle, peak) == row for (angle, peak), row in table.items())
    host = await set_constant_speed(await Host.start(dut), 3000, m=4, a=0)
    for current, peak in ((1000, 64), (4000, 255)):
        await host.ok(e=current)
        for number in range(16):
            assert await host.refs() == sines(HOME + 32 * number, peak)
            if (key := ((HOME + 32 * number) % 512, peak)) in table:
                assert await host.refs() == table[key]
            await move(host, 1)
            await host.pause(REFS)


@directed("P006-EXC-03", "P006-CMD-54")
async def p006_nothing_but_steps_moves_the_angle(dut: Any) -> None:
    """Only steps change the angle: settings and stops do not, and after a change to a coarser MSTEP the angle
    is not rounded.
    """
    host = await set_constant_speed(await Host.start(dut), 3000, m=128, a=0)
    await move(host, 5)
    await host.pause(REFS)
    held = await host.refs()
    assert held == sines(HOME + 5, code(800))
    for setting in ({"m": 0}, {"d": 0}, {"i": 1000}, {"d": 1}, {"g": 1}, {"g": 0}, {"u": 5}):
        await host.ok(**setting)
    assert await host.refs() == held and await host.ask("I") == 0
    await move(host, 3)
    await host.pause(REFS)
    assert await host.refs() == sines(HOME + 5 + 3 * 128, code(800))
    await host.ok(m=64, d=0)
    await move(host, 2)
    await host.pause(REFS)
    assert await host.refs() == sines(HOME + 5 + 3 * 128 - 4, code(800))


@directed("P006-EXC-20", "P006-CMD-26", "P006-CMD-35")
async def p006_currents(dut: Any) -> None:
    """Each current setting selects the drive index in whose range it is.

    The test uses both ends of several ranges.
    """
    host = await Host.start(dut)
    await host.ok(a=0)
    printed = (26, 35, 45, 54, 64, 73, 83, 92, 102, 112, 121, 131, 140, 150, 159, 169, 179, 188, 198, 207)
    printed += (217, 226, 236, 245, 255)
    assert printed == tuple(code(400 + 150 * k) for k in range(25))
    for k in (0, 1, 3, 4, 11, 12, 23, 24):
        for current in {max(400, 325 + 150 * k), min(4000, 325 + 150 * k + 149)}:
            await host.ok(e=current)
            assert await host.refs() == sines(HOME, printed[k]), f"{current} mA"
            assert await host.ask("n") == current


@cocotb.parametrize(
    case=[
        (0, 1000, 300, 1250, 3000, 1),
        (0, 1000, 300, 1250, 3000, 0),
        (2, 4000, 1200, 2000, 3000, 1),
        (2, 2000, 1200, 700, 2345, 0),
        (0, 400, 1200, 2000, 2999, 1),
        (16, 1000, 300, 1250, 3000, 1),
    ]
)
@directed("P006-EXC-21", "P006-EXC-22", "P006-EXC-23", "P006-EXC-24", "P006-CMD-10", "P006-CMD-13")
async def p006_compensation(dut: Any, case: Any) -> None:
    """The compensation of current and angle is 0 until the first update tick, then that of the present speed,
    and 0 at standstill.
    """
    m, e, ccomp, scomp, speed, forward = case
    host = await set_constant_speed(await Host.start(dut), speed, m=m, e=e, M=ccomp, P=scomp, d=forward, a=0)
    await run(host)
    mark = host.mark
    await after_steps(host, 9)
    peak = min(255, code(e) + boost(e, speed, m, ccomp))
    sign = 1 if forward else -1
    angle = HOME
    for number, edge in enumerate(host.steps(mark)[:8]):
        angle += sign * increment(m)
        assert references_at(host, edge + REFS) == sines(angle + sign * lead(speed, m, scomp), peak), (
            f"step {number}"
        )
    first = host.edges("mon_busy", mark)[0][0]
    assert references_at(host, first + host.us(50)) == sines(HOME, code(e))
    assert await host.ask("I") == 0
    await host.pause(REFS)
    assert await host.refs() == sines(HOME + sign * increment(m) * host.step_count(mark), code(e))


@directed("P006-EXC-22", "P006-EXC-23", "P006-CMD-54", "P006-CMD-10", "P006-CMD-13")
async def p006_factors_act_at_once(dut: Any) -> None:
    """CCOMP, SCOMP and CUR take effect during a motion; MSTEP does not."""
    host = await set_constant_speed(await Host.start(dut), 2000, m=0, a=0, e=1000)
    await run(host)
    mark = host.mark
    for settings in ({"M": 1200}, {"P": 300}, {"e": 2500}, {"m": 128}):
        await host.ok(**settings)
    await host.wait_us(400)
    await after_steps(host, host.step_count(mark) + 1)
    await host.pause(REFS)
    angle = HOME + 128 * host.step_count(mark)
    assert await host.refs() == sines(
        angle + lead(2000, 0, 300), min(255, code(2500) + boost(2500, 2000, 0, 1200))
    )
    await host.ask("I")


@directed("P006-EXC-22", "P006-EXC-23", "P006-CMD-54", "P006-MOT-22")
async def p006_factors_that_change_during_a_calculation(dut: Any) -> None:
    """CCOMP, SCOMP, CUR and VMAX are sampled at update ticks, every 100 us; the calculation that follows a
    tick does not use a later value.
    """
    host = await set_constant_speed(await Host.start(dut), 2000, m=0, a=0, e=1000)
    await run(host)
    begin, tick = host.t, host.us(100)
    factors = (("M", 1200, 300), ("P", 300, 1250), ("e", 2500, 1000), ("v", 2050, 2000))
    for number, offset in enumerate(range(0, tick, 50)):
        for name, *values in factors:
            await host.go(begin + ((host.t - begin) // tick + 1) * tick + offset)
            await host.ok(**{name: values[number % 2]})
    assert await host.ask("I") == 0


@directed("P006-EXC-30", "P006-EXC-31", "P006-EXC-32", "P006-CMD-14", "P006-CMD-22", "P006-STA-03")
async def p006_decay(dut: Any) -> None:
    """The current is reduced by the selected coefficient when 100 ms have passed since the fall of BUSY.

    Instructions a and Q and an accepted motion take effect immediately; a rejected instruction s has no
    effect.
    """
    host = await constant_speed_host(dut)
    await start(host, 1)
    fall = await wait_stopped(host)
    await host.ok(g=1)
    await host.ok(g=0)
    await host.go(fall + host.us(99_990))
    assert await host.refs() == sines(HOME + 8, code(800))
    await host.go(fall + host.us(100_010) + REFS)
    assert await host.refs() == sines(HOME + 8, code(800) >> 1)
    for factor in (4, 2, 3, 1):
        await host.ok(Q=factor)
        assert await host.refs() == sines(HOME + 8, code(800) >> factor)
    await host.ok(a=0)
    assert await host.refs() == sines(HOME + 8, code(800))
    await host.ok(a=1)
    change = host.edges("phase_a_ref", host.frame_start)[0][0]
    assert host.e <= change <= host.e + EXECUTE + REFS
    assert await host.ask("s", 0) == 0 and await host.refs() == sines(HOME + 8, code(800) >> 1)
    await host.ok(v=100)
    assert await host.ask("s", 3) == 0 and await host.refs() == sines(HOME + 8, code(800) >> 1)
    await run(host)
    change = host.edges("phase_a_ref", host.frame_start)[0][0]
    assert host.e <= change <= host.e + EXECUTE + REFS and await host.refs() == sines(HOME + 8, code(800))
    await host.ask("I")
    assert await host.refs() == sines(HOME + 8, code(800))


@directed("P006-STA-12", "P006-EXC-30", "P006-CMD-28")
async def p006_free(dut: Any) -> None:
    """Instruction g 1 switches all outputs off immediately; g 0 restores the hold current at the same
    angle.
    """
    host = await constant_speed_host(dut)
    await host.ok(e=2000)
    await start(host, 500)
    await after_steps(host, 11)
    await host.ok(g=1)
    made = host.step_count(0)
    off = host.edges("bridge_a_en", host.frame_start)[0]
    assert host.e <= off[0] <= host.e + EXECUTE + 5 and not off[1] and await host.refs() == (0, 0, 0, 0)
    assert not host.steps(off[0] + 5) and await host.position() == made
    await host.ok(g=0)
    assert await host.refs() == sines(HOME + 8 * made, code(2000)) and await host.out("bridge_b_en")


@directed("P006-EXC-30", "P006-EXC-31")
async def p006_end_of_the_decay(dut: Any) -> None:
    """A computation of the references begins every 32 cycles. The first that begins when BUSY is 1 already
    uses the full current.
    """
    host = await constant_speed_host(dut)
    begin, delays = host.t, []
    await start(host, 1)
    busy = host.edges("mon_busy", begin)[0][0] - begin
    for shift in (-1, 0, 1):
        fall = await wait_stopped(host)
        await host.go(fall + host.us(100_010) + REFS)
        reduced = host.edges("phase_a_ref", fall)[-1][0]
        await host.go(host.t + (reduced + shift - COMPUTATION - host.t - busy) % 32)
        begin = host.t
        await start(host, 1)
        assert host.edges("mon_busy", begin)[0][0] == begin + busy
        delays.append(host.edges("phase_a_ref", begin + busy)[0][0] - begin - busy)
    assert delays == [COMPUTATION + 1, COMPUTATION, COMPUTATION + 31]
