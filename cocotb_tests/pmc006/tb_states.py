"""Acceptance of each instruction in each state, and its effect on the motion (P006-STA).

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import cocotb

from .builds import directed
from .host import ACT, EXECUTE, Host
from .moves import (
    DECAY,
    EXT1,
    EXT1_EN,
    EXT2,
    EXT2_EN,
    FORWARD,
    FREE_RUN,
    SPEED_MODE,
    after_steps,
    constant_speed_host,
    download,
    is_stopped,
    run,
    set_constant_speed,
    start,
    wait_stopped,
)
from .programs import Op, rot

LONG = 50_000
EXTS = {"ext1": EXT1, "ext2": EXT2}


class State(NamedTuple):
    """A state: motion ("", "move", "speed", "stopping"), FREE, and EXT flags as in status 1."""

    motion: str = ""
    free: bool = False
    flags: int = 0


STATES = {
    "idle": State(),
    "move": State("move"),
    "speed": State("speed"),
    "stopping": State("stopping"),
    "free": State(free=True),
    "ext1": State(flags=EXT1),
    "both": State(free=True, flags=EXT1 | EXT2),
}


async def enter(host: Host, state: State) -> None:
    """Enter a state from any other state."""
    for code in "Ibl":
        await host.ask(code)
    await host.ok(g=0)
    for pin, flag in EXTS.items():
        if state.flags & flag:
            await host.pins(**{pin: 0})
            await host.pause(20)
            await host.pins(**{pin: 1})
    if state.free:
        await host.ok(g=1)
    if state.motion == "move":
        await start(host, LONG)
    elif state.motion:
        await run(host)
        if state.motion == "stopping":
            await run(host, 0)


async def read_status(host: Host) -> tuple[int, int]:
    """Return status 1 without the bit of the current decay, and the mode bits of status 2."""
    return await host.status() & ~DECAY, await host.ask("O") & (SPEED_MODE | FREE_RUN)


def expected_status(state: State) -> tuple[int, int]:
    """Return the expected result of `read_status`."""
    return bool(state.motion) | state.flags, SPEED_MODE * (state.motion == "speed") | FREE_RUN * state.free


def outcome(code: str, data: int, state: State, accepted: int) -> tuple[int, State]:
    """Return reply data and next state according to the rules P006-STA."""
    idle, blocked = not state.motion, state.free or bool(state.flags)
    if code == "s":
        return (accepted, State("move")) if idle and not blocked else (0, state)
    if (code, data) == ("N", 1):
        good = not blocked and state.motion != "move"
        return (1, state._replace(motion="speed")) if good else (0, state)
    if (code, data) == ("N", 0):
        return 0, state._replace(motion="stopping") if state.motion == "speed" else state
    if code == "I":
        return data, state._replace(motion="")
    if (code, data) == ("g", 1):
        return 1, state._replace(motion="", free=True)
    if (code, data) == ("g", 0):
        return 0, state._replace(free=False)
    cleared = {"b": EXT1, "l": EXT2, "p": 0}[code]
    return 0, state._replace(flags=state.flags & ~cleared)


ROWS = (("s", LONG), ("N", 1), ("N", 0), ("I", 0x77), ("g", 1), ("g", 0), ("b", 0), ("l", 5), ("p", -1))
TABLE_RULES = ("P006-CMD-06", "P006-CMD-11", "P006-CMD-23", "P006-CMD-28", "P006-CMD-33", "P006-CMD-37")
STATE_RULES = ("P006-STA-01", "P006-STA-11", "P006-STA-16", "P006-STA-17", "P006-CMD-40", "P006-EXT-11")
BAD_RULES = ("P006-BAD-10", "P006-BAD-25")


@cocotb.parametrize(name=list(STATES))
@directed(*TABLE_RULES, *STATE_RULES, *BAD_RULES, "P006-CMD-25", "P006-CMD-31", "P006-EXT-05")
async def p006_every_row_in_every_state(dut: Any, name: str) -> None:
    host = await Host.start(dut)
    await set_constant_speed(host, 3000, f=3)
    await host.ok(S=65)
    state = STATES[name]
    after = None
    for code, data in ROWS:
        if after != state:
            await enter(host, state)
        reply, after = outcome(code, data, state, host.accepted(data))
        before = host.step_count(0)
        assert await host.ask(code, data) == reply, f"{code} {data} in {name}"
        assert await read_status(host) == expected_status(after), f"{code} {data} in {name}"
        moves = not await is_stopped(host, host.us(700))
        assert moves == bool(after.motion), f"{code} {data} in {name}"
        assert moves or state.motion or host.step_count(0) == before
    position = await host.position()
    assert position == sum(t <= host.e + ACT for t in host.steps(0))


@cocotb.parametrize(name=["idle", "move", "ext1", "free"])
@directed("P006-PRG-17", "P006-PRG-20", "P006-STA-01")
async def p006_rot_is_accepted_like_s(dut: Any, name: str) -> None:
    """A ROT that instruction E executes is accepted in the same states as instruction s; the reply is 1 in
    all states.
    """
    host = await Host.start(dut)
    await set_constant_speed(host, 3000, f=3)
    await download(host, [rot(LONG)])
    await enter(host, STATES[name])
    assert await host.ask("E") == 1
    assert await host.busy() == (name in ("idle", "move"))
    assert await is_stopped(host, host.us(700)) == (name not in ("idle", "move"))


@directed("P006-STA-01", "P006-STA-02", "P006-BAD-10", "P006-CMD-43")
async def p006_speeds_against_the_maximum(dut: Any) -> None:
    """Instruction s is accepted if VSTART and VSTOP do not exceed VMAX; N 1 is accepted regardless of
    them.
    """
    host = await Host.start(dut)
    for low, high, limit, good in (
        (600, 600, 599, False),
        (600, 600, 600, True),
        (601, 600, 600, False),
        (600, 601, 600, False),
        (65, 3000, 2999, False),
        (3000, 65, 3000, True),
    ):
        await host.ok(L=low, S=high, v=limit)
        assert await host.ask("s", LONG) == (host.accepted(LONG) if good else 0)
        assert await host.busy() == good
        assert await host.ask("I") == 0
        await run(host)
        assert await host.busy() and await host.ask("I") == 0


@directed("P006-STA-04", "P006-MOT-52", "P006-STA-01")
async def p006_analog_speed_does_not_refuse(dut: Any) -> None:
    """With analog speed, instruction s is checked with the full-scale speed, even if the present speed is 0.

    If the full scale is 0, every start is rejected.
    """
    host = await Host.start(dut)
    await download(host, [Op(0x08, 1, 600), Op(0x08, 0, 0)])
    assert await host.ask("E") == 1
    await start(host, 300)
    assert await host.busy() and await host.ask("I") == 0
    await host.ok(A=2)
    assert await host.ask("E") == 1 and await host.ask("q") == 0
    assert await host.ask("s", 5) == 0 and await host.ask("N", 1) == 0 and not await host.busy()
    await host.ok(v=600)
    await start(host, 5)
    await wait_stopped(host)
    assert len(host.steps()) == 5


@directed("P006-STA-10", "P006-STA-12", "P006-STA-14", "P006-CMD-28", "P006-PRG-16")
async def p006_a_stop_while_planning(dut: Any) -> None:
    """A stop between acceptance and t = 0 cancels the motion without a step."""
    host = await constant_speed_host(dut)
    await host.ok(f=3)
    await download(host, [rot(5), Op(0x05, 0, 1)])
    assert await host.ask("z") == 1
    assert await is_stopped(host)
    assert not await host.busy()
    assert await host.ask("O") & FREE_RUN
    assert await host.ask("g", 0) == 0
    await host.send_frame("s", 5)
    await host.pins(ext2=0)
    assert await host.receive_reply() == host.accepted(5)
    assert await is_stopped(host) and await host.status() == DECAY | EXT2 and await host.position() == 0
    assert not host.steps(0) and [level for _, level in host.edges("mon_busy")] == [1, 0, 1, 0]
    assert await host.ask("l") == 0
    await start(host, 3)
    await wait_stopped(host)
    assert len(host.steps(0)) == 3


@directed("P006-STA-10", "P006-STA-13", "P006-CMD-06")
async def p006_abort_stops_within_its_window(dut: Any) -> None:
    host = await constant_speed_host(dut, 3000)
    for begin in (partial(start, count=LONG), run):
        await begin(host)
        await after_steps(host, 7)
        assert await host.ask("I", -1) == 0xFFFFFFFF
        assert not host.steps(host.edges("mon_busy")[-1][0] + 1) and not await host.busy()
        assert host.edges("mon_busy")[-1][0] - host.e <= EXECUTE + 5
        assert await host.position() == len(host.steps(0)) and await host.status() == DECAY


@directed("P006-STA-15", "P006-CMD-30", "P006-CMD-24", "P006-CMD-52")
async def p006_position_set_on_the_run(dut: Any) -> None:
    """If the position is set at any time during an interval, no step is lost or counted twice."""
    host = await constant_speed_host(dut, 3000)
    await run(host)
    await after_steps(host, 3)
    for shift in range(24):
        await host.pause(37 + shift)
        assert await host.ask("i", 1_000_000) == 1_000_000
        loaded = host.e + ACT
        position = await host.position()
        between = sum(loaded < t <= host.e + ACT for t in host.steps(0))
        assert 0 <= position - 1_000_000 - between <= 1
    assert await host.ask("I") == 0


@directed("P006-CMD-53", "P006-STA-18", "P006-CMD-31")
async def p006_busy_is_up_before_the_reply(dut: Any) -> None:
    host = await constant_speed_host(dut)
    for count in (1, 300):
        await start(host, count)
        rise = host.edges("mon_busy", host.mark)[0]
        assert rise[1] == 1 and rise[0] - host.e <= EXECUTE
        assert (await host.status() & 1) == int(await host.busy()) or count == 1
        await wait_stopped(host)


@directed("P006-CMD-25", "P006-CMD-12", "P006-EXT-11", "P006-CMD-27")
async def p006_everything_else_works_while_locked(dut: Any) -> None:
    host = await Host.start(dut)
    await host.ok(f=3)
    await host.pins(ext1=0)
    await host.pins(ext2=0)
    await host.pause(20)
    assert await host.status() == DECAY | EXT1 | EXT2
    await host.ok(v=3000, L=400, S=500, u=2, o=3, d=0, m=4, a=0, e=1234, i=-9, J=3, y=0xA8)
    assert await host.status() == EXT1 | EXT2 and await host.ask("O") == EXT1_EN | EXT2_EN
    assert await host.ask("N", 1) == 0 and await host.ask("f", 0) == 0 and await host.ask("s", 1) == 0
    assert await host.ask("b") == 0 and await host.ask("N", 1) == 0
    assert await host.ask("l") == 0
    await start(host, 2)
    await wait_stopped(host)
    assert await host.position() == -11 and await host.ask("O") & FORWARD == 0
