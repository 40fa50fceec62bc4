"""`Clockwork`: what a bench needs of the simulation a million times: clock, pins, levels, edges of outputs.

`clockwork()` is that of the main program the simulation runs on: `Native` on our own, `Stock` on cocotb's
(see `verilate`). Both give the same; the one is faster, the other needs nothing but cocotb.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Protocol

from .native import Native
from .stock import Stock


class Clockwork(Protocol):
    """Clock, pins and recorder. Times are steps of the simulation, which are ps; ports are those of the top
    module, by the numbers that `port` gives them."""

    def port(self, name: str) -> int:
        """Number of a port. Raises AttributeError if the top has none of this name."""

    def now(self) -> int:
        """Present time."""

    def read(self, port: int) -> int:
        """Present level of a port."""

    def put(self, port: int, level: int) -> None:
        """Level for an input; the design sees it with its next evaluation, in this time step."""

    def clock(self, port: int, half: int) -> None:
        """Start the clock (anew): low now, first rising edge after `half`. Nothing is watched yet."""

    def watch(self, port: int) -> None:
        """Record the changes of a port from now on, until the clock is started anew or the test ends. Once is
        enough for each port."""

    def seen(self) -> Iterable[tuple[int, int, int]]:
        """(time, port, level) of all changes of watched ports since the last call, this moment's among them.

        A port's changes are in order; of each time step it is the last level that counts.
        """


@cache
def clockwork() -> Clockwork:
    """The one of this simulation."""
    return Native() if Native.offered() else Stock()
