"""Registered instructions of a PPMC-312: overrides that wait for a position or an event, event buffers."""

from __future__ import annotations

from ...model.ppmc312.codes import Answer
from ..axis.axis import CCW, CW
from ..basis import units
from ..basis.errors import OutOfRange, ProtocolError
from . import blocks
from .blocks import Trigger
from .core import MotionT
from .errors import RegistrationRefused
from .registers import EventBuffer
from .settings import Settings

_EVENTS = {1: Trigger.EVENT1, 2: Trigger.EVENT2}
REGISTERED, IN_USE, FULL, DELETED, EMPTY_NOW, NOTHING = range(6)


class Overrides(Settings[MotionT]):
    """See `ppmc312.Ppmc312`.

    Overrides happen in the order of their registration, up to eight of them; each waits for a position (at)
    or for event input 1 or 2 (event). They stay through the end of a motion and go with the next table.
    Raises RegistrationRefused. What they did comes as a report (`Executed`, `Failed`): read it before the
    next one is due, or the part goes into alarm.
    """

    # ------------------------------------------------------------------ overrides

    def override_stop(self, at: int | None = None, event: int | None = None, slow: bool = True) -> None:
        """A stop, with a ramp or at once (then pulse `at` is the last one)."""
        make = blocks.slow_stop if slow else blocks.immediate_stop
        self._register(make(_trigger(at, event), at))

    def override_speed(
        self, pps: units.Number, at: int | None = None, event: int | None = None, ramped: bool = True
    ) -> None:
        """Another speed of the table, with a ramp (which needs a constant speed before) or at once."""
        self._register(blocks.change(self.rate_of(pps), ramped, _trigger(at, event), at))

    def override_move(self, pulses: int, event: int, pps: units.Number | None = None) -> None:
        """A move on an event; pps: constant speed, None for one with ramps."""
        self._register(self.move_block(pulses, pps, _trigger(None, event)))

    def override_run(self, direction: int, event: int, pps: units.Number | None = None) -> None:
        """An endless motion on an event; pps: constant speed, None: with a ramp to the high speed."""
        rate = 0 if pps is None else self.rate_of(pps)
        self._register(blocks.run(direction, rate, pps is None, _trigger(None, event)))

    def _register(self, block: bytes) -> None:
        response = self.window.ask(block)
        if response.code != Answer.REGISTERED:
            raise ProtocolError(f"{self.link.name}: nothing was registered: {response.raw.hex(' ')}")

    def move_block(
        self, pulses: int, pps: units.Number | None = None, trigger: Trigger = Trigger.NOW
    ) -> bytes:
        """Instruction of a move, signed pulses; pps: constant speed. OutOfRange."""
        side, count = (CCW, -pulses) if pulses < 0 else (CW, pulses)
        if not 1 <= count < blocks.POSITIONS:
            raise OutOfRange(f"{pulses} pulses: a move has 1 to {blocks.POSITIONS - 1} pulses either way")
        if pps is None:
            return blocks.acceleration(side, count, 0, trigger)
        return blocks.constant(side, count, self.rate_of(pps), trigger)

    # ------------------------------------------------------------------ event buffers

    def event_add(self, event: int, block: bytes) -> None:
        """Put an instruction (`move_block`, `blocks`) into event buffer 1 or 2, which hold four each. A
        falling edge of the event input carries the next one out, round and round. Only at rest."""
        status = self.instruct(blocks.event_register(event, block), 4)[0]
        if status == IN_USE:
            raise RegistrationRefused(status, f"event {event} is in use by an override")
        if status == FULL:
            raise RegistrationRefused(status, f"event buffer {event} is full: it holds four instructions")

    def event_delete(self, event: int) -> bool:
        """Take the last instruction of an event buffer out; False if there was none."""
        return self.instruct(blocks.event_delete(event), 4)[0] != NOTHING

    def event_buffer(self, event: int) -> EventBuffer:
        """What event buffer 1 or 2 holds; at rest."""
        return EventBuffer.parse(self.instruct(blocks.event_read(event), 9))


def _trigger(at: int | None, event: int | None) -> Trigger:
    """What an override waits for. OutOfRange if it is not exactly one thing."""
    if (at is None) == (event is None):
        raise OutOfRange("an override waits either for a position (at) or for an event")
    if event is None:
        return Trigger.POSITION
    if event not in _EVENTS:
        raise OutOfRange(f"event {event!r}: there are events 1 and 2")
    return _EVENTS[event]
