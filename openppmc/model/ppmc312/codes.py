"""Instruction codes, lengths, accept table and response codes of the PPMC-312.

Rules: P312-CMD, P312-STA-01; response codes: docs/ppmc312/README.md, 6.1 Blocks.
"""

from __future__ import annotations

from enum import IntEnum, unique

from ..clock import Callback, Event, Scheduler


@unique
class Code(IntEnum):
    """Instruction codes of the parallel bus."""

    INITIAL = 0x00
    FREE_CURVE = 0x01
    IN_POSITION = 0x02
    ENCODE = 0x03
    INTERLOCK_POSITION = 0x04
    SPEED_LIMIT = 0x05
    END_TERMINAL = 0x06
    ORIGIN_SEARCH = 0x10
    ZERO_RETURN = 0x11
    EXCITATION_ON = 0x20
    EXCITATION_OFF = 0x21
    COUNTER_CLEAR = 0x22
    ZERO_CLAMP = 0x23
    ALARM_CLEAR = 0x24
    INPUT = 0x25
    OUTPUT = 0x26
    TERMINALS = 0x27
    MASK = 0x28
    VERSION = 0x40
    TABLE_READ = 0x41
    POSITION_READ = 0x42
    POSITION_SET = 0x43
    INTERLOCK = 0x44
    RUN_MONITOR = 0x45
    EVENT_READ = 0x47
    EVENT_SET = 0x49
    STATUS = 0x4D
    STOP = 0x80
    SLOW_STOP = 0x81
    RAMP = 0x82
    CONSTANT = 0x83
    STEP = 0x84
    FOREVER_RAMP = 0x85
    FOREVER_CONSTANT = 0x86
    RAMP_CHANGE = 0x87
    CHANGE = 0x88
    RESET = 0xFF


class Answer(IntEnum):
    """Response codes that are not instruction codes (docs/ppmc312/README.md, 6.1 Blocks)."""

    STOPPED = 0xE0
    INTERLOCK_END = 0xE1
    HOLD_EXECUTED = 0xE2
    ENCODE_CHANGE = 0xE3
    POSITION_CHANGE = 0xE4
    REGISTERED = 0xE8
    INPUT_CHANGE = 0xE9
    PARAMETER = 0xF0
    STATUS = 0xF1
    LIMIT = 0xF2
    ALARM = 0xF4
    COMMAND = 0xF5
    SIZE = 0xF6
    REGISTRATION = 0xF7
    EVENT_FAILED = 0xF8
    OVERRIDE_FAILED = 0xF9


class State(IntEnum):
    """Operation states; the value is the condition byte (P312-CMD-4D)."""

    INI = 0x01
    NOR = 0x02
    ACC = 0x04
    FIX = 0x08
    ABN = 0x10
    WRN = 0x20


class Source(IntEnum):
    """Source of an instruction; the value is the header of the response (P312-RSP, 2.3)."""

    HOST = 0x03
    EVENT = 0x0B
    OVERRIDE = 0x1B


SPONTANEOUS = 0x23


class Cause(IntEnum):
    """Cause of the end of the pulses; the value is the bit of report E0 (docs/ppmc312/README.md, 6.1).

    Attributes:
        RETURN: phase 1 of a zero return has ended.
    """

    RETURN = 0x00
    LIMIT = 0x01
    LIMIT_SLOW = 0x02
    STOP = 0x04
    SLOW = 0x08
    LOW = 0x10
    ORIGIN = 0x20
    NORMAL = 0x40
    ALARM = 0x80


SHAPES = {0x00: "trapezoid", 0x10: "triangle", 0x20: "deceleration only", 0x40: "acceleration only"}
"""Shape of a motion, by the second byte after the code of an answer (docs/ppmc312/README.md, 9.1)."""

# Causes of an immediate end, highest priority first, for causes in the same cycle (P312-MOT-34).
IMMEDIATE = (Cause.ALARM, Cause.LIMIT, Cause.ORIGIN, Cause.STOP)


class Alarm(IntEnum):
    """Status byte of the report F4 (alarm)."""

    PIN = 0
    HOST = 1
    INTERLOCK_OR_HOLD = 2
    STOPPED = 3


class Trigger(IntEnum):
    """Condition that executes a registered instruction, in order of priority (P312-OVR-10)."""

    POSITION = 0
    EVT0 = 1
    EVT1 = 2

    @classmethod
    def of_flags(cls, flags: int) -> Trigger:
        """Decode bits 1:0 of a flag byte."""
        return {0b01: cls.EVT0, 0b11: cls.EVT1}.get(flags & 3, cls.POSITION)


OV, LE, FO, DIR, IDX = 0x04, 0x10, 0x08, 0x40, 0x10

# The first set contains the codes with an override bit in their flag byte; the second contains the codes that
# a position may trigger.
OVERRIDABLE = frozenset({0x80, 0x81, 0x82, 0x83, 0x85, 0x86, 0x87, 0x88})
POSITION_TRIGGERED = frozenset({0x80, 0x81, 0x87, 0x88})
MOTION_STARTS = frozenset({0x10, 0x11, 0x82, 0x83, 0x84, 0x85, 0x86})
# Codes that may be registered in an event buffer, but that an event never executes (P312-EVT-03).
NOT_FROM_EVENTS = frozenset({0x01, 0x41, 0x49})

# Valid lengths of an instruction; 00 and 49 also depend on their parameters (P312-BLK-01 step 6).
LENGTHS: dict[int, tuple[int, ...]] = {
    **dict.fromkeys((0x20, 0x21, 0x22, 0x23, 0x24, 0x25, 0x27, 0x40, 0x41, 0x44, 0x45, 0x4D, 0xFF), (1,)),
    **dict.fromkeys((0x06, 0x26, 0x42, 0x84), (2,)),
    **dict.fromkeys((0x05, 0x28), (3,)),
    **dict.fromkeys((0x02, 0x03, 0x10, 0x11, 0x85, 0x86), (4,)),
    **dict.fromkeys((0x80, 0x81), (2, 6)),
    **dict.fromkeys((0x87, 0x88), (4, 8)),
    0x00: (9, 14),
    0x01: (3, 4),
    0x04: (5,),
    0x43: (6,),
    0x47: (1, 2),
    0x49: tuple(range(2, 31)),
    0x82: (6, 8),
    0x83: (8,),
}

_STATES = (State.INI, State.NOR, State.ACC, State.FIX, State.ABN, State.WRN)
_AT_REST = "OO...."
_ALWAYS = "OOOOOO"
_NORMAL_ONLY = ".O...."
_START = (_NORMAL_ONLY, ".OOO..")
_STOP = ("..OO..", ".OOO..")

# Accept table (P312-STA-01). An instruction has a pair of rows: the first for OV = 0, the second for OV = 1.
# A row has one letter for each state, in the order of `_STATES`. "O" means that the instruction is accepted
# in this state.
_ACCEPT: dict[int, tuple[str, str]] = {
    **{code: (_AT_REST, _AT_REST) for code in (0x00, 0x01, 0x02, 0x03, 0x04, 0x06)},
    **{code: (_AT_REST, _AT_REST) for code in (0x20, 0x21, 0x22, 0x23, 0x28, 0x41, 0x43)},
    **{code: (_NORMAL_ONLY, _NORMAL_ONLY) for code in (0x05, 0x84, 0x10, 0x11, 0x44, 0x47, 0x49)},
    **{code: (_ALWAYS, _ALWAYS) for code in (0x25, 0x26, 0x27, 0x40, 0x42, 0x4D, 0xFF)},
    **dict.fromkeys((0x80, 0x81), _STOP),
    **dict.fromkeys((0x82, 0x83, 0x85, 0x86), _START),
    0x24: ("OO..OO", "OO..OO"),
    0x45: (".O...O", ".O...O"),
    0x87: ("...O..", ".OOO.."),
    0x88: _STOP,
}


def known(code: int) -> bool:
    """Return True if the instruction exists."""
    return code in _ACCEPT


def accepts(code: int, state: State, override: bool, end_wait: bool, table: bool) -> bool:
    """Return True if the accept table (P312-STA-01) accepts an instruction.

    Args:
        end_wait: True in state FIX if the part is waiting for the positioning end.
        table: True if a valid table exists.
    """
    if code == Code.END_TERMINAL and end_wait:
        return True
    if code == Code.TABLE_READ and not table:
        return False
    return _ACCEPT[code][override][_STATES.index(state)] == "O"


# Pins of the PPMC-312 with idle and reset levels (docs/ppmc312/README.md, 2 Pins).

INPUTS: dict[str, int] = {
    "rst_n": 1,
    "mode": 1,
    "d_i": 0,
    "rs": 0,
    "cs_n": 1,
    "we_n": 1,
    "oe_n": 1,
    "rxd": 1,
    "hsp": 0,
    "mod": 0,
    "adr": 0,
    "evt0_n": 1,
    "evt1_n": 1,
    "auxi": 0,
    "epin": 0,
    "epdir": 0,
    "index_n": 1,
    "org_n": 1,
    "alm_n": 1,
    "end_n": 1,
    "fl_n": 1,
    "bl_n": 1,
    "fhl_n": 1,
    "bhl_n": 1,
    "extck": 0,
    "run": 1,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "wrq_n": 1,
    "irq_n": 1,
    "txd": 1,
    "snd": 0,
    "auxo_n": 0x3F,
    "exon_n": 1,
    "cclr_n": 1,
    "aclr_n": 1,
    "zclmp_n": 1,
    "cd_n": 1,
    "pout": 0,
    "dir": 0,
    "intlk_n": 1,
    "out_oe": 0,
}
WIDTHS: dict[str, int] = {"d_i": 8, "rs": 3, "mod": 3, "adr": 4, "auxi": 8, "d_o": 8, "auxo_n": 6}
HOST_PINS = ("d_i", "rs", "cs_n", "we_n", "oe_n")
SERIAL_PINS = ("rxd",)


# Event queue for the blocks of a PPMC-312. A software reset cancels the events of all blocks.


class _BlockEvent(Event):
    """Event of a block.

    It is cancelled when the blocks are replaced.
    """

    __slots__ = ()


class ResettableScheduler(Scheduler):
    """A queue for the blocks of a part. When the blocks are replaced, their events are cancelled."""

    def __init__(self, queue: Scheduler) -> None:
        super().__init__()
        self._queue = queue
        self._alive = True

    def at(self, t: int, phase: int, action: Callback, kind: type[Event] = _BlockEvent) -> Event:
        """Schedule a call of `action(t)`; it does not take place if the blocks are replaced before edge t."""
        event = self._queue.at(t, phase, action, kind)
        if not self._alive:
            event.cancel()
        return event

    def close(self) -> None:
        """Cancel all events, because the blocks are replaced."""
        self._alive = False
        self._queue.cancel(_BlockEvent)
