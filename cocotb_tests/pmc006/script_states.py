"""Scripts: which instruction is accepted in which state, and what it makes of the motion (4.1, 4.2, 4.3)."""

from __future__ import annotations

from typing import NamedTuple

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import (
    DECAY,
    EXT1,
    EXT1_EN,
    EXT2,
    EXT2_EN,
    FORWARD,
    FREE_RUN,
    SPEED_MODE,
    Op,
    after_steps,
    brisk,
    download,
    quick,
    rest,
    rot,
    run,
    start,
    still,
)
from .script_host import EXECUTE, Host

LONG = 50_000
EXTS = {"ext1": EXT1, "ext2": EXT2}


class State(NamedTuple):
    """What tells a state: motion ("", "move", "speed", "stopping"), FREE, EXT flags as in status 1."""

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


def enter(host: Host, state: State) -> None:
    """From whatever state."""
    for code in "Ibl":
        host.ask(code)
    host.ok(g=0)
    for pin, flag in EXTS.items():
        if state.flags & flag:
            host.pins(**{pin: 0})
            host.pause(20)
            host.pins(**{pin: 1})
    if state.free:
        host.ok(g=1)
    if state.motion == "move":
        start(host, LONG)
    elif state.motion:
        run(host)
        if state.motion == "stopping":
            run(host, 0)


def seen(host: Host) -> tuple[int, int]:
    """Status 1 without the decay, and what says the mode of status 2."""
    return host.status() & ~DECAY, host.ask("O") & (SPEED_MODE | FREE_RUN)


def shown(state: State) -> tuple[int, int]:
    """What `seen` has to be."""
    return bool(state.motion) | state.flags, SPEED_MODE * (state.motion == "speed") | FREE_RUN * state.free


def outcome(code: str, data: int, state: State, accepted: int) -> tuple[int, State]:
    """Row of the table in 4.2: reply data, next state."""
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


@pytest.mark.parametrize("name", list(STATES))
@verifies(*TABLE_RULES, *STATE_RULES, *BAD_RULES, "P006-CMD-25", "P006-CMD-31", "P006-EXT-05")
def test_every_row_in_every_state(name: str) -> None:
    host = Host()
    brisk(host, 3000, f=3)
    host.ok(S=65)
    state = STATES[name]
    after = None
    for code, data in ROWS:
        if after != state:
            enter(host, state)
        reply, after = outcome(code, data, state, host.accepted(data))
        before = host.model.position
        assert host.ask(code, data) == reply, f"{code} {data} in {name}"
        assert seen(host) == shown(after), f"{code} {data} in {name}"
        moves = not still(host, host.us(700))
        assert moves == bool(after.motion), f"{code} {data} in {name}"
        assert moves or state.motion or host.model.position == before


@pytest.mark.parametrize("name", ["idle", "move", "ext1", "free"])
@verifies("P006-PRG-17", "P006-PRG-20", "P006-STA-01")
def test_rot_is_accepted_like_s(name: str) -> None:
    """By E, whose reply does not tell."""
    host = Host()
    brisk(host, 3000, f=3)
    download(host, [rot(LONG)])
    enter(host, STATES[name])
    assert host.ask("E") == 1
    assert host.busy == (name in ("idle", "move"))
    assert still(host, host.us(700)) == (name not in ("idle", "move"))


@verifies("P006-STA-01", "P006-STA-02", "P006-BAD-10", "P006-CMD-43")
def test_speeds_against_the_maximum() -> None:
    """Equal is enough; speed mode does not care."""
    host = Host()
    for low, high, limit, good in (
        (600, 600, 599, False),
        (600, 600, 600, True),
        (601, 600, 600, False),
        (600, 601, 600, False),
        (65, 3000, 2999, False),
        (3000, 65, 3000, True),
    ):
        host.ok(L=low, S=high, v=limit)
        assert host.ask("s", LONG) == (host.accepted(LONG) if good else 0)
        assert host.busy == good
        assert host.ask("I") == 0
        run(host)
        assert host.busy and host.ask("I") == 0


@verifies("P006-STA-04", "P006-MOT-52", "P006-STA-01")
def test_analog_speed_does_not_refuse() -> None:
    """The full-scale speed counts, though the momentary one is 0; a full scale of 0 refuses everything."""
    host = Host()
    download(host, [Op(0x08, 1, 600), Op(0x08, 0, 0)])
    assert host.ask("E") == 1
    start(host, 300)
    assert host.busy and host.ask("I") == 0
    host.ok(A=2)
    assert host.ask("E") == 1 and host.ask("q") == 0
    assert host.ask("s", 5) == 0 and host.ask("N", 1) == 0 and not host.busy
    host.ok(v=600)
    start(host, 5)
    rest(host)
    assert len(host.steps()) == 5


@verifies("P006-STA-10", "P006-STA-12", "P006-STA-14", "P006-CMD-28", "P006-PRG-16")
def test_a_stop_while_planning() -> None:
    """Between acceptance and t = 0 there is time for one; no step is made."""
    host = quick()
    host.ok(f=3)
    download(host, [rot(5), Op(0x05, 0, 1)])
    assert host.ask("z") == 1
    assert still(host) and not host.busy and host.ask("O") & FREE_RUN and host.ask("g", 0) == 0
    host.say("s", 5)
    host.pins(ext2=0)
    assert host.hear() == host.accepted(5)
    assert still(host) and host.status() == DECAY | EXT2 and host.position() == 0
    assert not host.steps(0) and [level for _, level in host.edges("mon_busy")] == [1, 0, 1, 0]
    assert host.ask("l") == 0
    start(host, 3)
    rest(host)
    assert len(host.steps(0)) == 3


@verifies("P006-STA-10", "P006-STA-13", "P006-CMD-06")
def test_abort_stops_within_its_window() -> None:
    host = quick(3000)
    for begin in (lambda: start(host, LONG), lambda: run(host)):
        begin()
        after_steps(host, 7)
        assert host.ask("I", -1) == 0xFFFFFFFF
        assert not host.steps(host.edges("mon_busy")[-1][0] + 1) and not host.busy
        assert host.edges("mon_busy")[-1][0] - host.e <= EXECUTE + 5
        assert host.position() == len(host.steps(0)) and host.status() == DECAY


@verifies("P006-STA-15", "P006-CMD-30", "P006-CMD-24", "P006-CMD-52")
def test_position_set_on_the_run() -> None:
    """Wherever in the interval of a step it comes, no step is lost or doubled."""
    host = quick(3000)
    run(host)
    after_steps(host, 3)
    for shift in range(24):
        host.pause(37 + shift)
        assert host.ask("i", 1_000_000) == 1_000_000
        executed = host.e + EXECUTE
        between = len([t for t in host.steps(0) if t > host.e + 4])
        assert 0 <= host.model.position - 1_000_000 - between <= 1 and executed > host.e
    assert host.ask("I") == 0


@verifies("P006-CMD-53", "P006-STA-18", "P006-CMD-31")
def test_busy_is_up_before_the_reply() -> None:
    host = quick()
    for count in (1, 300):
        start(host, count)
        rise = host.edges("mon_busy", host.mark)[0]
        assert rise[1] == 1 and rise[0] - host.e <= EXECUTE
        assert (host.status() & 1) == int(host.busy) or count == 1
        rest(host)


@verifies("P006-CMD-25", "P006-CMD-12", "P006-EXT-11", "P006-CMD-27")
def test_everything_else_works_while_locked() -> None:
    host = Host()
    host.ok(f=3)
    host.pins(ext1=0)
    host.pins(ext2=0)
    host.pause(20)
    assert host.status() == DECAY | EXT1 | EXT2
    host.ok(v=3000, L=400, S=500, u=2, o=3, d=0, m=4, a=0, e=1234, i=-9, J=3, y=0xA8)
    assert host.status() == EXT1 | EXT2 and host.ask("O") == EXT1_EN | EXT2_EN
    assert host.ask("N", 1) == 0 and host.ask("f", 0) == 0 and host.ask("s", 1) == 0
    assert host.ask("b") == 0 and host.ask("N", 1) == 0
    assert host.ask("l") == 0
    start(host, 2)
    rest(host)
    assert host.position() == -11 and host.ask("O") & FORWARD == 0
