"""Setting instructions of the PPMC-312: 00..06 (P312-CMD-00..06).

Each function checks the parameters of an instruction and returns its work (`work.Work`).
"""

from __future__ import annotations

from ...chip import Phase
from .. import timing
from ..codes import FO, LE, Answer
from ..stages import FreeCurve, SettingError, build
from .overrides import Core
from .work import Rejection, Work

LENGTH, BAD_RATE, BAD_VALUE, BAD_RANGE = 0x00, 0x20, 0x23, {0x02: 0x26, 0x03: 0x27}


def _number(data: bytes) -> int:
    return int.from_bytes(data, "big")


def initial(core: Core, data: bytes) -> Work:
    """Return the work of instruction 00.

    `data` consists of the flag byte and the parameters. Its length is one of the two valid lengths.
    """
    flags = data[0]
    separate, sigmoid = bool(flags & LE), bool(flags & FO)
    try:
        if len(data) == 8:
            if separate:
                raise SettingError(LENGTH)
            rates, counts = (_number(data[1:3]), 0, _number(data[3:5])), (_number(data[5:8]), 0)
        else:
            rates = _number(data[1:3]), _number(data[3:5]), _number(data[5:7])
            counts = _number(data[7:10]), _number(data[10:13])
        table = build(*rates, *counts, flags & 7, sigmoid, separate)
    except SettingError as error:
        core.discard_table()
        clk = core.core_timing.filling(error.table) + 1 if error.table else 0
        raise Rejection(Answer.PARAMETER, error.number, clk) from None

    def begin(t: int) -> None:
        core.discard_table()

    def finish(t: int) -> bytes:
        core.set_table(table)
        return b"\x00"

    clk = core.core_timing.filling(table) + core.core_timing.looking_up()
    return Work(finish, clk, timing.BUILD[sigmoid, separate], begin=begin)


def open_curve(core: Core, header: int, data: bytes) -> Work:
    """Return the work of the code block of instruction 01, which opens a transfer of a free curve."""
    core.discard_table()
    try:
        transfer = FreeCurve(header, data)
    except SettingError as error:
        raise Rejection(Answer.PARAMETER, error.number) from None

    def finish(t: int) -> bytes:
        core.transfer = transfer
        return b"\x01" + transfer.answer()

    return Work(finish)


def add_to_curve(core: Core, header: int, data: bytes) -> Work:
    """Return the work of a data block that continues the transfer of a free curve."""
    transfer = core.transfer
    assert transfer is not None
    try:
        transfer.add(header, data)
    except SettingError as error:
        core.transfer = None
        raise Rejection(Answer.PARAMETER, error.number, core.core_timing.data + len(data)) from None

    def finish(t: int) -> bytes:
        if transfer.table is not None:
            core.transfer = None
            core.set_table(transfer.table)
        return b"\x01" + transfer.answer()

    clk = core.core_timing.data + len(data)
    return Work(finish, clk + core.core_timing.looking_up() if transfer.table else clk)


def monitor(core: Core, code: int, data: bytes) -> Work:
    """Return the work of instruction 02 or 03."""
    distance = _number(data[1:3])
    if data[0] & 1 and not distance:
        raise Rejection(Answer.PARAMETER, BAD_RANGE[code])

    def finish(t: int) -> bytes:
        monitor = core.monitors
        monitor.set_up(t, monitor.in_position if code == 0x02 else monitor.encode, data[0], distance)
        return bytes([code])

    return Work(finish)


def interlock_position(core: Core, data: bytes) -> Work:
    """Return the work of instruction 04."""

    def finish(t: int) -> bytes:
        core.interlock.position = _number(data)
        return b"\x04"

    return Work(finish)


def speed_limit(core: Core, data: bytes) -> Work:
    """Return the work of instruction 05."""
    rate = _number(data)
    if rate < 2:
        raise Rejection(Answer.PARAMETER, BAD_RATE)

    def finish(t: int) -> bytes:
        core.operation.speed_limit = rate
        return b"\x05"

    return Work(finish)


def end_terminal(core: Core, data: bytes) -> Work:
    """Return the work of instruction 06."""
    if data[0] > 1:
        raise Rejection(Answer.PARAMETER, BAD_VALUE)

    def finish(t: int) -> bytes:
        core.operation.end_monitored = bool(data[0])
        core.context.queue.at(t + 1, Phase.QUEUE, core.operation.check_end)
        return b"\x06" + data

    return Work(finish)
