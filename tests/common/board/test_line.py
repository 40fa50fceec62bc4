"""The serial line of the virtual board: raw bytes through pyserial, noise, baud rates, block transfers."""

from __future__ import annotations

import random
import time
from collections.abc import Iterator

import pytest
import serial

from openppmc.host import Link, Ppmc104
from openppmc.host.frames import MESSAGE_NAK, WAKE_UP, Deframer, Frame, Nak, encode
from openppmc.host.script import Result, Script
from openppmc.sim import SimBoard

from .fixtures import PATIENCE, SETUP

IDENT = encode(bytes([0]) + bytes(Script().ident()))


class Line:
    """A serial port that returns whole frames.

    If more frames were received than requested, the next calls return them.
    """

    def __init__(self, port: serial.Serial) -> None:
        self.port = port
        self._deframer = Deframer()
        self._frames: list[bytes] = []

    def frame(self, seconds: float = PATIENCE) -> bytes:
        """Return the next frame without its checksum; b"" after `seconds` of wall-clock time."""
        end = time.monotonic() + seconds
        while not self._frames and time.monotonic() < end:
            items = self._deframer.feed(self.port.read(self.port.in_waiting or 1))
            self._frames += [item.payload for item in items if isinstance(item, Frame)]
        return self._frames.pop(0) if self._frames else b""

    def answer(self, seconds: float = PATIENCE) -> bytes:
        """Return the next frame that is not a message (UB-MSG)."""
        while (frame := self.frame(seconds)) and frame[0] & 0x80:
            pass
        return frame


@pytest.fixture
def line(board: SimBoard) -> Iterator[Line]:
    """Open the port of a board at 115 200 baud."""
    with serial.Serial(board.port, 115_200, timeout=0.1) as port:
        yield Line(port)


def test_ident(line: Line) -> None:
    """A request of IDENT is answered with one frame: SEQ, RESULT and the 16 bytes of docs/uart_bridge.md."""
    line.port.write(IDENT)
    part, clocks = (104).to_bytes(2, "little"), (16_000_000, 8_000_000)
    flags = 1 << 1 | 4 << 4
    tail = b"".join(hz.to_bytes(4, "little") for hz in clocks)
    assert line.frame() == b"\x00\x00" + b"PPMC\x01" + part + bytes([flags]) + tail


def test_garbage_before_a_good_frame(line: Line) -> None:
    """Noise without a flag causes only NAKs, and the valid frame after the noise is always answered."""
    seed = 104
    noise = random.Random(seed)
    for turn in range(20):
        junk = bytes(noise.choice([b for b in range(256) if b != 0x7E]) for _ in range(noise.randint(1, 40)))
        line.port.write(junk + IDENT)
        answer = line.answer()
        assert answer[2:6] == b"PPMC", f"seed {seed}, turn {turn}: {junk.hex(' ')} gave {answer.hex(' ')}"


def test_broken_checksum_is_told_and_nothing_done(line: Line) -> None:
    """A frame with one wrong bit causes NAK 2 and no response."""
    broken = bytearray(IDENT)
    broken[-2] ^= 0x04
    line.port.write(bytes(broken))
    assert line.frame() == bytes([MESSAGE_NAK, Nak.CRC])
    assert line.frame(0.5) == b""


def test_half_a_frame(line: Line) -> None:
    """Silence inside a frame causes NAK 5 after 100 ms of board time; the frame that follows is answered."""
    line.port.write(IDENT[:-2])
    assert line.frame() == bytes([MESSAGE_NAK, Nak.SILENCE])
    line.port.write(IDENT)
    assert line.frame()[2:6] == b"PPMC"


def test_does_not_sleep_while_a_script_waits(board: SimBoard, line: Line) -> None:
    """While a script waits for 4 s of board time, the board does not sleep, so the wait ends in time."""
    begin = board.status().seconds
    line.port.write(encode(bytes([0]) + bytes(Script().timeout(4000).wait(1, 0xFF, 0x55))))
    answer = line.frame(4 * PATIENCE)
    assert answer[:2] == bytes([0, Result.TIMED_OUT]), answer.hex(" ")
    assert 4.0 <= board.status().seconds - begin < 5.0


# 106 000 baud is 8 % too slow: the bridge, at 115 200 baud, samples the last data bit as the stop bit.
@pytest.mark.parametrize("baud", [9600, 57_600, 106_000, 230_400, 921_600])
def test_wrong_rate_hears_no_answer(board: SimBoard, baud: int) -> None:
    """To a request at a wrong baud rate the bridge sends nothing that could be a response; at the right rate
    it responds.
    """
    with serial.Serial(board.port, baud, timeout=0.1) as port:
        for _ in range(3):
            port.write(IDENT)
        port.flush()
        assert Line(port).answer(1.5) == b""
        port.baudrate = 115_200
        port.write(WAKE_UP)
        line = Line(port)
        while line.frame(0.5):
            pass
        port.write(IDENT)
        assert line.answer()[2:6] == b"PPMC"


@pytest.mark.parametrize("baud", [113_000, 117_500])
def test_small_rate_error_does_no_harm(board: SimBoard, baud: int) -> None:
    """A baud rate error of two percent, which real oscillators and dividers can have, causes no errors."""
    with serial.Serial(board.port, baud, timeout=0.1) as port:
        port.write(IDENT)
        assert Line(port).frame()[2:6] == b"PPMC"


def test_all_rates(board: SimBoard) -> None:
    """The host package works at every baud rate of the board; if a higher rate is requested, it uses 115 200
    baud.
    """
    for baud in (115_200, 230_400, 460_800, 921_600, 1_000_000, 3_000_000):
        with Link(board.port, baud) as link:
            assert link.baud == (baud if baud <= 1_000_000 else 115_200)
            data = link.execute(Script().read_many(1, 200)).values[0]
            assert data == bytes(200)


def test_block_transfer(board: SimBoard) -> None:
    """Frames of 240 accesses work at 1 Mbaud, with more than 1000 accesses per second (a loose limit)."""
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        begin, count = time.monotonic(), 0
        while time.monotonic() - begin < 1.0:
            values = axis.link.execute(Script().read_many(1, 240)).values[0]
            assert values == bytes(240)
            count += len(values)
        rate = count / (time.monotonic() - begin)
        print(f"{rate:.0f} register accesses/s, {board.status().factor:.2f} times real time")
        assert rate > 1000
        assert axis.link.repeats == 0
        assert board.status().lost == 0
