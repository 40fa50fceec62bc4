"""Golden model of the PPMC-312 at pin level, event driven and cycle-accurate.

`chip` and `clock` define pins and time. The other modules are `front` (host interface), `instructions`,
`stages` (tables, plans of moves) and `motion` (motions, positions, inputs, outputs); `core` connects them.
This module contains P312-PRT-01..03, the reset and the software reset.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..chip import Chip, Context, Phase, PinRegister
from ..clock import Latency, QuantumCounter
from .codes import HOST_PINS, INPUTS, OUTPUTS, SERIAL_PINS, WIDTHS, ResettableScheduler, Source, State
from .core import Core
from .front.mailbox import IDLE, Mailbox, Strobes
from .front.serial import bit_time
from .front.station import Driver, HostSide, Log, Station
from .motion.motion import Motion
from .timing import READY, CoreTiming

_LATE = ("irq_n", "intlk_n")
_SYNCHRONISED = {pin: (1 << WIDTHS.get(pin, 1)) - 1 for pin in INPUTS}
"""Internal levels of the pins until the pins are first sampled."""


class Ppmc312(Chip):
    """One PPMC-312. The model starts just after the release of reset, before edge 0.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..16e6.
        timing: "FAST" or "DATASHEET".
        version: 0..255.
        sum_mode: "BINARY" or "CHARS", checksum rule of the serial mode.
        snd_lead: 1..16, number of bits from the rising edge of snd to the start bit.
        snd_wait: 0..8, delay of snd in bits in addition to half a bit.
        straps: pin levels from the beginning on, for example mode, mod, adr.

    Raises:
        ValueError: a value is out of range.

    Attributes:
        replies: (edge at which snd rises, whole frame) of all frames that the station has sent.
        sent: (edge in the middle of the stop bit, character) of all characters sent. Both lists may be
            cleared at any time.
    """

    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, HOST_PINS

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        version: int = 0x12,
        sum_mode: str = "BINARY",
        snd_lead: int = 1,
        snd_wait: int = 0,
        straps: Mapping[str, int] | None = None,
        core_timing: CoreTiming | None = None,
        latency: Latency | None = None,
    ) -> None:
        if not 0 <= version <= 255:
            raise ValueError(f"version {version} is outside 0..255")
        if sum_mode not in ("BINARY", "CHARS"):
            raise ValueError(f"sum_mode {sum_mode!r} is neither BINARY nor CHARS")
        if not 1 <= snd_lead <= 16:
            raise ValueError(f"snd_lead {snd_lead} is outside 1..16")
        if not 0 <= snd_wait <= 8:
            raise ValueError(f"snd_wait {snd_wait} is outside 0..8")
        super().__init__(clk_hz, xtal_hz, timing, OUTPUTS, latency)
        self.core_timing = core_timing or CoreTiming()
        self._version, self._sum_mode = version, sum_mode
        self._driver = Driver(snd_lead, snd_wait)
        self._pins |= straps or {}
        self.replies: list[tuple[int, bytes]] = []
        self.sent: list[tuple[int, int]] = []
        self._latched: dict[str, int] = dict(INPUTS)
        self._counter = QuantumCounter(self.timebase, 0)
        self._restart()
        self._released(0)
        self._sample(0, self.INPUTS)

    def _build(self) -> None:
        """Create blocks in their reset state. The synchronisers hold inactive levels."""
        levels = dict(_SYNCHRONISED)
        self._block_queue = ResettableScheduler(self._queue)
        self._context = Context(
            self.timebase, self.latency, self.datasheet, self._block_queue, self.log, self._counter, levels
        )
        self.core = Core(
            self._context, self.core_timing, self._version, self._make_host, self._software_reset
        )

    def _make_host(self, core: Core) -> HostSide:
        self._mailbox = Mailbox(core.context, self.core_timing, core.responses, core.unit.host_block)
        return self._mailbox

    def _latch_mode(self, t: int) -> None:
        """Latch the pins that select the host side, at the end of a reset (P312-PRT-03)."""
        self._latched = {pin: self._pins[pin] for pin in ("mode", "mod", "adr")}
        self._connect()

    def _connect(self) -> None:
        """Connect the host side that the latched pins select."""
        self._host: HostSide = self._mailbox
        self._host_pins = {*self.HOST_PINS}
        if not self._latched["mode"]:
            bit = bit_time(self._latched["mod"], self.timebase.clk_hz, self.timebase.xtal_hz)
            log = Log(self.replies, self.sent)
            self._host = Station(self.core, bit, self._latched["adr"], self._sum_mode, log, self._driver)
            self._host_pins = {*SERIAL_PINS}
        self.core.connect(self._host, not self._latched["mode"])

    # ------------------------------------------------------------------ reset

    def _restart(self) -> None:
        self._build()
        self._strobes = Strobes(self._queue, self.log, self._mailbox)
        self._out_oe = 0

    def _released(self, t: int) -> None:
        """Process edge t, the first edge after a reset (P312-PRT-02, -03)."""
        self._latch_mode(t)
        self._out_oe = 0
        self._reset_levels_held = self._levels()
        self._registers = self._make_registers()
        self._last_state: object = None
        ready = t + (
            self.timebase.cyc(READY) + self.core_timing.start if self.datasheet else self.core_timing.ready
        )
        self._parallel = bool(self._latched["mode"])
        self._bus_from = self._line_from = t + self.core_timing.ready
        self._pins_from = ready + 1
        self._queue.at(ready, Phase.END, self._ready)

    def _make_registers(self) -> list[tuple[tuple[str, ...], PinRegister]]:
        """Return the output registers.

        Most output pins are registers of a block; some pins follow an internal level.
        """
        late = {name: level for name, level in self._reset_levels_held.items() if name in _LATE}
        early = {name: level for name, level in self._reset_levels_held.items() if name not in _LATE}
        return [
            (tuple(levels), PinRegister(self._queue, lag, levels, self.log.set))
            for levels, lag in ((early, 0), (late, self.core_timing.pins))
        ]

    def _ready(self, t: int) -> None:
        self._out_oe = 1
        self._host.ready(t)

    def _sample(self, t: int, changed: Iterable[str]) -> None:
        """Sample pins. During a reset, no pin is sampled; the first edge after it samples all pins."""
        names = set(changed)
        if self._host_pins & names:
            self._queue.at(max(t, self._bus_from), Phase.PINS, lambda now: self._sample_bus(now, self._pins))
        if others := names.difference(self.HOST_PINS, SERIAL_PINS):
            super()._sample(max(t, self._pins_from), others)

    def _sample_levels(self, t: int) -> None:
        super()._sample_levels(t)
        level = self._pins["run"]
        self._queue.at(t + self.latency.input_sync, Phase.PINS, lambda now: self._set_run_level(now, level))

    def _set_run_level(self, t: int, level: int) -> None:
        """Update RUN, which has no register before the decision.

        A start uses the level of RUN at the same edge, not the level at the previous edge (P312-INP-20).
        """
        if t >= self._pins_from + self.latency.input_sync:
            self.core.operation.run_level = level

    def _software_reset(self, t: int, source: Source) -> None:
        """Execute instruction FF (P312-CMD-FF) and send its response.

        After it, the state is the same as after a reset, except for the levels of the pins. A strobe on the
        bus continues (P312-PAR-11), unless the pins now select the serial mode.
        """
        self._block_queue.close()
        self._queue.at(t, Phase.PIN, self._reset_outputs)
        self._build()
        self._connect()
        # A read at this edge still returns the values of the old registers.
        self._queue.at(t, Phase.COMMAND, lambda now: self._strobes.replace_registers(now, self._mailbox))
        self._line_from = self._pins_from = t + self.core_timing.reboot
        self._queue.at(t + self.core_timing.reboot, Phase.PINS, self._switch)
        super()._sample(self._pins_from, {*self.INPUTS}.difference(self.HOST_PINS, SERIAL_PINS))
        self._queue.at(t + 1, Phase.PINS, self._latch_mode)
        self._queue.at(t + 1, Phase.END, lambda now: self._reopen(now, Station))
        self._queue.at(t + self.core_timing.reopen, Phase.END, lambda now: self._reopen(now, Mailbox))
        self._queue.at(t + self.core_timing.reboot, Phase.BUS, self.core.unit.answer_reset)

    def _switch(self, t: int) -> None:
        """Process edge t, the first edge in the mode that a software reset has selected.

        This edge samples the pins of the host side.
        """
        self._parallel = bool(self._latched["mode"])
        if not self._parallel:
            self._strobes.sample(t, IDLE)
        self._sample_bus(t, self._pins)

    def _reopen(self, t: int, kind: type[Mailbox | Station]) -> None:
        if isinstance(self._host, kind):
            self._host.ready(t)

    def _reset_outputs(self, t: int) -> None:
        """Reset the pins that follow no internal level, or follow an internal level one cycle later."""
        for pin in ("wrq_n", "txd", "snd", *_LATE):
            self.log.set(t, pin, OUTPUTS[pin])

    def on_char(self, t: int, byte: int | None) -> None:
        """Process a whole character on the line (serial mode only); the levels of rxd are not modelled.

        Args:
            t: edge that samples the stop bit.
            byte: the character, `None` if its stop bit is low.

        Raises:
            ValueError: edge t was already simulated.
        """
        self._queue.at(t, Phase.BUS, lambda now: self.station.on_char(now, byte))

    # ------------------------------------------------------------------ methods that `chip` calls

    def _levels(self) -> dict[str, int]:
        """Return the internal levels of the pins."""
        core, motion = self.core, self.motion
        pulse = {"pout": motion.pout, "dir": motion.direction, "intlk_n": int(not core.interlock.on)}
        return {**core.outputs.levels(), **pulse, **self._host.levels(), "out_oe": self._out_oe}

    def _latch(self, t: int) -> None:
        """Update the pins. Until out_oe is active, they keep their reset levels (P312-PRT-02)."""
        if not self._out_oe:
            levels = self._reset_levels_held
        else:
            # At most edges, no pin changes, so return early.
            core, motion = self.core, self.motion
            state = core.outputs.values, motion.pout, motion.direction, core.interlock.on, self._host.levels()
            if state == self._last_state:
                return
            self._last_state, levels = state, self._levels()
        for names, register in self._registers:
            register.latch(t, {name: levels[name] for name in names})

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        if self._parallel:
            self._strobes.sample(t, pins)
        elif isinstance(self._host, Station) and t >= self._line_from:
            self._host.sample(t, pins)

    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        if t < self._pins_from + self.latency.input_sync:
            return
        internal, core = self._context.levels, self.core
        before = dict(internal)
        internal.update(levels)
        if levels["epin"] and not before["epin"]:
            core.count_encoder(t, levels["epdir"])
        core.filters.on_levels(t, levels)
        if levels["run"] != before["run"]:
            core.operation.check_run(t)
        if levels["auxi"] != before["auxi"]:
            core.input_change.on_change(t)
        if levels["extck"] != before["extck"] and core.table is not None:
            counted = {6: 1, 7: 0}.get(core.table.clk)
            if counted == levels["extck"]:
                self._queue.at(t, Phase.BASE, self.motion.tick)

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        return {"cs_n": 0, "we_n" if write else "oe_n": 0, "rs": reg}

    # ------------------------------------------------------------------ observable state

    @property
    def motion(self) -> Motion:
        """The pulse output."""
        return self.core.operation.motion

    @property
    def csr(self) -> int:
        """Value of CSR without side effects; parallel mode only."""
        assert isinstance(self._host, Mailbox)
        return self._host.csr

    @property
    def station(self) -> Station:
        """Host side of the serial mode; every reset creates a new one."""
        assert isinstance(self._host, Station)
        return self._host

    @property
    def state(self) -> State:
        """Operation state."""
        return self.core.state

    @property
    def position(self) -> int:
        """Pulse position POS, 0 .. 2^32 - 1."""
        return self.core.counters.pulse
