"""Ports that are not a board, are in use, or disappear: each raises a clear error."""

from __future__ import annotations

import os
import random
import threading
import time
import tty
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from openppmc.host import Disconnected, NoAnswer, PortError, Ppmc104, WrongDevice
from openppmc.sim import SimBoard

from .fixtures import SETUP, one_line

Reply = Callable[[bytes], bytes]
MakeForeignDevice = Callable[[Reply], str]


def refusal(port: str, kind: type[Exception]) -> str:
    """Check that opening `port` raises an error `kind` whose message is one line that names the port; return
    the message.
    """
    with pytest.raises(kind) as caught:
        Ppmc104.open(port).close()
    text = str(caught.value)
    assert port in text and one_line(f"error: {text}")
    return text


def test_no_such_port() -> None:
    """A path that does not exist is rejected."""
    assert "no such port" in refusal("/dev/ttyNotThere7", PortError)


def test_not_a_port(tmp_path: Path) -> None:
    """A regular file is rejected."""
    (tmp_path / "file").touch()
    assert "not a serial port" in refusal(str(tmp_path / "file"), PortError)


def test_busy_port(board: SimBoard) -> None:
    """A second open of a port is rejected with an error; the first connection continues to work."""
    with Ppmc104.open(board.port) as axis:
        assert "close it first" in refusal(board.port, PortError)
        assert axis.status().busy is False


class NonBridgeDevice:
    """A pseudo-terminal with a device that responds, but is not a board."""

    def __init__(self, reply: Reply) -> None:
        self._reply = reply
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self._end = False
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        while not self._end:
            try:
                data = os.read(self._master, 1024)
            except OSError:
                return
            if reply := self._reply(data):
                os.write(self._master, reply)

    def close(self) -> None:
        self._end = True
        os.write(self._slave, b"x")  # wakes the thread up
        self._thread.join(5)
        os.close(self._slave)
        os.close(self._master)


@pytest.fixture
def foreign_device() -> Iterator[MakeForeignDevice]:
    """Create pseudo-terminals with a foreign device and remove them after the test."""
    made: list[NonBridgeDevice] = []

    def make(reply: Reply) -> str:
        made.append(NonBridgeDevice(reply))
        return made[-1].path

    yield make
    for one in made:
        one.close()


def test_silent_port(foreign_device: MakeForeignDevice) -> None:
    """A port without a device is reported as "no answer"."""
    assert "no answer" in refusal(foreign_device(lambda data: b""), NoAnswer)


def test_echo(foreign_device: MakeForeignDevice) -> None:
    """A device that echoes all bytes is not accepted as a bridge."""
    refusal(foreign_device(lambda data: data), (NoAnswer, WrongDevice))


def test_modem(foreign_device: MakeForeignDevice) -> None:
    """A device that sends text is rejected."""
    assert "check the port" in refusal(
        foreign_device(lambda data: b"ERROR unknown command\r\n" * 3), WrongDevice
    )


def test_garbage(foreign_device: MakeForeignDevice) -> None:
    """A device that sends random bytes is rejected."""
    noise = random.Random(7)
    refusal(foreign_device(lambda data: noise.randbytes(64)), (NoAnswer, WrongDevice))


def test_board_dies_in_a_move(board: SimBoard) -> None:
    """If the board ends during a motion, Disconnected is raised within 10 s, with a text of one line."""
    axis = Ppmc104.open(board.port)
    axis.initialise(**SETUP)
    motion = axis.start_move(30_000)
    board.process.kill()
    begin = time.monotonic()
    with pytest.raises(Disconnected) as caught:
        motion.wait()
    assert time.monotonic() - begin < 10
    assert one_line(f"error: {caught.value}")
    axis.close()
