"""Frames on the line of the PPMC-312 as pairs of question and answer, with their meaning as text."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from openppmc.check.records import Recording
from openppmc.model.ppmc312.front.serial import END_CODES

KINDS = {0x80: "busy", 0x90: "ready", 0xA0: "data", 0xB0: "specific"}
CAUSES = {code: cause.name.lower().replace("_", " ") for cause, code in END_CODES.items()}
STARTS = {0x83: "accelerate/decelerate, CW", 0xA3: "accelerate/decelerate, CCW"}


@dataclass(frozen=True)
class Exchange:
    """A frame of the master from edge `begin` to `sent_end`, and its reply from `replied` to `end`."""

    begin: int
    sent_end: int
    replied: int
    end: int
    question: bytes
    answer: bytes

    @property
    def station(self) -> int:
        """Number of the station that the question addresses."""
        return self.question[0] & 15

    @property
    def data(self) -> bytes:
        """Data of the question; empty for a poll."""
        return bytes.fromhex(self.question[1:-1].decode())

    @property
    def code(self) -> int:
        """Instruction code of the question; 0 for a poll, 100h for the initial setting."""
        return (self.data[0] or 0x100) if self.data else 0

    @property
    def kind(self) -> str:
        """Kind of the answer; "" if there is no answer."""
        return KINDS[self.answer[0] & 0xF0] if self.answer else ""

    @property
    def content(self) -> bytes:
        """Data in the answer."""
        return bytes.fromhex(self.answer[1:-1].decode())

    @property
    def sent(self) -> str:
        """The question as text: control code and checksum in hexadecimal, the other characters unchanged."""
        return as_text(self.question)

    @property
    def got(self) -> str:
        """The answer as text, in the format of the question."""
        return as_text(self.answer)

    @property
    def meaning(self) -> str:
        """The meaning of the question as text."""
        data, number = self.data, f"station {self.station}: "
        if not data:
            return number + "poll"
        if self.code == 0x100:
            slow, fast, pulses = (int.from_bytes(data[a:b], "big") for a, b in ((2, 4), (4, 6), (6, 9)))
            return f"{number}initial setting, rates {slow} to {fast}, {pulses} pulses"
        if data[0] in STARTS:
            return f"{number}{STARTS[data[0]]}, {int.from_bytes(data[3:7], 'big')} pulses"
        return number + {0x42: "read pulse position"}.get(data[0], f"instruction {data[0]:02X}")

    @property
    def reply(self) -> str:
        """The meaning of the answer as text."""
        if self.kind != "data":
            return self.kind if self.kind != "specific" else f"report {self.content.hex()}"
        if not self.code:
            return f"stopped: {CAUSES.get(self.content[0], '?')}"
        if self.code == 0x42:
            return str(int.from_bytes(self.content, "big", signed=True))
        return f"data {self.content.hex(' ')}"


def as_text(frame: bytes) -> str:
    """Return a frame as text, such as `92 "0a" 6D`: control code, characters, checksum."""
    if not frame:
        return ""
    middle = f' "{frame[1:-1].decode()}"' if len(frame) > 2 else ""
    return f"{frame[0]:02X}{middle} {frame[-1]:02X}"


def exchanges(talk: Sequence[Sequence[int | str]]) -> list[Exchange]:
    """Return the exchanges of frames given as (begin, end, "master" or "station", hex) in order of time."""
    found: list[Exchange] = []
    for begin, end, who, text in talk:
        begin, end, data = int(begin), int(end), bytes.fromhex(str(text))
        if who == "master":
            found.append(Exchange(begin, end, end, end, data, b""))
        elif found:
            request = found[-1]
            found[-1] = Exchange(request.begin, request.sent_end, begin, end, request.question, data)
    return found


@dataclass(frozen=True)
class LineRun:
    """Result of a run: the recording of the line, chapters, exchanges, and the positions that were read."""

    recording: Recording
    chapters: list[dict[str, Any]]
    talk: list[Exchange]
    positions: list[int]


def load(folder: Path) -> LineRun:
    """Read the result of a run from its folder."""
    data = json.loads((folder / "talk.json").read_text())
    return LineRun(
        Recording.from_json((folder / "recording.json").read_text()),
        json.loads((folder / "chapters.json").read_text()),
        exchanges(data["talk"]),
        data["positions"],
    )
