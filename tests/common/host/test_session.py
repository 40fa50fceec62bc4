"""Session of the host: SEQ, repeats, events, late responses (UB-SEQ, UB-MSG), on lines with and without
faults.
"""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from openppmc.host.frames import WAKE_UP, Deframer, Frame, RetriesExhausted, Session, crc16, encode, escape
from openppmc.model.carrier.bridge import Bridge, Receiver, Request


def answer(seq: int, body: bytes = b"\x00") -> bytes:
    return encode(bytes([seq]) + body)


def sent_seq(line: bytes) -> int:
    (item,) = Deframer().feed(line)
    assert isinstance(item, Frame)
    return item.seq


def test_sequence_numbers() -> None:
    """SEQ is 0 only for the first request, then 1 to 127 repeatedly; after a restart it is 0 again."""
    session, seen = Session(), []
    for _ in range(300):
        seen.append(sent_seq(session.request(b"", 1, 0)))
        assert session.receive(answer(seen[-1]), 0) == b"\x00"
    assert seen[:129] == [*range(128), 1]
    assert seen[127:256] == [127, *range(1, 128), 1]
    session.restart()
    assert sent_seq(session.request(b"", 1, 0)) == 0


@given(st.binary(max_size=40) | st.just(b"\x08"))
def test_a_lost_or_doubled_last_byte_is_detected(script: bytes) -> None:
    """No request has a CRC that ends with 00.

    A CRC register of 0 stays 0 if a byte 00 follows. If a CRC ended with 00, the request would therefore also
    be valid without this byte, or with it twice, and contain a shorter or longer script.
    """
    session = Session()
    for _ in range(200):
        (payload,) = (item.payload for item in Deframer().feed(session.request(script, 1, 0)))  # type: ignore[union-attr]
        content = payload + encode_crc(payload)
        for damaged in (content[:-1], content + content[-1:]):
            assert not any(isinstance(item, Request) for item in received(framed(damaged)))
        session.outstanding = None


@given(st.binary(max_size=40))
def test_a_wake_up_never_completes_a_request(script: bytes) -> None:
    """If a killed program has sent a request without its last flag, the wake-up bytes of the next program do
    not complete the request.
    """
    line = Session().request(script, 1, 0)
    for end in range(len(line)):
        assert not any(isinstance(item, Request) for item in received(line[:end] + WAKE_UP))


def encode_crc(payload: bytes) -> bytes:
    """Return the CRC of a payload, without escapes."""
    return crc16(payload).to_bytes(2, "big")


def framed(content: bytes) -> bytes:
    """Return the line bytes of a frame with any content."""
    return b"\x7e" + escape(content) + b"\x7e"


def received(line: bytes) -> list[Request | int | None]:
    """Return the contents of the frames that the bridge receives."""
    receiver = Receiver()
    return [receiver.take(byte) for byte in line]


def test_one_request_at_a_time() -> None:
    session = Session()
    session.request(b"", 1, 0)
    with pytest.raises(RuntimeError):
        session.request(b"", 1, 0)
    session.outstanding = None
    assert sent_seq(session.request(b"", 1, 0)) == 1


def test_repeats_at_the_deadline_only_and_not_for_ever() -> None:
    session = Session(attempts=3)
    line = session.request(b"\x06", 2.0, 10.0)
    assert session.deadline == 12.0
    assert session.tick(11.9) == b""
    assert session.tick(12.0) == line
    assert session.tick(12.1) == b""
    assert session.tick(14.0) == line
    with pytest.raises(RetriesExhausted) as gone:
        session.tick(16.0)
    assert (gone.value.attempts, gone.value.naks, gone.value.received) == (3, (), 0)
    assert not session.busy
    assert session.repeats == 2


@pytest.mark.parametrize("code", range(1, 8))
def test_a_nak_repeats_after_the_grace(code: int) -> None:
    session = Session(grace=0.25)
    line = session.request(b"\x06", 2.0, 0.0)
    assert session.receive(encode(bytes([0x81, code])), 0.5) is None
    assert session.tick(0.74) == b""
    assert session.tick(0.75) == line


def test_a_nak_about_noise_before_the_request_repeats_nothing() -> None:
    session = Session(grace=0.05)
    session.request(b"\x06", 2.0, 0.0)
    assert session.receive(encode(b"\x81\x04") + answer(0, b"\x00\xff"), 0.01) == b"\x00\xff"
    assert session.tick(1.0) == b""
    assert session.repeats == 0


def test_a_nak_about_seq_does_not_repeat() -> None:
    session = Session()
    session.request(b"\x06", 2.0, 0.0)
    session.receive(encode(b"\x81\x08"), 0.0)
    assert session.deadline == 2.0


def test_events_are_kept_apart() -> None:
    session = Session()
    session.receive(encode(b"\x80\xfe"), 0.0)
    session.request(b"\x06", 2.0, 0.0)
    assert session.receive(encode(b"\x80\xfc") + answer(0) + encode(b"\x80\xf8"), 0.0) == b"\x00"
    assert list(session.events) == [0xFE, 0xFC, 0xF8]


def test_stale_and_foreign_frames_are_ignored() -> None:
    session = Session()
    for seq in range(3):
        session.request(b"", 1, 0)
        session.receive(answer(seq), 0)
    session.request(b"", 1, 0)
    stale = answer(2) + answer(0) + answer(100) + encode(b"\x82\x00") + encode(b"\x80") + encode(b"\x03")
    assert session.receive(stale, 0) is None
    assert session.receive(answer(3, b"\x00\x07"), 0) == b"\x00\x07"
    assert session.receive(answer(3), 0) is None


class Counter:
    """A device that records the bytes written to it."""

    def __init__(self) -> None:
        self.written: list[int] = []

    def read(self, a: int) -> int:
        return 0x01

    def write(self, a: int, byte: int) -> None:
        self.written.append(byte)


faults = st.sampled_from(["good"] * 5 + ["lost", "flipped", "doubled", "noise before", "cut"])


def spoil(line: bytes, fault: str, where: int) -> bytes:
    """Return the bytes of a frame that arrive after a fault of the line."""
    place = where % len(line) if line else 0
    if not line or fault == "good":
        return line
    if fault == "lost":
        return b""
    if fault == "flipped":
        return line[:place] + bytes([line[place] ^ 1 << where % 8]) + line[place + 1 :]
    if fault == "doubled":
        return line + line
    if fault == "noise before":
        return bytes(where >> n & 0xFF for n in range(5)) + line
    return line[:place]


@given(st.lists(st.tuples(faults, faults, st.integers(0, 5000)), min_size=1, max_size=60))
def test_every_request_is_carried_out_exactly_once(weather: list[tuple[str, str, int]]) -> None:
    """If a line loses, doubles and cuts frames and flips bits, in both directions, each command is executed
    exactly once.

    This holds as long as the host does not abandon a request.
    """
    part = Counter()
    bridge = Bridge(part)
    session = Session(attempts=100)
    sky = iter(weather)
    now, expected = 0.0, []
    # SEQ 0 is always executed, so a session begins with a script that changes no state.
    for number in range(6):
        script = b"\x01" if number == 0 else bytes([0x10, number])
        if number:
            expected.append(number)
        out = session.request(script, 0.3, now)
        body = None
        for _ in range(1000):
            there, back, where = next(sky, ("good", "good", 0))
            arrived = spoil(out, there, where)
            copies = [arrived[: len(out)], arrived[len(out) :]] if there == "doubled" else [arrived]
            heard = b"".join(bridge.receive(copy) for copy in copies)
            body = session.receive(spoil(heard, back, where), now) or body
            if body is not None:
                break
            now = session.deadline or now
            heard = bridge.idle(300)
            body = session.receive(heard, now)
            out = session.tick(now)
        assert body is not None
        assert body[0] == 0
    assert part.written == expected
