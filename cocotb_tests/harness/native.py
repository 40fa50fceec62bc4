"""`Native`: the `Clockwork` of `verilated_sim.cpp`, our main program: clock, pins and recorder in C++.

What a bench does a million times costs a call of C instead of a trigger of cocotb. A port of more than
64 bits is several there, one a word, the lowest first; here it is put together. What the C++ side does not
find by its name, as ports of arrays or of two directions, is left to `Stock`.
"""

from __future__ import annotations

import ctypes
import gc
import struct
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

from .stock import Stock

_ROW = struct.Struct("=QQQ")
_WORD = 64
_ONES = (1 << _WORD) - 1
_OTHER = 1 << 20
"""Added to the numbers of ports that are left to `Stock`."""


def _function(name: str, result: Any, *arguments: Any) -> Any:
    function = getattr(ctypes.CDLL(None), name)
    function.restype, function.argtypes = result, arguments
    return function


class Native:
    """See `Clockwork`. The clock goes on, and ports stay watched, until it is started again."""

    def __init__(self) -> None:
        self._others = Stock()
        self._numbers: dict[str, int] = {}
        self._words: dict[int, int] = {}
        """Number of words of the wide ports."""
        self._levels: dict[int, int] = {}
        """Last levels of the wide ports that are watched."""
        self._part_of: dict[int, tuple[int, int]] = {}
        """Number of a word -> its port, its place in bits."""
        self.now = _function("openppmc_time", ctypes.c_uint64)
        self._port = _function("openppmc_port", ctypes.c_int, ctypes.c_char_p, ctypes.POINTER(ctypes.c_int))
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
            words = ctypes.c_int()
            number = self._port(name.encode(), ctypes.byref(words))
            if number < 0:
                number = _OTHER + self._others.port(name)
            self._numbers[name] = number
            if words.value > 1:
                self._words[number] = words.value
                self._part_of |= {number + word: (number, _WORD * word) for word in range(words.value)}
        return self._numbers[name]

    def read(self, port: int) -> int:
        """As `Clockwork.read`."""
        if port >= _OTHER:
            return self._others.read(port - _OTHER)
        if port not in self._words:
            level: int = self._read(port)
            return level
        return sum(self._read(port + word) << _WORD * word for word in range(self._words[port]))

    def put(self, port: int, level: int) -> None:
        """As `Clockwork.put`."""
        if port >= _OTHER:
            self._others.put(port - _OTHER, level)
            return
        for word in range(self._words.get(port, 1)):
            self._put(port + word, level >> _WORD * word & _ONES)

    def clock(self, port: int, half: int) -> None:
        """As `Clockwork.clock`."""
        self._clock(port, half)
        self._others.unwatch()

    def watch(self, port: int) -> None:
        """As `Clockwork.watch`."""
        if port >= _OTHER:
            self._others.watch(port - _OTHER)
            return
        for word in range(self._words.get(port, 1)):
            self._watch(port + word)
        if port in self._words:
            self._levels[port] = self.read(port)

    def seen(self) -> Iterable[tuple[int, int, int]]:
        """As `Clockwork.seen`."""
        count = ctypes.c_uint64()
        rows = self._seen(ctypes.byref(count))
        found = _ROW.iter_unpack(ctypes.string_at(rows, _ROW.size * count.value))
        others = [(time, _OTHER + port, level) for time, port, level in self._others.seen()]
        return chain(self._whole(found) if self._levels else found, others)

    def _whole(self, rows: Iterable[tuple[int, int, int]]) -> Iterator[tuple[int, int, int]]:
        """Rows with words put together to levels of their ports."""
        part_of, levels = self._part_of, self._levels
        for row in rows:
            time, number, value = row
            if number in part_of:
                port, place = part_of[number]
                level = levels[port] & ~(_ONES << place) | value << place
                levels[port] = level
                yield time, port, level
            else:
                yield row


def collect_seldom() -> None:
    """Look for garbage in cycles less often: a run makes a million small tuples that live to its end."""
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
