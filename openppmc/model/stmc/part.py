"""Golden model of the STMC core at pin level, event driven and cycle-accurate.

Rules by module: parameters and reset values are in this module (docs/stmc/README.md, 3 Parameters). Bus:
`single.hostport` (STMC-BUS). Commands and motion: `commands` in this folder and in `single` (STMC-ST, -CMD,
-INI, -RD), `motion.motion` (STMC-MOT, -STP, -CLK, -MOV, -DEC, -IN, -DS). Phases and chopper:
`motion.excitation` (STMC-EXC, -CHP). Ramp: `motion.ramp` (STMC-RMP). `chip`, `clock` and `single.single`
contain pins and time. `clock.Latency` contains the constants that the rules leave open.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..chip import Context
from ..clock import Latency
from ..motion.excitation import Chopper
from ..single.hostport import HostPort, strobes
from ..single.single import SingleAxis
from .codes import READ_MAPS
from .commands import CommandUnit, Motion
from .pins import GUARD, HOST_PINS, INPUTS, OUTPUTS, WIDTHS

# The ramp table of the STMC has 16-bit thresholds. Therefore, its build takes longer than for related parts.
LATENCY = Latency(build_base=2032, build_per_rate=144)


@dataclass(frozen=True)
class FixedChopperTimes:
    """Chopper times in crystal periods, rounded up to whole quanta (STMC-CHP-01)."""

    on: int
    off: int
    quantum: int

    def quanta(self, on: bool) -> int:
        """Return the length of a phase that begins now, in quanta."""
        return -(-(self.on if on else self.off) // self.quantum)


class Stmc(SingleAxis):
    """One STMC core. The model starts just after the release of reset, before edge 0.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..20e6.
        timing: "FAST" or "DATASHEET".
        read_map: "FAMILY" or "SHEET".
        phase_idle: 0 or 1.
        hold_xt: time from the end of a motion to HOLD in crystal periods, at least 1.
        chop_on_xt: on-time of the chopper in crystal periods, at least 1.
        chop_off_xt: off-time of the chopper in crystal periods, at least 1.

    Raises:
        ValueError: a value is out of range.
    """

    XTAL_MAX = 20_000_000
    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, HOST_PINS
    GUARD, CLOCK_PIN = GUARD, "ext_clk"

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        read_map: str = "FAMILY",
        phase_idle: int = 0,
        hold_xt: int = 544_000,
        chop_on_xt: int = 1_040,
        chop_off_xt: int = 1_740,
        latency: Latency | None = None,
    ) -> None:
        if read_map not in READ_MAPS:
            raise ValueError(f"read_map {read_map!r} is neither FAMILY nor SHEET")
        if min(hold_xt, chop_on_xt, chop_off_xt) < 1:
            raise ValueError(f"hold {hold_xt}, chopper {chop_on_xt} and {chop_off_xt} crystal periods")
        self._read_map = read_map
        self._hold_xt = hold_xt
        self._chop_xt = (chop_on_xt, chop_off_xt)
        super().__init__(clk_hz, xtal_hz, timing, OUTPUTS, phase_idle, latency or LATENCY)

    def _blocks(self, context: Context) -> None:
        self._chopper = Chopper(context, FixedChopperTimes(*self._chop_xt, self.timebase.quantum))
        self._port = HostPort(context, self._take, self._state, strobes)
        self._motion = motion = Motion(context, self._port, self._excitation, self._chopper, self._hold_xt)
        self._commands = CommandUnit(
            context, self._port, motion, self._excitation, self._chopper, self._read_map
        )

    def _motor_levels(self) -> dict[str, int]:
        return {"hold": self._motion.hold}

    @property
    def position(self) -> int:
        """Current position in the excitation table."""
        return self._excitation.index
