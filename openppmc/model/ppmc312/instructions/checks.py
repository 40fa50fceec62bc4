"""Checks 1..7 on an instruction block of the PPMC-312 and its registration (P312-BLK-01, P312-OVR-01)."""

from __future__ import annotations

from ..codes import (
    LENGTHS,
    MOTION_STARTS,
    NOT_FROM_EVENTS,
    OV,
    OVERRIDABLE,
    POSITION_TRIGGERED,
    Answer,
    Code,
    Source,
    Trigger,
    accepts,
    known,
)
from . import settings, starts, terminals
from .core import Core
from .overrides import Entry
from .work import Refusal, Work

MORE, LAST, CODE_MORE, CODE_LAST = range(4)
INSTRUCTION_DUE, DATA_DUE = 0x01, 0x02
LONGEST = 30
TOO_LONG, BAD_SIZE, CURVE_LENGTH, NO_TRIGGER, BAD_OPERANDS, EVENT_LENGTH = 0x15, 0x16, 0x11, 0x21, 0x23, 0x25
FIFO_FULL, EVT_IN_USE = 0x00, 0x01


def is_reset(block: bytes) -> bool:
    """A well-formed 03 01 FF."""
    return block == bytes([CODE_LAST, 1, Code.RESET])


def check(core: Core, block: bytes, source: Source, at_position: bool = False) -> Work:
    """Check a block in logical order. Raises Refusal; what a refusal destroys is destroyed by then.

    at_position: released by a position, which the DATASHEET times of 80 make a difference for.
    """
    _check_size(core, block)
    header, body = block[0], block[2:]
    if core.transfer is not None:
        if header in (MORE, LAST):
            return settings.add_to_curve(core, header, body)
        core.transfer = None
        raise Refusal(Answer.STATUS, DATA_DUE)
    if header not in (CODE_MORE, CODE_LAST):
        raise Refusal(Answer.STATUS, INSTRUCTION_DUE)
    code, data = body[0], body[1:]
    if not known(code):
        raise Refusal(Answer.COMMAND, code)
    if header == CODE_MORE and code != Code.FREE_CURVE:
        raise Refusal(Answer.STATUS, INSTRUCTION_DUE)
    override = code in OVERRIDABLE and bool(data) and bool(data[0] & OV)
    if source is Source.EVENT and (override or code in NOT_FROM_EVENTS):
        raise Refusal(Answer.PARAMETER)
    override = override and source is Source.HOST
    operation = core.operation
    if not accepts(code, core.state, override, operation.waits_for_end, core.table is not None):
        raise Refusal(Answer.STATUS)
    _check_length(core, header, code, len(body))
    if override:
        return _registration(core, code, data, block)
    if code == Code.INITIAL:
        return settings.initial(core, data)
    if code == Code.FREE_CURVE:
        return settings.open_curve(core, header, data)
    return _work(core, block, at_position)


def _check_size(core: Core, block: bytes) -> None:
    n = len(block)
    length = block[1] if n > 1 else 0
    if n >= 3 and length == n - 2:
        return
    if core.transfer is not None:
        core.transfer = None
        raise Refusal(Answer.PARAMETER, TOO_LONG if length > LONGEST else BAD_SIZE)
    raise Refusal(Answer.SIZE, length)


def _check_length(core: Core, header: int, code: int, length: int) -> None:
    if length in LENGTHS[code] or code == Code.FREE_CURVE:
        return
    if code == Code.INITIAL:
        core.forget_table()
        raise Refusal(Answer.PARAMETER, settings.LENGTH)
    raise Refusal(Answer.PARAMETER, EVENT_LENGTH if code == Code.EVENT_SET else BAD_OPERANDS)


def _registration(core: Core, code: int, data: bytes, block: bytes) -> Work:
    """OV = 1: into the command FIFO."""
    trigger = Trigger.of_flags(data[0])
    position = 0
    if trigger is Trigger.POSITION:
        if code not in POSITION_TRIGGERED:
            raise Refusal(Answer.PARAMETER, NO_TRIGGER)
        place = 3 if code in (Code.RAMP_CHANGE, Code.CHANGE) else 1
        if len(data) < place + 4:
            raise Refusal(Answer.PARAMETER, BAD_OPERANDS)
        position = int.from_bytes(data[place : place + 4], "big")

    if trigger is not Trigger.POSITION and core.events[trigger - 1].entries:
        raise Refusal(Answer.REGISTRATION, EVT_IN_USE)
    if core.fifo.full:
        raise Refusal(Answer.REGISTRATION, FIFO_FULL)

    def register(t: int) -> bytes:
        core.fifo.register(Entry(block, trigger, position), t + core.pace.armed)
        return bytes([Answer.REGISTERED])

    return Work(register, core.pace.copy)


def _work(core: Core, block: bytes, at_position: bool) -> Work:
    code, data = block[2], block[3:]
    if code in MOTION_STARTS:
        return starts.start(core, block)
    if code in (Code.STOP, Code.SLOW_STOP):
        return starts.stop(core, code, at_position)
    if code in (Code.RAMP_CHANGE, Code.CHANGE):
        return starts.change(core, code, data)
    if code in (Code.IN_POSITION, Code.ENCODE):
        return settings.monitor(core, code, data)
    simple = {
        Code.INTERLOCK_POSITION: settings.interlock_position,
        Code.SPEED_LIMIT: settings.speed_limit,
        Code.END_TERMINAL: settings.end_terminal,
    }
    if code in simple:
        return simple[Code(code)](core, data)
    return terminals.act(core, code, data)
