"""Golden model of the PPMC-104 at pin level, event driven and exact to the clk.

Time is the index of rising clk edges. A pin change at t is first sampled by edge t; an output edge at t is
the register changing at edge t. Edge 0 is the first one with rst_n = 1. Blocks: `hostport104` (P104-BUS,
-HSK), `commands104` (P104-CMD, -ERR, -INI, -RD, -AUX), `motion104` (P104-OPR, -BCK, -PRO, -FDC, -TIM,
-END), `guard104` (P104-LIM), `chopper104` (P104-SW), `excitation` (P104-PHS), `ramp` (P104-RMP). Here:
P104-PORT-01..03 (pins, reset), P104-PAR-01 (parameters). The constants that the rules leave open are in
`timebase.Latency`. The cost of a run grows with its events, not with its clk.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from .chopper104 import Chopper
from .codes104 import IBF, OBF
from .commands104 import CommandUnit
from .edges import Edge, EdgeLog
from .excitation import ALL_PHASES, Excitation
from .hostport104 import HostPort
from .motion104 import Interval, Motion
from .parts104 import HOST_PINS, INPUTS, OUTPUTS, WIDTHS, Context, MotorPins, Phase
from .scheduler import Scheduler
from .timebase import Latency, QuantumCounter, Timebase

DATA, STATUS, COMMAND = 0, 1, 1
_JUDGED = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")


class Ppmc104:
    """One PPMC-104.

    clk_hz 8e6..200e6, xtal_hz 1e6..16e6, timing "FAST" or "DATASHEET", phase_idle 0 or 1; ValueError for
    anything else. The model starts just released from reset, before edge 0.
    """

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        phase_idle: int = 1,
        latency: Latency | None = None,
    ) -> None:
        if timing not in ("FAST", "DATASHEET"):
            raise ValueError(f"timing {timing!r} is neither FAST nor DATASHEET")
        if phase_idle not in (0, 1):
            raise ValueError(f"phase_idle {phase_idle} is neither 0 nor 1")
        self.timebase = Timebase(clk_hz, xtal_hz)
        self.latency = latency or Latency()
        self._phase_idle = phase_idle
        self._reset_levels = {**OUTPUTS, "s": ALL_PHASES if phase_idle else 0}
        self._queue = Scheduler()
        self.log = EdgeLog(self._reset_levels)
        counter = QuantumCounter(self.timebase, self.latency.reset_tick)
        self._context = Context(
            self.timebase, self.latency, timing == "DATASHEET", self._queue, self.log, counter
        )
        self._pins = dict(INPUTS)
        self._changed_at = -1
        motor = {name: self._reset_levels[name] for name in ("s", "pout_n", "hold", "dir")}
        self._motor_pins = MotorPins(self._context, motor)
        self._build()

    def _build(self) -> None:
        """Fresh blocks in their reset state."""
        self._excitation = Excitation(self._phase_idle)
        self._chopper = Chopper(self._context)
        self._port = HostPort(self._context, self._take, self._state)
        self._motion = Motion(self._context, self._port, self._excitation, self._chopper)
        self._commands = CommandUnit(self._context, self._port, self._motion, self._excitation, self._chopper)

    def _take(self, t: int, byte: int, command: bool, reference: int) -> None:
        self._commands.take(t, byte, command, reference)

    def _state(self) -> int:
        return self._commands.state()

    # ------------------------------------------------------------------ time

    @property
    def now(self) -> int:
        """The last edge that was run, -1 before edge 0."""
        return self._queue.now

    @property
    def next_event(self) -> int | None:
        """The next edge on which anything happens by itself, None if nothing ever will."""
        return self._queue.next_edge()

    def run_until(self, t: int) -> None:
        """Run all edges up to and including t. Raises ValueError if t lies before `now`."""
        queue = self._queue
        if t < queue.now:
            raise ValueError(f"run_until({t}): edge {queue.now} is done")
        while (edge := queue.next_edge()) is not None and edge <= t:
            queue.now = edge - 1
            queue.run_edge(edge)
            self._latch(edge)
            queue.run_edge(edge)
        queue.now = t

    def _latch(self, t: int) -> None:
        motion = self._motion
        phases = self._excitation.pattern if self._chopper.on else self._excitation.chopped
        self._motor_pins.latch(
            t, {"s": phases, "pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}
        )

    # ------------------------------------------------------------------ pins

    def pins(self, t: int, **levels: int) -> None:
        """Input levels that rising edge t samples first; later calls for the same t overrule.

        Raises ValueError for an edge already run, an unknown pin or a level out of range. rst_n = 0 acts
        at once (P104-PORT-03); its output edges are stamped t.
        """
        for pin, level in levels.items():
            if pin not in INPUTS:
                raise ValueError(f"no input pin {pin!r}")
            if not 0 <= level < 1 << WIDTHS.get(pin, 1):
                raise ValueError(f"level {level} of {pin} is out of range")
        if t <= self.now:
            raise ValueError(f"pins({t}): edge {self.now} is done")
        self.run_until(t - 1)
        if levels.get("rst_n") == 0:
            self._reset(t)
        released = levels.get("rst_n") == 1 and not self._pins["rst_n"]
        before = dict(self._pins)
        self._pins.update(levels)
        if released:
            self._context.counter.restart(t + self.latency.reset_tick)
            self._sample(t, self._pins)
        elif self._pins["rst_n"]:
            changed = {pin for pin, level in levels.items() if level != before[pin]}
            self._sample(t, changed)

    def _sample(self, t: int, changed: Mapping[str, int] | set[str]) -> None:
        """Edge t samples pins; the levels reach the inside `input_sync` clk later."""
        if not changed:
            return
        queue = self._queue
        if any(pin in changed for pin in HOST_PINS):
            queue.at(t, Phase.PINS, self._sample_bus)
        if any(pin not in HOST_PINS for pin in changed):
            queue.at(t, Phase.PINS, self._sample_levels)

    def _sample_bus(self, t: int) -> None:
        self._port.sample(t, self._pins)

    def _sample_levels(self, t: int) -> None:
        levels = dict(self._pins)
        at = t + self.latency.input_sync
        self._queue.at(at, Phase.LEVELS, lambda now: self._see(now, levels))

    def _see(self, t: int, levels: dict[str, int]) -> None:
        """Synchronised levels as decisions at edge t use them."""
        inside = self._context.levels
        was, judged = inside["clock"], any(inside[pin] != levels[pin] for pin in _JUDGED)
        inside.update(levels)
        if judged:
            self._queue.at(t, Phase.GUARD, self._motion.judge)
        if levels["clock"] != was:
            edge = self._motion.base_fall if was else self._motion.base_rise
            self._queue.at(t, Phase.BASE, edge)

    def _reset(self, t: int) -> None:
        """Asynchronous reset (P104-PORT-03, P104-BAD-19)."""
        self._queue.clear()
        self._motor_pins.reset()
        self._context.levels = {**INPUTS, "clock": self._pins["clock"]}
        for signal, level in self._reset_levels.items():
            self.log.set(t, signal, level)
        self._build()

    # ------------------------------------------------------------------ host

    def write(self, t: int, reg: int, byte: int, strobe: int = 2) -> int:
        """Write cycle: strobe from edge t, data byte (reg 0) or command byte (reg 1).

        Returns edge 0 of P104-BUS-06 = t + strobe, up to which the pins are set; edge 0 is not run yet.
        """
        self.pins(t, cs_n=0, wr_n=0, a0=reg, d_i=byte)
        self.pins(t + strobe, cs_n=1, wr_n=1)
        return t + strobe

    def read(self, t: int, reg: int, strobe: int = 4) -> int:
        """Read cycle: strobe from edge t; returns d_o at its end. The next access may begin at
        t + strobe + 2."""
        self.pins(t, cs_n=0, rd_n=0, a0=reg)
        self.run_until(t + strobe - 1)
        value = self.log.levels["d_o"]
        self.pins(t + strobe, cs_n=1, rd_n=1)
        return value

    # ------------------------------------------------------------------ what there is to see

    @property
    def edges(self) -> list[Edge]:
        """All output edges so far, in time order."""
        return self.log.edges

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels after edge `now`."""
        return MappingProxyType(self.log.levels)

    @property
    def inputs(self) -> Mapping[str, int]:
        """Input levels as set last."""
        return MappingProxyType(self._pins)

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
