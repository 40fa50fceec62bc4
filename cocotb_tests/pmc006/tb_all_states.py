"""Every instruction code in each state of the motion, and during a program or a save."""

from __future__ import annotations

from typing import Any, NamedTuple

import cocotb

from .builds import directed
from .chip import Chip
from .host import Host
from .moves import download
from .programs import goto, out

FLAT = {"v": 600, "L": 600, "S": 600, "u": 0}
STEEP = {"v": 16_000, "L": 65, "S": 65, "u": 5}
"""Settings for a motion with a constant rate, and for a motion whose rate changes for a long time."""
LONG = 1_000_000
LOOP, OUT = 0, 2
"""Program pointer: index of a jump to itself, and of an instruction that the host may execute."""
PROGRAM = (goto(0), out(1, 1))


class State(NamedTuple):
    """A state of the part.

    Attributes:
        begun: codes of the frames that lead from standstill into the state.
        speeds: settings that are written before these frames.
    """

    begun: str = ""
    speeds: dict[str, int] = FLAT


STATES = {
    "at rest": State(),
    "blocked": State("g"),
    "rate changing": State("s", STEEP),
    "rate constant": State("s"),
    "speed mode": State("N"),
    "program": State("z"),
    "save": State("t"),
}
DATA = {"g": 1, "s": LONG, "N": 1}
MOVING = ("s", "N")

REPLIES: dict[str, int | None] = {
    **{"A": OUT, "B": 1, "E": 1, "F": 1, "G": PROGRAM[1].words[0], "I": 77, "J": 3, "K": 3, "M": 300, "N": 0},
    **{"P": 1250, "Q": 1, "R": 0x123, "T": 64, "U": 1, "V": 0, "W": PROGRAM[1].words[0], "X": 0, "Y": 0},
    **{"Z": 0, "a": 1, "b": 0, "d": 1, "e": 800, "f": 0, "g": 0, "h": 0, "i": 5, "k": 16, "l": 0, "m": 16},
    **{"n": 800, "o": 0, "p": 0, "t": 1, "w": 0xFF, "y": 0, "z": 1, "H": 0},
    # The replies to these codes depend on the state, and the comparison with the golden model checks them.
    **dict.fromkeys("OcjxLSuvqrs"),
}
"""Code -> reply to the code with its data at standstill. Code H is undefined."""
UNLIKE = {"R": 1, "T": -1, "y": 7, "w": 0, "H": 1}
"""Code -> data to send, for codes whose reply is not the data."""
AT = {"E": OUT, "G": OUT, "W": OUT, "z": LOOP}
"""Code -> value that the program pointer must have before the code is sent."""
DISTURBS = "BEFINgstz"


def reply(code: str, name: str, speeds: dict[str, int], accepted: int) -> int | None:
    """Return the reply that the rules require for a code in a state."""
    if name == "program" and code in "EWz":
        return 0
    if name == "save" and code in "BtV":
        return int(code == "V")
    if code == "s":
        return accepted if name in ("at rest", "program", "save") else 0
    return speeds.get({"q": "v", "r": "u"}.get(code, code), REPLIES[code])


async def enter(host: Host, state: State) -> None:
    """Enter a state from any other state."""
    assert await host.ask("I", 1) == 1
    await host.ok(F=0, g=0, A=LOOP)
    while await host.ask("V"):
        await host.ms(1)
    for code in state.begun:
        assert await host.ask(code, DATA.get(code, 0))


@cocotb.parametrize(name=list(STATES))
@directed(
    "P006-CMD-02", "P006-CMD-06", "P006-CMD-18", "P006-CMD-41", "P006-CMD-53", "P006-CMD-56", "P006-BAD-07"
)
async def p006_every_code(dut: Any, name: str) -> None:
    """Each code has the reply that the rules require, and only codes that end a motion end the motion."""
    host = await Host.start(dut, chip=Chip(write_us=4_000))
    state = STATES[name]
    await download(host, PROGRAM)
    await host.ok(J=3, **state.speeds)
    disturbed = True
    for code in REPLIES:
        if disturbed or name in ("rate changing", "save"):
            await enter(host, state)
        if code in AT:
            await host.ok(A=AT[code])
        expected = reply(code, name, state.speeds, host.accepted(9))
        data = 9 if code == "s" else UNLIKE.get(code, expected or 0)
        got = await host.ask(code, data)
        assert expected in (None, got), f"{code} {data} {name}: {got:#x} instead of {expected:#x}"
        if code not in "NIs":
            assert await host.busy() == (state.begun in MOVING), f"{code} {name}"
        disturbed = code in DISTURBS
