"""Command processor of the STMC: the effect of each command.

`single.commands` converts bytes to commands.

Initialisation: STMC-INI-01..08, STMC-DS-02/03. Motion commands: STMC-MOT-01..04. Reads: STMC-FIN, -INP, -OUT,
-REM, -RD.
"""

from __future__ import annotations

from ..chip import Context
from ..motion.codes import (
    CONSTANT,
    CONTINUOUS,
    FINISH_SLOW,
    FINISH_STOP,
    ORIGIN,
    ActiveCauses,
    Command,
    input_register,
)
from ..motion.excitation import Chopper, Excitation
from ..motion.motion import Setup
from ..motion.ramp import BaseClock, Ramp
from ..single.codes import Error, Kind
from ..single.commands import ByteUnit, TimedMotion
from ..single.hostport import HostPort
from .codes import FINISH_STATUS, INPUTS, OUTPUTS, READ_MAPS, TICK_XT, decode
from .pins import GUARD, INPUT_REGISTER

# Motion of the STMC, where it differs from related parts: STMC-MOT, -CLK, -DEC, -IN, -DS. A gap of x ticks is
# an interval of rate x - 1 with a base clock of 1280 crystal periods. Therefore, the ramp and the rate
# counter of the PPMC family are used unchanged (STMC-INI-01, STMC-RMP-01). There is no pulse output, so a
# motion ends with its last step (STMC-MOT-08). An operation that starts while its deceleration limit is
# active outputs one step (STMC-DEC-03). At the start-up speed, a deceleration request ends a motion
# immediately.


class Motion(TimedMotion):
    """Motion of the axis of an STMC.

    Args:
        hold_xt: crystal periods from the falling edge of BUSY to `hold`.
    """

    ends_at_start_rate = True

    def __init__(
        self, context: Context, port: HostPort, excitation: Excitation, chopper: Chopper, hold_xt: int
    ) -> None:
        super().__init__(context, port, excitation, chopper, GUARD)
        self.hold_cycles = hold_xt
        self.finish = 0x80

    # ------------------------------------------------------------------ start

    def _latch_operation(self, command: Command, data: list[int], setup: Setup) -> None:
        """Latch an operation.

        Args:
            data: data bytes in the order in which they were written: divisor, then count.
        """
        rated = [data[0] - 1, *data[1:]] if data and command.operation in (4, 5, 7) else data
        self._latch_settings(command, rated, setup, csel=1, plain=True)
        self._clock = BaseClock(TICK_XT // self._context.timebase.quantum)

    # ------------------------------------------------------------------ stops and inputs

    def slow_stop(self, t: int, reference: int) -> None:
        """Process command 1 (deceleration stop) in state S or A of command 3 or 6.

        Rules: STMC-STP-03, STMC-DS-11.
        """
        self._request(t, "flag", FINISH_STOP)

    def _active_causes(self, t: int) -> ActiveCauses:
        """Return the active causes of an end. Command 7 also ends at its deceleration limit (STMC-IN-04)."""
        causes = super()._active_causes(t)
        if self.operation == ORIGIN and causes.slow:
            return ActiveCauses(causes.bits | FINISH_SLOW, causes.origin)
        return causes

    # ------------------------------------------------------------------ steps and end

    def _begin_low(self, t: int, rate: int | None, gap: int | None) -> None:
        """Do nothing, because there is no pulse output."""

    def _last_pulse_output(self, t: int) -> None:
        if self._context.datasheet:
            super()._last_pulse_output(t)
        else:
            self._plan_end(t)


def profile(d1: int, d2: int, pa: int) -> Ramp:
    """Return the ramp of divisors d1 >= d2 >= 1 (STMC-MOV-02, -04).

    Without ramp steps, all gaps have d2 ticks.
    """
    return Ramp(d1 - 1, d2 - 1, pa) if pa and d1 > d2 else Ramp(d2 - 1, d2 - 1, 0)


class CommandUnit(ByteUnit):
    """Commands of the STMC.

    Args:
        read_map: "FAMILY" or "SHEET".
    """

    def __init__(
        self,
        context: Context,
        port: HostPort,
        motion: Motion,
        excitation: Excitation,
        chopper: Chopper,
        read_map: str,
    ) -> None:
        super().__init__(context, port, motion, excitation, chopper)
        self._read_map = read_map

    def _decode(self, byte: int) -> Command:
        return decode(byte, self._read_map)

    def _execute(self, t: int, command: Command, reference: int, data: list[int]) -> Error | None:
        if command.kind is Kind.INITIALISE:
            return self._initialise(t, command.code, data, reference)
        if command.kind is Kind.READ:
            self._port.answer(self._register(t, READ_MAPS[self._read_map][command.code]))
        elif command.kind is Kind.OPERATION:
            if command.operation in (CONSTANT, CONTINUOUS, ORIGIN) and not data[0]:
                return Error.BAD_RAMP
            assert self.setup is not None
            self._motion.start(t, command, data, self.setup, reference)
        else:
            self._stop(t, command.kind, reference)
        return None

    # ------------------------------------------------------------------ registers

    def _register(self, t: int, which: str) -> list[int]:
        """Return the bytes of a read command, sampled at edge t."""
        motion = self._motion
        if which == FINISH_STATUS:
            self._context.drive(t, "int_n", 1)
            return [motion.finish]
        if which == INPUTS:
            return [input_register(self._context.levels, INPUT_REGISTER)]
        if which == OUTPUTS:
            pattern, hold = self._excitation.pattern, self._context.log.levels["hold"]
            phases = sum((pattern >> i & 1) << (7 - i) for i in range(5))
            return [phases | hold << 2 | motion.direction << 1]
        return list(motion.remaining.to_bytes(3, "little"))

    # ------------------------------------------------------------------ initialisation

    def _initialise(self, t: int, code: int, data: list[int], reference: int) -> Error | None:
        """Check and store an initialisation after its fourth byte, and begin the table build.

        Rules: STMC-INI-02..07.
        """
        d1, d2 = data[0], data[1]
        pa = data[2] | data[3] << 8
        if not 1 <= d2 <= d1:
            return Error.BAD_RAMP
        self._set_up(t, code, profile(d1, d2, pa), reference, 264_000 + 209 * pa)
        return None
