"""Python side of `verilated_sim.cpp`, the main program of simulations: clock, pins, recorder, tapes in C++.

What a bench does a million times costs a call of C instead of a trigger of cocotb. Ports are those of the top
module, up to 64 bits wide. Times are steps of the simulation (ps). Only for code that runs in a simulation.
"""

from __future__ import annotations

import ctypes
import gc
import struct
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

_ROW = struct.Struct("=QQQ")


def _function(name: str, result: Any, *arguments: Any) -> Any:
    function = getattr(ctypes.CDLL(None), name)
    function.restype, function.argtypes = result, arguments
    return function


@cache
def port(name: str) -> int:
    """Number of a port of the top module; -1 if it has none of this name or it is wider than 64 bits."""
    number: int = _function("openppmc_port", ctypes.c_int, ctypes.c_char_p)(name.encode())
    return number


try:
    now = _function("openppmc_time", ctypes.c_uint64)
    """Present time."""
    read = _function("openppmc_read", ctypes.c_uint64, ctypes.c_int)
    """Level of a port, by its number."""
    put = _function("openppmc_put", None, ctypes.c_int, ctypes.c_uint64)
    """Level for an input, by its number; the design sees it with its next evaluation, now."""
    clock = _function("openppmc_clock", None, ctypes.c_int, ctypes.c_uint64)
    """Start the clock of the simulation: low now, first rising edge after half a period."""
    watch = _function("openppmc_watch", None, ctypes.c_int)
    """Record the changes of a port from now on."""
    _seen = _function("openppmc_seen", ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint64))
    _tape = _function("openppmc_tape", None, ctypes.c_char_p, ctypes.c_uint64)
except AttributeError:  # imported outside of a simulation
    pass


def collect_seldom() -> None:
    """Look for garbage in cycles less often: a run makes a million small tuples that live to its end."""
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)


def seen() -> Iterator[tuple[int, int, int]]:
    """(time, port, level) of all changes of watched ports since the last call, this moment's among them."""
    count = ctypes.c_uint64()
    rows = _seen(ctypes.byref(count))
    return _ROW.iter_unpack(ctypes.string_at(rows, _ROW.size * count.value))


def tape(changes: Iterable[tuple[int, int, int]]) -> None:
    """Have (time, port, level) changes made, all in the future and in order; they replace earlier ones."""
    rows = b"".join(_ROW.pack(*change) for change in changes)
    _tape(rows, len(rows) // _ROW.size)
