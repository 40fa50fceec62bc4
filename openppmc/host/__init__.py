"""The PC's side of a board: protocol without I/O, ports, drivers of the parts.

    from openppmc.host import CCW, Ppmc104

    with Ppmc104.open("/dev/ttyUSB0") as axis:
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=400)
        axis.home(CCW)
        axis.move(2500)

`frames`, `script`, `session`, `units`, `ending`, `registers104` are pure; `transport` and `loopback` do I/O.
"""

from .ascii312 import SumMode
from .axis import CCW, CW, Axis
from .axis006 import BACKWARD, FORWARD
from .axis2104 import Axis2104
from .ending import Cause, End
from .errors import (
    AlarmStop,
    AlreadyDecelerating,
    BadRamp,
    BadSwitching,
    CommandRefused,
    CutCommand,
    Disconnected,
    LimitReached,
    LinkError,
    Misused,
    MotionError,
    NoAnswer,
    NoSuchName,
    NothingToStop,
    NotInitialised,
    NotWhileBusy,
    OriginNotFound,
    OutOfRange,
    PortError,
    PpmcError,
    ProtocolError,
    RampTooLong,
    StartRefused,
    StoppedEarly,
    Timeout,
    TooFast,
    UnexpectedData,
    UnexpectedDataBusy,
    UnknownCode,
    WrongDevice,
)
from .kinds import BOARD_CLOCK
from .link import Link
from .motion import Motion, Progress
from .parts import AnyPart, open_part
from .pmc006 import Pmc006
from .pmc006_bus import Pmc006Bus
from .ppmc104 import Ppmc104
from .ppmc312 import Ppmc312
from .ppmc312_bus import Ppmc312Bus
from .ppmc2104 import Ppmc2104
from .station312 import Station312
from .stmc import Stmc
from .transport import open_port, serial_ports

__all__ = [
    "BACKWARD",
    "BOARD_CLOCK",
    "CCW",
    "CW",
    "AlarmStop",
    "AlreadyDecelerating",
    "AnyPart",
    "Axis",
    "Axis2104",
    "BadRamp",
    "BadSwitching",
    "Cause",
    "CommandRefused",
    "CutCommand",
    "Disconnected",
    "End",
    "FORWARD",
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
]
