"""Shrinks a list of acts that shows a fault to a short one that still shows it (delta debugging).

The last exchanges may be enough. Then all acts of a kind are left out, then parts of the list: exchanges,
messages, single acts, ever fewer at a time, for as long as what is left still fails; and the pauses between
the acts that remain are closed. What makes trials short comes first. `fails` carries a list out, each time on
a part fresh out of reset.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field

from .acts import Act
from .messages import PAUSE, exchanges, messages, together

Fails = Callable[[Sequence[Act]], Awaitable[int | None]]
"""Edge of the first difference, None if there is no such one."""

CAPS = (PAUSE, 10 * PAUSE, 100 * PAUSE, 1000 * PAUSE)
"""clk that no pause shall be longer than, tried in turn."""


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
            await self._keep_the_end()
            await self._leave_out_kinds()
            await self._leave_out(exchanges(self.acts))
            await self._cap_pauses()
            await self._leave_out(messages(self.acts))
            before: list[Act] = []
            while before != self.acts:
                before = self.acts
                await self._leave_out([[act] for act in self.acts])
                await self._close_pauses()
        except _EnoughError as limit:
            self.stopped = str(limit)

    async def _try(self, acts: Sequence[Act]) -> bool:
        """Whether this list fails as well; then it is the one to go on with, up to the difference."""
        if tuple(acts) in self._tried:
            return False
        if self.trials >= self.trials_at_most:
            raise _EnoughError(f"after {self.trials} trials")
        if time.process_time() >= self._end:
            raise _EnoughError(f"after {self.seconds:g} s")
        self._tried.add(tuple(acts))
        self.trials += 1
        edge = await self.fails(acts)
        if edge is None:
            return False
        self.acts = [act for act in acts if act.begin <= edge]
        self.kept()
        return True

    async def _keep_the_end(self) -> None:
        """Only the last exchanges, soon after the reset: ever more of them until they are enough.

        A part left out further on shifts what is read later; and short lists are cheap to try.
        """
        runs, count = exchanges(self.acts), 1
        head = [act for act in self.acts if act.begin < PAUSE]
        start = max((act.end for act in head), default=0) + PAUSE
        while count <= len(runs) // 2:
            end = together(runs[-count:])
            if end[0].begin <= start:
                return
            if await self._try([*head, *(act.moved(start - end[0].begin) for act in end)]):
                return
            count += 1 + count // 4

    async def _leave_out_kinds(self) -> None:
        """Without all acts of a kind, the most frequent first: polls, clocks, what other pins do.

        Rare ones can wait. The last message stays: it may be the poll that shows the difference.
        """
        for kind, count in Counter(act.kind for act in self.acts).most_common():
            if count < len(self.acts) // 20:
                return
            last = max(messages(self.acts), key=lambda run: run[-1].end)
            await self._try([act for act in self.acts if act.kind != kind or act in last])

    async def _leave_out(self, runs: list[list[Act]]) -> None:
        """Without halves, quarters, …, single ones of the runs."""
        size = max(1, len(runs) // 2)
        while size:
            first = 0
            while first < len(runs):
                rest = runs[:first] + runs[first + size :]
                if await self._try(together(rest)):
                    runs = [run for run in rest if run[0].begin <= self.acts[-1].begin]
                else:
                    first += size
            size //= 2

    async def _cap_pauses(self) -> None:
        """No pause longer than it must be, all of them at once."""
        for longest in CAPS:
            acts: list[Act] = []
            saved = last = 0
            for act in self.acts:
                saved += max(0, act.begin - saved - last - longest)
                acts.append(act.moved(-saved))
                last = max(last, acts[-1].end)
            if not saved or await self._try(acts):
                return

    async def _close_pauses(self) -> None:
        """What follows a pause comes sooner: at once, or after half of it, or a quarter of it is saved."""
        place = 0
        while place < len(self.acts):
            last = max((act.end for act in self.acts[:place]), default=0)
            spare = self.acts[place].begin - last - PAUSE
            for saved in (spare, spare // 2, spare // 4):
                if saved <= 0:
                    break
                later = [act.moved(-saved) for act in self.acts[place:]]
                if await self._try(self.acts[:place] + later):
                    break
            place += 1
