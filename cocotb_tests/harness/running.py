"""What the running test has on the bench, for `start_bench` and `directed`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from .side import Side

TAIL = 24
"""clk for which a side goes on before it is judged: what was done last has its effects by then."""
Judge = Callable[[Any], Any]
"""Compares what a side has seen with the golden model; raises AssertionError at a difference."""


class Running:
    """One test: the side that it works on now, if any, and who judges it (None: nobody).

    `differs`: a comparison has failed. `seed`: that of its sides, if not the one of the run.
    """

    def __init__(self, judge: Judge | None, seed: int | None = None) -> None:
        self._judge = judge
        self.seed = seed
        self.side: Side | None = None
        self.differs = False

    async def judge(self) -> None:
        """Compare what the present side has seen; AssertionError at a difference."""
        if self._judge and self.side and self.side.simulated:
            await self.side.align()
            await self.side.clocks(TAIL)
            self.differs = True
            self._judge(self.side)
            self.differs = False

    async def opinion(self) -> str:
        """What the golden model says of a run that has failed a check of its test."""
        if not (self._judge and self.side and self.side.simulated):
            return "nothing is compared with the golden model here"
        try:
            await self.judge()
        except Exception as other:  # whatever the model does, the failed check is what counts
            return f"the golden model differs: {other}"
        return "up to here the golden model shows the same edges"

    async def put_away(self) -> None:
        """Judge the present side, if there is one, and let its pins rest: another one is to start."""
        if self.side:
            await self.judge()
            self.side.close()
            self.side = None


_now: list[Running] = []
_ended: list[Running] = []


def present() -> Running | None:
    """The directed or random test that is running; None outside of one."""
    return _now[-1] if _now else None


@contextmanager
def running_test(judge: Judge | None, seed: int | None = None) -> Iterator[Running]:
    """Inside, a test runs whose sides `judge` compares; see `Running`."""
    _now.append(Running(judge, seed))
    try:
        yield _now[-1]
    finally:
        _ended[:] = [_now.pop()]


def ended() -> Running | None:
    """The directed or random test that has ended last, with the side that it worked on; None before one."""
    return _ended[-1] if _ended else None
