"""DATASHEET times of the PPMC-2104: processing windows (8.1) and the polling of limits and alarm (8.2)."""

from __future__ import annotations

from ..common.blocks import Context, Phase
from ..motion.codes import ACC_DEC, CONSTANT, CONTINUOUS, HIGH_SPEED, ORIGIN, SINGLE_STEP, Command, Kind
from ..single.hostport import HostPort
from .codes import CONTROL_INPUT, END_STATUS, ERROR_CODE, OUTPUT_SIGNAL, REMAINING

_KINDS = {
    Kind.INITIALISE: 71_000,
    Kind.STOP: 400,
    Kind.SLOW_STOP: 32,
    Kind.EXCITATION_OFF: 32,
    Kind.AUX_OUTPUT: 40,
    Kind.AUX_INPUT: 40,
    Kind.SWITCHING: 36,
    Kind.HOLD_DELAY: 32,
}
_READS = {END_STATUS: 40, CONTROL_INPUT: 36, OUTPUT_SIGNAL: 32, REMAINING: 37, ERROR_CODE: 43}
_OPERATIONS = {SINGLE_STEP: 103, ACC_DEC: 110, CONSTANT: 29, CONTINUOUS: 32, HIGH_SPEED: 118, ORIGIN: 32}
_TRIANGLE = 340
_POLL = 35


def window_us(command: Command, triangle: bool = False) -> int:
    """Length of an instruction's processing window in us (P2104-DS-01..13)."""
    if command.kind is Kind.READ:
        return _READS[command.code & 7]
    if command.kind is Kind.OPERATION:
        return _TRIANGLE if triangle and command.operation == ACC_DEC else _OPERATIONS[command.operation]
    return _KINDS[command.kind]


class Windows:
    """The open window, if any, and the poll ticks that it holds up. Only used in DATASHEET timing.

    `axis`: 0 or 1 while a window of that axis is open, else None.
    """

    def __init__(self, context: Context, port: HostPort, released: int) -> None:
        self._context = context
        self._port = port
        self._period = context.timebase.cyc(16 * _POLL)
        self._origins = (released, released)
        self._since = -1
        self.axis: int | None = None

    def open(self, t: int, us: int, axis: int | None) -> int:
        """Open a window at edge t; returns its last edge. axis None: no axis shows it in CMND."""
        context = self._context
        end = t + context.timebase.cyc(16 * us) + context.latency.ds_window
        self._port.close_until(end)
        self._origins = (self._origin(t), end)
        self._since = t
        self.axis = axis
        context.queue.at(end, Phase.BEGIN, self._close)
        return end

    def _close(self, t: int) -> None:
        self.axis = None

    def _origin(self, t: int) -> int:
        """Edge from which the poll ticks at edge t count; the one a window opens on is still an old one."""
        return self._origins[t > self._since]

    def is_tick(self, t: int) -> bool:
        """Whether limits and alarm are looked at on edge t (P2104-DS-20)."""
        passed = t - self._origin(t)
        return passed > 0 and passed % self._period == 0

    def next_tick(self, t: int) -> int:
        """The first tick after edge t, unless a window opens before."""
        origin = self._origin(t + 1)
        return origin + (max(0, t - origin) // self._period + 1) * self._period
