"""Terminal and aiding instructions of the PPMC-312: 20..28, 40..4D (P312-CMD-20..4D)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ...chip import Phase
from .. import timing
from ..codes import Answer, Code, Trigger
from ..front.responses import INPUT
from ..stages import read_back
from .overrides import Core
from .work import Rejection, Work

BAD_VALUE, NO_BUFFER, BAD_EVENT = 0x23, 0x24, 0x25
REGISTERED, IN_USE, FULL, DELETED, NOW_EMPTY, NOTHING = range(6)
_LONGEST_EVENT = 14
_TERMINALS = (
    ("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n"),
    ("evt1_n", "evt0_n", "run", None, None, None, None, None),
)


def _bits(values: Sequence[int | bool]) -> int:
    """Return the values as the bits of a number; the first value is the most significant bit."""
    return sum(bool(value) << place for place, value in enumerate(reversed(values)))


def terminals(core: Core) -> bytes:
    """Return the parameters of the response to instruction 27: unfiltered pin levels (P312-CMD-27)."""
    levels = core.context.levels
    return bytes(_bits([pin is not None and levels[pin] for pin in pins]) for pins in _TERMINALS)


def status(core: Core) -> bytes:
    """Return the parameters of the response to instruction 4D (P312-CMD-4D)."""
    operation, monitors, fifo = core.operation, core.monitors, core.fifo
    first = [
        operation.run_ignored,
        core.interlock.on,
        0,
        monitors.encode.enabled,
        monitors.in_position.enabled,
    ]
    first += [operation.end_monitored, monitors.encode.outside, monitors.in_position.outside]
    events = [bool(core.events[1].entries), bool(core.events[0].entries)]
    events += [fifo.uses(Trigger.EVT1), fifo.uses(Trigger.EVT0)]
    return bytes([_bits(first), core.state, _bits(events) << 4 | len(fifo.waiting)])


def _alarm_clear(core: Core, t: int, data: bytes) -> bytes:
    core.clear_alarm(t)
    return b""


def _mask(core: Core, t: int, data: bytes) -> bytes:
    core.responses.discard(INPUT)
    core.input_change.set_up(t, data[1], bool(data[0] & 1))
    return b""


def _position_read(core: Core, data: bytes) -> bytes:
    counters = core.counters
    return data + (counters.encoder if data[0] else counters.pulse).to_bytes(4, "big")


def _position_set(core: Core, t: int, data: bytes) -> bytes:
    value = int.from_bytes(data[1:], "big")
    if data[0]:
        core.counters.encoder = value
    else:
        core.counters.pulse = value
    core.monitors.evaluate(t)
    return b""


def _interlock(core: Core, t: int, data: bytes) -> bytes:
    core.interlock.on = not core.interlock.on
    return bytes([core.interlock.on])


def _run_monitor(core: Core, t: int, data: bytes) -> bytes:
    core.operation.run_ignored = not core.operation.run_ignored
    core.context.queue.at(t + 1, Phase.QUEUE, core.operation.check_run)
    return bytes([core.operation.run_ignored])


def _event_read(core: Core, data: bytes) -> bytes:
    return core.events[data[0] if data else 0].read()


def _event_set(core: Core, data: bytes) -> Work:
    """Return the work of instruction 49 with legal parameters."""
    number, deletes = data[0] & 1, data[0] & 2
    buffer = core.events[number]
    result, action = REGISTERED, None
    if deletes:
        result = NOTHING if not buffer.entries else DELETED if len(buffer.entries) > 1 else NOW_EMPTY
        action = buffer.delete
    elif core.fifo.uses((Trigger.EVT0, Trigger.EVT1)[number]):
        result = IN_USE
    elif buffer.full:
        result = FULL
    else:
        action = lambda: buffer.register(data[1:])  # noqa: E731

    def finish(t: int) -> bytes:
        if action:
            action()
        return bytes([Code.EVENT_SET, result])

    return Work(finish, core.core_timing.copy if result == REGISTERED else 0)


def _set(**levels: int) -> Callable[[Core, int, bytes], bytes]:
    def action(core: Core, t: int, data: bytes) -> bytes:
        for name, level in levels.items():
            setattr(core.outputs, name, level)
        return b""

    return action


def _output(core: Core, t: int, data: bytes) -> bytes:
    core.outputs.auxo_n = ~data[0] & 0x3F
    return b""


def _counter_clear(core: Core, t: int, data: bytes) -> bytes:
    core.outputs.counter_clear(t)
    return b""


# A read of pins is executed in the cycle after its check, before the levels of that cycle are updated. Thus,
# it returns the levels at the edge of the check.
_PINS: dict[int, Callable[[Core], bytes]] = {
    Code.INPUT: lambda core: bytes([core.context.levels["auxi"]]),
    Code.TERMINALS: terminals,
}
# Reads of the part return its state at the time of the check.
_READS: dict[int, Callable[[Core, bytes], bytes]] = {
    Code.VERSION: lambda core, data: bytes([core.version]),
    Code.POSITION_READ: _position_read,
    Code.EVENT_READ: _event_read,
    Code.STATUS: lambda core, data: status(core),
}
# Actions of the instructions that have an effect at edge t. They return the parameters of the response.
_ACTIONS: dict[int, Callable[[Core, int, bytes], bytes]] = {
    Code.EXCITATION_ON: _set(exon_n=0),
    Code.EXCITATION_OFF: _set(exon_n=1),
    Code.COUNTER_CLEAR: _counter_clear,
    Code.ZERO_CLAMP: _set(zclmp_n=0),
    Code.ALARM_CLEAR: _alarm_clear,
    Code.OUTPUT: _output,
    Code.MASK: _mask,
    Code.POSITION_SET: _position_set,
    Code.INTERLOCK: _interlock,
    Code.RUN_MONITOR: _run_monitor,
}


def _check_event(data: bytes) -> None:
    """Check the parameters of instruction 49: an embedded block, or a deletion without a block.

    Rule: P312-CMD-49.
    """
    if data and data[0] & 2:
        legal = len(data) == 1
    else:
        legal = (
            len(data) >= 4 and data[1] == 0x03 and 1 <= data[2] <= _LONGEST_EVENT and len(data) == 3 + data[2]
        )
    if not legal:
        raise Rejection(Answer.PARAMETER, BAD_EVENT)


def execute(core: Core, code: int, data: bytes) -> Work:
    """Return the work of an instruction of this module that has a legal length.

    Args:
        data: parameters of the instruction.
    """
    if code == Code.TABLE_READ:
        return Work(lambda t: _table(core))
    if code in (Code.POSITION_READ, Code.POSITION_SET) and data[0] > 1:
        raise Rejection(Answer.PARAMETER, BAD_VALUE)
    if code == Code.EVENT_READ and data and data[0] > 1:
        raise Rejection(Answer.PARAMETER, NO_BUFFER)
    if code == Code.EVENT_SET:
        _check_event(data)
        return _event_set(core, data)
    if code in _PINS:
        return Work(lambda t: bytes([code]) + _PINS[code](core))
    if code in _READS:
        response = bytes([code]) + _READS[code](core, data)
        return Work(lambda t: response)
    return Work(
        lambda t: bytes([code]) + _ACTIONS[code](core, t, data),
        cycles=timing.OUTPUT if code == Code.OUTPUT else None,
    )


def _table(core: Core) -> list[bytes]:
    assert core.table is not None
    return [bytes([header, len(body)]) + body for header, body in read_back(core.table)]
