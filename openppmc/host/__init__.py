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
    from .bank.axis import BankAxis
    from .bank.driver import PpmcBank
    from .bank.errors import GroupRefused
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
        Disconnected,
        LinkError,
        Misused,
        NoAnswer,
        NoSuchName,
        OutOfRange,
        PortError,
        PpmcError,
        ProtocolError,
        Timeout,
        WrongDevice,
    )
    from .basis.refusals import (
        AlreadyDecelerating,
        BadRamp,
        CommandRefused,
        NothingToStop,
        NotInitialised,
        NotWhileBusy,
        RampTooLong,
        StartRefused,
        UnexpectedData,
        UnexpectedDataBusy,
        UnknownCode,
    )
    from .bridge.link import Link
    from .bridge.port import open_port
    from .opening import open_part
    from .pmc006.axis import BACKWARD, FORWARD
    from .pmc006.bus import Pmc006Bus
    from .pmc006.driver import Pmc006
    from .ports.transport import serial_ports
    from .ppmc104.driver import Ppmc104
    from .ppmc312.driver import Ppmc312
    from .ppmc312.line.ascii import SumMode
    from .ppmc312.line.bus import Ppmc312Bus
    from .ppmc312.line.station import Station312
    from .ppmc2104.axis import Axis2104
    from .ppmc2104.driver import Ppmc2104
    from .ppmc2104.errors import BadSwitching, CutCommand, TooFast
    from .stmc.driver import Stmc
    from .stmc.kind import BOARD_CLOCK
    from .stopping import Signalled, stop_on_signals
else:
    __getattr__, __dir__ = lazy(
        __name__,
        """
        . units
        .axis.axis CCW CW Axis
        .axis.motion Motion Progress
        .axis.part AnyPart=Part
        .bank.axis BankAxis
        .bank.driver PpmcBank
        .bank.errors GroupRefused
        .basis.ending AlarmStop Cause End EndUnknown LimitReached MotionError OriginNotFound StoppedEarly
        .basis.errors Disconnected LinkError Misused NoAnswer NoSuchName OutOfRange PortError PpmcError
        .basis.errors ProtocolError Timeout WrongDevice
        .basis.refusals AlreadyDecelerating BadRamp CommandRefused NothingToStop NotInitialised NotWhileBusy
        .basis.refusals RampTooLong StartRefused UnexpectedData UnexpectedDataBusy UnknownCode
        .bridge.link Link
        .bridge.port open_port
        .opening open_part
        .pmc006.axis BACKWARD FORWARD
        .pmc006.bus Pmc006Bus
        .pmc006.driver Pmc006
        .ports.transport serial_ports
        .ppmc104.driver Ppmc104
        .ppmc312.driver Ppmc312
        .ppmc312.line.ascii SumMode
        .ppmc312.line.bus Ppmc312Bus
        .ppmc312.line.station Station312
        .ppmc2104.axis Axis2104
        .ppmc2104.driver Ppmc2104
        .ppmc2104.errors BadSwitching CutCommand TooFast
        .stmc.driver Stmc
        .stmc.kind BOARD_CLOCK
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
