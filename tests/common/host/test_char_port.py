"""`CharPort` with a simulated line: identification of the character host, and damaged characters."""

from __future__ import annotations

import time

import pytest

from openppmc.host.char_port import CharPort
from openppmc.host.errors import NoAnswer, ProtocolError, WrongDevice

INFO = b"C\x01\x68\x00\x01" + (16_000_000).to_bytes(4, "little") + (12_000_000).to_bytes(4, "little")


class FakeLine:
    """Line with a character host whose info bytes are `info`; `bad` is added to the echo of a write."""

    name = "fake"

    def __init__(self, info: bytes = INFO, bad: int = 0) -> None:
        self.info, self.bad = info.ljust(15, b"\0") + b"\xff", bad
        self.sent: list[bytes] = []
        self.closed = False
        self._answer = b""

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        if len(data) == 2:
            self._answer += bytes([((data[0] & 1) << 7 | data[1]) ^ self.bad])
        elif self.info[15]:
            self._answer += self.info[data[0] >> 1 & 15 :][:1] if data[0] & 0x20 else b"\0"

    def read(self, timeout: float) -> bytes:
        answer, self._answer = self._answer[:1], self._answer[1:]
        return answer

    def set_baud(self, baud: int) -> None:
        raise AssertionError("the rate of the line never changes")

    def clock(self) -> float:
        return time.perf_counter()

    def close(self) -> None:
        self.closed = True


def test_identity() -> None:
    """The bridge in this program reports part, timing and clocks of the info bytes, and no counter."""
    line = FakeLine()
    port = CharPort(line)
    port.set_baud(1_000_000)
    port.write(b"\x7e\x00\x01\x0d\x2e\x7e")
    answer = port.read(1)
    assert answer[3:7] == b"PPMC" and answer[8:11] == b"\x68\x00\x51"
    assert line.sent == [bytes([0xA0 | n << 1]) for n in range(15)]
    port.close()
    assert line.closed


@pytest.mark.parametrize("info", [b"X\x01", b"C\x02", b"PPMC"])
def test_other_device(info: bytes) -> None:
    """A device with other info bytes is rejected, and the line is closed."""
    line = FakeLine(info)
    with pytest.raises(WrongDevice, match=r"^char:fake: the device that answers has no character host"):
        CharPort(line)
    assert line.closed


def test_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """If the line does not answer, it is rejected after a time limit."""
    monkeypatch.setattr("openppmc.host.char_port.ANSWER_SECONDS", 0.02)
    line = FakeLine()
    line.info = bytes(16)
    with pytest.raises(NoAnswer, match="no answer of a character host"):
        CharPort(line)
    assert line.closed


def test_damaged_write() -> None:
    """A write whose echo differs raises an error that names both bytes."""
    port = CharPort(FakeLine(bad=0x10))
    with pytest.raises(ProtocolError, match="received 0x53 instead of 0x43"):
        port._bus.write(1, 0x43)


def test_a_late_answer_is_discarded() -> None:
    """An answer that arrives after NoAnswer is not taken as the answer of the next request."""
    line = FakeLine()
    port = CharPort(line)
    line._answer = b"\x55"
    assert port._bus.info(0) == INFO[0]
