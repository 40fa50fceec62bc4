"""Command processor of the PPMC-104 model: what each command does. The bytes before that: `single.commands`.

Initialisation: P104-INI-01..10, P104-DS-01/02. Reads: P104-RD-01..08. Auxiliary: P104-AUX-01..06,
P104-DS-11.
"""

from __future__ import annotations

from collections.abc import Callable

from ..common.blocks import Context, Phase
from ..motion.chopper import Chopper
from ..motion.codes import FINISH_NEW, PA_MAX, PA_MIN
from ..motion.excitation import Excitation
from ..motion.guard import input_register
from ..motion.ramp import Ramp
from ..single.codes import Command, Error, Kind, decode
from ..single.commands import ByteUnit
from ..single.hostport import BytePort
from .chopper import Switching
from .motion import Motion
from .pins import INPUT_REGISTER

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
        switching: Switching,
    ) -> None:
        super().__init__(context, port, motion, excitation, chopper)
        self._switching = switching

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
            self._switching.set(*data)
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
        """Now in FAST; in DATASHEET after so many XTAL cycles with the mailbox closed (P104-DS-11)."""
        if not self._context.datasheet:
            action(t)
            return
        at = reference + self._context.timebase.cyc(cycles)
        self._port.close_until(at)
        self._context.queue.at(at, Phase.BEGIN, action)

    def _excitation_off(self, t: int) -> None:
        """Software reset (P104-AUX-04, -06)."""
        self._chopper.stop()
        self._excitation.off()
        self.setup = None

    # ------------------------------------------------------------------ registers

    def _register(self, t: int, code: int) -> list[int]:
        """Bytes of a read command, sampled at edge t (P104-RD-02..08)."""
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
        """Present level of a motor pin."""
        return self._context.log.levels[name]

    # ------------------------------------------------------------------ initialisation

    def _initialise(self, t: int, code: int, data: list[int], reference: int) -> Error | None:
        """Fourth byte of an initialisation: check, store, begin the table build (P104-INI-05..08)."""
        rl, rh = data[0], data[1]
        pa = data[2] | data[3] << 8
        if pa > PA_MAX:
            return Error.PA_TOO_LARGE
        if rh > rl or pa < PA_MIN:
            return Error.BAD_RAMP
        self._set_up(t, code, Ramp(rl, rh, pa), reference, 264_000 + 209 * (pa - 4))
        return None
