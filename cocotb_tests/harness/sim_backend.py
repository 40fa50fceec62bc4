"""`SimBackend`: the operations that a bench needs often: clock, pins, levels, edges of outputs.

`sim_backend()` returns a `CppBackend` in a simulation with our main program, and a `CocotbBackend` in one
with the main program of cocotb (`build.MAINS`). Both record the same changes; `CppBackend` is faster,
`CocotbBackend` needs only cocotb.
"""

from __future__ import annotations

import ctypes
import gc
import struct
from collections.abc import Iterable, Iterator
from functools import cache, reduce
from itertools import chain
from typing import Any, Protocol

import cocotb
from cocotb import simtime
from cocotb.clock import Clock
from cocotb.simtime import get_sim_time
from cocotb.task import Task

PICOSECOND = -12


class CocotbBackend:
    """`SimBackend` that uses only cocotb.

    Clock and recorder are tasks of the running test and end with it.
    """

    def __init__(self) -> None:
        if simtime.time_precision != PICOSECOND:
            raise RuntimeError("a bench counts in ps: build the simulation with --timescale 1ps/1ps")
        self.now = get_sim_time
        self._numbers: dict[str, int] = {}
        self._handles: list[Any] = []
        self._clock: Clock | None = None
        self._recorders: dict[int, Task[None]] = {}
        self._levels: dict[int, int] = {}
        self._rows: dict[tuple[int, int], int] = {}

    def port(self, name: str) -> int:
        """See `SimBackend.port`."""
        if name not in self._numbers:
            self._handles.append(reduce(getattr, name.split("."), cocotb.top))
            self._numbers[name] = len(self._handles) - 1
        return self._numbers[name]

    def read(self, port: int) -> int:
        """See `SimBackend.read`.

        Raises AssertionError if a bit has no level (X), which only some simulators report. Undriven data,
        such as d_o with d_oe = 0, are not checked: such bits read as 0.
        """
        value = self._handles[port].value
        try:
            return int(value)
        except ValueError:
            name = self._handles[port]._name
            enable = getattr(cocotb.top, f"{name}e", None)
            if enable is not None and int(enable.value) == 0:
                return int(value.resolve("zeros"))
            raise AssertionError(f"{name} = {value} at {self.now():.0f} ps: a bit without a level") from None

    def put(self, port: int, level: int) -> None:
        """See `SimBackend.put`."""
        self._handles[port].value = level

    def clock(self, port: int, half: int) -> None:
        """See `SimBackend.clock`."""
        if self._clock is not None:
            self._clock.stop()
        self._clock = Clock(self._handles[port], 2 * half, impl="gpi")
        self._clock.start(start_high=False)
        self.unwatch()

    def unwatch(self) -> None:
        """Stop recording all ports."""
        for recorder in self._recorders.values():
            recorder.cancel()
        for record in (self._recorders, self._levels, self._rows):
            record.clear()

    def watch(self, port: int) -> None:
        """See `SimBackend.watch`."""
        self._levels[port] = self.read(port)
        if port not in self._recorders or self._recorders[port].done():
            self._recorders[port] = cocotb.start_soon(self._record(port))

    async def _record(self, port: int) -> None:
        trigger = self._handles[port].value_change
        while True:
            await trigger
            self._note(port)

    def _note(self, port: int) -> None:
        self._rows[self.now(), port] = self.read(port)

    def changes(self) -> Iterable[tuple[int, int, int]]:
        """See `SimBackend.changes`."""
        # After a change in this time step, the recorder of the port may not have run yet.
        for port in self._recorders:
            self._note(port)
        changed = []
        for (time, port), level in self._rows.items():
            if level != self._levels[port]:
                self._levels[port] = level
                changed.append((time, port, level))
        self._rows.clear()
        return changed


_ROW = struct.Struct("=QQQ")
_WORD = 64
_ONES = (1 << _WORD) - 1
_OTHER = 1 << 20
"""Added to the numbers of those ports that `CppBackend` lets a `CocotbBackend` handle."""


def _function(name: str, result: Any, *arguments: Any) -> Any:
    function = getattr(ctypes.CDLL(None), name)
    function.restype, function.argtypes = result, arguments
    return function


class CppBackend:
    """`SimBackend` with our main program. Clock and watches last until the clock is started again."""

    def __init__(self) -> None:
        self._others = CocotbBackend()
        self._numbers: dict[str, int] = {}
        self._words: dict[int, int] = {}
        """Number of a wide port -> number of its words."""
        self._levels: dict[int, int] = {}
        """Number of a watched wide port -> its last level."""
        self._part_of: dict[int, tuple[int, int]] = {}
        """Number of a word -> (port of the word, position of the word in the port in bits)."""
        self.now = _function("openppmc_time", ctypes.c_uint64)
        self._port = _function("openppmc_port", ctypes.c_int, ctypes.c_char_p, ctypes.POINTER(ctypes.c_int))
        self._read = _function("openppmc_read", ctypes.c_uint64, ctypes.c_int)
        self._put = _function("openppmc_put", None, ctypes.c_int, ctypes.c_uint64)
        self._clock = _function("openppmc_clock", None, ctypes.c_int, ctypes.c_uint64)
        self._watch = _function("openppmc_watch", None, ctypes.c_int)
        self._seen = _function("openppmc_seen", ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint64))

    @staticmethod
    def offered() -> bool:
        """Return whether this process is a simulation with our main program."""
        return hasattr(ctypes.CDLL(None), "openppmc_time")

    def port(self, name: str) -> int:
        """See `SimBackend.port`."""
        if name not in self._numbers:
            words = ctypes.c_int()
            path = f"{cocotb.top._name}.{name}" if "." in name else name
            number = self._port(path.encode(), ctypes.byref(words))
            if number < 0:
                number = _OTHER + self._others.port(name)
            self._numbers[name] = number
            if words.value > 1:
                self._words[number] = words.value
                self._part_of |= {number + word: (number, _WORD * word) for word in range(words.value)}
        return self._numbers[name]

    def read(self, port: int) -> int:
        """See `SimBackend.read`."""
        if port >= _OTHER:
            return self._others.read(port - _OTHER)
        if port not in self._words:
            level: int = self._read(port)
            return level
        return sum(self._read(port + word) << _WORD * word for word in range(self._words[port]))

    def put(self, port: int, level: int) -> None:
        """See `SimBackend.put`."""
        if port >= _OTHER:
            self._others.put(port - _OTHER, level)
            return
        for word in range(self._words.get(port, 1)):
            self._put(port + word, level >> _WORD * word & _ONES)

    def clock(self, port: int, half: int) -> None:
        """See `SimBackend.clock`."""
        self._clock(port, half)
        self._others.unwatch()

    def watch(self, port: int) -> None:
        """See `SimBackend.watch`."""
        if port >= _OTHER:
            self._others.watch(port - _OTHER)
            return
        for word in range(self._words.get(port, 1)):
            self._watch(port + word)
        if port in self._words:
            self._levels[port] = self.read(port)

    def changes(self) -> Iterable[tuple[int, int, int]]:
        """See `SimBackend.changes`."""
        count = ctypes.c_uint64()
        rows = self._seen(ctypes.byref(count))
        found = _ROW.iter_unpack(ctypes.string_at(rows, _ROW.size * count.value))
        others = [(time, _OTHER + port, level) for time, port, level in self._others.changes()]
        return chain(self._whole(found) if self._levels else found, others)

    def _whole(self, rows: Iterable[tuple[int, int, int]]) -> Iterator[tuple[int, int, int]]:
        """Yield the rows, but combine the words of each wide port to a level of the whole port."""
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
    """Make garbage collections rarer, because a run keeps a million small tuples until its end."""
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


class SimBackend(Protocol):
    """Clock, pins and recorder of a simulation.

    Times are steps of the simulation, that is, ps. Ports are ports of the top module; `port` returns their
    numbers.
    """

    def port(self, name: str) -> int:
        """Return the number of a port, or of a visible inner signal such as "u_sync.stage_q".

        Raises AttributeError if the top has no signal of this name.
        """

    def now(self) -> int:
        """Return the present time."""

    def read(self, port: int) -> int:
        """Return the present level of a port."""

    def put(self, port: int, level: int) -> None:
        """Set the level of an input; the next evaluation of the design, in this time step, uses it."""

    def clock(self, port: int, half: int) -> None:
        """Start or restart the clock: low now, first rising edge after `half`. This call ends all watches."""

    def watch(self, port: int) -> None:
        """Record the changes of a port from now on, until the clock is started again or the test ends.

        A second call for the same port has no effect.
        """

    def changes(self) -> Iterable[tuple[int, int, int]]:
        """Return (time, port, level) of all changes of watched ports since the last call.

        The changes of a port are in order; only the last level of each time step counts.
        """


@cache
def sim_backend() -> SimBackend:
    """Return the backend of this simulation."""
    return CppBackend() if CppBackend.offered() else CocotbBackend()
