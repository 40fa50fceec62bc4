"""`Stock`: the `Clockwork` of simulations on cocotb's own main program: nothing but what cocotb offers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import cocotb
from cocotb import simtime
from cocotb.clock import Clock
from cocotb.simtime import get_sim_time
from cocotb.task import Task

PICOSECOND = -12


class Stock:
    """See `Clockwork`. Clock and recorder are tasks of the running test and end with it."""

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
        """As `Clockwork.port`."""
        if name not in self._numbers:
            self._handles.append(getattr(cocotb.top, name))
            self._numbers[name] = len(self._handles) - 1
        return self._numbers[name]

    def read(self, port: int) -> int:
        """As `Clockwork.read`. AssertionError if a bit has no level (X), which some simulators can tell.

        Data that are not driven, such as d_o with d_oe = 0, are not looked at: such bits read 0.
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
        """As `Clockwork.put`."""
        self._handles[port].value = level

    def clock(self, port: int, half: int) -> None:
        """As `Clockwork.clock`."""
        if self._clock is not None:
            self._clock.stop()
        self._clock = Clock(self._handles[port], 2 * half, impl="gpi")
        self._clock.start(start_high=False)
        self.unwatch()

    def unwatch(self) -> None:
        """Watch nothing any more."""
        for recorder in self._recorders.values():
            recorder.cancel()
        for record in (self._recorders, self._levels, self._rows):
            record.clear()

    def watch(self, port: int) -> None:
        """As `Clockwork.watch`."""
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

    def seen(self) -> Iterable[tuple[int, int, int]]:
        """As `Clockwork.seen`."""
        # A change of this moment may not have woken its recorder yet.
        for port in self._recorders:
            self._note(port)
        changed = []
        for (time, port), level in self._rows.items():
            if level != self._levels[port]:
                self._levels[port] = level
                changed.append((time, port, level))
        self._rows.clear()
        return changed
