"""Frames of the PPMC-312's serial mode: example transactions byte for byte, checksums, damaged replies."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from openppmc.host import CCW, CW, OutOfRange
from openppmc.host.ppmc312 import blocks
from openppmc.host.ppmc312.blocks import Trigger
from openppmc.host.ppmc312.line.wire import (
    DATA,
    DATA_BYTES,
    END_STATUS,
    ERROR_CODE,
    ERROR_COUNTS,
    INSTRUCTION,
    POLL,
    READY,
    SPECIFIC,
    Fault,
    Receiver,
    Reply,
    SumMode,
    checksum,
    frame,
    line_data,
    response,
    station_number,
)
from openppmc.model.ppmc312.codes import Code

# Frames to station 1. The number in each name is that of the transaction in
# cocotb_tests/ppmc312/tb_serial_transactions.py. The first block has the flags of T1 in the data sheet.
INSTRUCTIONS = {
    "1 initial T1": (
        blocks.initial_setting(1, 1000, 200, 2000),
        "91 30 30 30 31 30 33 65 38 30 30 63 38 30 30 30 37 64 30 63",
    ),
    "3 in-position": (blocks.in_position(True, 10), "91 30 32 30 31 30 30 30 61 61"),
    "4 encode": (blocks.encoder_watch(True, 20), "91 30 33 30 31 30 30 31 34 56"),
    "5 interlock": (blocks.interlock_position(5000), "91 30 34 30 30 30 30 31 33 38 38 4F"),
    "6 speed limit": (blocks.speed_limit(300), "91 30 35 30 31 32 63 3C"),
    "7 END": (blocks.end_terminal(True), "91 30 36 30 31 67"),
    "8 stop": (blocks.immediate_stop(), "91 38 30 6E"),
    "9 stop at": (
        blocks.immediate_stop(Trigger.POSITION, 0x1000),
        "91 39 30 30 30 30 30 31 30 30 30 4E",
    ),
    "10 slow stop on EVT0": (blocks.slow_stop(Trigger.EVENT1), "91 61 31 4D"),
    "11 ramp": (
        blocks.acceleration(CW, 5000),
        "91 38 33 30 30 30 30 30 30 30 30 31 33 38 38 50",
    ),
    "12 constant": (
        blocks.constant(CCW, 100, 500),
        "91 61 34 30 31 66 34 30 30 30 30 30 30 36 34 71",
    ),
    "13 step": (blocks.single_step(CCW), "91 61 32 4C"),
    "14 run": (blocks.run(CW, ramped=True), "91 38 36 30 30 30 30 68"),
    "15 run constant": (blocks.run(CCW, 400), "91 61 35 30 31 39 30 38"),
    "16 change": (blocks.change(400), "91 38 39 30 31 39 30 54"),
    "17 change at": (
        blocks.change(300, False, Trigger.POSITION, 0x800),
        "91 39 61 30 31 32 63 30 30 30 30 30 38 30 30 1F",
    ),
    "18 search": (blocks.origin_search(CCW, 500, index=True), "91 62 37 30 31 66 34 42"),
    "19 zero return": (blocks.zero_return(CW), "91 38 38 30 30 30 30 66"),
    "20 input": (blocks.block(Code.INPUT), "91 32 35 49"),
    "21 output": (blocks.outputs(0x15), "91 32 36 31 35 33"),
    "22 terminals": (blocks.block(Code.TERMINALS), "91 32 37 47"),
    "23 mask": (blocks.input_mask(0x24), "91 32 38 32 34 22"),
    "24 position": (blocks.read_position(), "91 34 32 2C"),
    "25 set encoder": (
        blocks.set_position(-1, encoder=True),
        "91 36 33 66 66 66 66 66 66 66 66 0F",
    ),
    "26 interlock": (blocks.block(Code.INTERLOCK), "91 34 34 2A"),
    "27 monitor": (blocks.block(Code.RUN_MONITOR), "91 34 35 29"),
    "28 version": (blocks.block(Code.VERSION), "91 34 31 2D"),
    "29 event": (
        blocks.event_register(2, blocks.acceleration(CW, 100)),
        "91 35 39 30 33 30 38 38 32 30 30 30 30 30 30 30 30 30 30 30 30 36 34 24",
    ),
    "30 event delete": (blocks.event_delete(2), "91 37 39 75"),
    "32 status": (blocks.block(Code.STATUS), "91 34 64 21"),
    "40 excitation": (blocks.block(Code.EXCITATION_ON), "91 32 30 4E"),
    "40 alarm clear": (blocks.block(Code.ALARM_CLEAR), "91 32 34 4A"),
    "41 reset": (blocks.block(Code.RESET), "91 66 66 6F"),
}
REPLIES = {
    "91 6E": (0, Reply(1, READY, b"")),
    "81 7E": (0, Reply(1, POLL, b"")),
    "A1 61 35 39": (1, Reply(1, DATA, b"\xa5")),
    "A1 66 66 65 30 7F": (2, Reply(1, DATA, b"\xff\xe0")),
    "A1 31 32 33 34 35 36 37 38 4A": (4, Reply(1, DATA, bytes.fromhex("12345678"))),
    "A1 30 30 30 32 30 30 5C": (3, Reply(1, DATA, b"\x00\x02\x00")),
    "A1 33 38 26": (1, Reply(1, DATA, b"\x38")),
    "A1 30 30 30 30 30 31 5D": (3, Reply(1, DATA, b"\x00\x00\x01")),
    "B1 34 36 08": (1, Reply(1, SPECIFIC, b"\x46")),
    "B1 34 32 0C": (4, Reply(1, SPECIFIC, b"\x42")),
    "B1 32 61 30 30 30 34 20": (1, Reply(1, SPECIFIC, b"\x2a\x00\x04")),
    "B1 34 37 07": (1, Reply(1, SPECIFIC, b"\x47")),
}


@pytest.mark.parametrize("name", INSTRUCTIONS)
def test_instructions_of_chapter_12(name: str) -> None:
    block, wire = INSTRUCTIONS[name]
    assert frame(INSTRUCTION | 1, line_data(block)).hex(" ").upper() == wire


def test_frames_without_a_block() -> None:
    assert frame(POLL | 1).hex(" ").upper() == "81 7E"
    for code, wire in (
        (END_STATUS, "91 34 30 2E"),
        (ERROR_CODE, "91 34 65 20"),
        (ERROR_COUNTS, "91 34 66 1F"),
    ):
        assert frame(INSTRUCTION | 1, bytes([code])).hex(" ").upper() == wire


def _take(wire: str, gives: int = 1, mode: SumMode = SumMode.BINARY) -> Reply | Fault | None:
    receiver = Receiver(1, gives, mode)
    got: Reply | Fault | None = None
    for byte in bytes.fromhex(wire):
        assert got is None
        got = receiver.feed(byte)
    return got


@pytest.mark.parametrize("wire", REPLIES)
def test_replies_of_chapter_12(wire: str) -> None:
    gives, reply = REPLIES[wire]
    assert _take(wire, gives) == reply
    assert frame(reply.kind | 1, reply.data) == bytes.fromhex(wire)


def test_the_checksum_of_the_sheet_both_ways() -> None:
    """The data sheet prints checksum 4D in its second example; its text results in 09 (P312-CHK-57)."""
    data = bytes.fromhex("001011225566abcdef")
    assert checksum(0x91, data) == 0x09 and checksum(0x91, data, SumMode.CHARS) == 0x4D
    assert frame(POLL | 1, mode=SumMode.CHARS) == b"\x81\x7f"
    assert _take("A1 61 35 39") is not None
    assert _take("A1 61 35 39", mode=SumMode.CHARS) is Fault.BROKEN


@pytest.mark.parametrize(
    ("wire", "fault"),
    [
        ("A2", Fault.FOREIGN),
        ("C1", Fault.FOREIGN),
        ("E1", Fault.FOREIGN),
        ("91 6F", Fault.BROKEN),
        ("A1 41", Fault.BROKEN),
        ("A1 61 35 38", Fault.BROKEN),
        ("A1 61 91", Fault.BROKEN),
        ("35", Fault.NOISE),
    ],
)
def test_broken_replies(wire: str, fault: Fault) -> None:
    assert _take(wire) is fault


def test_a_control_code_begins_anew() -> None:
    receiver = Receiver(1, 2)
    assert [receiver.feed(byte) for byte in b"\xa1a5"] == [None, None, None]
    assert receiver.feed(0xB1) is Fault.BROKEN
    assert [receiver.feed(byte) for byte in b"41"] == [None, None]
    assert receiver.feed(0x0D) == Reply(1, SPECIFIC, b"\x41")


@given(st.integers(0, 15), st.binary(max_size=8), st.sampled_from(SumMode))
def test_what_is_sent_is_received(station: int, data: bytes, mode: SumMode) -> None:
    receiver = Receiver(station, len(data), mode)
    *before, last = [receiver.feed(byte) for byte in frame(DATA | station, data, mode)]
    assert set(before) == {None} and last == Reply(station, DATA, data)


@given(st.binary(max_size=30), st.integers(0, 9))
def test_noise_never_raises(noise: bytes, gives: int) -> None:
    receiver = Receiver(3, gives)
    for byte in noise:
        if isinstance(got := receiver.feed(byte), Reply):
            assert got.station == 3
            break
        if got in (Fault.BROKEN, Fault.FOREIGN):
            break


@pytest.mark.parametrize(
    ("block", "text"),
    [
        (blocks.free_curve(1, [100, 200], [5, 4])[0], "free curves"),
        (blocks.block(Code.TABLE_READ), "reading the table"),
        (blocks.event_read(1), "event buffer"),
        (blocks.initial_setting(1, 1000, 200, 2000, 500, 1500), "one ramp for both"),
        (blocks.in_position(True, 5, auto=False), "single report"),
        (blocks.encoder_watch(True, 5, auto=False), "single report"),
        (blocks.input_mask(1, auto=False), "single report"),
        (blocks.acceleration(CW, 5, trigger=Trigger.EVENT1), "event buffer"),
        (blocks.event_register(1, bytes(11)), "serial events hold 10"),
    ],
)
def test_what_the_line_cannot_do(block: bytes, text: str) -> None:
    with pytest.raises(OutOfRange, match=text):
        line_data(block)


def test_stations_have_numbers() -> None:
    assert station_number(15) == 15
    for number in (-1, 16):
        with pytest.raises(OutOfRange, match="stations 0 to 15"):
            station_number(number)


def test_replies_read_as_the_bus_answers() -> None:
    """Serial replies are converted to the answers of the parallel mode, which the driver expects."""
    position = response(blocks.read_position(True), Reply(1, DATA, bytes.fromhex("12345678")))
    assert position.raw.hex(" ") == "03 06 42 01 12 34 56 78"
    assert response(blocks.block(Code.VERSION), Reply(1, DATA, b"\x12")).raw.hex(" ") == "03 02 40 12"
    assert response(blocks.event_delete(2), Reply(1, READY, b"")).raw.hex(" ") == "03 02 49 03"
    assert response(blocks.single_step(CW), Reply(1, READY, b"")).raw.hex(" ") == "03 01 84"
    assert DATA_BYTES[0x62] == 4
