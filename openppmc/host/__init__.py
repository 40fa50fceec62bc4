"""The PC's side of a board: protocol without I/O, ports, drivers of the parts.

    from openppmc.host import CCW, Ppmc104

    with Ppmc104.open("/dev/ttyUSB0") as axis:
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=400)
        axis.home(CCW)
        axis.move(2500)

`frames`, `script`, `session`, `units`, `ending`, `registers104` are pure; `transport` and `loopback` do I/O.
"""

from .ending import Cause, End
from .errors import (
    AlarmStop,
    AlreadyDecelerating,
    BadRamp,
    CommandRefused,
    Disconnected,
    LimitReached,
    LinkError,
    MotionError,
    NoAnswer,
    NothingToStop,
    NotInitialised,
    NotWhileBusy,
    OriginNotFound,
    OutOfRange,
    PortError,
    PpmcError,
    ProtocolError,
    RampTooLong,
    StoppedEarly,
    Timeout,
    UnexpectedData,
    UnexpectedDataBusy,
    WrongDevice,
)
from .link import Link
from .motion import Motion, Progress
from .ppmc104 import CCW, CW, Ppmc104
from .transport import open_port, serial_ports

__all__ = [
    "CCW",
    "CW",
    "AlarmStop",
    "AlreadyDecelerating",
    "BadRamp",
    "Cause",
    "CommandRefused",
    "Disconnected",
    "End",
    "LimitReached",
    "Link",
    "LinkError",
    "Motion",
    "MotionError",
    "NoAnswer",
    "NotInitialised",
    "NotWhileBusy",
    "NothingToStop",
    "OriginNotFound",
    "OutOfRange",
    "PortError",
    "Ppmc104",
    "PpmcError",
    "Progress",
    "ProtocolError",
    "RampTooLong",
    "StoppedEarly",
    "Timeout",
    "UnexpectedData",
    "UnexpectedDataBusy",
    "WrongDevice",
    "open_port",
    "serial_ports",
]
