"""Keeps the virtual time of a model beside the clock on the wall, and its calls whole."""

from __future__ import annotations

import os
import time
from _thread import get_ident, start_new_thread
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, TypeVar

T = TypeVar("T")

SLICE = 0.01
"""Seconds of wall time between two looks."""
_LAG = 0.25


class Pacer:
    """speed: virtual seconds a second; None: as fast as it goes."""

    def __init__(self, speed: float | None) -> None:
        self.speed = speed
        self._origin = time.monotonic()

    def step(self, left: float) -> float:
        """How much of `left` virtual seconds may pass before the next look."""
        return left if self.speed is None else min(left, SLICE * self.speed)

    def wait(self, seconds: float) -> None:
        """Do not run ahead of the wall clock; forget the lag of a model that cannot keep up."""
        if self.speed is None:
            return
        ahead = seconds / self.speed - (time.monotonic() - self._origin)
        if ahead > 0:
            time.sleep(ahead)
        elif ahead < -_LAG:
            self._origin -= ahead

    def behind(self, seconds: float) -> float:
        """Virtual seconds that went by on the wall while the program did something else, 0 if few."""
        if self.speed is None:
            return 0.0
        behind = (time.monotonic() - self._origin) * self.speed - seconds
        return behind if behind > SLICE else 0.0


_Jobs = SimpleQueue[tuple[Callable[[], Any], SimpleQueue[Any]]]
_worker: tuple[int, int, _Jobs] | None = None
"""The process that has the thread, the thread, and its queue."""


def whole(call: Callable[[], T]) -> T:
    """Call into a model. The call ends even if a signal handler raises meanwhile; the next one waits for it.

    A model that stops in the middle of an edge is broken. Handlers raise in the main thread only, so one
    other thread makes all calls. Queues of C, because locks of Python can stay locked where a handler raises.
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
