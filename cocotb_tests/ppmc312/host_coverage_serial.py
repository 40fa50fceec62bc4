"""Counts the events that random hosts on the line cause in the golden model of the PPMC-312.

Each count has a text as its key: "frame POLL", "reply A0", "reply B0 41", "overrun", "framing", "event",
"FF".
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from openppmc.model.ppmc312.codes import Source
from openppmc.model.ppmc312.front.serial import SPECIFIC, Frame
from openppmc.model.ppmc312.front.station import Station
from openppmc.model.ppmc312.part import Ppmc312

LEAST: dict[str, int] = {
    "FF HOST": 40,
    "FF EVENT": 1,
    "answer EVENT": 12,
    "answer HOST": 400,
    "answer OVERRIDE": 10,
    "frame FAULT": 25,
    "frame POLL": 300,
    "frame UNKNOWN": 1,
    "framing": 50,
    "overrun": 70,
    "silence": 3,
    "reply 80": 40,
    "reply 90": 500,
    "reply A0": 80,
    **dict.fromkeys((f"reply B0 {note}" for note in ("22", "23", "24", "25", "26", "27")), 2),
    "reply B0 28": 5,
    "reply B0 29": 5,
    "reply B0 2a": 20,
    "reply B0 41": 25,
    "reply B0 42": 10,
    "reply B0 43": 25,
    "reply B0 44": 2,
    "reply B0 46": 5,
    "reply B0 47": 1,
    "reply B0 49": 7,
    "reply B0 4a": 4,
    "reply B0 4b": 4,
}
"""Minimum number of each event in the hosts of `make test`."""


@contextmanager
def counting_frames() -> Iterator[Counter[str]]:
    """Count all frames that stations receive and all replies that they send."""
    counts: Counter[str] = Counter()
    take, send, hear, answer = Station._take, Station._send, Station._character, Station.answer
    silent, reset = Station._silent, Ppmc312._software_reset

    def counted_take(self: Station, t: int, finished: Frame) -> None:
        counts[f"frame {finished.outcome.name}"] += 1
        take(self, t, finished)

    def counted_send(self: Station, t: int, message: bytes) -> None:
        kind = message[0] & 0xF0
        counts[f"reply {kind:02X}" + (f" {message[1:3].decode()}" if kind == SPECIFIC else "")] += 1
        send(self, t, message)

    def counted_hear(self: Station, t: int, byte: int | None) -> None:
        before = self.framing, self.overruns
        hear(self, t, byte)
        counts["character"] += 1
        counts["framing"] += self.framing - before[0]
        counts["overrun"] += self.overruns - before[1]

    def counted_answer(self: Station, t: int, source: Source, block: bytes) -> None:
        counts[f"answer {source.name}"] += 1
        answer(self, t, source, block)

    def counted_silent(self: Station, t: int) -> None:
        counts["silence"] += 1
        silent(self, t)

    def counted_reset(self: Ppmc312, t: int, source: Any) -> None:
        counts[f"FF {source.name}"] += 1
        reset(self, t, source)

    with (
        patch.object(Station, "_take", counted_take),
        patch.object(Station, "_send", counted_send),
        patch.object(Station, "_character", counted_hear),
        patch.object(Station, "answer", counted_answer),
        patch.object(Station, "_silent", counted_silent),
        patch.object(Ppmc312, "_software_reset", counted_reset),
    ):
        yield counts


def thin_frames(counts: Counter[str]) -> dict[str, tuple[int, int]]:
    """Return event -> (number seen, number needed), for the events that are too rare."""
    return {kind: (counts[kind], least) for kind, least in LEAST.items() if counts[kind] < least}
