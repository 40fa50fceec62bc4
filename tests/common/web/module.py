"""A part's module in this process: WebAssembly with wasmtime, or the equivalent native library with
ctypes.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import wasmtime

from openppmc.check.records import Change, Edge, Recording
from scripts.fpga.flow.plain_sim import parted, words
from scripts.site.webparts import WebPart

ROW = struct.Struct("<dII")
INPUT = 1 << 16
"""In a row that the module returns, number INPUT + n means input word n; a lower number is that of an output
word.
"""
QUEUE = 1 << 16
"""Number of future changes that the queue of a module can store."""
Call = Callable[..., Any]
_KINDS = {
    "power_up": (None, []),
    "run": (ctypes.c_double, [ctypes.c_double, ctypes.c_uint32]),
    "queue_rows": (ctypes.c_void_p, []),
    "queued": (None, [ctypes.c_uint32]),
    "put": (None, [ctypes.c_uint32, ctypes.c_uint32]),
    "place": (None, [ctypes.c_uint32, *[ctypes.c_double] * 6]),
    "plant": (None, [ctypes.c_uint32]),
    "position": (ctypes.c_double, [ctypes.c_uint32]),
    "clk_now": (ctypes.c_double, []),
    "take": (ctypes.c_uint32, []),
    "row_at": (ctypes.c_void_p, []),
}


class Module:
    """One part after power-up.

    Attributes:
        call: name -> function of the module (site/core/core.cpp).
    """

    def __init__(self, part: WebPart, path: Path) -> None:
        pins = part.part
        self.inputs, self.outputs = words(pins, pins.inputs), words(pins, pins.watched)
        self.numbers = {word: number for number, word in enumerate(self.inputs)}
        self.part = pins
        self.call: dict[str, Call] = {}
        self._bytes: Callable[[int, int], bytes]
        self._write: Callable[[int, bytes], Any]
        (self._open_native if path.suffix == ".so" else self._open_wasm)(path)
        self.call["power_up"]()

    def _open_native(self, path: Path) -> None:
        library = ctypes.CDLL(str(path))
        for name, (result, arguments) in _KINDS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, arguments
            self.call[name] = function
        self._bytes = lambda at, size: ctypes.string_at(at, size)
        self._write = lambda at, data: ctypes.memmove(at, data, len(data))

    def _open_wasm(self, path: Path) -> None:
        engine = wasmtime.Engine()
        store, linker = wasmtime.Store(engine), wasmtime.Linker(engine)
        store.set_wasi(wasmtime.WasiConfig())
        linker.define_wasi()
        exports = linker.instantiate(store, wasmtime.Module.from_file(engine, str(path))).exports(store)
        memory: Any = exports["memory"]
        for name in _KINDS:
            function: Any = exports[name]
            self.call[name] = lambda *words, function=function: function(store, *words)
        start: Any = exports["_initialize"]
        start(store)
        self._bytes = lambda at, size: bytes(memory.read(store, at, at + size))
        self._write = lambda at, data: memory.write(store, data, at)

    def rows(self) -> Iterator[tuple[int, int, int]]:
        """Yield (t, number of the word, value) of all changes since the last call; see core.cpp."""
        count = self.call["take"]()
        for t, pin, value in ROW.iter_unpack(self._bytes(self.call["row_at"](), count * ROW.size)):
            yield int(t), pin, value

    def play(self, recording: Recording) -> list[Edge]:
        """Apply the pin changes of a recording after power-up; return the output edges.

        If a word of a wide port changes, the edge has the level of the whole port.
        """
        self.call["power_up"]()
        levels = self.part.reset_levels(recording.params)
        changes = self._changes(recording.stimulus)
        edges, left = [], list(islice(changes, QUEUE))
        while True:
            self._write(self.call["queue_rows"](), b"".join(ROW.pack(*row) for row in left))
            self.call["queued"](len(left))
            # Stop before the first change that is not in the queue yet.
            more = list(islice(changes, QUEUE))
            end = min(recording.end + 1, int(more[0][0]) if more else recording.end + 1)
            while (now := int(self.call["clk_now"]())) < end:
                self.call["run"](float(end - now), 0)
                for t, pin, value in self.rows():
                    if pin >= INPUT:
                        continue
                    name, place = self.outputs[pin]
                    levels[name] = levels[name] & ~(0xFFFFFFFF << 32 * place) | value << 32 * place
                    edges.append(Edge(t, name, levels[name]))
            if not more:
                return edges
            left = more

    def _changes(self, stimulus: Iterable[Change]) -> Iterator[tuple[float, int, int]]:
        for t, pin, value in stimulus:
            if pin == "rst_n":
                yield float(t), len(self.inputs), value
                continue
            for place, part in enumerate(parted(value, (self.part.width(pin) + 31) // 32)):
                yield float(t), self.numbers[pin, place], part
