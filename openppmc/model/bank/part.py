"""Golden model of the bank at pin level: N axes, each of which behaves like a PPMC-104.

The bank processes its axes in turn; a visit of an axis is an edge of `clk` at which it processes this axis.
The model is event driven and cycle-accurate.

`chip` and `clock` define pins and time. Rules by module: BANK-GEN-01, -02 and -05 are in this module;
BANK-WIN is in `window`, BANK-CHP in `chopper` (which also calculates the times of the visits), BANK-GEN-04 in
`axis` (one object per axis), BANK-HSK, BANK-GEN-03 and BANK-INI in `commands`, BANK-MOT and BANK-HLD in
`motion`, BANK-GRP in `group`. In all other respects, an axis behaves like a PPMC-104.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..chip import Chip, Context
from ..clock import Latency, QuantumCounter
from ..motion.motion import Interval
from .axis import Axis
from .chopper import VisitSchedule, round_clk
from .commands import Builder
from .group import HOST_PINS, PHASES, SWITCHES, Group, inputs, outputs, widths
from .window import Window

SIZES = (4, 8, 16, 32, 64)


class PpmcBank(Chip):
    """Bank of PPMC-104 axes, which are numbered from 0.

    The model starts just after the release of reset, before edge 0.

    Args:
        axes: number of axes: 4, 8, 16, 32 or 64.
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..16e6.
        phase_idle: 0 or 1.

    Raises:
        ValueError: an argument has another value, or BANK-GEN-02 forbids this combination of clk_hz and
            xtal_hz.
    """

    HOST_PINS = HOST_PINS

    def __init__(
        self,
        axes: int = 32,
        clk_hz: int = 100_000_000,
        xtal_hz: int = 16_000_000,
        phase_idle: int = 1,
    ) -> None:
        if axes not in SIZES:
            raise ValueError(f"axes={axes} is not supported; use one of {', '.join(map(str, SIZES))}")
        if phase_idle not in (0, 1):
            raise ValueError(f"phase_idle {phase_idle} is neither 0 nor 1")
        self.INPUTS, self.WIDTHS = inputs(axes), widths(axes)
        super().__init__(clk_hz, xtal_hz, "FAST", outputs(axes, phase_idle), Latency(motor_pins=0))
        self.round = round_clk(axes)
        if 4 * clk_hz % xtal_hz:
            raise ValueError(f"clk_hz {clk_hz}: a quantum of {xtal_hz} Hz is not a whole number of cycles")
        if self.timebase.cyc(16) < self.round:
            raise ValueError(
                f"clk_hz {clk_hz}: 16 XTAL cycles of {xtal_hz} Hz are shorter than {self.round} cycles"
            )
        self._size, self._phase_idle = axes, phase_idle
        self._build(0)

    def _build(self, released: int) -> None:
        """Create blocks in their reset state.

        Args:
            released: first edge after the reset.
        """
        self._levels = {pin: self.INPUTS[pin] for pin in SWITCHES}
        self._changed_axes: set[int] = set()
        self._motors = {name: self._reset_levels[name] for name in ("pout_n", "dir", "hold", "s")}
        counter = QuantumCounter(self.timebase, released)
        context = Context(self.timebase, self.latency, False, self._queue, self.log, counter, {})
        group, builder = Group(self._queue, self._size, self.round), Builder()
        self._axes = [
            Axis(
                number,
                context,
                self._changed_axes,
                VisitSchedule(number, self._size, released),
                group,
                builder,
                self._phase_idle,
            )
            for number in range(self._size)
        ]
        group.members = self._axes
        self._window = Window(self._queue, self.log, self._axes, group, released)

    # ------------------------------------------------------------------ methods that `chip` calls

    def _latch(self, t: int) -> None:
        """Update the ports of all axes in which an event occurred."""
        if not self._changed_axes:
            return
        pout_n, directions, hold, phases = self._motors.values()
        for number in self._changed_axes:
            pulse, direction, rest, pattern = self._axes[number].pins()
            bit, low = 1 << number, PHASES * number
            pout_n = pout_n | bit if pulse else pout_n & ~bit
            directions = directions | bit if direction else directions & ~bit
            hold = hold | bit if rest else hold & ~bit
            phases = phases & ~(0b11111 << low) | pattern << low
        self._changed_axes.clear()
        self._motors = {"pout_n": pout_n, "dir": directions, "hold": hold, "s": phases}
        for signal, value in self._motors.items():
            self.log.set(t, signal, value)
        self.log.set(t, "int_n", int(not any(axis.context.interrupt for axis in self._axes)))

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        self._window.sample(t, pins)

    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        changed = 0
        for pin in SWITCHES:
            changed |= self._levels[pin] ^ levels[pin]
            self._levels[pin] = levels[pin]
        for number, axis in enumerate(self._axes):
            if changed >> number & 1:
                axis.on_levels(t, {pin: levels[pin] >> number & 1 for pin in SWITCHES})

    def _restart(self) -> None:
        self._build(0)

    def _released(self, t: int) -> None:
        self._build(t)

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        return {"cs_n": 0, "wr_n" if write else "rd_n": 0, "a": reg}

    def read(self, t: int, reg: int, strobe: int = 6) -> int:
        """Read the register at address `reg`.

        The next access may begin at edge t + strobe + 3.
        """
        return super().read(t, reg, strobe)

    # ------------------------------------------------------------------ observable state

    def visit(self, axis: int, edge: int) -> int:
        """Return the first visit of an axis at or after an edge."""
        return self._axes[axis].visits.first(edge)

    def bits(self, signal: str, axis: int, since: int = 0) -> list[tuple[int, int]]:
        """Return the changes (t, level) of the bits of one axis in a port of all axes.

        `s` has five bits per axis, other ports one.

        Args:
            since: first edge.
        """
        width = PHASES if signal == "s" else 1
        place, ones, changes = width * axis, (1 << width) - 1, []
        level = self.log.initial[signal] >> place & ones
        for t, value in self.log.of(signal):
            if (bits := value >> place & ones) != level:
                level = bits
                changes.append((t, bits))
        return [(t, bits) for t, bits in changes if t >= since]

    def pulses(self, axis: int, since: int = 0) -> list[int]:
        """Return the edges of the pulses of an axis: falling edges of its pout_n (P104-GEN-05)."""
        return [t for t, level in self.bits("pout_n", axis, since) if level == 0]

    def busy(self, axis: int) -> bool:
        """Return BUSY of an axis."""
        return self._axes[axis].motion.busy

    def status(self, axis: int) -> int:
        """Return the status register of an axis."""
        return self._axes[axis].status

    def position(self, axis: int) -> int:
        """Return the position of an axis after edge `now`, in two's complement."""
        return self._axes[axis].motion.position(self.now)

    def initialised(self, axis: int) -> bool:
        """Return True if an initialisation of an axis is active, also while its ramp table is being built."""
        return self._axes[axis].commands.setup is not None

    def intervals(self, axis: int) -> list[Interval]:
        """Return the intervals of the current or last operation of an axis."""
        return self._axes[axis].motion.intervals

    def index(self, axis: int) -> int | None:
        """Return the ramp index of an axis's running interval.

        The result is `None` at standstill or at constant speed.
        """
        return self._axes[axis].motion.index
