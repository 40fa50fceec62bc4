"""Shrinks a list of acts that shows a fault to a short one that still shows it (delta debugging).

All acts of a kind, then parts of the list are left out, ever smaller ones, for as long as what is left still
fails; then the pauses between the acts that remain are closed. `fails` carries a list out, each time on a
part fresh out of reset.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field

from .acts import Act

Fails = Callable[[Sequence[Act]], Awaitable[bool]]

PAUSE = 20
"""clk between two acts whose pause is closed; every bus of ours has room in it."""


def bursts(acts: Sequence[Act]) -> list[list[Act]]:
    """Acts that follow each other at once, such as the bytes of a block, together."""
    found: list[list[Act]] = []
    for act in acts:
        if found and act.begin - found[-1][-1].end < PAUSE:
            found[-1].append(act)
        else:
            found.append([act])
    return found


class _EnoughError(Exception):
    """A limit is reached."""


@dataclass
class Shrinker:
    """`acts` is the shortest list so far, `trials` how often one was carried out.

    trials_at_most, seconds (of this process on the processor): limits. kept: called with each list that is
    shorter than the ones before it.
    """

    acts: list[Act]
    fails: Fails
    trials_at_most: int = 500
    seconds: float = 60
    kept: Callable[[], None] = lambda: None
    trials: int = 0
    stopped: str = ""
    _tried: set[tuple[Act, ...]] = field(default_factory=set)

    async def run(self) -> None:
        """Shrink; `stopped` says which limit ended it before nothing could be left out any more."""
        self._end = time.process_time() + self.seconds
        try:
            await self._leave_out_kinds()
            await self._leave_out(bursts(self.acts))
            await self._leave_out([[act] for act in self.acts])
            await self._close_pauses()
            await self._leave_out([[act] for act in self.acts])
        except _EnoughError as limit:
            self.stopped = str(limit)

    async def _try(self, acts: Sequence[Act]) -> bool:
        """Whether this list fails as well; then it is the one to go on with."""
        if tuple(acts) in self._tried:
            return False
        if self.trials >= self.trials_at_most:
            raise _EnoughError(f"after {self.trials} trials")
        if time.process_time() >= self._end:
            raise _EnoughError(f"after {self.seconds:g} s")
        self._tried.add(tuple(acts))
        self.trials += 1
        if not await self.fails(acts):
            return False
        self.acts = list(acts)
        self.kept()
        return True

    async def _leave_out_kinds(self) -> None:
        """Without all acts of a kind, the most frequent first: polls, clocks, what other pins do."""
        for kind, _ in Counter(act.kind for act in self.acts).most_common():
            await self._try([act for act in self.acts if act.kind != kind])

    async def _leave_out(self, runs: list[list[Act]]) -> None:
        """Without halves, quarters, …, single ones of the runs, until no single one can be missed."""
        size = len(runs)
        while size:
            before, first = len(runs), 0
            while first < len(runs):
                rest = runs[:first] + runs[first + size :]
                if await self._try([act for run in rest for act in run]):
                    runs = rest
                else:
                    first += size
            if size > 1 or len(runs) == before:
                size //= 2

    async def _close_pauses(self) -> None:
        """What follows a pause comes sooner: at once, or after half of it, or a quarter of it is saved."""
        for place in range(len(self.acts)):
            last = max((act.end for act in self.acts[:place]), default=0)
            spare = self.acts[place].begin - last - PAUSE
            for saved in (spare, spare // 2, spare // 4):
                if saved <= 0:
                    break
                later = [act.moved(-saved) for act in self.acts[place:]]
                if await self._try(self.acts[:place] + later):
                    break
