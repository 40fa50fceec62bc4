"""Communication with one PMC006B4: instructions and their replies.

An instruction whose reply is lost is repeated only if the repetition has no side effect.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import PortError
from ..line import PATIENCE, Master, ReplyReceiver
from ..line_port import MissingReply, open_line
from ..port import Port
from .wire import Receiver, Reply, address_number, command

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings
from collections.abc import Callable

from ..check import Checked
from ..line import LostReply, unanswered
from ..line_port import Counters, Fault
from ..motion_result import position_lost
from .wire import FACTORY, PORT_BITS, STATUS_1_BITS, STATUS_2_BITS, Code, Flags, Modes, Ports

# Line with any number of PMC006B4 controllers. It transfers one frame and its reply at a time.

PART = "pmc006"
BAUD, SLOWEST, FASTEST = 9600, 1200, 115_200
DROPPED_AFTER = 200
"""Time without a character after which a controller has discarded an incomplete frame, in bit times.

The part needs 192 bit times; the other 8 are a reserve.
"""


class Line(Master[Reply]):
    """Master of an RS-232 or RS-485 line.

    Adapters that receive their own bytes are supported without an option.

    Attributes:
        spec: port that pyserial supports (`/dev/ttyUSB0`, `COM3`, `socket://host:port`, …), `sim:…` or
            `model:…`.
        baud: line rate of the controllers, 1200 to 115200; 9600 unless they were built with another rate.
        rs485: settings of pyserial for adapters whose transmitter is switched by RTS.
        patience: time in s that the master waits for a reply in addition to the transmission time on the
            line.
        unsynchronised: addresses of controllers that did not reply to a frame, so that a reply may still
            arrive later.

    Raises:
        PortError: the port cannot be opened.
    """

    def __init__(
        self,
        spec: str | Port,
        baud: int = BAUD,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
    ) -> None:
        if not SLOWEST <= baud <= FASTEST:
            raise PortError(f"{baud} bit/s is outside {SLOWEST} to {FASTEST}: it is {BAUD} as delivered")
        self.check_patience(patience)
        port = open_line(spec, baud, PART, rs485) if isinstance(spec, str) else spec
        super().__init__(port, baud, False, patience)
        self.unsynchronised: set[int] = set()

    def exchange(
        self, address: int, code: int, data: int = 0, answers: int | None = None
    ) -> Reply | MissingReply:
        """Send a frame and return its reply. Raises Disconnected.

        Args:
            answers: address in the reply, `None` if it is the address in the frame.
        """
        sent = command(address_number(address), code, data)
        got = self.request(address, sent, Receiver(address if answers is None else answers, sent))
        if isinstance(got, MissingReply) and not got.received:
            self.unsynchronised.add(address)
        return got

    def wait_until_idle(self) -> None:
        """Wait until no controller holds an incomplete frame and no more bytes arrive."""
        self.pause(DROPPED_AFTER / self.baud)

    def _missing_reply(self, listener: ReplyReceiver[Reply], heard: bytes) -> MissingReply:
        assert isinstance(listener, Receiver)
        return MissingReply(listener.fault, heard if listener.fault else b"")


ATTEMPTS = 5
_TRIES, _MARKS = 4, 199
_CHECK = "is it there and powered, are address, baud rate and wires right?"
_OTHERS = "noise, another baud rate, or two controllers with this address"


class StationLink(Checked):
    """Communication with one controller; see `pmc006.Pmc006`.

    Attributes:
        address: 1 to 120, or 255.
        alone: True if this program uses only one controller. Then messages do not name the controller.
        unsaved: last known values of those settings that a reset changes.
    """

    line: Line
    link: Line
    address: int
    alone: bool
    unsaved: dict[str, int]

    def __init__(self, line: Line, address: int = FACTORY, alone: bool = True) -> None:
        self.line = self.link = line
        self.address = address_number(address)
        self.alone = alone
        self._mark = 0
        self.unsaved = {}
        self._known_position = 0

    @property
    def _message_prefix(self) -> str:
        """Prefix of messages about this controller; empty if `alone`."""
        return "" if self.alone else f"controller {self.address}: "

    @property
    def _location(self) -> str:
        """Names of line and address, for messages."""
        return f"{self.line.name}: controller {self.address}"

    @property
    def counters(self) -> Counters:
        """Counters of the faults between the master and this controller."""
        return self.line.counters.setdefault(self.address, Counters())

    # ------------------------------------------------------------------ instructions

    def execute(
        self,
        code: int,
        data: int = 0,
        good: Callable[[int], bool] = lambda value: True,
        resolve: Callable[[], int | None] = lambda: None,
        sure: bool = True,
        risky: bool = False,
    ) -> int:
        """Send an instruction and return the data of its reply, signed.

        Args:
            good: function that returns True for data that a reply to this instruction can have. With any
                other data, the reply is damaged or belongs to another instruction.
            resolve: called after each attempt without a reply. It returns the reply if the instruction was
                executed, or `None` if it was not executed and may be repeated. It may raise an exception.
            sure: if False, data for which `good` returns False are returned after they were received twice.
            risky: True if the caller must know whether the instruction was executed.

        Raises:
            StationNotResponding, CorruptReply: no valid reply was received.
            LostReply: no reply to an instruction with `risky` was received.
        """
        misses: list[MissingReply] = []
        odd: list[int] = []
        if not self._synchronise(misses):
            raise unanswered(self._location, misses, len(misses), _CHECK, _OTHERS)
        for attempt in range(ATTEMPTS):
            self.counters.repeated += attempt > 0
            got = self.line.exchange(self.address, code, data)
            if not isinstance(got, MissingReply):
                if good(got.value) or (not sure and got.value in odd):
                    return got.value
                odd.append(got.value)
                if not sure:
                    continue
                self.counters.garbled += 1
                got = MissingReply(Fault.BROKEN, b"?")
            misses.append(got)
            self.line.wait_until_idle()
            if not self._synchronise(misses):
                if risky:
                    raise self._lost_reply("the controller has been silent since")
                break
            if (done := resolve()) is not None:
                return done
        raise unanswered(self._location, misses, len(misses), _CHECK, _OTHERS)

    def _synchronise(self, misses: list[MissingReply]) -> bool:
        """Synchronise instructions and replies after a missing reply; return False if that fails.

        A reply does not identify its instruction, so a late reply would be accepted as the reply to the next
        instruction. The method writes a new value to the word pointer, and repeats this until a reply
        contains the value that was written last. Missing replies are appended to `misses`.
        """
        if self.address not in self.line.unsynchronised:
            return True
        for _ in range(_TRIES):
            self._mark = self._mark % _MARKS + 1
            got = self.line.exchange(self.address, Code.POINTER, self._mark)
            if isinstance(got, MissingReply):
                misses.append(got)
                self.line.wait_until_idle()
            elif got.value == self._mark:
                self.line.unsynchronised.discard(self.address)
                return True
        return False

    def _bits(self, code: Code, bits: int) -> int:
        return self.execute(code, good=lambda value: 0 <= value < 1 << bits)

    def _lost_reply(self, reason: str) -> LostReply:
        """Return the exception for an instruction that may have been executed."""
        return LostReply(
            f"{self._message_prefix}the reply to an instruction was lost, so it may have been executed; "
            f"{reason}: check "
            "the status of the controller before you repeat the instruction"
        )

    # ------------------------------------------------------------------ read-outs

    def flags(self) -> Flags:
        """Return status 1. The call is allowed at any time."""
        return Flags.parse(self._bits(Code.STATUS_1, STATUS_1_BITS))

    def modes(self) -> Modes:
        """Return status 2. The call is allowed at any time."""
        return Modes.parse(self._bits(Code.STATUS_2, STATUS_2_BITS))

    def ports(self) -> Ports:
        """Return inputs, outputs and the levels of EXT1 and EXT2. The call is allowed at any time."""
        return Ports.parse(self._bits(Code.READ_IO, PORT_BITS))

    @property
    def position(self) -> int:
        """Position in steps, forward positive. The call is allowed at any time.

        Raises:
            ProtocolError: the position is 0 because the controller was reset. The reset is detected only if
                this object has set direction, stops or maximum speed to a value that differs from the factory
                value, and has not saved it. The call after this error returns 0.
        """
        known, self._known_position = self._known_position, self._read_position()
        if known and not self._known_position and self.was_reset():
            raise position_lost(f"{self.line.name}: {self._message_prefix}", known)
        return self._known_position

    def _read_position(self) -> int:
        return self.execute(Code.POSITION)

    def was_reset(self) -> bool:
        """Return True if one of the settings that a reset changes differs from its last known value."""
        raise NotImplementedError

    def version(self) -> str:
        """Return the firmware version, for example V0.1.35."""
        value = self.execute(Code.VERSION) & 0xFFFFFFFF
        return f"V{value >> 16}.{value >> 8 & 0xFF}.{value & 0xFF}"

    def _is_connected(self) -> bool:
        """Return True if the controller replies to a poll; after noise, the poll is repeated once.

        Raises CorruptReply if both replies are corrupt.
        """
        misses: list[MissingReply] = []
        while len(misses) < 2:
            got = self.line.exchange(self.address, Code.STATUS_1)
            if not isinstance(got, MissingReply):
                return True
            if not got.received:
                return False
            misses.append(got)
            self.line.wait_until_idle()
        raise unanswered(self._location, misses, len(misses), _CHECK, _OTHERS)
