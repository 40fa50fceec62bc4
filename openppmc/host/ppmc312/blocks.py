"""Instruction blocks of the PPMC-312 in logical order: header, length, code, parameters. Pure.

Numbers are big-endian. Every function raises OutOfRange for a value that does not fit its field. Whether the
part accepts a block also depends on the table that it holds and on its state.

>>> acceleration(CW, 5000).hex(" ")
'03 08 82 00 00 00 00 00 13 88'
>>> immediate_stop(Trigger.POSITION, 0x1000).hex(" ")
'03 06 80 04 00 00 10 00'
>>> bus_order(immediate_stop(Trigger.POSITION, 0x1000)).hex(" ")
'00 10 00 00 04 80 06 03'
"""

from __future__ import annotations

from enum import Enum

from ...model.ppmc312.codes import Code
from ..check import side, whole, within
from ..errors import OutOfRange

CW, CCW = 0, 1
WHOLE, LAST_DATA, MORE_DATA, OPENING = 0x03, 0x01, 0x00, 0x02
"""Headers of blocks.

They are the headers, in this order, of a complete instruction, of the last data block, of a data block that
other data blocks follow, and of a code block that data blocks follow.
"""
LONGEST = 32
WINDOW = 0x20
POSITIONS = 1 << 32
_DIRECTION, _OVERRIDE, _INDEX, _SEPARATE, _SIGMOID = 0x40, 0x04, 0x10, 0x10, 0x08


class Trigger(Enum):
    """Condition that starts a registered instruction.

    The value contains the fields OV and TRG of the flag byte.
    """

    NOW = 0x00
    POSITION = _OVERRIDE
    EVENT1 = _OVERRIDE | 1
    EVENT2 = _OVERRIDE | 3


def block(code: int, parameters: bytes = b"", header: int = WHOLE) -> bytes:
    """Return a block of code and parameters. Raises OutOfRange if it has more than 32 bytes.

    >>> block(Code.VERSION).hex(" ")
    '03 01 40'
    """
    length = 1 + len(parameters)
    if length + 2 > LONGEST:
        raise OutOfRange(f"{len(parameters)} parameter bytes: a block has up to {LONGEST - 3}")
    return bytes([header, length, code]) + parameters


def bus_order(logical: bytes) -> bytes:
    """Return the bytes of a block in the order in which the bus transfers them; the header is last."""
    return logical[::-1]


def start_address(logical: bytes) -> int:
    """Return the value of the register WAR for a block.

    >>> f"{start_address(acceleration(CW, 5000)):02X}"
    '16'
    """
    return WINDOW - len(logical)


def number(value: int, width: int, what: str, least: int = 0) -> bytes:
    """Return the big-endian bytes of an unsigned number. Raises OutOfRange."""
    most = (1 << 8 * width) - 1
    return within(value, what, least, most).to_bytes(width, "big")


def position_bytes(position: int) -> bytes:
    """Return the four bytes of a position.

    The position is signed, -2^31 to 2^31 - 1, or unsigned as in the part, 0 to 2^32 - 1.

    >>> position_bytes(-7).hex(" ")
    'ff ff ff f9'
    """
    position = whole(position, "position")
    if not -POSITIONS // 2 <= position < POSITIONS:
        raise OutOfRange(f"position {position} is outside {-POSITIONS // 2} to {POSITIONS // 2 - 1} pulses")
    return (position % POSITIONS).to_bytes(4, "big")


def _side(direction: int) -> int:
    return side(direction) * _DIRECTION


# ---------------------------------------------------------------------- settings


def initial_setting(
    clk: int, start: int, high: int, up: int, stop: int | None = None, down: int = 0, sigmoid: bool = False
) -> bytes:
    """Return instruction 00: base clock (0 to 7), rates and pulses of the ramps.

    `stop` adds a separate deceleration ramp.

    >>> initial_setting(1, 1000, 200, 2000).hex(" ")
    '03 09 00 01 03 e8 00 c8 00 07 d0'
    >>> initial_setting(1, 1000, 200, 2000, 500, 1500).hex(" ")
    '03 0e 00 11 03 e8 01 f4 00 c8 00 07 d0 00 05 dc'
    """
    separate = stop is not None
    flags = number(clk, 1, "base clock")[0] | separate * _SEPARATE | sigmoid * _SIGMOID
    data = bytes([flags]) + number(start, 2, "start rate")
    if stop is not None:
        data += number(stop, 2, "stop rate")
    data += number(high, 2, "high rate") + number(up, 3, "acceleration pulses")
    if separate:
        data += number(down, 3, "deceleration pulses")
    return block(Code.INITIAL, data)


def free_curve(clk: int, rates: list[int], up: list[int], down: list[int] | None = None) -> list[bytes]:
    """Return the blocks of instruction 01, which loads a free curve.

    The lists begin with the fastest stage.

    `down` is required only if the deceleration is not the reversed acceleration.

    >>> for part in free_curve(1, [100, 200, 400], [5, 4, 3]):
    ...     print(part.hex(" "))
    02 03 01 01 03
    00 06 00 64 00 c8 01 90
    01 09 00 00 05 00 00 04 00 00 03
    """
    stages = bytes([len(up), *([] if down is None else [len(down)])])
    flags = number(clk, 1, "base clock")[0] | (_SEPARATE if down is not None else 0)
    blocks = [block(Code.FREE_CURVE, bytes([flags]) + stages, OPENING)]
    for values, width, what in ((rates, 2, "rate"), (up, 3, "pulses"), (down or [], 3, "pulses")):
        for k in range(0, len(values), 10):
            data = b"".join(number(value, width, what) for value in values[k : k + 10])
            blocks.append(bytes([MORE_DATA, len(data)]) + data)
    blocks[-1] = bytes([LAST_DATA]) + blocks[-1][1:]
    return blocks


def in_position(enabled: bool, distance: int, auto: bool = True, clamp: bool = False) -> bytes:
    """Return instruction 02: report when the deviation of the encoder enters or leaves a range.

    The part reports only while the motor is stopped. The deviation is within the range if encoder and pulse
    position differ by at most `distance`, which is 1 to 65 535 pulses.

    >>> in_position(True, 10).hex(" ")
    '03 04 02 03 00 0a'
    """
    flags = bytes([enabled | auto << 1 | clamp << 2])
    return block(Code.IN_POSITION, flags + number(distance, 2, "range", int(enabled)))


def encoder_watch(enabled: bool, distance: int, auto: bool = True) -> bytes:
    """Return instruction 03: report the deviation as with instruction 02, but also during motions.

    >>> encoder_watch(True, 20).hex(" ")
    '03 04 03 03 00 14'
    """
    flags = bytes([enabled | auto << 1])
    return block(Code.ENCODE, flags + number(distance, 2, "range", int(enabled)))


def interlock_position(position: int) -> bytes:
    """Return instruction 04: set the interlock position.

    >>> interlock_position(5000).hex(" ")
    '03 05 04 00 00 13 88'
    """
    return block(Code.INTERLOCK_POSITION, position_bytes(position))


def speed_limit(rate: int) -> bytes:
    """Return instruction 05: set, as a rate, the speed limit that applies at a slow-down limit.

    >>> speed_limit(300).hex(" ")
    '03 03 05 01 2c'
    """
    return block(Code.SPEED_LIMIT, number(rate, 2, "rate", 2))


def end_terminal(monitored: bool) -> bytes:
    """Return instruction 06: set whether a motion ends only when the input END is active."""
    return block(Code.END_TERMINAL, bytes([monitored]))


def input_mask(mask: int, auto: bool = True) -> bytes:
    """Return instruction 28: report changes of the general inputs that the mask selects.

    >>> input_mask(0x24).hex(" ")
    '03 03 28 01 24'
    """
    return block(Code.MASK, bytes([auto]) + number(mask, 1, "mask"))


def outputs(value: int) -> bytes:
    """Return instruction 26: set the six general outputs; a 1 sets a pin low."""
    return block(Code.OUTPUT, bytes([within(value, "outputs", 0, 63)]))


def read_position(encoder: bool = False) -> bytes:
    """Return instruction 42: read the position of the pulses or of the encoder."""
    return block(Code.POSITION_READ, bytes([encoder]))


def set_position(position: int, encoder: bool = False) -> bytes:
    """Return instruction 43: set the position of the pulses or of the encoder.

    >>> set_position(-1, encoder=True).hex(" ")
    '03 06 43 01 ff ff ff ff'
    """
    return block(Code.POSITION_SET, bytes([encoder]) + position_bytes(position))


# ---------------------------------------------------------------------- motions


def _flags(direction: int, trigger: Trigger) -> bytes:
    if trigger is Trigger.POSITION:
        raise OutOfRange("a start cannot wait for a position: use an event, or start it yourself")
    return bytes([_side(direction) | trigger.value])


def acceleration(direction: int, pulses: int, rate: int = 0, trigger: Trigger = Trigger.NOW) -> bytes:
    """Return instruction 82: move by a number of pulses, with ramps up to `rate`; rate 0 = the high speed."""
    data = number(rate, 2, "rate") + number(pulses, 4, "pulses", 1)
    return block(Code.RAMP, _flags(direction, trigger) + data)


def constant(direction: int, pulses: int, rate: int = 0, trigger: Trigger = Trigger.NOW) -> bytes:
    """Return instruction 83: move by a number of pulses at constant speed.

    >>> constant(CCW, 100, 500).hex(" ")
    '03 08 83 40 01 f4 00 00 00 64'
    """
    data = number(rate, 2, "rate") + number(pulses, 4, "pulses", 1)
    return block(Code.CONSTANT, _flags(direction, trigger) + data)


def single_step(direction: int) -> bytes:
    """Return instruction 84: output one pulse."""
    return block(Code.STEP, bytes([_side(direction)]))


def run(direction: int, rate: int = 0, ramped: bool = False, trigger: Trigger = Trigger.NOW) -> bytes:
    """Return instruction 86 (constant speed) or 85 (with a ramp): run until a stop, a limit or the alarm.

    >>> run(CW, ramped=True).hex(" "), run(CCW, 400).hex(" ")
    ('03 04 85 00 00 00', '03 04 86 40 01 90')
    """
    code = Code.FOREVER_RAMP if ramped else Code.FOREVER_CONSTANT
    return block(code, _flags(direction, trigger) + number(rate, 2, "rate"))


def origin_search(direction: int, rate: int, index: bool = False) -> bytes:
    """Return instruction 10: run at constant speed to the origin switch or its first index pulse.

    With `index`, the search ends when the switch is active and the index pulse is present.

    >>> origin_search(CCW, 500, index=True).hex(" ")
    '03 04 10 50 01 f4'
    """
    return block(Code.ORIGIN_SEARCH, bytes([_side(direction) | index * _INDEX]) + number(rate, 2, "rate"))


def zero_return(direction: int, rate: int = 0, index: bool = False) -> bytes:
    """Return instruction 11: run at high speed past the origin switch, then return at start speed."""
    return block(Code.ZERO_RETURN, bytes([_side(direction) | index * _INDEX]) + number(rate, 2, "rate"))


# ---------------------------------------------------------------------- stops and changes


def _place(trigger: Trigger, position: int | None) -> bytes:
    if (trigger is Trigger.POSITION) != (position is not None):
        raise OutOfRange("a position belongs to the trigger POSITION, and to no other")
    return b"" if position is None else position_bytes(position)


def immediate_stop(trigger: Trigger = Trigger.NOW, position: int | None = None) -> bytes:
    """Return instruction 80: stop immediately."""
    return block(Code.STOP, bytes([trigger.value]) + _place(trigger, position))


def slow_stop(trigger: Trigger = Trigger.NOW, position: int | None = None) -> bytes:
    """Return instruction 81: stop with a ramp.

    >>> slow_stop(Trigger.EVENT1).hex(" ")
    '03 02 81 05'
    """
    return block(Code.SLOW_STOP, bytes([trigger.value]) + _place(trigger, position))


def change(
    rate: int, ramped: bool = True, trigger: Trigger = Trigger.NOW, position: int | None = None
) -> bytes:
    """Return instruction 87 (with a ramp) or 88 (immediately): change the speed while the motor runs.

    >>> change(400).hex(" "), change(300, False, Trigger.POSITION, 0x800).hex(" ")
    ('03 04 87 00 01 90', '03 08 88 04 01 2c 00 00 08 00')
    """
    code = Code.RAMP_CHANGE if ramped else Code.CHANGE
    return block(code, bytes([trigger.value]) + number(rate, 2, "rate") + _place(trigger, position))


# ---------------------------------------------------------------------- event buffers


def event_register(buffer: int, instruction: bytes) -> bytes:
    """Return instruction 49: register an instruction in event buffer 1 or 2.

    >>> event_register(2, acceleration(CW, 100)).hex(" ")
    '03 0c 49 01 03 08 82 00 00 00 00 00 00 64'
    """
    return block(Code.EVENT_SET, bytes([buffer_number(buffer)]) + instruction)


def event_delete(buffer: int) -> bytes:
    """Return instruction 49: remove the last instruction from the event buffer.

    >>> event_delete(2).hex(" ")
    '03 02 49 03'
    """
    return block(Code.EVENT_SET, bytes([buffer_number(buffer) | 2]))


def event_read(buffer: int) -> bytes:
    """Return instruction 47: read the event buffer."""
    return block(Code.EVENT_READ, bytes([buffer_number(buffer)]))


def buffer_number(buffer: int) -> int:
    """Return the number that the part uses for event 1 or 2: 0 or 1. Raises OutOfRange."""
    buffer = whole(buffer, "event")
    if buffer not in (1, 2):
        raise OutOfRange(f"event {buffer}: there are events 1 and 2")
    return buffer - 1
