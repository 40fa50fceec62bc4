"""The event queue of the PPMC-312 as its blocks see it: a software reset drops what they wait for."""

from __future__ import annotations

from ..common.scheduler import Callback, Event, Scheduler


class _Asked(Event):
    """What a block has asked for; only the present blocks have any in the queue."""

    __slots__ = ()


class Scope(Scheduler):
    """The queue of a part as its blocks see it: what they have asked for is forgotten with them."""

    def __init__(self, queue: Scheduler) -> None:
        super().__init__()
        self._queue = queue
        self._alive = True

    def at(self, t: int, phase: int, action: Callback, kind: type[Event] = _Asked) -> Event:
        """Call `action(t)` unless the blocks have been replaced by then."""
        event = self._queue.at(t, phase, action, kind)
        if not self._alive:
            event.cancel()
        return event

    def close(self) -> None:
        """The blocks are replaced."""
        self._alive = False
        self._queue.cancel(_Asked)
