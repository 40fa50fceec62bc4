"""Golden model of the PPMC-104 at pin level, event driven and cycle-accurate.

Rules by module: pins, reset and parameters are in this module (P104-PORT-01..03, P104-PAR-01). Bus:
`single.hostport` (P104-BUS, -HSK). Commands: this module and `single.commands` (P104-CMD, -ERR, -INI, -RD,
-AUX). Motion: this module, `motion.motion` and `single.commands` (P104-OPR, -BCK, -PRO, -FDC, -TIM, -END).
Limits: `motion.codes` (P104-LIM). Phases and chopper: `motion.excitation` (P104-PHS, -SW). Ramp:
`motion.ramp` (P104-RMP). `chip`, `clock` and `single.single` contain pins and time. `clock.Latency` contains
the constants that the rules leave open.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .carrier import carrier
from .carrier.carrier import SWITCHES, Plant
from .chip import Context, Phase
from .clock import Latency, Timebase
from .motion.codes import FINISH_NEW, FINISH_STOP, PA_MAX, PA_MIN, Command, GuardPins, input_register
from .motion.excitation import Chopper, Excitation
from .motion.motion import Setup
from .motion.ramp import BaseClock, Ramp
from .single.codes import Error, Kind, decode
from .single.commands import ByteUnit, TimedMotion
from .single.hostport import BytePort, HostPort, SpeedGate, strobes
from .single.predict import Limits, RampMove, run
from .single.single import SingleAxis

# Pins of the PPMC-104 with idle and reset levels (P104-PORT-01).

INPUTS: dict[str, int] = {
    "rst_n": 1,
    "a0": 0,
    "cs_n": 1,
    "rd_n": 1,
    "wr_n": 1,
    "d_i": 0,
    "csel": 1,
    "vsel": 1,
    "clock": 0,
    "l1_n": 1,
    "l2_n": 1,
    "l3_n": 1,
    "l4_n": 1,
    "cnp_n": 1,
    "alm_n": 1,
    "auxi": 0,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "int_n": 1,
    "auxo": 0b1111,
    "aux_n": 1,
    "s": 0b11111,
    "hold": 1,
    "pout_n": 1,
    "dir": 0,
}
WIDTHS: dict[str, int] = {"d_i": 8, "auxi": 4, "d_o": 8, "auxo": 4, "s": 5}
HOST_PINS = ("a0", "cs_n", "rd_n", "wr_n", "d_i")
GUARD = GuardPins(limits=("l1_n", "l2_n"), slow_limits=("l3_n", "l4_n"), alarm="alm_n", origin="cnp_n")
# Bits of the input register and their pins (P104-RD-05).
INPUT_REGISTER = {7: "cnp_n", 6: "alm_n", 3: "l1_n", 2: "l2_n", 1: "l3_n", 0: "l4_n"}


# Chopper times of the PPMC-104 (P104-SW-04, -05, P104-AUX-03).

DEFAULT_QUANTA = (260, 435)


class ChopperTimes:
    """Chopper times.

    Until the first command 0x84, the default times are used; afterwards, the times of the last such command.

    If vsel is low, both times are longer.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._parameters: tuple[int, int] | None = None

    def set(self, p_on: int, p_off: int) -> None:
        """Execute command 0x84.

        Both values, 0..255, are used from the next phase boundary on (P104-AUX-03).
        """
        self._parameters = (p_on, p_off)

    def quanta(self, on: bool) -> int:
        """Return the length of a phase that begins now, in quanta (P104-SW-04, -05)."""
        if self._parameters is None:
            return DEFAULT_QUANTA[0 if on else 1]
        plain = self._context.levels["vsel"]
        p_on, p_off = self._parameters
        if on:
            return 12 * p_on + (108 if plain else 100)
        return 12 * p_off + (132 if plain else 115)


# Motion of the PPMC-104, where it differs from related parts: P104-OPR, P104-STP, P104-DS-03 (triangular
# profiles), -10, -12.

DS_FLAG_COMMAND, DS_FLAG_LIMIT, DS_FLAG_LIMIT_HIGH = 272, 192, 272
DS_FAST_PULSE, DS_FAST_PHASE = 100, 148


class Motion(TimedMotion):
    """Motion of the axis of a PPMC-104."""

    hold_cycles = 544_000

    def __init__(
        self, context: Context, port: BytePort, gate: SpeedGate, excitation: Excitation, chopper: Chopper
    ) -> None:
        super().__init__(context, port, excitation, chopper, GUARD)
        self._gate = gate

    # ------------------------------------------------------------------ start

    def _latch_operation(self, command: Command, data: list[int], setup: Setup) -> None:
        levels = self._context.levels
        self._latch_settings(command, data, setup, levels["csel"], bool(levels["vsel"]))

    def _first_pulse_cycles(self) -> int:
        triangle = self.is_ramp and self._total - 1 < 2 * self._setup.ramp.pa
        return super()._first_pulse_cycles() + (123 * self._total // 16 if triangle else 0)

    # ------------------------------------------------------------------ stop commands and inputs

    def slow_stop(self, t: int, reference: int) -> None:
        """Process a deceleration stop (P104-STP-03, P104-DS-10).

        The stop was accepted in state START, ACC or HIGH of operation 011 or 110.
        """
        at = t
        if self._context.datasheet:
            at = reference + self._context.timebase.cyc(DS_FLAG_COMMAND)
            self._port.close_until(at)
        self._request(at, "flag", FINISH_STOP)

    def _slow_limit_effective(self) -> bool:
        return super()._slow_limit_effective() and (self.high or not self._command.pulse_only)

    def _slow_limit_edge(self, t: int) -> int:
        if not self._context.datasheet:
            return t
        cycles = DS_FLAG_LIMIT_HIGH if self.high else DS_FLAG_LIMIT
        return t + self._context.timebase.cyc(cycles) + self._context.latency.ds_motor

    # ------------------------------------------------------------------ pulses

    def _interval_begun(self, t: int) -> None:
        if self._context.datasheet and not self._external:
            rate, limit = self.intervals[-1].rate, self._fast_limit
            self._gate.set(t + self._fast_decision_delay(rate, limit), self._clock.quanta(rate) < limit)
        if self.high and self._command.pulse_only:
            self._context.queue.at(t + 1, Phase.GUARD, self.check_stops)

    @property
    def _fast_limit(self) -> int:
        return DS_FAST_PULSE if self._command.pulse_only else DS_FAST_PHASE

    def _fast_decision_delay(self, rate: int, limit: int) -> int:
        """Return the number of cycles from a pulse event to the decision of P104-DS-12.

        The decision compares the length of the new interval with a limit; see `Latency.ds12_lag`.
        """
        latency, quanta = self._context.latency, self._clock.quanta
        before = self.intervals[-2].rate if len(self.intervals) > 1 else rate
        passed = 0
        while before + passed < rate and quanta(before + passed) < limit:
            passed += 1
        if not passed:
            return latency.ds12_lag
        slower = len(self.intervals) > 2 and self._is_decelerating_interval(-2)
        look_up = latency.lookup_start + latency.lookup_per_rate * passed if slower else latency.lookup_first
        return latency.ds12_lag + look_up

    def _is_decelerating_interval(self, number: int) -> bool:
        """Return True if this interval of a ramp has a lower index than the previous one."""
        index, before = self.intervals[number].index, self.intervals[number - 1].index
        return index is not None and before is not None and index < before

    # ------------------------------------------------------------------ end

    def _ending(self, t: int) -> None:
        self._gate.set(t, False)


# Command processor of the PPMC-104 model: the effect of each command. `single.commands` converts bytes to
# commands. Initialisation: P104-INI-01..10, P104-DS-01/02. Reads: P104-RD-01..08. Auxiliary: P104-AUX-01..06,
# P104-DS-11.

_DS_AUX, _DS_EXCITATION_OFF = 224, 288


class CommandUnit(ByteUnit):
    """Commands of the PPMC-104."""

    def __init__(
        self,
        context: Context,
        port: BytePort,
        motion: Motion,
        excitation: Excitation,
        chopper: Chopper,
        chopper_times: ChopperTimes,
    ) -> None:
        super().__init__(context, port, motion, excitation, chopper)
        self._chopper_times = chopper_times

    def _decode(self, byte: int) -> Command:
        return decode(byte)

    def _execute(self, t: int, command: Command, reference: int, data: list[int]) -> Error | None:
        kind = command.kind
        if kind is Kind.INITIALISE:
            return self._initialise(t, command.code, data, reference)
        if kind is Kind.OPERATION:
            assert self.setup is not None
            self._motion.start(t, command, data, self.setup, reference)
        elif kind in (Kind.STOP, Kind.SLOW_STOP):
            self._stop(t, kind, reference)
        elif kind is Kind.READ:
            self._port.answer(self._register(t, command.code))
        elif kind is Kind.SWITCHING:
            self._chopper_times.set(*data)
        elif kind is Kind.AUX_OUTPUT:
            level = ~data[0] & 0xF
            self._later(t, reference, _DS_AUX, lambda at: self._context.drive(at, "auxo", level))
        elif kind is Kind.EXCITATION_OFF and not self._motion.busy:
            self._later(t, reference, _DS_EXCITATION_OFF, self._excitation_off)
        else:
            level = int(kind is Kind.AUX_OFF)
            self._later(t, reference, _DS_AUX, lambda at: self._context.drive(at, "aux_n", level))
        return None

    def _later(self, t: int, reference: int, cycles: int, action: Callable[[int], None]) -> None:
        """Execute an action immediately, or with DATASHEET timing after its processing time (P104-DS-11).

        The mailbox is closed during the processing time.

        Args:
            cycles: processing time before the action in crystal cycles.
        """
        if not self._context.datasheet:
            action(t)
            return
        at = reference + self._context.timebase.cyc(cycles)
        self._port.close_until(at)
        self._context.queue.at(at, Phase.BEGIN, action)

    def _excitation_off(self, t: int) -> None:
        """Execute a software reset (P104-AUX-04, -06)."""
        self._chopper.stop()
        self._excitation.off()
        self.setup = None

    # ------------------------------------------------------------------ registers

    def _register(self, t: int, code: int) -> list[int]:
        """Return the bytes of a read command, sampled at edge t (P104-RD-02..08)."""
        motion, levels = self._motion, self._context.levels
        if code == 0x80:
            value = motion.finish
            motion.finish &= ~FINISH_NEW
            self._context.drive(t, "int_n", 1)
            return [value]
        if code == 0x81:
            return [input_register(levels, INPUT_REGISTER)]
        if code == 0x82:
            pattern = self._excitation.pattern
            phases = sum((pattern >> i & 1) << (7 - i) for i in range(5))
            return [phases | self._pin("hold") << 2 | self._pin("dir") << 1]
        if code == 0x83:
            return list(motion.remaining.to_bytes(3, "little"))
        return [levels["auxi"]]

    def _pin(self, name: str) -> int:
        """Return the current level of a motor pin."""
        return self._context.log.levels[name]

    # ------------------------------------------------------------------ initialisation

    def _initialise(self, t: int, code: int, data: list[int], reference: int) -> Error | None:
        """Check an initialisation after its fourth byte. If it is valid, store it and begin the table build.

        Rules: P104-INI-05..08.
        """
        rl, rh = data[0], data[1]
        pa = data[2] | data[3] << 8
        if pa > PA_MAX:
            return Error.PA_TOO_LARGE
        if rh > rl or pa < PA_MIN:
            return Error.BAD_RAMP
        self._set_up(t, code, Ramp(rl, rh, pa), reference, 264_000 + 209 * (pa - 4))
        return None


class Ppmc104(SingleAxis):
    """One PPMC-104. The model starts just after the release of reset, before edge 0.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..16e6.
        timing: "FAST" or "DATASHEET".
        phase_idle: 0 or 1.

    Raises:
        ValueError: a value is out of range.
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
        chopper_times = ChopperTimes(context)
        self._chopper = Chopper(context, chopper_times)
        gate = SpeedGate(lambda t: self._port.retry(t))
        self._port = HostPort(context, self._take, self._state, strobes, gate.must_wait)
        self._motion = motion = Motion(context, self._port, gate, self._excitation, self._chopper)
        self._commands = CommandUnit(
            context, self._port, motion, self._excitation, self._chopper, chopper_times
        )

    def _motor_levels(self) -> dict[str, int]:
        motion = self._motion
        return {"pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}

    @property
    def pulses(self) -> list[int]:
        """Edges of all pulses: falling edges of pout_n (P104-GEN-05)."""
        return self.log.falls("pout_n")


# Carrier model with a PPMC-104.

_PINS = dict(zip(SWITCHES, ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc104]):
    """Carrier with the connections of ppmc104_carrier: bit 0 of the straps is csel, bit 1 is vsel."""

    def __init__(
        self,
        plant: Plant,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        super().__init__(Ppmc104(clk_hz, xtal_hz, timing), [plant], on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return {_PINS[name]: level for name, level in levels[0].items()}

    def straps(self, levels: int) -> None:
        self.set_pins(csel=levels & 1, vsel=levels >> 1 & 1)

    def watched_register(self) -> object:
        return self.part.status

    def pins(self) -> int:
        self._run_pending()
        return self.pin_byte(self.part.outputs["hold"], 0)


# Prediction of one move of a PPMC-104 (P104-INI-05).

_LIMITS = Limits(slower=0, least=0, shortest=PA_MIN, longest=PA_MAX)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> RampMove:
    """Return the prediction of a move; see `single.predict.predict_move`."""
    ramp = Ramp(*_LIMITS.check(init, n, rate))
    return run(timebase or Timebase(), BaseClock.of_pins(csel, vsel), ramp, n, rate)
