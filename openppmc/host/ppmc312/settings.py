"""Settings of a PPMC-312: tables, monitors, interlock, limits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...model.ppmc312.codes import Code
from ..basis import units
from ..basis.errors import OutOfRange, ProtocolError
from ..basis.kind import Wanted
from . import blocks
from .core import Core, MotionT
from .free import plan_stages, read_stages
from .kind import KIND
from .profile import Setup
from .window import ANSWER_MS

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
        start_pps: units.Number = 1000,
        high_pps: units.Number = 5000,
        ramp_pulses: int = KIND.usual_ramp,
        stop_pps: units.Number | None = None,
        down_pulses: int | None = None,
        sigmoid: bool = False,
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
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
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
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

    def rate_of(self, pps: units.Number, what: str = "speed") -> int:
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

    def limit_speed(self, pps: units.Number) -> None:
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
