"""Operation instructions of the PPMC-312: 10, 11, 80..88 with OV = 0 (chapter 3.3, checks 7 and 8)."""

from __future__ import annotations

from ...common.blocks import Phase
from .. import pace
from ..codes import DIR, IDX, Answer, Code, State
from ..motion.motion import Order
from ..motion.sequence import Change
from ..stages.plan import TRAPEZOID, Plan, constant, ramped
from ..stages.tables import Table
from .core import Core
from .work import Refusal, Work

BAD_RATE, BAD_VALUE = 0x20, 0x23


def _rate(table: Table, data: bytes, zero: bool = True) -> int:
    """Rate parameter; zero: 0 stands for RH."""
    rate = int.from_bytes(data, "big")
    if not rate and zero:
        return table.high
    if not table.contains(rate):
        raise Refusal(Answer.PARAMETER, BAD_RATE)
    return rate


def _count(data: bytes) -> int:
    n = int.from_bytes(data, "big")
    if not n:
        raise Refusal(Answer.PARAMETER, BAD_VALUE)
    return n


def _plan(code: int, table: Table, data: bytes) -> tuple[Plan, int]:
    """Plan and DATASHEET time to pulse 1 of a start."""
    given = data[1:3]
    if code == Code.RAMP:
        given = data[1:3] if len(data) == 7 else b"\0\0"
        count = _count(data[-4:])  # judged before the rate
        plan = ramped(table, _rate(table, given), count)
        if any(given):
            slow = pace.TRAPEZOID_RATE, pace.OTHER_SHAPE_RATE
        else:
            slow = pace.TRAPEZOID, pace.OTHER_SHAPE
        return plan, slow[plan.kind != TRAPEZOID]
    if code == Code.CONSTANT:
        count = _count(data[3:7])
        return constant(table, _rate(table, given), count), pace.CONSTANT
    if code == Code.STEP:
        return constant(table, table.rates[table.sa], 1), pace.GENERAL
    if code == Code.FOREVER_CONSTANT:
        return constant(table, _rate(table, given)), pace.CONSTANT
    if code == Code.ORIGIN_SEARCH:
        return constant(table, _rate(table, given, zero=False)), pace.GENERAL
    plan = ramped(table, _rate(table, given), None)
    return plan, pace.ENDLESS_RATE if any(given) else pace.ENDLESS


def start(core: Core, block: bytes) -> Work:
    """10, 11, 82..86; block: in logical order."""
    code, data = block[2], block[3:]
    table = core.table
    assert table is not None
    plan, cycles = _plan(code, table, data)
    search = code in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN)
    index = search and bool(data[0] & IDX)
    order = Order(plan, int(bool(data[0] & DIR)), plan.rate, search, code == Code.ZERO_RETURN, index)

    def check(t: int) -> None:
        if core.operation.limited(order):
            raise Refusal(Answer.LIMIT)

    def begin(t: int) -> bytes:
        if core.state is State.ABN:
            raise Refusal(Answer.STATUS)
        held = core.operation.start(t, order)
        kind = plan.kind if code == Code.RAMP else 0
        return bytes([code]) if code == Code.STEP else bytes([code, kind | held])

    ramped_plan = code in (Code.RAMP, Code.FOREVER_RAMP, Code.ZERO_RETURN)
    clk = core.pace.starting(plan, code == Code.STEP, ramped_plan)
    return Work(begin, clk, cycles, starts=True, check=check)


def stop(core: Core, code: int, at_position: bool) -> Work:
    """80, 81. at_position: triggered by a position."""

    def halt(t: int) -> None:
        if not core.operation.waits_for_end:
            core.operation.stop(t)

    def act(t: int) -> bytes:
        if code == Code.STOP:
            core.context.queue.at(t + core.pace.halt, Phase.BUS, halt)
        else:
            core.operation.slow_stop(t)
        return bytes([code])

    delayed = code == Code.STOP and not at_position
    return Work(act, cycles=pace.STOP if delayed else None)


def change(core: Core, code: int, data: bytes) -> Work:
    """87, 88."""
    assert core.table is not None
    rate = _rate(core.table, data[1:3], zero=False)

    def act(t: int) -> bytes:
        core.operation.change(t, Change(rate, code == Code.RAMP_CHANGE))
        return bytes([code])

    return Work(act, core.pace.look_up())
