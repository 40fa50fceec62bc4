"""Command processor of the STMC: what each command does. The bytes before that: `single.commands`.

Initialisation: STMC-INI-01..08, STMC-DS-02/03. Motion commands: STMC-MOT-01..04. Reads: STMC-FIN, -INP,
-OUT, -REM, -RD.
"""

from __future__ import annotations

from ..common.blocks import Context
from ..motion.chopper import Chopper
from ..motion.codes import CONSTANT, CONTINUOUS, ORIGIN
from ..motion.excitation import Excitation
from ..motion.guard import input_register
from ..motion.ramp import Ramp
from ..single.codes import Command, Error, Kind
from ..single.commands import ByteUnit
from ..single.hostport import HostPort
from .codes import FINISH_STATUS, INPUTS, OUTPUTS, READ_MAPS, decode
from .motion import Motion
from .pins import INPUT_REGISTER


def profile(d1: int, d2: int, pa: int) -> Ramp:
    """Ramp of divisors d1 >= d2 >= 1; without ramp steps all gaps are d2 (STMC-MOV-02, -04)."""
    return Ramp(d1 - 1, d2 - 1, pa) if pa and d1 > d2 else Ramp(d2 - 1, d2 - 1, 0)


class CommandUnit(ByteUnit):
    """Commands of the STMC. read_map: "FAMILY" or "SHEET"."""

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
        """Bytes of a read command, sampled at edge t."""
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
        """Fourth byte of an initialisation: check, store, begin the table build (STMC-INI-02..07)."""
        d1, d2 = data[0], data[1]
        pa = data[2] | data[3] << 8
        if not 1 <= d2 <= d1:
            return Error.BAD_RAMP
        self._set_up(t, code, profile(d1, d2, pa), reference, 264_000 + 209 * pa)
        return None
