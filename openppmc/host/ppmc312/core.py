"""What a PPMC-312 is without its motions: registers, positions, terminals, reports."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from typing import Generic, Protocol, TypeVar

from ...model.ppmc312.codes import Code
from ..basis.arguments import Checked
from ..basis.ending import End
from ..basis.errors import ProtocolError
from . import blocks
from .answers import BadResponse, Executed, Report, Response, Stopped, signed
from .kind import TableKind
from .motion import Motion, Way
from .profile import Setup
from .registers import Inputs, Status
from .window import ANSWER_MS, SHORTEST

MOST_KEPT = 1000
MotionT = TypeVar("MotionT", bound=Motion)


class Instructions(Protocol):
    """What carries instructions to a part; `window.Window` does by the bridge, `line.talk.Talk` by a line."""

    @property
    def answers(self) -> int:
        """Answers so far; reports that come after one are younger than its instruction."""

    def open(self) -> None:
        """After a reset of the part."""

    def ask(self, block: bytes, gives: int = SHORTEST, milliseconds: int = ANSWER_MS) -> Response:
        """Carry out an instruction block; returns the answer. Raises the part's refusal and LinkErrors."""

    def more(self) -> Response:
        """The next block of an answer of several."""

    def collect(self) -> None:
        """Read what waits."""


class Core(Checked, Generic[MotionT]):
    """See `ppmc312.Ppmc312`.

    setup: the table that this object made, if any. reports: what the part said by itself and nobody took yet,
    oldest first (stops of this object's own motions are in their `end`); beyond 1000 the oldest are dropped.
    """

    kind: TableKind
    number = 1
    busy = 0x2C
    who = ""
    link: Way
    window: Instructions
    setup: Setup | None
    reports: deque[Report]

    def __init__(self, link: Way) -> None:
        self.link = link
        self.setup = None
        self.reports = deque(maxlen=MOST_KEPT)
        self._motion: MotionT | None = None
        self._mark = 0
        self.window = self._make_window()
        self.window.open()

    def _make_window(self) -> Instructions:
        """The way of instructions to the part and of responses back."""
        raise NotImplementedError

    def _make_motion(self, asked: int | None, direction: int, begin: int | None) -> MotionT:
        """The handle of a motion; see `motion.Motion`."""
        raise NotImplementedError

    @property
    def motion(self) -> MotionT | None:
        """The motion that was started last, None before the first."""
        return self._motion

    def told(self, end: End) -> End:
        """The end with the words of this part."""
        return replace(end, who=self.who, alarm=self.kind.alarm)

    # ------------------------------------------------------------------ instructions

    def instruct(self, block: bytes, gives: int = 3, milliseconds: int = ANSWER_MS) -> bytes:
        """Carry out any instruction block in logical order (`blocks`); returns the parameters of the
        answer. Raises the part's refusal."""
        response = self.window.ask(block, gives, milliseconds)
        if response.code != block[2]:
            raise ProtocolError(
                f"{self.link.name}: the part answers {response.code:02X} to {block[2]:02X}: does another "
                "program use it?"
            )
        return response.data

    def _plain(self, code: int, gives: int = 0) -> bytes:
        """An instruction without parameters; gives: parameters of its answer."""
        return self.instruct(blocks.block(code), 3 + gives)

    # ------------------------------------------------------------------ reports

    def _arrived(self, response: Response) -> None:
        """A response that is no answer to this object."""
        try:
            report = response.report()
        except BadResponse as error:
            raise ProtocolError(f"{self.link.name}: {error}") from error
        self._heard(report)

    def _heard(self, report: Report) -> None:
        """Give a report to the motion that it ends, or keep it."""
        motion = self._motion
        younger = self.window.answers > self._mark
        if isinstance(report, Stopped) and motion is not None and not motion.over and younger:
            motion.stopped(report)
        else:
            if isinstance(report, Executed) and report.code == Code.SLOW_STOP and motion is not None:
                motion.stop_ordered = True
            self.reports.append(report)

    def next_report(self, timeout: float = 0) -> Report | None:
        """The oldest report that nobody took, None if none comes within `timeout` seconds."""
        end = self.link.clock() + timeout
        if not self.reports:
            self.window.collect()
        while not self.reports and (left := end - self.link.clock()) > 0:
            self.link.wait_event(min(left, 0.5))
            self.window.collect()
        return self.reports.popleft() if self.reports else None

    def attend(self, seconds: float) -> None:
        """Let time of the board pass, and read what the part says by itself."""
        end = self.link.clock() + seconds
        while (left := end - self.link.clock()) > 0:
            if self.link.wait_event(left) is not None:
                self.window.collect()

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """State, monitors, registered instructions; allowed at any time."""
        return Status.parse(self._plain(Code.STATUS, 3))

    def inputs(self) -> Inputs:
        """Switches and other inputs; allowed at any time."""
        return Inputs.parse(self._plain(Code.TERMINALS, 2))

    def version(self) -> int:
        """Version byte of the part."""
        return self._plain(Code.VERSION, 1)[0]

    @property
    def position(self) -> int:
        """Pulse position of the part, CW positive; allowed at any time."""
        return self._position(False)

    @property
    def encoder(self) -> int:
        """Encoder position of the part; allowed at any time."""
        return self._position(True)

    def _position(self, encoder: bool) -> int:
        data = self.instruct(blocks.read_position(encoder), 8)
        return signed(int.from_bytes(data[1:5], "big"))

    def counted(self, count: int) -> int | None:
        """A position, as other parts may have none."""
        return count

    def set_position(self, position: int, encoder: bool = False) -> None:
        """The pulse position, or that of the encoder, is this one; at rest (NotWhileBusy)."""
        self.instruct(blocks.set_position(position, encoder))

    def zero(self) -> None:
        """Here is position 0 of pulses and encoder."""
        self.set_position(0)
        self.set_position(0, encoder=True)

    # ------------------------------------------------------------------ terminals

    def excitation_on(self) -> None:
        """Output EXON active; at rest."""
        self._plain(Code.EXCITATION_ON)

    def excitation_off(self) -> None:
        """Output EXON inactive; at rest. The table stays."""
        self._plain(Code.EXCITATION_OFF)

    def counter_clear(self) -> None:
        """Pulse of 24.6 ms (at 16 MHz) at output CCLR; at rest."""
        self._plain(Code.COUNTER_CLEAR)

    def zero_clamp(self) -> None:
        """Output ZCLMP active until the next start; at rest."""
        self._plain(Code.ZERO_CLAMP)

    def clear_alarm(self) -> None:
        """Pulse of 24.6 ms at output ACLR; leaves the alarm state if the alarm input is not active then."""
        self._plain(Code.ALARM_CLEAR)

    def aux_inputs(self) -> int:
        """Levels of the eight general inputs."""
        return self._plain(Code.INPUT, 1)[0]

    def auxo(self, value: int) -> None:
        """Six general outputs, 0 to 63: a 1 makes its pin low."""
        self.instruct(blocks.outputs(value))

    # ------------------------------------------------------------------ reset

    def software_reset(self) -> None:
        """The part's own reset instruction; the same but for the pin."""
        self._plain(Code.RESET)
        self.forget()

    def forget(self) -> None:
        """The part was reset."""
        self.setup = self._motion = None
        self.reports.clear()
        self.window.open()
