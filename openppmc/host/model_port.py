"""Port `model:`: golden models of bridge and part, and a plant model, in virtual time.

The line is modelled byte by byte, including the time of each byte. A byte at a wrong rate arrives as a
framing error or a break.
"""

from __future__ import annotations

import os
import time
from _thread import get_ident, start_new_thread
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, TypeVar

from .. import __version__
from ..model.carrier.bridge import Bridge
from ..model.carrier.bridge_ops import RATES
from ..parts import part
from ..sim.common.machine import PLANT_WORDS, Setup, machine_kind, own_words, parse_machine
from ..sources import build_id
from .errors import Disconnected, PortError

# `Pacer` keeps the virtual time of a model in step with real time. `whole` calls a model such that no signal
# interrupts the call.

T = TypeVar("T")

SLICE = 0.01
"""Seconds of wall time between two checks."""
_LAG = 0.25


class Pacer:
    """Control of the virtual time, which follows the wall time.

    Args:
        speed: virtual seconds per second of wall time, `None` for as fast as possible.
    """

    def __init__(self, speed: float | None) -> None:
        self.speed = speed
        self._origin = time.monotonic()

    def step(self, left: float) -> float:
        """Return the virtual seconds, at most `left`, that may pass before the next check."""
        return left if self.speed is None else min(left, SLICE * self.speed)

    def wait(self, seconds: float) -> None:
        """Wait until the wall clock reaches the virtual time; discard the lag of a model that is too slow."""
        if self.speed is None:
            return
        ahead = seconds / self.speed - (time.monotonic() - self._origin)
        if ahead > 0:
            time.sleep(ahead)
        elif ahead < -_LAG:
            self._origin -= ahead

    def behind(self, seconds: float) -> float:
        """Return the delay of the model in virtual seconds; 0 if it is below SLICE."""
        if self.speed is None:
            return 0.0
        behind = (time.monotonic() - self._origin) * self.speed - seconds
        return behind if behind > SLICE else 0.0


_Jobs = SimpleQueue[tuple[Callable[[], Any], SimpleQueue[Any]]]
_worker: tuple[int, int, _Jobs] | None = None
"""Thread that calls models: the ID of its process, its own ID, and its queue of calls."""


def whole(call: Callable[[], T]) -> T:
    """Call a model, and complete the call even if a signal handler raises an exception.

    A model that is interrupted within an edge is unusable. Signal handlers raise exceptions in the main
    thread only, so another thread makes all calls, one after the other. The queues are implemented in C,
    because a Python lock can remain locked after an exception in a handler.
    """
    global _worker
    if _worker is None or _worker[0] != os.getpid():
        jobs: _Jobs = SimpleQueue()
        _worker = os.getpid(), start_new_thread(_serve, (jobs,)), jobs
    if get_ident() == _worker[1]:
        return call()
    answer: SimpleQueue[tuple[T, BaseException | None]] = SimpleQueue()
    _worker[2].put((call, answer))
    value, error = answer.get()
    if error is not None:
        raise error
    return value


def _serve(jobs: _Jobs) -> None:
    while True:
        call, answer = jobs.get()
        try:
            answer.put((call(), None))
        except BaseException as error:  # noqa: BLE001 - raised by `whole`
            answer.put((None, error))


BITS_PER_BYTE = 10
OPTIONS = ("part", "speed", "clk", "xtal", "timing")


class ModelPort:
    """Board that needs no hardware.

    Args:
        text: options of the machine model (`openppmc.sim.common.machine`), and these: `speed` (1: real time,
            10: ten times as fast, max: as fast as possible); `clk` and `xtal` in Hz; `timing` FAST or
            DATASHEET; `read_map` (stmc) FAMILY or SHEET; `unplug` (the port disappears after this number of
            virtual seconds).

    Raises:
        PortError: text is invalid.
    """

    def __init__(self, text: str = "", baud: int = 115_200) -> None:
        self.name = "model:" + text
        self._baud = baud
        self._waiting = bytearray()
        self._closed = False
        try:
            machine = parse_machine(text, (*OPTIONS, "unplug"))
            options = dict(machine.others)
            self._pacer = Pacer(_speed(options.pop("speed", "1")))
            clk_hz, xtal_hz = (int(options.pop(word, "16000000")) for word in ("clk", "xtal"))
            timing = options.pop("timing", "FAST").upper()
            self._unplug = float(options.pop("unplug", "inf"))
            if options:
                known = ", ".join((*PLANT_WORDS, *OPTIONS, *own_words(), "unplug"))
                raise ValueError(f"unknown word {next(iter(options))!r} (there are {known})")
            setup = Setup(machine.plants, clk_hz, xtal_hz, timing, machine.own, self._interrupt)
            kind = machine_kind(machine.part)
            kind.check(setup)
            self.board = board = kind.carrier(setup)
        except ValueError as error:
            raise PortError(f"{self.name}: {error}") from error
        axes = len(machine.plants) if kind.counters else 1
        number, datasheet = part(machine.part).number, timing == "DATASHEET"
        # The model has no RTL, so its source digest is empty.
        build = build_id(__version__, b"", board="MODL")
        self.bridge = Bridge(board, number, clk_hz, xtal_hz, datasheet, kind.counters, axes, build)

    # ------------------------------------------------------------------ port

    def read(self, timeout: float) -> bytes:
        self._check()
        self._synchronise()
        end = self.board.seconds + timeout
        while not self._waiting and (left := end - self.board.seconds) > 0:
            self._advance(self._pacer.step(left))
            self._pacer.wait(self.board.seconds)
            self._check()
        data = bytes(self._waiting)
        self._waiting.clear()
        return data

    def write(self, data: bytes) -> None:
        self._check()
        self._synchronise()
        whole(lambda: self._send(data))

    def set_baud(self, baud: int) -> None:
        self._baud = baud

    def clock(self) -> float:
        return self.board.seconds

    def close(self) -> None:
        self._closed = True

    # ------------------------------------------------------------------ time

    def _check(self) -> None:
        if self._closed or self.board.seconds >= self._unplug:
            raise Disconnected(
                f"{self.name}: the port went away: plug the board in and run the command again"
            )

    def _advance(self, seconds: float) -> None:
        """Advance the board without bytes from the host; return early when a message arrives."""
        whole(lambda: self._idle(seconds))

    def _idle(self, seconds: float) -> None:
        begin = self.board.seconds
        self.board.run_until(
            self.board.t + max(1, round(seconds * self.board.clk_hz)), stop=lambda: bool(self._waiting)
        )
        self._arrives(self.bridge.idle(1000 * (self.board.seconds - begin)))

    def _send(self, data: bytes) -> None:
        self._line_time(len(data))
        for start, byte in enumerate(data):
            if self._baud == RATES[self.bridge.rate]:
                self._arrives(self.bridge.receive(data[start:]))
                return
            slower = self._baud < RATES[self.bridge.rate]
            self._arrives(self.bridge.receive_bad(0 if slower and byte == 0 else 0xFF))

    def _line_time(self, count: int) -> None:
        clk = count * BITS_PER_BYTE * self.board.clk_hz // self._baud
        self.board.run_until(self.board.t + clk)

    def _synchronise(self) -> None:
        """Advance the board by the time that has passed since its last access."""
        end = self.board.seconds + self._pacer.behind(self.board.seconds)
        while (left := end - self.board.seconds) > 0:
            self._advance(left)

    # ------------------------------------------------------------------ bytes from the bridge

    def _arrives(self, data: bytes) -> None:
        self._line_time(len(data))
        self._waiting += data

    def _interrupt(self) -> None:
        self._waiting += self.bridge.interrupt()


def _speed(text: str) -> float | None:
    """Return the speed as a multiple of real time, `None` for as fast as possible."""
    if text == "max":
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0
    if not 0 < speed < float("inf"):
        raise ValueError(f"speed={text} is neither a positive number nor max")
    return speed
