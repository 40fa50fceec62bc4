"""Golden model of the PPMC-104 at pin level, event driven and exact to the clk.

Pins and time: `common.chip`, `single.single`. Blocks: `hostport` and `strobes` (P104-BUS, -HSK), `commands`
here and in `single` (P104-CMD, -ERR, -INI, -RD, -AUX), `motion` here and in `motion`, `timed_motion`
(P104-OPR, -BCK, -PRO, -FDC, -TIM, -END), `guard` (P104-LIM), `chopper` (P104-SW), `excitation` (P104-PHS),
`ramp` (P104-RMP). Here: P104-PORT-01..03 (pins, reset), P104-PAR-01 (parameters). The constants that the
rules leave open are in `timebase.Latency`.
"""

from __future__ import annotations

from ..common.blocks import Context
from ..common.timebase import Latency
from ..motion.chopper import Chopper
from ..single.hostport import HostPort
from ..single.single import SingleAxis
from ..single.strobes import SpeedGate, strobes
from .chopper import Switching
from .commands import CommandUnit
from .motion import Motion
from .pins import GUARD, HOST_PINS, INPUTS, OUTPUTS, WIDTHS


class Ppmc104(SingleAxis):
    """One PPMC-104.

    clk_hz 8e6..200e6, xtal_hz 1e6..16e6, timing "FAST" or "DATASHEET", phase_idle 0 or 1; ValueError for
    anything else. The model starts just released from reset, before edge 0.
    """

    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, HOST_PINS
    GUARD, CLOCK_PIN = GUARD, "clock"

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        phase_idle: int = 1,
        latency: Latency | None = None,
    ) -> None:
        super().__init__(clk_hz, xtal_hz, timing, OUTPUTS, phase_idle, latency)

    def _blocks(self, context: Context) -> None:
        switching = Switching(context)
        self._chopper = Chopper(context, switching)
        gate = SpeedGate(lambda t: self._port.retry(t))
        self._port = HostPort(context, self._take, self._state, strobes, gate.waits)
        self._motion = motion = Motion(context, self._port, gate, self._excitation, self._chopper)
        self._commands = CommandUnit(context, self._port, motion, self._excitation, self._chopper, switching)

    def _motor_levels(self) -> dict[str, int]:
        motion = self._motion
        return {"pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}

    @property
    def pulses(self) -> list[int]:
        """Edges of all pulses: falls of pout_n (P104-GEN-05)."""
        return self.log.falls("pout_n")
