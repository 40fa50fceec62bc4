"""Golden model of the PPMC-2104 at pin level, event driven and cycle-accurate.

Rules by module: P2104-PORT-01..03 and P2104-PAR-01 are in this module. Bus: `single.hostport` (P2104-BUS,
-HSK). `commands`: P2104-CMD, -INI, -RD, -AUX, -ERR, -FSM. `codes`: interrupt (P2104-INT). `axis`, one object
per axis, with `motion.motion`: P2104-OPR, -STP, -BCK, -TIM, -PRO, -FDC, -END, -LIM, -DS. Phases and chopper:
`motion.excitation` (P2104-PHS, -SW). Ramp: `motion.ramp` (P2104-RMP). `chip` and `clock` contain pins and
time. `clk_o` is not modelled.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..chip import Chip, Context, PinRegister
from ..clock import Latency, QuantumCounter
from ..motion.motion import Interval
from ..single.hostport import HostPort
from .axis import Axis, Windows
from .codes import AXES, HOST_PINS, IBF, INPUTS, OBF, OUTPUTS, WIDTHS, Interrupt, axis_levels, strobes
from .commands import CommandUnit


class Ppmc2104(Chip):
    """One PPMC-2104. The model starts just after the release of reset, before edge 0.

    A port of both axes is one number, bit 0 = axis 1.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..16e6.
        timing: "FAST" or "DATASHEET".

    Raises:
        ValueError: a value is out of range.
    """

    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, HOST_PINS

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        latency: Latency | None = None,
    ) -> None:
        super().__init__(clk_hz, xtal_hz, timing, OUTPUTS, latency)
        self._build(0, INPUTS)

    def _build(self, released: int, pins: Mapping[str, int]) -> None:
        """Create blocks in their reset state.

        Args:
            released: first edge after the reset.
        """
        counter = QuantumCounter(self.timebase, released + self.latency.reset_tick)
        # After a reset, the synchroniser of extck holds the level of its pin, so the part counts no edge of
        # the clock that did not occur at the pin. All other synchronisers hold idle levels.
        levels = {**INPUTS, "extck": pins["extck"]}
        context = Context(self.timebase, self.latency, self.datasheet, self._queue, self.log, counter, levels)
        self._context = context
        self._port = HostPort(context, self._take, self._state, strobes, self._must_wait)
        self._interrupt = Interrupt(context)
        windows = Windows(context, self._port, released)
        self.axes = [Axis(number, context, windows, self._interrupt) for number in AXES]
        self._commands = CommandUnit(context, self._port, self.axes, self._interrupt, windows)
        self._int_pin = PinRegister(self._queue, self.latency.int_pin, {"int_n": 1}, self.log.set)

    def _take(self, t: int, byte: int, command: bool, stored_at: int) -> None:
        self._commands.take(t, byte, command)

    def _must_wait(self, t: int, byte: int, command: bool) -> bool:
        return self._commands.must_wait(t, byte, command)

    def _state(self) -> int:
        return self._commands.state()

    # ------------------------------------------------------------------ methods that `chip` calls

    def _latch(self, t: int) -> None:
        for axis in self.axes:
            axis.latch(t)
        self._int_pin.latch(t, {"int_n": self._interrupt.level(t)})

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        self._port.sample(t, pins, self._stage)

    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        self._context.levels.update(levels)
        for axis in self.axes:
            axis.on_levels(t, axis_levels(levels, axis.number))

    def _restart(self) -> None:
        self._build(0, self._pins)

    def _released(self, t: int) -> None:
        self._build(t, self._pins)

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        if self._pins["busc"]:
            return {"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": int(not write), "a0": reg}
        return {"cs_n": 0, "ds_wrs_n" if write else "rw_rds_n": 0, "a0": reg}

    # ------------------------------------------------------------------ observable state

    def bits(self, signal: str, axis: int, since: int = 0) -> list[tuple[int, int]]:
        """Return the changes (t, level) of the bit of one axis in a port of both axes.

        Args:
            axis: 1 or 2.
            since: first edge.
        """
        place, changes = axis - 1, []
        level = self.log.initial[signal] >> place & 1
        for t, value in self.log.of(signal):
            if (bit := value >> place & 1) != level:
                level = bit
                changes.append((t, bit))
        return [(t, bit) for t, bit in changes if t >= since]

    def pulses(self, axis: int, since: int = 0) -> list[int]:
        """Return the edges of the pulses of axis 1 or 2: falling edges of its pout_n (P2104-GEN-05)."""
        return [t for t, level in self.bits("pout_n", axis, since) if level == 0]

    def busy(self, axis: int) -> bool:
        """Return BUSY of axis 1 or 2."""
        return self.axes[axis - 1].motion.busy

    def intervals(self, axis: int) -> list[Interval]:
        """Return the intervals of the current or last operation of axis 1 or 2."""
        return self.axes[axis - 1].motion.intervals

    def index(self, axis: int) -> int | None:
        """Return the ramp index of the running interval of axis 1 or 2.

        The result is `None` at standstill or at constant speed.
        """
        return self.axes[axis - 1].motion.index

    @property
    def status(self) -> int:
        """Status register without transfers in progress.

        IBF remains 0 until a written byte is stored, and OBF remains 1 until a byte that was read is removed.
        """
        return self._state() | (IBF if self._port.ibf else 0) | (OBF if self._port.obf else 0)
