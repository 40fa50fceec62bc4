"""One axis of the PPMC-2104: its blocks, its registers, and the path to its pins."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..common.blocks import Context, Phase, PinRegister
from ..common.timebase import QuantumCounter
from ..motion.chopper import Chopper
from ..motion.codes import FINISH_NEW
from ..motion.excitation import Excitation
from ..motion.guard import input_register
from ..motion.motion import Setup
from .codes import CONTROL_INPUT, END_STATUS, ERROR_CODE, OUTPUT_SIGNAL, Error
from .interrupt import Cause, Interrupt
from .motion import Motion
from .pins import CONTROL_INPUT_BITS, MOTOR_AT_REST, axis_levels
from .windows import Windows


@dataclass
class Switching:
    """Switching times in units of 2 quanta (P2104-SW-04, -05, P2104-AUX-04, -06)."""

    on: int = 0x53
    off: int = 0xA6

    def quanta(self, on: bool) -> int:
        """Length of a phase that begins now."""
        return 2 * (self.on if on else self.off)


class Axis:
    """Axis `number` 0 or 1. `setup` None: state INITIAL; `table_ready`: edge on which the table build ends;
    `building`: state INITP."""

    def __init__(self, number: int, shared: Context, windows: Windows, interrupt: Interrupt) -> None:
        self.number = number
        counter = QuantumCounter(shared.timebase, shared.counter.origin)
        self.context = replace(shared, counter=counter, levels=axis_levels(shared.levels, number))
        self.excitation = Excitation()
        self.switching = Switching()
        self.chopper = Chopper(self.context, self.switching)
        self.motion = Motion(self.context, self.excitation, self.chopper, windows, self._ended)
        self.setup: Setup | None = None
        self.error = Error.NONE
        self.building = False
        self.table_ready = -1
        self._interrupt = interrupt
        latency = shared.latency
        self._pins = PinRegister(shared.queue, latency.motor_pins, MOTOR_AT_REST, self._put)

    def _ended(self, t: int, masked: bool) -> None:
        if not masked:
            self._interrupt.raise_(Cause.END, self.number)

    def _put(self, t: int, signal: str, value: int) -> None:
        """Set a pin: phases have a port of their own, the rest one bit of a common one."""
        log = self.context.log
        if signal == "s":
            log.set(t, f"s{self.number + 1}_n", value)
        else:
            others = log.levels[signal] & ~(1 << self.number)
            log.set(t, signal, others | value << self.number)

    def latch(self, t: int) -> None:
        """Motor pins follow the levels after edge t."""
        motion = self.motion
        phases = self.excitation.pattern if self.chopper.on else self.excitation.chopped
        self._pins.latch(
            t, {"s": phases, "pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}
        )

    def see(self, t: int, levels: dict[str, int]) -> None:
        """New synchronised levels at edge t."""
        inside, queue, motion = self.context.levels, self.context.queue, self.motion
        changed = {pin for pin, level in levels.items() if inside[pin] != level}
        inside.update(levels)
        if changed - {"run", "extck", "csel"}:
            queue.at(t, Phase.GUARD, motion.judge)
        if "run" in changed:
            queue.at(t, Phase.RUN, motion.look_at_run)
        if "extck" in changed:
            queue.at(t, Phase.BASE, motion.base_rise if levels["extck"] else motion.base_fall)

    @property
    def operating(self) -> bool:
        """Whether the other axis must count this one as operating (P2104-DS-31)."""
        return self.motion.busy or (self.setup is not None and self.setup.chopping)

    def switch_off(self) -> None:
        """Excitation OFF: INITIAL again (P2104-AUX-01)."""
        self.chopper.stop()
        self.excitation.off()
        self.setup = None

    def register(self, t: int, number: int) -> list[int]:
        """Bytes of a register read, sampled at edge t (P2104-RD-01..07)."""
        motion = self.motion
        if number == END_STATUS:
            value = motion.finish
            motion.finish &= ~FINISH_NEW
            self._interrupt.release(t, Cause.END, self.number)
            return [value]
        if number == CONTROL_INPUT:
            return [input_register(self.context.levels, CONTROL_INPUT_BITS)]
        if number == OUTPUT_SIGNAL:
            pattern = self.excitation.pattern
            phases = sum((pattern >> i & 1) << (7 - i) for i in range(5))
            return [phases | self.pin("hold") << 2 | self.pin("dir") << 1]
        if number == ERROR_CODE:
            error, self.error = self.error, Error.NONE
            self._interrupt.release(t, Cause.ERROR, self.number)
            return [int(error)]
        return list(motion.remaining.to_bytes(3, "little"))

    def pin(self, signal: str) -> int:
        """Present level of a pin of both axes, this axis's bit."""
        return self.context.log.levels[signal] >> self.number & 1
