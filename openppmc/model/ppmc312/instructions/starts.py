"""Operation instructions of the PPMC-312: 10, 11, and 80..88 with OV = 0.

Rules: P312-BLK-01, P312-CMD-10, -11, -80..88 (parameter checks and starts).
"""

from __future__ import annotations

from ...chip import Phase
from .. import timing
from ..codes import (
    DIR,
    IDX,
    LENGTHS,
    MOTION_STARTS,
    NOT_FROM_EVENTS,
    OV,
    OVERRIDABLE,
    POSITION_TRIGGERED,
    Answer,
    Code,
    Source,
    State,
    Trigger,
    accepts,
    known,
)
from ..motion.motion import MotionRequest
from ..motion.sequence import Change
from ..stages import TRAPEZOID, Plan, Table, constant, ramped
from . import settings, terminals
from .overrides import Core, Entry
from .work import Rejection, Work

# Checks 1..7 of an instruction block of the PPMC-312, and its registration (P312-BLK-01, P312-OVR-01).

MORE, LAST, CODE_MORE, CODE_LAST = range(4)
INSTRUCTION_DUE, DATA_DUE = 0x01, 0x02
LONGEST = 30
TOO_LONG, BAD_SIZE, CURVE_LENGTH, NO_TRIGGER, BAD_OPERANDS, EVENT_LENGTH = 0x15, 0x16, 0x11, 0x21, 0x23, 0x25
FIFO_FULL, EVT_IN_USE = 0x00, 0x01


def is_reset(block: bytes) -> bool:
    """Return True for the block 03 01 FF, which is the software reset."""
    return block == bytes([CODE_LAST, 1, Code.RESET])


def check(core: Core, block: bytes, source: Source, at_position: bool = False) -> Work:
    """Check a block in logical order; return its work (`work.Work`).

    Args:
        at_position: True if a position has released the block; this affects the DATASHEET time of instruction
            80.

    Raises:
        Rejection: the block is rejected. If this rejection clears some state, the state has already been
            cleared.
    """
    _check_size(core, block)
    header, body = block[0], block[2:]
    if core.transfer is not None:
        if header in (MORE, LAST):
            return settings.add_to_curve(core, header, body)
        core.transfer = None
        raise Rejection(Answer.STATUS, DATA_DUE)
    if header not in (CODE_MORE, CODE_LAST):
        raise Rejection(Answer.STATUS, INSTRUCTION_DUE)
    code, data = body[0], body[1:]
    if not known(code):
        raise Rejection(Answer.COMMAND, code)
    if header == CODE_MORE and code != Code.FREE_CURVE:
        raise Rejection(Answer.STATUS, INSTRUCTION_DUE)
    override = code in OVERRIDABLE and bool(data) and bool(data[0] & OV)
    if source is Source.EVENT and (override or code in NOT_FROM_EVENTS):
        raise Rejection(Answer.PARAMETER)
    override = override and source is Source.HOST
    operation = core.operation
    if not accepts(code, core.state, override, operation.waits_for_end, core.table is not None):
        raise Rejection(Answer.STATUS)
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
        raise Rejection(Answer.PARAMETER, TOO_LONG if length > LONGEST else BAD_SIZE)
    raise Rejection(Answer.SIZE, length)


def _check_length(core: Core, header: int, code: int, length: int) -> None:
    if length in LENGTHS[code] or code == Code.FREE_CURVE:
        return
    if code == Code.INITIAL:
        core.discard_table()
        raise Rejection(Answer.PARAMETER, settings.LENGTH)
    raise Rejection(Answer.PARAMETER, EVENT_LENGTH if code == Code.EVENT_SET else BAD_OPERANDS)


def _registration(core: Core, code: int, data: bytes, block: bytes) -> Work:
    """Return the work that registers an instruction with OV = 1 in the command FIFO."""
    trigger = Trigger.of_flags(data[0])
    position = 0
    if trigger is Trigger.POSITION:
        if code not in POSITION_TRIGGERED:
            raise Rejection(Answer.PARAMETER, NO_TRIGGER)
        place = 3 if code in (Code.RAMP_CHANGE, Code.CHANGE) else 1
        if len(data) < place + 4:
            raise Rejection(Answer.PARAMETER, BAD_OPERANDS)
        position = int.from_bytes(data[place : place + 4], "big")

    if trigger is not Trigger.POSITION and core.events[trigger - 1].entries:
        raise Rejection(Answer.REGISTRATION, EVT_IN_USE)
    if core.fifo.full:
        raise Rejection(Answer.REGISTRATION, FIFO_FULL)

    def register(t: int) -> bytes:
        core.fifo.register(Entry(block, trigger, position), t + core.core_timing.armed)
        return bytes([Answer.REGISTERED])

    return Work(register, core.core_timing.copy)


def _work(core: Core, block: bytes, at_position: bool) -> Work:
    code, data = block[2], block[3:]
    if code in MOTION_STARTS:
        return start(core, block)
    if code in (Code.STOP, Code.SLOW_STOP):
        return stop(core, code, at_position)
    if code in (Code.RAMP_CHANGE, Code.CHANGE):
        return change(core, code, data)
    if code in (Code.IN_POSITION, Code.ENCODE):
        return settings.monitor(core, code, data)
    simple = {
        Code.INTERLOCK_POSITION: settings.interlock_position,
        Code.SPEED_LIMIT: settings.speed_limit,
        Code.END_TERMINAL: settings.end_terminal,
    }
    if code in simple:
        return simple[Code(code)](core, data)
    return terminals.execute(core, code, data)


BAD_RATE, BAD_VALUE = 0x20, 0x23


def _rate(table: Table, data: bytes, zero: bool = True) -> int:
    """Return a rate parameter.

    Args:
        zero: True if the value 0 means RH.
    """
    rate = int.from_bytes(data, "big")
    if not rate and zero:
        return table.high
    if not table.contains(rate):
        raise Rejection(Answer.PARAMETER, BAD_RATE)
    return rate


def _count(data: bytes) -> int:
    n = int.from_bytes(data, "big")
    if not n:
        raise Rejection(Answer.PARAMETER, BAD_VALUE)
    return n


def _plan(code: int, table: Table, data: bytes) -> tuple[Plan, int]:
    """Return the plan of a start, and the time to its pulse 1 with DATASHEET timing."""
    given = data[1:3]
    if code == Code.RAMP:
        given = data[1:3] if len(data) == 7 else b"\0\0"
        count = _count(data[-4:])  # the pulses are checked before the rate
        plan = ramped(table, _rate(table, given), count)
        if any(given):
            slow = timing.TRAPEZOID_RATE, timing.OTHER_SHAPE_RATE
        else:
            slow = timing.TRAPEZOID, timing.OTHER_SHAPE
        return plan, slow[plan.kind != TRAPEZOID]
    if code == Code.CONSTANT:
        count = _count(data[3:7])
        return constant(table, _rate(table, given), count), timing.CONSTANT
    if code == Code.STEP:
        return constant(table, table.rates[table.sa], 1), timing.GENERAL
    if code == Code.FOREVER_CONSTANT:
        return constant(table, _rate(table, given)), timing.CONSTANT
    if code == Code.ORIGIN_SEARCH:
        return constant(table, _rate(table, given, zero=False)), timing.GENERAL
    plan = ramped(table, _rate(table, given), None)
    return plan, timing.ENDLESS_RATE if any(given) else timing.ENDLESS


def start(core: Core, block: bytes) -> Work:
    """Return the work of instruction 10, 11 or 82..86.

    Args:
        block: instruction block in logical order.
    """
    code, data = block[2], block[3:]
    table = core.table
    assert table is not None
    plan, cycles = _plan(code, table, data)
    search = code in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN)
    index = search and bool(data[0] & IDX)
    request = MotionRequest(
        plan, int(bool(data[0] & DIR)), plan.rate, search, code == Code.ZERO_RETURN, index
    )

    def check(t: int) -> None:
        if core.operation.is_start_blocked(request):
            raise Rejection(Answer.LIMIT)

    def begin(t: int) -> bytes:
        if core.state is State.ABN:
            raise Rejection(Answer.STATUS)
        waits_for_run = core.operation.start(t, request)
        kind = plan.kind if code == Code.RAMP else 0
        return bytes([code]) if code == Code.STEP else bytes([code, kind | waits_for_run])

    ramped_plan = code in (Code.RAMP, Code.FOREVER_RAMP, Code.ZERO_RETURN)
    clk = core.core_timing.starting(plan, code == Code.STEP, ramped_plan)
    return Work(begin, clk, cycles, starts=True, check=check)


def stop(core: Core, code: int, at_position: bool) -> Work:
    """Return the work of instruction 80 or 81.

    Args:
        at_position: True if a position has triggered the instruction.
    """

    def halt(t: int) -> None:
        if not core.operation.waits_for_end:
            core.operation.stop(t)

    def execute(t: int) -> bytes:
        if code == Code.STOP:
            core.context.queue.at(t + core.core_timing.halt, Phase.BUS, halt)
        else:
            core.operation.slow_stop(t)
        return bytes([code])

    delayed = code == Code.STOP and not at_position
    return Work(execute, cycles=timing.STOP if delayed else None)


def change(core: Core, code: int, data: bytes) -> Work:
    """Return the work of instruction 87 or 88."""
    assert core.table is not None
    rate = _rate(core.table, data[1:3], zero=False)

    def execute(t: int) -> bytes:
        core.operation.change(t, Change(rate, code == Code.RAMP_CHANGE))
        return bytes([code])

    return Work(execute, core.core_timing.look_up())
