"""The bytes of a PPMC-104 host in words: commands, status, finish status, register reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

ERRORS = (
    "undefined command, or a stop at rest",
    "not allowed while BUSY",
    "not initialised",
    "data byte nobody asked for",
    "PA above 11220",
    "RH above RL, or PA below 4",
    "data byte nobody asked for while BUSY",
    "already decelerating",
)
OPERATIONS = {
    2: ("single step", 0),
    3: ("accelerate/decelerate", 3),
    4: ("constant speed", 4),
    5: ("continuous constant speed", 1),
    6: ("continuous high speed", 0),
    7: ("origin search", 1),
}
READS = {
    0x80: ("read finish status", 1),
    0x81: ("read input signals", 1),
    0x82: ("read output signals", 1),
    0x83: ("read remaining pulses", 3),
    0x85: ("read auxiliary inputs", 1),
}


def status_words(byte: int) -> str:
    """The status register: flags that are set, error or bytes still expected."""
    flags = [name for bit, name in ((4, "BUSY"), (2, "IBF"), (1, "OBF")) if byte & bit]
    number = byte >> 4 & 7
    if byte & 0x80:
        flags.append(f"error {number}: {ERRORS[number]}")
    elif number:
        flags.append(f"{number} more byte{'s' if number > 1 else ''} expected")
    return ", ".join(flags) or "ready, nothing pending"


def finish_words(byte: int) -> str:
    """The finish status: how the last operation ended."""
    name = OPERATIONS.get(byte & 7, ("no operation yet", 0))[0]
    causes = [
        text
        for bit, text in (
            (0x40, "a stop command"),
            (0x20, "ALM"),
            (0x10, "the limit"),
            (0x08, "the slow-down limit"),
        )
        if byte & bit
    ]
    if not byte & 7:
        return name
    return f"{name}: {'ended by ' + ' and '.join(causes) if causes else 'all pulses made'}"


def inputs_words(byte: int) -> str:
    """The input signals that are active (low)."""
    names = ((0x80, "CNP"), (0x40, "ALM"), (8, "L1"), (4, "L2"), (2, "L3"), (1, "L4"))
    active = [name for bit, name in names if not byte & bit]
    return f"active: {', '.join(active)}" if active else "no switch active"


def outputs_words(byte: int) -> str:
    """Phases, HOLD and DIR."""
    high = [f"S{index + 1}" for index in range(5) if byte & 0x80 >> index]
    hold, direction = "high" if byte & 4 else "low", "CCW" if byte & 2 else "CW"
    return f"{' '.join(high) or 'no phase'} high, HOLD {hold}, {direction}"


def init_words(code: int, data: Sequence[int]) -> str:
    """An initialisation command with its data."""
    step, level = "half" if code & 4 else "full", "high" if code & 8 else "low"
    phases = f"{(code & 3) + 2} phases, {step} step, {level} = on"
    clock = "CLOCK pin" if code & 0x10 else "internal clock"
    chop = "chopped at rest" if code & 0x20 else "full current at rest"
    text = f"initialise: {phases}, {clock}, {chop}"
    if len(data) == 4:
        text += f"; RL {data[0]}, RH {data[1]}, PA {data[2] | data[3] << 8}"
    return text


def command_words(code: int, data: Sequence[int]) -> str:
    """A command with its data bytes."""
    if code < 0x40:
        return init_words(code, data)
    if code in READS:
        return READS[code][0]
    if code & 0x40 and code & 7 in OPERATIONS:
        name, count = OPERATIONS[code & 7]
        words = [name, "CCW" if code & 8 else "CW"]
        values = list(data)
        if count in (1, 4) and values:
            words.append(f"rate {values.pop(0)}")
        if len(values) == 3:
            words.append(f"{(values[0] | values[1] << 8 | values[2] << 16) + 1} pulses")
        return ", ".join(words)
    return {0x40: "immediate stop", 0x41: "decelerating stop"}.get(code, f"command {code:02X}")


def answer_words(code: int, data: Sequence[int], stopped: bool) -> str:
    """What the bytes read after a read command mean; `stopped`: the last finish status named a cause."""
    if code == 0x80:
        return finish_words(data[0])
    if code == 0x81:
        return inputs_words(data[0])
    if code == 0x82:
        return outputs_words(data[0])
    if code == 0x83 and len(data) == 3:
        left = (data[0] | data[1] << 8 | data[2] << 16) + stopped
        return f"{left} pulses not made" if left else "no pulse left"
    return ""


@dataclass
class Exchange:
    """A command with its data, the answer, and the status bytes seen meanwhile; `t` in clk."""

    t: int
    sent: list[int] = field(default_factory=list)
    answer: list[int] = field(default_factory=list)
    polls: list[int] = field(default_factory=list)
    stopped: bool = False

    @property
    def meaning(self) -> str:
        """What was sent, in words."""
        return command_words(self.sent[0], self.sent[1:]) if self.sent else "look at the status register"

    @property
    def reply(self) -> str:
        """The answer in words; without one, the last status."""
        if self.sent and self.answer:
            return answer_words(self.sent[0], self.answer, self.stopped)
        return status_words(self.polls[-1]) if self.polls else ""

    @property
    def statuses(self) -> list[int]:
        """Status bytes with IBF = 0 in order, repeats dropped: what the chip made of each byte."""
        taken = [byte for byte in self.polls if not byte & 2]
        return [byte for index, byte in enumerate(taken) if index == 0 or byte != taken[index - 1]]


def exchanges(accesses: Sequence[Any]) -> list[Exchange]:
    """Fold the accesses of a host (t, kind, reg, byte) into exchanges: each begins with a command byte."""
    rows: list[Exchange] = []
    stopped = False
    for access in accesses:
        if access.kind == "write" and access.reg == 1:
            rows.append(Exchange(access.t, [access.byte], stopped=stopped))
            continue
        if not rows:
            rows.append(Exchange(access.t))
        if access.kind == "write":
            rows[-1].sent.append(access.byte)
        elif access.reg == 1:
            rows[-1].polls.append(access.byte)
        else:
            rows[-1].answer.append(access.byte)
            if rows[-1].sent == [0x80]:
                stopped = bool(access.byte & 0x78)
    return rows
