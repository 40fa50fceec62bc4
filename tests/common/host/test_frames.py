"""Line frames of the UART bridge: UB-FRM-01..06."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from openppmc.host.frames import ANSWER_LIMIT, REQUEST_LIMIT, Broken, Deframer, Fault, Frame, crc16, encode
from openppmc.model.carrier.bridge import Receiver, Request, crc, frame

payloads = st.binary(min_size=1, max_size=REQUEST_LIMIT - 2)
spiky = st.lists(st.sampled_from([0x7E, 0x7D, 0x5E, 0x5D, 0x20, 0x00, 0xFF]), min_size=1, max_size=40)


@given(payloads | spiky.map(bytes))
def test_a_frame_survives_the_line(payload: bytes) -> None:
    line = encode(payload)
    assert Deframer().feed(line) == [Frame(payload)]
    assert line[0] == line[-1] == 0x7E
    assert 0x7E not in line[1:-1]


@given(payloads | spiky.map(bytes))
def test_host_and_golden_model_agree_on_the_line(payload: bytes) -> None:
    assert encode(payload) == frame(payload)
    assert crc16(payload) == crc(payload)


@given(st.lists(payloads, min_size=1, max_size=5), st.data())
def test_bytes_may_come_in_any_pieces(sent: list[bytes], data: st.DataObject) -> None:
    line = b"".join(map(encode, sent))
    deframer, found, place = Deframer(), [], 0
    while place < len(line):
        step = data.draw(st.integers(1, 60))
        found += deframer.feed(line[place : place + step])
        place += step
    assert found == [Frame(payload) for payload in sent]


@given(st.binary(max_size=400))
def test_host_and_golden_model_see_the_same_frames_in_noise(noise: bytes) -> None:
    receiver = Receiver()
    seen = [item for byte in noise if (item := receiver.take(byte)) is not None]
    ours = [
        (item.payload[0], item.payload[1:]) if isinstance(item, Frame) else int(item.fault)
        for item in Deframer(REQUEST_LIMIT).feed(noise)
    ]
    theirs = [(item.seq, item.script) if isinstance(item, Request) else item for item in seen]
    assert ours == theirs


def test_known_crc() -> None:
    """The CRC of the digits 1 to 9 equals the published check value."""
    assert crc16(b"123456789") == 0x29B1


def test_escapes() -> None:
    """UB-FRM-02: any byte may be sent as an escape sequence."""
    assert encode(b"\x7e\x7d")[1:5] == b"\x7d\x5e\x7d\x5d"
    plain = b"\x01\x41"
    line = (
        b"\x7e" + b"".join(bytes([0x7D, b ^ 0x20]) for b in plain + crc16(plain).to_bytes(2, "big")) + b"\x7e"
    )
    assert Deframer().feed(line) == [Frame(plain)]


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        (b"\x7e\x01\x02\x03\x04\x7e", Fault.CRC),
        (b"\x7e\x01\x02\x7e", Fault.TOO_SHORT),
        (b"\x7e\x01\x7e", Fault.TOO_SHORT),
        (b"\x7e\x01\x02\x03\x7d\x7e", Fault.ABORTED),
        (b"\x7e\x7d\x7e", Fault.ABORTED),
        (b"\x7e" + bytes(ANSWER_LIMIT + 1), Fault.TOO_LONG),
    ],
)
def test_broken_frames(line: bytes, fault: Fault) -> None:
    """UB-FRM-06: the flag that ends an invalid frame also begins the next frame, except after a frame that is
    too long.
    """
    deframer = Deframer()
    assert deframer.feed(line) == [Broken(fault)]
    good = encode(b"\x05\x00")
    after = good if fault is Fault.TOO_LONG else good[1:]
    assert deframer.feed(after) == [Frame(b"\x05\x00")]


def test_hunt_and_idle_flags() -> None:
    """UB-FRM-01, -05: noise before the first flag and repeated flags have no effect."""
    deframer = Deframer()
    assert deframer.feed(b"noise\x7d") == []
    assert deframer.feed(b"\x7e\x7e\x7e" + encode(b"\x01\x00") + b"\x7e") == [Frame(b"\x01\x00")]


@pytest.mark.parametrize("size", [0, REQUEST_LIMIT - 1])
def test_payload_size_is_checked(size: int) -> None:
    with pytest.raises(ValueError, match="1 to 254 bytes"):
        encode(bytes(size), REQUEST_LIMIT)


def test_longest_answer_is_taken() -> None:
    """The longest response, with 256 data bytes and an error, is accepted (UB-ANS-01); no request is
    as long.
    """
    payload = bytes(4 + 256)
    assert Deframer().feed(encode(payload)) == [Frame(payload)]
