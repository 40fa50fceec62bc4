"""Stimuli of parts on a byte bus: every code from 00 to FF, and moves of each kind.

Speeds are low and moves short, so that all edges of a section fit into a small recorder.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ...model.motion.codes import IBF, Command, Kind
from ..script import Identity, Script
from .plan import COMMANDS, MOVES, REGISTERS, PartAccess, Section

DATA, COMMAND = 0, 1
STOP, SLOW_STOP, FINISH = 0x40, 0x41, 0x80
CCW, MASKED, PULSE_ONLY, AXIS_2 = 0x08, 0x10, 0x80, 0x20
STEP, RAMP, CONSTANT, CONTINUOUS, HIGH, ORIGIN = 0x42, 0x43, 0x44, 0x45, 0x46, 0x47
HALF = 0x04
TABLE_S = 0.006
"""Longest build time of a ramp table in s, with FAST timing at 8 MHz."""
RECORDS_A_CODE, RECORDS_A_SLOW_CODE = 96, 512
"""Number of records that the test of one command code requires: with FAST timing, and with DATASHEET timing.

With DATASHEET timing, the chopper runs longer.
"""
MOST_LOOKS = 100
LONGEST_MOVE_S = 2.0


@dataclass(frozen=True)
class Rates:
    """Bytes of the default initialisation.

    Attributes:
        start: start rate.
        high: high rate.
        ramp: pulses of the ramp, two bytes.
        slow: rate of constant speeds.
        table: time in s from an initialisation until its ramp table may be used, with DATASHEET timing.
    """

    start: int = 249
    high: int = 99
    ramp: tuple[int, int] = (12, 0)
    slow: int = 199
    table: float = 0.05

    @property
    def data(self) -> tuple[int, int, int, int]:
        """Data bytes in the order in which they follow the code."""
        return self.start, self.high, *self.ramp


@dataclass(frozen=True)
class ByteBus:
    """Axis of a part on a byte bus.

    Attributes:
        before: script that is executed before each access.
        axis: bits of the axis in its command codes.
        building: mask of the status bits that are set while a ramp table is built; 0 if the part has no such
        bits.
        positive, chopped: bits of the initialisation code for positive logic and for the chopper; 0 if the
            code has no such bit.
    """

    decode: Callable[[int], Command]
    rates: Rates = Rates()
    before: Script | None = None
    axis: int = 0
    building: int = 0
    positive: int = 0x08
    chopped: int = 0x20

    # ------------------------------------------------------------------ accesses

    def command(self, access: PartAccess, code: int, *data: int) -> None:
        """Write a command with its data, then read the status twice."""
        if self.before is not None:
            access.run(self.before)
        access.write(COMMAND, [code])
        if data:
            self._until(access, IBF)  # a data byte that is written too early would replace the command
            access.write(DATA, data)
        access.read(COMMAND, 2)

    def _until(self, access: PartAccess, bits: int) -> None:
        """Poll the status until these bits are 0. A virtual board may be slow."""
        for _ in range(MOST_LOOKS):
            if not access.read(COMMAND)[0] & bits:
                return
            access.pause(TABLE_S)

    @property
    def setup(self) -> int:
        """Code of the default initialisation: 4 phases, full steps, internal clock."""
        return 2 | self.positive

    def initialise(self, access: PartAccess, code: int | None = None) -> None:
        """Execute an initialisation, the default one or `code`; wait until the ramp table is complete."""
        self.command(access, (self.setup if code is None else code) | self.axis, *self.rates.data)
        self._is_built(access)

    def _is_built(self, access: PartAccess) -> None:
        """Wait until the ramp table is complete."""
        access.pause(self.rates.table if access.slow else TABLE_S)
        self._until(access, self.building)

    def read_end(self, access: PartAccess, seconds: float = LONGEST_MOVE_S) -> None:
        """Wait for the end of a motion; read its finish status and remaining pulses."""
        access.until_interrupt(seconds)
        self.read_finish(access)

    def read_finish(self, access: PartAccess) -> None:
        """Read the finish status and the remaining pulses of a motion that has ended."""
        self.command(access, FINISH | self.axis)
        access.read(DATA)
        self.command(access, 0x83 | self.axis)
        access.read(DATA, 3)

    # ------------------------------------------------------------------ every code

    def one(self, access: PartAccess, code: int) -> None:
        """Write one code with its data.

        Afterwards, stop a motion that the code has started, and restore a set-up that it has changed.
        """
        command = self.decode(code)
        kind, axis = command.kind, code & AXIS_2 if self.axis or command.axis else 0
        data = {
            Kind.INITIALISE: self.rates.data,
            Kind.SWITCHING: (0x60, 0x50),
            Kind.OPERATION: (2, 0, 0) if command.parameters == 3 else (self.rates.slow, 2, 0, 0),
        }.get(kind, (5, 5, 5, 5))
        self.command(access, code, *data[: command.parameters])
        if kind is Kind.OPERATION:
            access.pause(0.0015)
            self.command(access, STOP | axis)
        elif kind is Kind.READ:
            access.read(DATA, 3)
        elif kind in (Kind.INITIALISE, Kind.EXCITATION_OFF):
            self._is_built(access)
            self.command(access, self.setup | axis, *self.rates.data)
            self._is_built(access)

    def codes(self, identity: Identity, records: int, others: Sequence[ByteBus] = ()) -> list[Section]:
        """Return sections that write every code, first to the uninitialised, then to the initialised part.

        Args:
            others: other axes, which are also initialised.
        """
        a_code = RECORDS_A_SLOW_CODE if identity.datasheet else RECORDS_A_CODE
        count = max(4, min(64, records // a_code))
        found = []
        for first in range(0, 256, count):
            some = range(first, min(256, first + count))

            def with_setup(access: PartAccess, some: range = some) -> None:
                for bus in (self, *others):
                    bus.initialise(access)
                for code in some:
                    self.one(access, code)

            def without(access: PartAccess, some: range = some) -> None:
                for code in some:
                    self.command(access, code)

            name = f"{some[0]:02X} to {some[-1]:02X}"
            found.append(Section(f"codes {name} before initialisation", COMMANDS, without))
            found.append(Section(f"codes {name}", COMMANDS, with_setup))
        return found

    # ------------------------------------------------------------------ moves

    def motion(
        self, *steps: Callable[[PartAccess], None], code: int | None = None
    ) -> Callable[[PartAccess], None]:
        """Return a function that initialises the axis and then executes these steps."""

        def play(access: PartAccess) -> None:
            self.initialise(access, code)
            for step in steps:
                step(access)

        return play

    def go(
        self, code: int, *data: int, stop: int | None = None, after: float = 0.004
    ) -> Callable[[PartAccess], None]:
        """Return a function that plays a motion to its end.

        Args:
            stop: command that stops the motion; `None` if the motion ends without a command.
            after: seconds from the start to this command.
        """

        def play(access: PartAccess) -> None:
            self.command(access, code | self.axis, *data)
            if stop is not None:
                access.pause(after)
                self.command(access, stop | self.axis)
            self.read_end(access)

        return play

    def moves(self, pulse_only: bool = True) -> list[Section]:
        """Return sections that play moves of each kind in both directions.

        Args:
            pulse_only: True to play also moves that output pulses without changing the phases.
        """
        go, slow = self.go, self.rates.slow
        kinds: list[tuple[str, Callable[[PartAccess], None]]] = [
            ("single steps", self.motion(go(STEP), go(STEP | CCW), go(STEP))),
            ("ramp CW", self.motion(go(RAMP, 39, 0, 0))),
            ("ramp CCW", self.motion(go(RAMP | CCW, 30, 0, 0))),
            ("triangles", self.motion(go(RAMP, 6, 0, 0), go(RAMP | CCW, 5, 0, 0), go(RAMP, 0, 0, 0))),
            ("constant speed", self.motion(go(CONSTANT, slow, 9, 0, 0), go(CONSTANT | CCW, slow, 9, 0, 0))),
            (
                "continuous, stopped",
                self.motion(go(CONTINUOUS, slow, stop=STOP), go(CONTINUOUS | CCW, slow, stop=STOP)),
            ),
            ("high speed, slowed down", self.motion(go(HIGH, stop=SLOW_STOP, after=0.015))),
            ("high speed CCW, stopped", self.motion(go(HIGH | CCW, stop=STOP, after=0.015))),
            ("search for an origin, stopped", self.motion(go(ORIGIN, slow, stop=STOP))),
            ("ramp, slowed down", self.motion(go(RAMP, 200, 0, 0, stop=SLOW_STOP, after=0.012))),
            ("ramp, stopped", self.motion(go(RAMP, 200, 0, 0, stop=STOP, after=0.012))),
        ]
        for phases in (1, 2, 3):
            for half in (0, HALF):
                title = f"{phases + 2} phases, {'half' if half else 'full'} steps"
                steps = (go(CONSTANT, slow, 10, 0, 0), go(CONSTANT | CCW, slow, 3, 0, 0))
                kinds.append((title, self.motion(*steps, code=self.positive | half | phases)))
        if self.positive:
            kinds.append(("the other logic", self.motion(go(CONSTANT, slow, 5, 0, 0), code=2)))
        if pulse_only:
            kinds.append(("pulses only", self.motion(go(PULSE_ONLY | RAMP, 20, 0, 0))))
        chopped = self.setup | self.chopped
        kinds.append(
            (
                "at rest, chopped",
                self.motion(go(RAMP, 5, 0, 0), lambda access: access.pause(0.06), code=chopped),
            )
        )
        kinds.append(("at rest", self.motion(go(STEP), lambda access: access.pause(0.06))))
        return [Section(title, MOVES, play) for title, play in kinds]

    def registers(self) -> Section:
        """Return a section that reads the status and every register.

        The registers are read before and after the initialisation.
        """

        def play(access: PartAccess) -> None:
            access.read(COMMAND, 3)
            access.read(DATA, 2)
            for begin in (False, True):
                if begin:
                    self.initialise(access)
                for code in range(0x80, 0x88):
                    if self.decode(code | self.axis).kind is Kind.READ:
                        self.command(access, code | self.axis)
                        access.read(DATA, 3)

        return Section("status and registers", REGISTERS, play)
