"""Golden model of the PMC006B4 at pin level, event driven and cycle-accurate.

`chip` and `clock` define pins and time. `line` contains the serial line; `codes`, `settings` and
`instructions` contain the instructions, the user program and its keys; `motion` contains motion, emergency
inputs and stall; `memory` contains the EEPROM; `drive` contains microsteps and chopper.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..chip import Chip, Phase
from .drive.drive import Drive
from .instructions.executor import ExecutionContext, Executor
from .instructions.operations import KeyFilter
from .instructions.processor import Processor
from .line import Command, Line, reply
from .memory.boot import Boot
from .memory.eeprom import Bus, Engine
from .motion.motion import Motion
from .pins import INPUTS, OUTPUTS, SYNCHRONISED, WIDTHS, CoreTiming, Services, Ticks
from .settings import Settings

MS, RESTORE_MS = 1000, 20
"""Number of µs ticks in a millisecond, and the time in ms for which FSET must be low to request a restore."""
_LINES = {"scl_i", "sda_i"}


class Pmc006(Chip):
    """One PMC006B4. The model starts just after the release of reset, before edge 0.

    The RTL parameters have the names of these arguments, in capitals. pwm_a_ref and pwm_b_ref are not in the
    log; `pwm` returns them.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: accepted because all parts have this argument, but without effect.
        timing: "FAST" or "DATASHEET"; both behave identically.
        step_ack: "MANUAL" or "ECHO".
        baud: 1200..115200.
        i2c_hz: 10e3..400e3.
        ee_dev: 0..127.
        t_off_ns: off-time of the chopper in ns.
        t_blank_ns: blanking time of the chopper in ns.
        fw_version: firmware version.
        straps: pin levels from the beginning on.

    Raises:
        ValueError: a value is out of range.

    Attributes:
        replies: (edge at which de rises, frame) of all replies.
        sent: (edge in the middle of a stop bit, byte) of all bytes sent. Both lists may be cleared at any
            time.
    """

    INPUTS, WIDTHS, HOST_PINS = INPUTS, WIDTHS, ("rxd",)

    def __init__(
        self,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        step_ack: str = "MANUAL",
        baud: int = 9600,
        i2c_hz: int = 400_000,
        ee_dev: int = 0x50,
        t_off_ns: int = 20_000,
        t_blank_ns: int = 1_000,
        fw_version: int = 0x123,
        straps: Mapping[str, int] | None = None,
        core_timing: CoreTiming | None = None,
    ) -> None:
        del xtal_hz
        super().__init__(clk_hz, 16_000_000, timing, OUTPUTS, None)
        if step_ack not in ("MANUAL", "ECHO"):
            raise ValueError(f"step_ack {step_ack!r} is neither MANUAL nor ECHO")
        for name, given, low, high in (
            ("baud", baud, 1200, 115_200),
            ("i2c_hz", i2c_hz, 10_000, 400_000),
            ("ee_dev", ee_dev, 0, 0x7F),
            ("t_off_ns", t_off_ns, 1_000, 100_000),
            ("t_blank_ns", t_blank_ns, 100, 10_000),
            ("fw_version", fw_version, 0, 0xFFFF_FFFF),
        ):
            if not low <= given <= high:
                raise ValueError(f"{name} {given} is outside {low}..{high}")
        self.core_timing = core_timing or CoreTiming()
        self._echo, self._version = step_ack == "ECHO", fw_version
        self._baud, self._i2c_hz, self._ee_dev = baud, i2c_hz, ee_dev
        self._chopper_ns = (t_off_ns, t_blank_ns)
        self._pins |= straps or {}
        self.replies: list[tuple[int, bytes]] = []
        self.sent: list[tuple[int, int]] = []
        self._released(0)
        self._sample(0, self.INPUTS)

    # ------------------------------------------------------------------ reset

    def _build(self, t: int) -> None:
        """Create blocks in their reset state; edge t is the first edge after the reset."""
        first = t + self.core_timing.reset
        queue, clk_hz = self._queue, self.timebase.clk_hz
        us = Ticks(clk_hz, 1_000_000, first - 1)
        self._first, self._booting = first, True
        self._services = services = Services(queue, self.log, clk_hz, us, self.core_timing, Settings())
        self.context = context = ExecutionContext(services, self._echo, self._version, self._changed)
        self.motion = context.motion = Motion(services, self._stepped, context.ended)
        self.drive = Drive(services, self.motion, *self._chopper_ns, origin=first)
        self.executor = Executor(context, self._answer)
        context.program = Processor(context, self.executor)
        bus = self._bus(services, context.levels)
        context.eeprom = Engine(context, bus, self._ee_dev)
        self._boot = Boot(context, context.eeprom, bus, self._booted, self._changed)
        self.line = Line(services, self._baud, self._accept_frame, self.replies, self.sent)
        ticks = MS + self.core_timing.key_ticks
        self._reset_key = KeyFilter(
            services, ticks, ticks, context.program.reset_key, context.program.release_key
        )
        self._pause_key = KeyFilter(services, ticks, ticks, context.program.pause_key)
        restore_ticks = RESTORE_MS * MS + self.core_timing.key_ticks
        self._restore_key = KeyFilter(services, restore_ticks, 0, self._restore, armed=True)

    def _bus(self, services: Services, levels: Mapping[str, int]) -> Bus:
        """Return the master of the I2C bus of the EEPROM."""
        return Bus(services, levels, self._i2c_hz)

    def _restart(self) -> None:
        self._build(0)

    def _released(self, t: int) -> None:
        """Process edge t, the first edge after a reset."""
        self._build(t)
        self._output_values = (0, 0, True, False)
        levels = dict(SYNCHRONISED)
        self._queue.at(self._first, Phase.LEVELS, lambda now: self._keys(now, levels))
        self._boot.begin(self._first)

    # ------------------------------------------------------------------ boot

    def _restore(self, t: int) -> None:
        """Process the restore request: FSET was low for the required time (P006-EEP-21)."""
        self._queue.at(t, Phase.END, self._restore_now)

    def _restore_now(self, t: int) -> None:
        if self._booting:
            self._boot.restore(t)
        else:
            self.context.eeprom.restore(t)

    def _booted(self, t: int, valid: bool) -> None:
        """Process the end of BOOT at edge t."""
        self._booting = False
        self.context.eeprom.idle()
        self.drive.booted(t)
        self.line.listen(t, True)
        if valid and self.context.settings.offline:
            self.context.program.start(t, 0)

    # ------------------------------------------------------------------ frames

    def _accept_frame(self, t: int, command: Command) -> bool:
        """Process a frame with a valid checksum (P006-FRM-02)."""
        if command.address != self.context.settings.addr:
            return False
        self.executor.frame(t, command)
        return True

    def _answer(self, t: int, data: int) -> None:
        self.line.answer(reply(self.context.settings.addr, data))

    def on_char(self, t: int, byte: int | None) -> None:
        """Process a whole byte on the line, without modelling the levels of rxd.

        Args:
            t: edge that samples the stop bit.
            byte: the byte, `None` if its stop bit is low.

        Raises:
            ValueError: edge t was already simulated.
        """
        self._queue.at(t, Phase.BUS, lambda now: self.line.on_char(now, byte))

    # ------------------------------------------------------------------ methods that `chip` calls

    def _latch(self, t: int) -> None:
        """Update the outputs and evaluate the state after edge t."""
        context, motion = self.context, self.motion
        now = (context.settings.trigm, context.gpo, motion.forward, motion.busy)
        if now != self._output_values:
            before, self._output_values = self._output_values, now
            self._output_state(t, before, now)
        self.executor.check_wait(t + 1)
        context.stop_monitor.evaluate(t)

    def _output_state(self, t: int, before: tuple[int, ...], now: tuple[int, ...]) -> None:
        trigm, gpo, forward, busy = now
        self.log.set(t, "ext1_pu", ~trigm & 1)
        self.log.set(t, "ext2_pu", ~trigm >> 1 & 1)
        self.log.set(t, "mon_dir", int(forward))
        self.log.set(t, "mon_busy", int(busy))
        if gpo != before[1]:
            at = t + self.core_timing.gpo
            self._queue.at(at, Phase.PIN, lambda later: self.log.set(later, "gpo", gpo))

    def _changed(self, t: int) -> None:
        """Process new values of registers after edge t."""
        self.drive.settings_changed(t)

    def _stepped(self, t: int, forward: bool) -> None:
        self.context.stepped(t, forward)
        self.log.set(t, "mon_step", 1)
        self._queue.at(t + 1, Phase.PIN, lambda now: self.log.set(now, "mon_step", 0))

    def _sample(self, t: int, changed: Iterable[str]) -> None:
        """Sample pins. During a reset, no pin is sampled; the first edge after it samples all pins."""
        names, at = set(changed), max(t, self._first)
        if names <= _LINES:
            # The I2C bus has more edges than all other pins, so process it first.
            levels = {pin: self._pins[pin] for pin in names}
            seen = self.context.levels
            later = at + self.latency.input_sync
            self._queue.at(later, Phase.LEVELS, lambda now: seen.update(levels))
        else:
            super()._sample(at, names)

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        level = pins["rxd"]
        self.line.sample(t, level, self._stage.get("rxd", level))

    def _sample_levels(self, t: int) -> None:
        pins = self._pins
        if pins["adc_valid"]:
            self.motion.adc(t, pins["adc_data"])
        self.context.stop_monitor.strobe(t, pins["bemf_valid"], pins["bemf_level"])
        self.drive.compare(t, pins["cmp_a"], pins["cmp_b"])
        super()._sample_levels(t)

    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        seen = self.context.levels
        seen.update((pin, levels[pin]) for pin in SYNCHRONISED)
        self.context.stop_monitor.on_levels(t, seen)
        self._keys(t, seen)
        self.executor.check_wait(t)

    def _keys(self, t: int, levels: Mapping[str, int]) -> None:
        self._reset_key.on_level(t, levels["gpi"] & 1)
        self._pause_key.on_level(t, levels["gpi"] >> 1 & 1)
        self._restore_key.on_level(t, levels["fset_n"])

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        raise NotImplementedError("there is no bus")

    # ------------------------------------------------------------------ observable state

    def pwm(self, phase: str) -> int:
        """Return the level of pwm_a_ref ("a") or pwm_b_ref ("b") after edge `now`."""
        return self.drive.level(self.now, phase)

    @property
    def position(self) -> int:
        """Position register POS in steps, signed."""
        return self.context.position

    @property
    def angle(self) -> int:
        """Electrical angle TH, 0..511."""
        return self.drive.angle

    @property
    def booting(self) -> bool:
        """True until the end of BOOT."""
        return self._booting
