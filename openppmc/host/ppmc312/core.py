"""What a PPMC-312 is without its motions: registers, positions, terminals, reports."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from ...model.ppmc312.codes import Code
from .. import speeds
from ..check import Checked
from ..ending import End
from ..errors import OutOfRange, ProtocolError
from ..kind import Wanted
from . import blocks
from .answers import BadResponse, Executed, Inputs, Report, Response, Status, Stopped, signed
from .motion import Motion, Way
from .profile import KIND, Setup, TableKind, plan_stages, read_stages
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


# Settings of a PPMC-312: tables, monitors, interlock, limits.

LONGEST_BUILD_MS = 300
ITEM_RATES, ITEM_UP, ITEM_DOWN = 1, 2, 3


@dataclass(frozen=True)
class TableRead:
    """The table as the part holds it, fastest stage first: rates in base clocks, pulses of each stage (down
    is empty if the deceleration is the acceleration backwards)."""

    rates: tuple[int, ...]
    up: tuple[int, ...]
    down: tuple[int, ...]


class Settings(Core[MotionT]):
    """See `ppmc312.Ppmc312`."""

    # ------------------------------------------------------------------ tables

    def initialise(
        self,
        start_pps: speeds.Number = 1000,
        high_pps: speeds.Number = 5000,
        ramp_pulses: int = KIND.usual_ramp,
        stop_pps: speeds.Number | None = None,
        down_pulses: int | None = None,
        sigmoid: bool = False,
        base_clock: speeds.Number | None = None,
        external_clock: speeds.Number | None = None,
    ) -> Setup:
        """Speeds and ramps; returns what is really reached.

        start_pps, high_pps: 0.24 pps to 4 Mpps as the base clock allows (the old part: up to 2 Mpps).
        ramp_pulses: from start to high speed, 24 bits. stop_pps, down_pulses: of a deceleration of its own.
        base_clock: 8e6, 1e6, 500e3, 250e3, 62.5e3 or 15.625e3 Hz at a 16 MHz crystal, None: the fastest that
        reaches the start and stop speed. external_clock: frequency at the pin EXTCK in Hz. Overrides and
        event buffers are emptied. Raises OutOfRange, and NotWhileBusy during a motion.
        """
        wanted = Wanted(
            start_pps,
            high_pps,
            ramp_pulses,
            base_clock=base_clock,
            external_clock=external_clock,
            stop_pps=stop_pps,
            down_pulses=down_pulses,
            sigmoid=sigmoid,
        )
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, wanted))

    def load_curve(
        self,
        stages: Iterable[Sequence[float | int | None]] | str | Path,
        base_clock: speeds.Number | None = None,
        external_clock: speeds.Number | None = None,
    ) -> Setup:
        """A free curve of 2 to 127 stages, slowest first: (pps, pulses up[, pulses down]), or the path of a
        CSV file of such lines. Clocks as for `initialise`. Raises OutOfRange."""
        rows = read_stages(Path(stages)) if isinstance(stages, (str, Path)) else stages
        return self.apply(plan_stages(self.link.identity.xtal_hz, rows, base_clock, external_clock))

    def apply(self, setup: Setup) -> Setup:
        """Initialise with a setup that was planned before, and switch the excitation on."""
        self.setup = None
        milliseconds = ANSWER_MS
        if self.link.identity.datasheet:
            milliseconds += LONGEST_BUILD_MS * 16_000_000 // self.link.identity.xtal_hz
        for block in setup.blocks:
            self.window.ask(block, 5, milliseconds)
        self.excitation_on()
        self.setup = setup
        return setup

    def read_table(self) -> TableRead:
        """The table that the part holds; at rest. NotInitialised if there is none."""
        response = self.window.ask(blocks.block(Code.TABLE_READ), 12)
        if response.code != Code.TABLE_READ:
            raise ProtocolError(f"{self.link.name}: no table came, but {response.raw.hex(' ')}")
        items: dict[int, bytearray] = {ITEM_RATES: bytearray(), ITEM_UP: bytearray(), ITEM_DOWN: bytearray()}
        while not response.last:
            response = self.window.more()
            items.setdefault(response.data[0], bytearray()).extend(response.data[1:])
        return TableRead(
            *(_numbers(items[item], width) for item, width in ((ITEM_RATES, 2), (ITEM_UP, 3), (ITEM_DOWN, 3)))
        )

    def rate_of(self, pps: speeds.Number, what: str = "speed") -> int:
        """Rate of a speed of the table. OutOfRange, also without a table of this object."""
        return self.known_setup().rate_of(pps, what)

    def known_setup(self) -> Setup:
        """The table that this object made. OutOfRange if there is none."""
        if self.setup is None:
            raise OutOfRange("a speed needs a base clock, which an initialisation chooses: initialise first")
        return self.setup

    # ------------------------------------------------------------------ monitors, limits

    def watch_position(self, distance: int | None, auto: bool = True, clamp: bool = False) -> None:
        """Report when pulses and encoder differ by more than `distance` (1 to 65 535) at rest, and when they
        agree again (`InPositionChange`); None: no more. auto: more than one report; clamp: ZCLMP active
        while they agree."""
        self.instruct(blocks.in_position(distance is not None, distance or 0, auto, clamp))

    def watch_encoder(self, distance: int | None, auto: bool = True) -> None:
        """The same during motions, too (`EncoderChange`): lost steps, a motor that stands."""
        self.instruct(blocks.encoder_watch(distance is not None, distance or 0, auto))

    def limit_speed(self, pps: speeds.Number) -> None:
        """At an active slow-down limit nothing as fast as this, or faster (the high speed, if not set)."""
        rate = self.known_setup().clock.choose(pps).rate
        self.instruct(blocks.speed_limit(rate))

    def monitor_end(self, on: bool) -> None:
        """Whether a motion is over only when the input END is active."""
        self.instruct(blocks.end_terminal(on), 4)

    def monitor_run(self, on: bool) -> None:
        """Whether starts wait for the input RUN; off lets a start go that waits."""
        if self.status().run_monitored != on:
            self._plain(Code.RUN_MONITOR, 1)

    def interlock(self, position: int | None) -> None:
        """Output INTLK active until the pulses reach this position (`InterlockEnded`); None: inactive now."""
        running = self.status().interlock
        if running:
            self._plain(Code.INTERLOCK, 1)
        if position is not None:
            self.instruct(blocks.interlock_position(position))
            self._plain(Code.INTERLOCK, 1)

    def watch_inputs(self, mask: int, auto: bool = True) -> None:
        """Report changes of general inputs (`InputChange`); mask: which, 0 for none. auto: not just one."""
        self.instruct(blocks.input_mask(mask, auto))


def _numbers(data: bytes | bytearray, width: int) -> tuple[int, ...]:
    return tuple(int.from_bytes(data[k : k + width], "big") for k in range(0, len(data), width))
