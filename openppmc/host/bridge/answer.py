"""Answers of the UART bridge to scripts (docs/uart_bridge.md, UB-ANS-01, -02). Pure, no I/O."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from .script import IDENT_BYTES, VERSION_BYTES, Op, Script

PROTOCOL_VERSION = 1
IDENT_MARK = b"PPMC"


class Result(IntEnum):
    """RESULT of an answer (UB-ANS-02)."""

    DONE = 0
    TIMED_OUT = 1
    REFUSED = 2
    ILLEGAL = 3
    TOO_MUCH_DATA = 4
    INTERRUPTED = 5


@dataclass(frozen=True)
class Answer:
    """What came back: `values` holds the data of each op that gives some, in order.

    With result DONE it is complete. Otherwise `failed` is the op that ended the script (None if the position
    fits no op), `last` the byte last read from the part, and the data of the failed op come last, if any.
    """

    result: Result
    values: tuple[bytes, ...]
    failed: Op | None = None
    last: int = 0

    def byte(self, place: int) -> int:
        """The value at that place, of one byte."""
        (value,) = self.values[place]
        return value

    def number(self, place: int, signed: bool = False) -> int:
        """The value at that place as a little-endian number."""
        return int.from_bytes(self.values[place], "little", signed=signed)


class BadAnswer(ValueError):  # noqa: N818 - the noun says it
    """An answer that does not fit the script: the other side does not keep the contract."""


def parse_answer(script: Script, body: bytes) -> Answer:
    """Split an answer without its SEQ. Raises BadAnswer if it does not fit the script."""
    if not body:
        raise BadAnswer("an answer without a result")
    try:
        result = Result(body[0])
    except ValueError:
        raise BadAnswer(f"result {body[0]}") from None
    if result is Result.DONE:
        values, rest = _split(script.ops, body[1:])
        if rest:
            raise BadAnswer(f"{len(rest)} more data bytes than the ops give")
        return Answer(result, values)
    if len(body) < 3:
        raise BadAnswer(f"result {body[0]} without its position")
    position, last = body[1], body[2]
    done, failed = _op_at(script.ops, position)
    values, rest = _split(done, body[3:])
    if failed is not None and len(rest) > failed.gives:
        raise BadAnswer(f"{len(rest)} data bytes from an op that gives {failed.gives}")
    return Answer(result, (*values, rest) if rest else values, failed, last)


def _split(ops: list[Op], data: bytes) -> tuple[tuple[bytes, ...], bytes]:
    values = []
    for op in ops:
        if op.gives:
            if len(data) < op.gives:
                raise BadAnswer(f"{len(data)} data bytes where {op.name} gives {op.gives}")
            values.append(data[: op.gives])
            data = data[op.gives :]
    return tuple(values), data


def _op_at(ops: list[Op], position: int) -> tuple[list[Op], Op | None]:
    """Ops before the position, and the op there."""
    start = 0
    for place, op in enumerate(ops):
        if start == position:
            return ops[:place], op
        start += len(op.code)
    raise BadAnswer(f"position {position} is not the beginning of an op")


@dataclass(frozen=True)
class Identity:
    """Answer of IDENT. Frequencies in Hz; `best_rate` is a code into RATES."""

    version: int
    part: int
    datasheet: bool
    counter: bool
    best_rate: int
    xtal_hz: int
    clk_hz: int
    axes: int = 1

    @classmethod
    def parse(cls, data: bytes) -> Identity:
        """From the 16 bytes; BadAnswer if they do not begin with the mark."""
        if len(data) != IDENT_BYTES or data[:4] != IDENT_MARK:
            raise BadAnswer("no IDENT of a PPMC bridge")
        return cls(
            version=data[4],
            part=int.from_bytes(data[5:7], "little"),
            datasheet=bool(data[7] & 1),
            counter=bool(data[7] & 2),
            best_rate=data[7] >> 4,
            xtal_hz=int.from_bytes(data[8:12], "little"),
            clk_hz=int.from_bytes(data[12:16], "little"),
            axes=(data[7] >> 2 & 3) + 1,
        )


@dataclass(frozen=True)
class Build:
    """Answer of VERSION (UB-VER-01). version: as "0.3.1". changed: there were changes since the commit.
    source, commit: hexadecimal, "" if nobody knows; board: 4 letters, or ""."""

    version: str
    changed: bool
    source: str
    commit: str
    board: str

    @classmethod
    def parse(cls, data: bytes) -> Build | None:
        """From the 16 bytes; None if nobody knows. BadAnswer for anything but 16 bytes."""
        if len(data) != VERSION_BYTES:
            raise BadAnswer(f"VERSION of {len(data)} bytes")
        if not any(data):
            return None
        source, commit = (data[n : n + 4].hex() if any(data[n : n + 4]) else "" for n in (4, 8))
        board = data[12:].rstrip(b"\0").decode("ascii", "replace")
        return cls(".".join(map(str, data[:3])), bool(data[3] & 1), source, commit, board)
