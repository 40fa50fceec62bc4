"""One PMC006B4 on its line: instructions and replies, repeated where that does no harm."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import PortError
from ..line import PATIENCE, Listener, Master
from ..line_port import Miss, open_line
from ..port import Port
from .wire import Receiver, Reply, address_number, command

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings
from collections.abc import Callable

from ..check import Checked
from ..line import LostReply, unanswered
from ..line_port import Counters, Fault
from .wire import FACTORY, PORT_BITS, STATUS_1_BITS, STATUS_2_BITS, Code, Flags, Modes, Ports

# A line with PMC006B4: any number of controllers, a frame and its reply at a time.

PART = "pmc006"
BAUD, SLOWEST, FASTEST = 9600, 1200, 115_200
DROPPED_AFTER = 200
"""Bit times of silence after which a controller has forgotten half a frame (192, and some for safety)."""


class Line(Master[Reply]):
    """The master's end of a line, RS-232 or RS-485. An adapter that hears itself needs no option.

    spec: a port that pyserial knows (`/dev/ttyUSB0`, `COM3`, `socket://host:port`, …), `sim:…` or `model:…`.
    baud: 9600 unless the controllers were built with another rate, 1200 to 115200. rs485: settings of
    pyserial for adapters whose driver is switched by RTS. patience: s beyond line time until a controller is
    silent. Raises PortError.

    doubtful: addresses that have left a question unanswered, so that a late reply may still come.
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
        self.doubtful: set[int] = set()

    def exchange(self, address: int, code: int, data: int = 0, answers: int | None = None) -> Reply | Miss:
        """A frame and its reply. answers: the address that replies, if it is another one. Raises
        Disconnected."""
        sent = command(address_number(address), code, data)
        got = self.ask(address, sent, Receiver(address if answers is None else answers, sent))
        if isinstance(got, Miss) and not got.heard:
            self.doubtful.add(address)
        return got

    def settle(self) -> None:
        """Wait until no controller holds half a frame and nothing more comes."""
        self.pause(DROPPED_AFTER / self.baud)

    def _missed(self, listener: Listener[Reply], heard: bytes) -> Miss:
        assert isinstance(listener, Receiver)
        return Miss(listener.fault, heard if listener.fault else b"")


ATTEMPTS = 5
_TRIES, _MARKS = 4, 199
_CHECK = "is it there and powered, are address, baud rate and wires right?"
_OTHERS = "noise, another baud rate, or two controllers with this address"


class Talk(Checked):
    """See `pmc006.Pmc006`. address: 1 to 120, or 255. alone: the only controller that this program uses, so
    that messages need not name it. unsaved: last known values of settings that a reset changes."""

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

    @property
    def who(self) -> str:
        """Begins a message about this controller, if there are several."""
        return "" if self.alone else f"controller {self.address}: "

    @property
    def where(self) -> str:
        """Line and address, for messages."""
        return f"{self.line.name}: controller {self.address}"

    @property
    def counters(self) -> Counters:
        """What went wrong between the master and this controller."""
        return self.line.counters.setdefault(self.address, Counters())

    # ------------------------------------------------------------------ instructions

    def ask(
        self,
        code: int,
        data: int = 0,
        good: Callable[[int], bool] = lambda value: True,
        settle: Callable[[], int | None] = lambda: None,
        sure: bool = True,
        risky: bool = False,
    ) -> int:
        """Send an instruction; returns the data of its reply, signed.

        good: what a reply can be; another one is a damaged one or that of something else, unless sure is
        False: then it is the part's last word after it has come twice. settle: called after each attempt
        without a reply; what it returns is the reply if the instruction was carried out, None if it was not
        and may be repeated; it may raise. Raises StationSilent, GarbledReply, and LostReply instead of the
        former if the instruction is risky: if it matters whether it was carried out.
        """
        misses: list[Miss] = []
        odd: list[int] = []
        if not self._in_step(misses):
            raise unanswered(self.where, misses, len(misses), _CHECK, _OTHERS)
        for attempt in range(ATTEMPTS):
            self.counters.repeated += attempt > 0
            got = self.line.exchange(self.address, code, data)
            if not isinstance(got, Miss):
                if good(got.value) or (not sure and got.value in odd):
                    return got.value
                odd.append(got.value)
                if not sure:
                    continue
                self.counters.garbled += 1
                got = Miss(Fault.BROKEN, b"?")
            misses.append(got)
            self.line.settle()
            if not self._in_step(misses):
                if risky:
                    raise self.lost("the controller has been silent since")
                break
            if (done := settle()) is not None:
                return done
        raise unanswered(self.where, misses, len(misses), _CHECK, _OTHERS)

    def _in_step(self, misses: list[Miss]) -> bool:
        """After a silence: replies do not say what they answer, so one that comes late would answer the next
        question. Set the word pointer, which nobody relies on, until that very value comes back. False if it
        does not; silences are added to `misses`."""
        if self.address not in self.line.doubtful:
            return True
        for _ in range(_TRIES):
            self._mark = self._mark % _MARKS + 1
            got = self.line.exchange(self.address, Code.POINTER, self._mark)
            if isinstance(got, Miss):
                misses.append(got)
                self.line.settle()
            elif got.value == self._mark:
                self.line.doubtful.discard(self.address)
                return True
        return False

    def _bits(self, code: Code, bits: int) -> int:
        return self.ask(code, good=lambda value: 0 <= value < 1 << bits)

    def lost(self, why: str) -> LostReply:
        """For instructions of which nobody knows whether they were carried out."""
        return LostReply(
            f"{self.who}the reply to an instruction was lost, it may have been carried out; {why}: look at "
            "the controller (status) before you repeat it"
        )

    # ------------------------------------------------------------------ read-outs

    def flags(self) -> Flags:
        """Status 1; at any time."""
        return Flags.parse(self._bits(Code.STATUS_1, STATUS_1_BITS))

    def modes(self) -> Modes:
        """Status 2; at any time."""
        return Modes.parse(self._bits(Code.STATUS_2, STATUS_2_BITS))

    def ports(self) -> Ports:
        """Inputs, outputs and the levels of EXT1 and EXT2; at any time."""
        return Ports.parse(self._bits(Code.READ_IO, PORT_BITS))

    @property
    def position(self) -> int:
        """Steps from where it was 0, forward positive; at any time."""
        return self.ask(Code.POSITION)

    def version(self) -> str:
        """Firmware line, as V0.1.35."""
        value = self.ask(Code.VERSION) & 0xFFFFFFFF
        return f"V{value >> 16}.{value >> 8 & 0xFF}.{value & 0xFF}"

    def is_there(self) -> bool:
        """Whether it answers, asked once or, if noise comes, twice. Raises GarbledReply."""
        misses: list[Miss] = []
        while len(misses) < 2:
            got = self.line.exchange(self.address, Code.STATUS_1)
            if not isinstance(got, Miss):
                return True
            if not got.heard:
                return False
            misses.append(got)
            self.line.settle()
        raise unanswered(self.where, misses, len(misses), _CHECK, _OTHERS)
