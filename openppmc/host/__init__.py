"""Host software for a board: protocol without I/O, ports, and drivers of the parts.

    from openppmc.host import CCW, Ppmc104

    with Ppmc104.open("/dev/ttyUSB0") as axis:
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=400)
        axis.home(CCW)
        axis.move(2500)

Each function that the parts share is in a module of its own, and each part has a module or folder. A command
passes through `part` → `axis` → `moves` → `motion` → `link` → `script` → `frames` → `port`; each of these
modules imports only modules that follow it in this list. `port` performs the I/O; `model_port` and
`line_port` contain the boards that need no hardware. A module with "Pure" in its first line performs no I/O
and imports no module that performs I/O.
"""

from typing import TYPE_CHECKING

from ..lazy import lazy

if TYPE_CHECKING:
    from . import units as units
    from .axis import CCW, CW, Axis
    from .bank.axis import BankAxis
    from .bank.part import PpmcBank
    from .bank.registers import GroupRefused
    from .errors import (
        AlreadyDecelerating,
        AxisBusy,
        CommandRefused,
        Disconnected,
        InvalidRamp,
        LinkError,
        NoAnswer,
        NotCalledError,
        NothingToStop,
        NotInitialised,
        OutOfRange,
        PortError,
        PpmcError,
        ProtocolError,
        RampTooLong,
        StartRefused,
        Timeout,
        UnexpectedData,
        UnexpectedDataBusy,
        UnknownAttributeError,
        UnknownCommand,
        WrongDevice,
    )
    from .link import Link
    from .motion import Motion, Progress
    from .motion_result import (
        AlarmStop,
        Cause,
        EndUnknown,
        LimitReached,
        MotionError,
        MotionResult,
        OriginNotFound,
        StoppedByCommand,
    )
    from .part import Part as AnyPart
    from .part import open_part
    from .pmc006.axis import BACKWARD, FORWARD
    from .pmc006.part import Pmc006, Pmc006Bus
    from .port import open_port, serial_ports
    from .ppmc104 import Ppmc104
    from .ppmc312.line.bus import Ppmc312Bus
    from .ppmc312.line.station import Station312
    from .ppmc312.line.wire import SumMode
    from .ppmc312.part import Ppmc312
    from .ppmc2104.axis import Axis2104
    from .ppmc2104.part import Ppmc2104
    from .ppmc2104.registers import IncompleteCommand, InvalidChopperTimes, RateLimitExceeded
    from .stmc import BOARD_CLOCK, Stmc
    from .stopping import Signalled, stop_on_signals
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        . units
        .axis Axis CCW CW
        .bank.axis BankAxis
        .bank.part PpmcBank
        .bank.registers GroupRefused
        .errors AlreadyDecelerating AxisBusy CommandRefused Disconnected InvalidRamp LinkError NoAnswer
        .errors NotCalledError NothingToStop NotInitialised OutOfRange PortError PpmcError ProtocolError
        .errors RampTooLong StartRefused Timeout UnexpectedData UnexpectedDataBusy UnknownAttributeError
        .errors UnknownCommand WrongDevice
        .link Link
        .motion Motion Progress
        .motion_result AlarmStop Cause EndUnknown LimitReached MotionError MotionResult OriginNotFound
        .motion_result StoppedByCommand
        .part AnyPart=Part open_part
        .pmc006.axis BACKWARD FORWARD
        .pmc006.part Pmc006 Pmc006Bus
        .port open_port serial_ports
        .ppmc104 Ppmc104
        .ppmc2104.axis Axis2104
        .ppmc2104.part Ppmc2104
        .ppmc2104.registers IncompleteCommand InvalidChopperTimes RateLimitExceeded
        .ppmc312.line.bus Ppmc312Bus
        .ppmc312.line.station Station312
        .ppmc312.line.wire SumMode
        .ppmc312.part Ppmc312
        .stmc BOARD_CLOCK Stmc
        .stopping Signalled stop_on_signals
        """,
        {
            "BadRamp": "InvalidRamp",
            "BadSwitching": "InvalidChopperTimes",
            "CutCommand": "IncompleteCommand",
            "End": "MotionResult",
            "Misused": "NotCalledError",
            "NoSuchName": "UnknownAttributeError",
            "NotWhileBusy": "AxisBusy",
            "StoppedEarly": "StoppedByCommand",
            "TooFast": "RateLimitExceeded",
            "UnknownCode": "UnknownCommand",
        },
    )

__all__ = [
    "Signalled",
    "stop_on_signals",
    "BACKWARD",
    "BOARD_CLOCK",
    "CCW",
    "CW",
    "AlarmStop",
    "AlreadyDecelerating",
    "AnyPart",
    "Axis",
    "Axis2104",
    "BankAxis",
    "InvalidRamp",
    "InvalidChopperTimes",
    "Cause",
    "CommandRefused",
    "IncompleteCommand",
    "Disconnected",
    "MotionResult",
    "EndUnknown",
    "FORWARD",
    "GroupRefused",
    "LimitReached",
    "Link",
    "LinkError",
    "NotCalledError",
    "Motion",
    "MotionError",
    "NoAnswer",
    "UnknownAttributeError",
    "NotInitialised",
    "AxisBusy",
    "NothingToStop",
    "OriginNotFound",
    "OutOfRange",
    "Pmc006",
    "Pmc006Bus",
    "PortError",
    "Ppmc104",
    "Ppmc2104",
    "Ppmc312",
    "Ppmc312Bus",
    "PpmcBank",
    "PpmcError",
    "Progress",
    "ProtocolError",
    "RampTooLong",
    "StartRefused",
    "Station312",
    "Stmc",
    "SumMode",
    "StoppedByCommand",
    "Timeout",
    "RateLimitExceeded",
    "UnexpectedData",
    "UnexpectedDataBusy",
    "UnknownCommand",
    "WrongDevice",
    "open_part",
    "open_port",
    "serial_ports",
    "units",
]
