"""The PC's side of a board: protocol without I/O, ports, drivers of the parts.

    from openppmc.host import CCW, Ppmc104

    with Ppmc104.open("/dev/ttyUSB0") as axis:
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=400)
        axis.home(CCW)
        axis.move(2500)

Rooms, from the ground up: `basis` (arguments, units, errors, ends of motions, what a part allows) · `ports` ·
`bridge` (frames, scripts, the link) · `axis` (what the drivers share) · `line` (several stations on RS-485) ·
one for each part. `ports.transport` does the I/O; `bridge.loopback` and `line.loopback` play a board. What is
called "Pure" in its first line does neither.
"""

from typing import TYPE_CHECKING

from ..lazy import lazy

if TYPE_CHECKING:
    from . import units as units
    from .axis.axis import CCW, CW, Axis
    from .axis.motion import Motion, Progress
    from .axis.part import Part as AnyPart
    from .axis.part import open_part
    from .bank.axis import BankAxis
    from .bank.driver import PpmcBank
    from .bank.registers import GroupRefused
    from .basis.ending import (
        AlarmStop,
        Cause,
        End,
        EndUnknown,
        LimitReached,
        MotionError,
        OriginNotFound,
        StoppedEarly,
    )
    from .basis.errors import (
        AlreadyDecelerating,
        BadRamp,
        CommandRefused,
        Disconnected,
        LinkError,
        Misused,
        NoAnswer,
        NoSuchName,
        NothingToStop,
        NotInitialised,
        NotWhileBusy,
        OutOfRange,
        PortError,
        PpmcError,
        ProtocolError,
        RampTooLong,
        StartRefused,
        Timeout,
        UnexpectedData,
        UnexpectedDataBusy,
        UnknownCode,
        WrongDevice,
    )
    from .bridge.link import Link
    from .pmc006.axis import BACKWARD, FORWARD
    from .pmc006.driver import Pmc006, Pmc006Bus
    from .ports.transport import open_port, serial_ports
    from .ppmc104.driver import Ppmc104
    from .ppmc312.driver import Ppmc312
    from .ppmc312.line.bus import Ppmc312Bus
    from .ppmc312.line.serial import SumMode
    from .ppmc312.line.station import Station312
    from .ppmc2104.axis import Axis2104
    from .ppmc2104.driver import Ppmc2104
    from .ppmc2104.errors import BadSwitching, CutCommand, TooFast
    from .stmc.driver import BOARD_CLOCK, Stmc
    from .stopping import Signalled, stop_on_signals
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        . units
        .axis.axis CCW CW Axis
        .axis.motion Motion Progress
        .axis.part AnyPart=Part open_part
        .bank.axis BankAxis
        .bank.driver PpmcBank
        .bank.registers GroupRefused
        .basis.ending AlarmStop Cause End EndUnknown LimitReached MotionError OriginNotFound StoppedEarly
        .basis.errors Disconnected LinkError Misused NoAnswer NoSuchName OutOfRange PortError PpmcError
        .basis.errors ProtocolError Timeout WrongDevice AlreadyDecelerating BadRamp CommandRefused
        .basis.errors NothingToStop NotInitialised NotWhileBusy RampTooLong StartRefused UnexpectedData
        .basis.errors UnexpectedDataBusy UnknownCode
        .bridge.link Link
        .ports.transport open_port serial_ports
        .pmc006.axis BACKWARD FORWARD
        .pmc006.driver Pmc006Bus Pmc006
        .ppmc104.driver Ppmc104
        .ppmc312.driver Ppmc312
        .ppmc312.line.serial SumMode
        .ppmc312.line.bus Ppmc312Bus
        .ppmc312.line.station Station312
        .ppmc2104.axis Axis2104
        .ppmc2104.driver Ppmc2104
        .ppmc2104.errors BadSwitching CutCommand TooFast
        .stmc.driver Stmc BOARD_CLOCK
        .stopping Signalled stop_on_signals
        """,
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
    "BadRamp",
    "BadSwitching",
    "Cause",
    "CommandRefused",
    "CutCommand",
    "Disconnected",
    "End",
    "EndUnknown",
    "FORWARD",
    "GroupRefused",
    "LimitReached",
    "Link",
    "LinkError",
    "Misused",
    "Motion",
    "MotionError",
    "NoAnswer",
    "NoSuchName",
    "NotInitialised",
    "NotWhileBusy",
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
    "StoppedEarly",
    "Timeout",
    "TooFast",
    "UnexpectedData",
    "UnexpectedDataBusy",
    "UnknownCode",
    "WrongDevice",
    "open_part",
    "open_port",
    "serial_ports",
    "units",
]
