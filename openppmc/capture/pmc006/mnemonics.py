"""Frames of a PMC006B4 host as text."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from openppmc.model.pmc006.line import command, reply

from ..common.mnemonics import CommandDecoder

MEANINGS = {
    "A": "program pointer {}",
    "B": "burn the program",
    "E": "carry out one line",
    "F": "run after power-up: {}",
    "G": "read a program word",
    "I": "stop at once",
    "J": "edges of the emergency inputs {}",
    "K": "edges of the emergency inputs?",
    "L": "start speed {} pps",
    "M": "current compensation {}",
    "N": "speed mode {}",
    "O": "status 2?",
    "P": "speed compensation {}",
    "Q": "attenuation {}",
    "R": "version?",
    "S": "stop speed {} pps",
    "T": "stall length {}",
    "U": "attenuation?",
    "V": "state of the EEPROM?",
    "W": "program word {:08X}",
    "X": "position of the stall?",
    "Y": "stall configuration {}",
    "Z": "stall level {}",
    "a": "reduction at rest: {}",
    "b": "clear EXT1",
    "c": "position?",
    "d": "direction {}",
    "e": "current {} mA",
    "f": "emergency inputs {}",
    "g": "free: {}",
    "h": "deceleration coefficient?",
    "i": "position := {}",
    "j": "status 1?",
    "k": "microsteps?",
    "l": "clear EXT2",
    "m": "{} microsteps",
    "n": "current?",
    "o": "deceleration coefficient {}",
    "p": "clear the stall",
    "q": "maximum speed?",
    "r": "acceleration coefficient?",
    "s": "move {} steps",
    "t": "save the settings",
    "u": "acceleration coefficient {}",
    "v": "maximum speed {} pps",
    "w": "address {}",
    "x": "ports?",
    "y": "outputs {}",
    "z": "run the program",
}
FLAGS = ("busy", "stopped by EXT1", "stopped by EXT2", "", "stalled")
KIND = re.compile(r"(?:'(.)' to|reply of) (\w\w), data")


def signed(data: int) -> int:
    """Return 32 bits as a signed number."""
    return data - (1 << 32) if data >> 31 else data


def status(data: int) -> str:
    """Return status 1 as text."""
    return ", ".join(text for bit, text in enumerate(FLAGS) if text and data >> bit & 1) or "at rest"


@dataclass
class Exchange006:
    """Frame and its reply. Repeated polls of the status are one row, which contains the last reply."""

    t: int
    letter: str
    data: int
    sent: list[int]
    answer: list[int] = field(default_factory=list)
    got: int = 0
    polls: list[int] = field(default_factory=list)
    statuses: tuple[int, ...] = ()
    more: int = 0

    @property
    def meaning(self) -> str:
        """Instruction as text."""
        text = MEANINGS.get(self.letter, f"{self.letter} {{}}").format(
            self.data if self.letter == "W" else signed(self.data)
        )
        return f"{text}, and {self.more} more" if self.more else text

    @property
    def reply(self) -> str:
        """Data of the reply as text."""
        if self.letter == "j":
            return status(self.got)
        if self.letter == "s":
            return "accepted" if self.got else "refused"
        return f"{self.got:08X}" if self.letter == "W" else str(signed(self.got))


class Pmc006Decoder(CommandDecoder):
    """Decoder for the bytes of a PMC006B4; units are steps and pps."""

    unit, speed, rate = "step", "thousand pps", "pps"

    def exchanges(self, accesses: Iterable[Any]) -> list[Exchange006]:
        """Return one row for each frame with its reply.

        The accesses are those that the script host records. Consecutive polls of a moving motor are combined
        in one row. The words of a program are also combined in one row.
        """
        rows: list[Exchange006] = []
        for access in accesses:
            found = KIND.fullmatch(access.kind)
            assert found, access.kind
            what, address = found.groups()
            if what is None:
                rows[-1].answer = list(reply(int(address, 16), access.byte))
                rows[-1].got = access.byte
                if rows[-1].letter == "j":
                    rows[-1].polls.append(access.byte)
                continue
            sent = list(command(int(address, 16), what, access.byte))
            if rows and rows[-1].letter == what == "j":
                continue
            if rows and rows[-1].letter == what == "W":
                rows[-1].more += 1
                continue
            rows.append(Exchange006(access.t, what, access.byte, sent))
        return rows
