"""What a bridge's recorder has seen (docs/uart_bridge.md, UB-REC): its answer, its records. Pure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from .answer import BadAnswer
from .script import RECORDED_BYTES


@dataclass(frozen=True)
class Recorded:
    """Answer of RECORDED. record_bytes: of one record, time_bits of them count clk. most: records that there
    is room for. running: it records still. full: there was no room for one. count: records so far."""

    record_bytes: int
    time_bits: int
    most: int
    running: bool
    full: bool
    count: int

    @property
    def width(self) -> int:
        """Levels in a record."""
        return 8 * self.record_bytes - self.time_bits

    @classmethod
    def parse(cls, data: bytes) -> Recorded:
        """From the 16 bytes; BadAnswer if they make no sense."""
        if len(data) != RECORDED_BYTES or not 0 < data[1] < 8 * data[0] or data[2] > 24:
            raise BadAnswer(f"RECORDED {data.hex()}")
        count = int.from_bytes(data[4:8], "little")
        return cls(data[0], data[1], 1 << data[2], bool(data[3] & 1), bool(data[3] & 2), count)

    def samples(self, data: bytes) -> Iterator[tuple[int, int]]:
        """(clk since the first record, levels) of each whole record in these bytes."""
        now = 0
        for start in range(0, len(data) - self.record_bytes + 1, self.record_bytes):
            word = int.from_bytes(data[start : start + self.record_bytes], "little")
            now += word & (1 << self.time_bits) - 1
            yield now, word >> self.time_bits
