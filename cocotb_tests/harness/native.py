"""`Native`: the `Clockwork` of `verilated_sim.cpp`, our main program: clock, pins and recorder in C++.

What a bench does a million times costs a call of C instead of a trigger of cocotb. Ports that are wider than
64 bits are left to `Stock`.
"""

from __future__ import annotations

import ctypes
import gc
import struct
from collections.abc import Iterable
from itertools import chain
from typing import Any

from .stock import Stock

_ROW = struct.Struct("=QQQ")
_WIDE = 1 << 20
"""Added to the numbers of ports that are left to `Stock`."""


def _function(name: str, result: Any, *arguments: Any) -> Any:
    function = getattr(ctypes.CDLL(None), name)
    function.restype, function.argtypes = result, arguments
    return function


class Native:
    """See `Clockwork`. The clock goes on, and ports stay watched, until it is started again."""

    def __init__(self) -> None:
        self._wide = Stock()
        self._numbers: dict[str, int] = {}
        self.now = _function("openppmc_time", ctypes.c_uint64)
        self._port = _function("openppmc_port", ctypes.c_int, ctypes.c_char_p)
        self._read = _function("openppmc_read", ctypes.c_uint64, ctypes.c_int)
        self._put = _function("openppmc_put", None, ctypes.c_int, ctypes.c_uint64)
        self._clock = _function("openppmc_clock", None, ctypes.c_int, ctypes.c_uint64)
        self._watch = _function("openppmc_watch", None, ctypes.c_int)
        self._seen = _function("openppmc_seen", ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint64))

    @staticmethod
    def offered() -> bool:
        """Whether this process is a simulation with our main program."""
        return hasattr(ctypes.CDLL(None), "openppmc_time")

    def port(self, name: str) -> int:
        """As `Clockwork.port`."""
        if name not in self._numbers:
            number = self._port(name.encode())
            self._numbers[name] = number if number >= 0 else _WIDE + self._wide.port(name)
        return self._numbers[name]

    def read(self, port: int) -> int:
        """As `Clockwork.read`."""
        level: int = self._read(port) if port < _WIDE else self._wide.read(port - _WIDE)
        return level

    def put(self, port: int, level: int) -> None:
        """As `Clockwork.put`."""
        if port < _WIDE:
            self._put(port, level)
        else:
            self._wide.put(port - _WIDE, level)

    def clock(self, port: int, half: int) -> None:
        """As `Clockwork.clock`."""
        self._clock(port, half)
        self._wide.unwatch()

    def watch(self, port: int) -> None:
        """As `Clockwork.watch`."""
        if port < _WIDE:
            self._watch(port)
        else:
            self._wide.watch(port - _WIDE)

    def seen(self) -> Iterable[tuple[int, int, int]]:
        """As `Clockwork.seen`."""
        count = ctypes.c_uint64()
        rows = self._seen(ctypes.byref(count))
        narrow = _ROW.iter_unpack(ctypes.string_at(rows, _ROW.size * count.value))
        wide = [(time, _WIDE + port, level) for time, port, level in self._wide.seen()]
        return chain(narrow, wide)


def collect_seldom() -> None:
    """Look for garbage in cycles less often: a run makes a million small tuples that live to its end."""
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
