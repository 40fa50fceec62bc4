"""Golden model of the PPMC-104 at pin level, event driven and exact to the clk.

Pins and time: `chip`. Blocks: `hostport` and `hostport104` (P104-BUS, -HSK), `commands104` (P104-CMD, -ERR,
-INI, -RD, -AUX), `motion` and `motion104` (P104-OPR, -BCK, -PRO, -FDC, -TIM, -END), `guard` (P104-LIM),
`chopper` (P104-SW), `excitation` (P104-PHS), `ramp` (P104-RMP). Here: P104-PORT-01..03 (pins, reset),
P104-PAR-01 (parameters). The constants that the rules leave open are in `timebase.Latency`.
"""

from __future__ import annotations

from collections.abc import Mapping

from .chip import Chip
from .chopper import Chopper
from .chopper104 import Switching104
from .codes import IBF, OBF
from .commands104 import CommandUnit
from .excitation import ALL_PHASES, Excitation
from .hostport import HostPort
from .hostport104 import SpeedGate, strobes
from .motion import Interval
from .motion104 import Motion104
from .parts import Context, Phase, PinRegister
from .parts104 import GUARD, HOST_PINS, INPUTS, OUTPUTS, WIDTHS
from .timebase import Latency, QuantumCounter

_MOTOR_PINS = ("s", "pout_n", "hold", "dir")


class Ppmc104(Chip):
    """One PPMC-104.

    clk_hz 8e6..200e6, xtal_hz 1e6..16e6, timing "FAST" or "DATASHEET", phase_idle 0 or 1; ValueError for
    anything else. The model starts just released from reset, before edge 0.
    """

    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, HOST_PINS

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        phase_idle: int = 1,
        latency: Latency | None = None,
    ) -> None:
        if phase_idle not in (0, 1):
            raise ValueError(f"phase_idle {phase_idle} is neither 0 nor 1")
        outputs = {**OUTPUTS, "s": ALL_PHASES if phase_idle else 0}
        super().__init__(clk_hz, xtal_hz, timing, outputs, latency)
        self._phase_idle = phase_idle
        counter = QuantumCounter(self.timebase, self.latency.reset_tick)
        self._context = Context(
            self.timebase, self.latency, self.datasheet, self._queue, self.log, counter, dict(INPUTS)
        )
        self._build()

    def _build(self) -> None:
        """Fresh blocks in their reset state."""
        context = self._context
        at_rest = {name: self._reset_levels[name] for name in _MOTOR_PINS}
        self._motor_pins = PinRegister(self._queue, self.latency.motor_pins, at_rest, self.log.set)
        self._excitation = Excitation(self._phase_idle)
        switching = Switching104(context)
        self._chopper = Chopper(context, switching)
        gate = SpeedGate(lambda t: self._port.retry(t))
        self._port = HostPort(context, self._take, self._state, strobes, gate.waits)
        self._motion = Motion104(context, self._port, gate, self._excitation, self._chopper)
        self._commands = CommandUnit(
            context, self._port, self._motion, self._excitation, self._chopper, switching
        )

    def _take(self, t: int, byte: int, command: bool, stored_at: int) -> None:
        """C-event; the times of section 8 count from the write event, or from the end of a wait."""
        latency = self.latency
        waited = t > stored_at + latency.c_event
        reference = t + latency.ds_waited if waited else stored_at + latency.ds_host
        self._commands.take(t, byte, command, reference)

    def _state(self) -> int:
        return self._commands.state()

    # ------------------------------------------------------------------ inside of `chip`

    def _latch(self, t: int) -> None:
        motion = self._motion
        phases = self._excitation.pattern if self._chopper.on else self._excitation.chopped
        self._motor_pins.latch(
            t, {"s": phases, "pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}
        )

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        self._port.sample(t, pins)

    def _see(self, t: int, levels: Mapping[str, int]) -> None:
        inside = self._context.levels
        was, judged = inside["clock"], any(inside[pin] != levels[pin] for pin in GUARD.all)
        inside.update(levels)
        if judged:
            self._queue.at(t, Phase.GUARD, self._motion.judge)
        if levels["clock"] != was:
            edge = self._motion.base_fall if was else self._motion.base_rise
            self._queue.at(t, Phase.BASE, edge)

    def _restart(self) -> None:
        self._context.levels = {**INPUTS, "clock": self._pins["clock"]}
        self._build()

    def _released(self, t: int) -> None:
        self._context.counter.restart(t + self.latency.reset_tick)

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        return {"cs_n": 0, "wr_n" if write else "rd_n": 0, "a0": reg}

    # ------------------------------------------------------------------ what there is to see

    @property
    def pulses(self) -> list[int]:
        """Edges of all pulses: falls of pout_n (P104-GEN-05)."""
        return self.log.falls("pout_n")

    @property
    def busy(self) -> bool:
        """BUSY."""
        return self._motion.busy

    @property
    def status(self) -> int:
        """Status register without the look-ahead of the read path."""
        return self._state() | (IBF if self._port.ibf else 0) | (OBF if self._port.obf else 0)

    @property
    def index(self) -> int | None:
        """Ramp index of the running interval, None at rest, before pulse 1 and in constant speed."""
        return self._motion.index

    @property
    def intervals(self) -> list[Interval]:
        """Intervals of the present or last operation."""
        return self._motion.intervals

    @property
    def initialised(self) -> bool:
        """An initialisation is in force (its table build may still run)."""
        return self._commands.setup is not None

    @property
    def finish(self) -> int:
        """Finish status as the next 0x80 would return it."""
        return self._motion.finish

    @property
    def remaining(self) -> int:
        """Remaining-pulse value as 0x83 would return it."""
        return self._motion.remaining
