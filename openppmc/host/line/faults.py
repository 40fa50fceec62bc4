"""What can go wrong between the master of a line and a station, and how often it did. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Fault(Enum):
    """Why bytes were no reply. FOREIGN: it came from another station; BROKEN: a wrong character or checksum;
    NOISE: bytes that belong to no reply."""

    FOREIGN = "another station replied"
    BROKEN = "a broken reply"
    NOISE = "stray bytes"


@dataclass
class Counters:
    """What has happened between the master and a station.

    sent: frames. repeated: of these, once more. silent: no reply; garbled: a broken one; foreign: another
    station replied; refused: the station says that a frame arrived broken (41). lost_reports: polls without a
    whole reply, with which a report may be gone.
    """

    sent: int = 0
    repeated: int = 0
    silent: int = 0
    garbled: int = 0
    foreign: int = 0
    refused: int = 0
    lost_reports: int = 0

    @property
    def faults(self) -> int:
        """All that went wrong on the line."""
        return self.silent + self.garbled + self.foreign + self.refused


@dataclass(frozen=True)
class Miss:
    """No reply. fault: why, None after silence. heard: bytes that came."""

    fault: Fault | None
    heard: bytes
