"""Scripts for the UART bridge and its answers (UB-ANS-01, -02). Pure.

See "Ops" in docs/uart_bridge.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from .check import within
from .frames import CRC_BYTES, REQUEST_LIMIT

LONGEST_SCRIPT = REQUEST_LIMIT - CRC_BYTES - 1
MOST_DATA = 256
DEFAULT_WAIT_MS = 250
IDENT_BYTES = 16
VERSION_BYTES = 16
RECORDED_BYTES = 16

RATES = (115_200, 230_400, 460_800, 921_600, 1_000_000, 2_000_000, 3_000_000)
"""Line rates in baud by rate code; code 0 is the rate after reset (UB-LIN-02)."""


@dataclass(frozen=True)
class Op:
    """Operation: its bytes, and the number of data bytes that it returns."""

    name: str
    code: bytes
    response_size: int = 0


def _within(name: str, value: int, low: int, high: int) -> int:
    return within(value, name, low, high)


class Script:
    """List of operations, built by chaining: `Script().call(0x80).get(1)`.

    Every method raises ValueError in three cases: an operand is out of range, the script would be longer than
    253 bytes, or it would return more than 256 data bytes.
    """

    def __init__(self) -> None:
        self.ops: list[Op] = []
        self._size = 0
        self.response_size = 0
        """Number of data bytes of a complete answer."""
        self._wait_ms = DEFAULT_WAIT_MS
        self._mailbox_ms = 0
        self._waits_ms = 0

    def __bytes__(self) -> bytes:
        return b"".join(op.code for op in self.ops)

    @property
    def patience(self) -> float:
        """Longest expected run time in s: the time limits of all waits, plus one for the mailbox."""
        return (self._waits_ms + self._mailbox_ms) / 1000

    def _add(self, name: str, code: bytes, gives: int = 0, mailbox: bool = False) -> Script:
        if self._size + len(code) > LONGEST_SCRIPT:
            raise ValueError(f"the script would be longer than {LONGEST_SCRIPT} bytes")
        if self.response_size + gives > MOST_DATA:
            raise ValueError(f"the script would give more than {MOST_DATA} data bytes")
        if mailbox:
            self._mailbox_ms = max(self._mailbox_ms, self._wait_ms)
        self.ops.append(Op(name, code, gives))
        self._size += len(code)
        self.response_size += gives
        return self

    def extend(self, other: Script) -> Script:
        """Append all operations of another script."""
        for op in other.ops:
            self._add(op.name, op.code, op.response_size, mailbox=op.name in ("POST", "CALL", "GET"))
        self._mailbox_ms = max(self._mailbox_ms, other._mailbox_ms)
        self._waits_ms += other._waits_ms
        if any(op.name == "TIMEOUT" for op in other.ops):
            self._wait_ms = other._wait_ms
        return self

    # ------------------------------------------------------------------ operations of the bridge

    def nop(self) -> Script:
        """Append an operation that has no effect."""
        return self._add("NOP", b"\x00")

    def ident(self) -> Script:
        """Append a read of the identity of bridge and part, 16 bytes; see `Identity`."""
        return self._add("IDENT", b"\x01", IDENT_BYTES)

    def rate(self, code: int) -> Script:
        """Append a change of the line rate to RATES[code], which takes effect after this answer."""
        return self._add("RATE", bytes([0x02, _within("rate code", code, 0, len(RATES) - 1)]))

    def events(self, on: bool) -> Script:
        """Append an operation that enables or disables the event messages, sent when int_n falls."""
        return self._add("EVENTS", bytes([0x03, int(on)]))

    def timeout(self, milliseconds: int) -> Script:
        """Append an operation that sets the time limit of the following waits, 0 to 65535 ms."""
        _within("time limit in ms", milliseconds, 0, 0xFFFF)
        self._wait_ms = milliseconds
        return self._add("TIMEOUT", b"\x04" + milliseconds.to_bytes(2, "little"))

    def reset(self) -> Script:
        """Append a reset of the part."""
        return self._add("RESET", b"\x05")

    def pins(self) -> Script:
        """Append a read of the pin levels of the part, 1 byte."""
        return self._add("PINS", b"\x06", 1)

    def straps(self, levels: int) -> Script:
        """Append a write of the strap pins, 8 bits."""
        return self._add("STRAPS", bytes([0x07, _within("straps", levels, 0, 255)]))

    def count(self, axis: int = 1) -> Script:
        """Append a read of the signed pulse counter of axis 1 or 2, 4 bytes."""
        return self._add("COUNT", bytes([0x06 + 2 * _within("axis", axis, 1, 2)]), 4)

    def zero(self, axis: int = 1) -> Script:
        """Append a reset of the pulse counter of axis 1 or 2 to 0."""
        return self._add("ZERO", bytes([0x07 + 2 * _within("axis", axis, 1, 2)]))

    def version(self) -> Script:
        """Append a read of the build of the bitstream, 16 bytes; see `Build`."""
        return self._add("VERSION", b"\x0c", VERSION_BYTES)

    # ------------------------------------------------------------------ operations of the recorder

    def record(self, on: bool) -> Script:
        """Append an operation that starts or ends the recording."""
        return self._add("RECORD", bytes([0x0D, int(on)]))

    def rewind(self) -> Script:
        """Append a rewind. The next read of records begins with the first record."""
        return self._add("RECORD", b"\x0d\x02")

    def recorded(self) -> Script:
        """Append a read of the state of the recorder, 16 bytes; see `Recorded`."""
        return self._add("RECORDED", b"\x0e", RECORDED_BYTES)

    def fetch(self, n: int) -> Script:
        """Append a read of the next n = 1 to 255 bytes of the records."""
        return self._add("FETCH", bytes([0x90, _within("count", n, 1, 255)]), n)

    # ------------------------------------------------------------------ operations of the part's registers

    def write(self, a: int, byte: int) -> Script:
        """Append one write access to register a."""
        return self._add("WRITE", bytes([0x10 | _register(a), _within("byte", byte, 0, 255)]))

    def read(self, a: int) -> Script:
        """Append one read access to register a; it returns 1 byte."""
        return self._add("READ", bytes([0x20 | _register(a)]), 1)

    def read_many(self, a: int, n: int) -> Script:
        """Append n = 1 to 255 read accesses to register a; they return n bytes."""
        return self._add("READN", bytes([0x30 | _register(a), _within("count", n, 1, 255)]), n)

    def read_number(self, a: int, n: int) -> Script:
        """Append a read of n = 1 to 4 successive registers, the first is a; it returns n bytes."""
        _within("count", n, 1, 4)
        return self._add("READ", bytes(0x20 | _register(place) for place in range(a, a + n)), n)

    def post(self, a: int, data: bytes) -> Script:
        """Append writes of 1 to 255 bytes to register a, each when the part accepts it (IBF = 0)."""
        _within("number of bytes", len(data), 1, 255)
        return self._add("POST", bytes([0x40 | _register(a), len(data)]) + data, mailbox=True)

    def call(self, command: int, *data: int) -> Script:
        """Append a command byte with up to 14 data bytes. The bridge checks for an error after each byte.

        The operation returns 1 byte, the last status.
        """
        _within("number of command bytes", 1 + len(data), 1, 15)
        for byte in (command, *data):
            _within("byte", byte, 0, 255)
        return self._add("CALL", bytes([0x50 | 1 + len(data), command, *data]), 1, mailbox=True)

    def get(self, n: int) -> Script:
        """Append a read of n = 1 to 15 bytes from the part. Each byte is read when it is valid (OBF = 1)."""
        return self._add("GET", bytes([0x60 | _within("count", n, 1, 15)]), n, mailbox=True)

    def wait(self, a: int, mask: int, value: int) -> Script:
        """Append a wait until (register a AND mask) = value; it returns the byte of the register."""
        _within("mask", mask, 0, 255)
        _within("value", value, 0, 255)
        self._waits_ms += self._wait_ms
        return self._add("WAIT", bytes([0x70 | _register(a), mask, value]), 1)

    def write_many(self, a: int, data: bytes) -> Script:
        """Append 1 to 255 write accesses to register a, without a wait between them."""
        _within("number of bytes", len(data), 1, 255)
        return self._add("WRITEN", bytes([0x80 | _register(a), len(data)]) + data)


def _register(a: int) -> int:
    return _within("register", a, 0, 15)


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
    """Answer to a script.

    The answer is complete if its result is DONE.

    Attributes:
        values: data of each operation that returns data, in order. If an operation failed, the data that it
            returned before are the last entry.
        failed: operation that ended the script early; `None` if POS is not the position of an operation.
        last: last byte that was read from the part.
    """

    result: Result
    values: tuple[bytes, ...]
    failed: Op | None = None
    last: int = 0

    def byte(self, place: int) -> int:
        """Return the value with index `place`, which has one byte."""
        (value,) = self.values[place]
        return value

    def number(self, place: int, signed: bool = False) -> int:
        """Return the value with index `place` as a little-endian number."""
        return int.from_bytes(self.values[place], "little", signed=signed)


class BadAnswer(ValueError):  # noqa: N818 - names the invalid object
    """The answer does not match the script: the device that sent it violates the protocol."""


def parse_answer(script: Script, body: bytes) -> Answer:
    """Decode an answer without its SEQ. Raises BadAnswer if it does not match the script."""
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
    if failed is not None and len(rest) > failed.response_size:
        raise BadAnswer(f"{len(rest)} data bytes from an op that gives {failed.response_size}")
    return Answer(result, (*values, rest) if rest else values, failed, last)


def _split(ops: list[Op], data: bytes) -> tuple[tuple[bytes, ...], bytes]:
    values = []
    for op in ops:
        if op.response_size:
            if len(data) < op.response_size:
                raise BadAnswer(f"{len(data)} data bytes where {op.name} gives {op.response_size}")
            values.append(data[: op.response_size])
            data = data[op.response_size :]
    return tuple(values), data


def _op_at(ops: list[Op], position: int) -> tuple[list[Op], Op | None]:
    """Return the operations before this position in the script, and the operation at the position."""
    start = 0
    for place, op in enumerate(ops):
        if start == position:
            return ops[:place], op
        start += len(op.code)
    raise BadAnswer(f"position {position} is not the beginning of an op")


@dataclass(frozen=True)
class Identity:
    """Answer to IDENT. Frequencies are in Hz; `best_rate` is an index of RATES."""

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
        """Decode the 16 bytes of the answer. Raises BadAnswer if they do not begin with the mark."""
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
    """Answer to VERSION (UB-VER-01).

    Attributes:
        version: for example "0.3.1".
        changed: True if the sources differed from those of the commit.
        source, commit: hexadecimal, "" if unknown.
        board: 4 letters, or "".
    """

    version: str
    changed: bool
    source: str
    commit: str
    board: str

    @classmethod
    def parse(cls, data: bytes) -> Build | None:
        """Decode the 16 bytes of the answer; return `None` if all are 0 (build unknown).

        Raises BadAnswer for another length.
        """
        if len(data) != VERSION_BYTES:
            raise BadAnswer(f"VERSION of {len(data)} bytes")
        if not any(data):
            return None
        source, commit = (data[n : n + 4].hex() if any(data[n : n + 4]) else "" for n in (4, 8))
        board = data[12:].rstrip(b"\0").decode("ascii", "replace")
        return cls(".".join(map(str, data[:3])), bool(data[3] & 1), source, commit, board)
