"""Conversion of the bridge's records to a recording of the part (UB-REC).

A recording contains the time of every change of a pin.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...check.records import Access, Change, Edge, Recording
from ..script import RECORDED_BYTES, BadAnswer

# Records of the bridge (docs/uart_bridge.md, UB-REC).


@dataclass(frozen=True)
class Recorded:
    """Answer to RECORDED.

    Attributes:
        record_bytes: number of bytes of one record.
        time_bits: number of bits of the cycle counter in a record.
        most: number of records that fit into the recorder.
        running: True if the recorder is recording.
        full: True if a record was dropped because the recorder was full.
        count: number of records so far.
    """

    record_bytes: int
    time_bits: int
    most: int
    running: bool
    full: bool
    count: int

    @property
    def width(self) -> int:
        """Number of pin levels in a record."""
        return 8 * self.record_bytes - self.time_bits

    @classmethod
    def parse(cls, data: bytes) -> Recorded:
        """Decode the 16 bytes of the answer. Raises BadAnswer if they are invalid."""
        if len(data) != RECORDED_BYTES or not 0 < data[1] < 8 * data[0] or data[2] > 24:
            raise BadAnswer(f"RECORDED {data.hex()}")
        count = int.from_bytes(data[4:8], "little")
        return cls(data[0], data[1], 1 << data[2], bool(data[3] & 1), bool(data[3] & 2), count)

    def samples(self, data: bytes) -> Iterator[tuple[int, int]]:
        """Yield (cycles since the first record, levels) for each complete record in `data`."""
        now = 0
        for start in range(0, len(data) - self.record_bytes + 1, self.record_bytes):
            word = int.from_bytes(data[start : start + self.record_bytes], "little")
            now += word & (1 << self.time_bits) - 1
            yield now, word >> self.time_bits


Layout = Sequence[tuple[str, int]]
SETTLE = 2
"""Number of cycles from the falling edge of rst_n until the outputs have their reset levels."""


class NoReset(ValueError):  # noqa: N818 - names the missing object
    """The records contain no reset of the part. A golden model must begin with a reset."""


def pins_of(layout: Layout, levels: int) -> dict[str, int]:
    """Return the level of each pin from the levels of a record."""
    found = {}
    for pin, width in layout:
        found[pin] = levels & (1 << width) - 1
        levels >>= width
    return found


def reset_levels(samples: Sequence[tuple[int, int]], layout: Layout) -> dict[str, int]:
    """Return the levels of the pins while the part is in reset. Raises NoReset."""
    for t, pins in _in_reset(samples, layout):
        if t >= SETTLE:
            return pins
    raise NoReset("no reset was recorded")


def _in_reset(samples: Sequence[tuple[int, int]], layout: Layout) -> Iterator[tuple[int, dict[str, int]]]:
    """Yield (cycles since rst_n fell, levels of the pins) during the first reset.

    For each record, the generator yields the levels at the record, and again one cycle before the next
    record.
    """
    fell, pins = None, dict[str, int]()
    for t, levels in samples:
        if fell is not None:
            yield t - 1 - fell, pins
        pins = pins_of(layout, levels)
        if not pins["rst_n"]:
            fell = t if fell is None else fell
            yield t - fell, pins
        elif fell is not None:
            return


def recording_of(
    samples: Sequence[tuple[int, int]],
    layout: Layout,
    part: str,
    params: Mapping[str, object],
    inputs: Mapping[str, int],
    outputs: Mapping[str, int],
) -> Recording:
    """Return the recording of the part, beginning with its reset.

    If an output does not have its reset level in reset, the recording contains an additional edge of this
    output, which the comparison reports as a difference.

    Args:
        samples: (cycle, levels) of all records.
        inputs: idle levels of the inputs.
        outputs: levels of the outputs in reset.

    Raises:
        NoReset: no reset was recorded.
    """
    fell = next((t for t, levels in samples if not pins_of(layout, levels)["rst_n"]), None)
    if fell is None:
        raise NoReset("no reset was recorded")
    watched = [name for name, _ in layout]
    now = {**inputs, "rst_n": 0}
    out = {name: level for name, level in outputs.items() if name in watched}
    # Earlier states of the part are irrelevant: the model is in reset until the recorded reset ends.
    stimulus = [Change(0, "rst_n", 0)]
    edges: list[Edge] = []
    for t, levels in _from(samples, fell):
        for pin, level in pins_of(layout, levels).items():
            if pin in out and t >= fell + SETTLE and out[pin] != level:
                out[pin] = level
                edges.append(Edge(t - 1, pin, level))
            elif pin in now and now[pin] != level:
                now[pin] = level
                stimulus.append(Change(t, pin, level))
    end = samples[-1][0] - 1
    return Recording(part, dict(params), 0, end, stimulus, edges, list(_accesses(stimulus, edges, now)))


def _from(samples: Sequence[tuple[int, int]], fell: int) -> Iterator[tuple[int, int]]:
    """Yield the records from the reset on.

    The generator also yields the levels at the time `SETTLE` after the start of the reset, when the outputs
    must have their reset levels.
    """
    looked = False
    before = samples[0][1]
    for t, levels in samples:
        if t > fell + SETTLE and not looked:
            looked = True
            yield fell + SETTLE, before
        looked = looked or t == fell + SETTLE
        before = levels
        if t >= fell:
            yield t, levels


def _accesses(stimulus: Iterable[Change], edges: Iterable[Edge], pins: Mapping[str, int]) -> Iterator[Access]:
    """Yield the host's writes and reads, which reports of differences contain.

    The time of a write is the end of its write strobe, the time of a read the end of its read strobe.
    """
    names = [next((n for n in group if n in pins), "") for group in (("wr_n", "we_n", "ds_wrs_n"),)]
    reads = next((n for n in ("rd_n", "oe_n", "rw_rds_n") if n in pins), "")
    where = next((n for n in ("a0", "rs", "a") if n in pins), "")
    levels = {"d_i": 0, where: 0, "d_o": 0}
    rows = [(c.t, 1, c.pin, c.value) for c in stimulus] + [(e.t, 0, e.signal, e.value) for e in edges]
    for t, _, pin, value in sorted(rows):
        if pin in levels:
            levels[pin] = value
        elif pin == names[0] and value:
            yield Access(t, "write", levels[where], levels["d_i"])
        elif pin == reads and value:
            yield Access(t, "read", levels[where], levels["d_o"])
