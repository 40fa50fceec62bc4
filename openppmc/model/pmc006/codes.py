"""The 256 instruction codes of the PMC006B4 as a table of objects.

Rules: P006-CMD, P006-STA.
"""

from __future__ import annotations

from .execution_context import ActionInstruction, Effect, ExecutionContext, Instruction, Read, Setting, value
from .settings import LEGAL

STEPS = range(1, 0x8000_0000)


def may_step(context: ExecutionContext, count: int) -> bool:
    """Return True if condition C of P006-STA-01 is true for a displacement of `count` steps."""
    return (
        count in STEPS
        and max(context.settings.vstart, context.settings.vstop) <= context.settings.vmax
        and not context.motion.busy
        and not context.locked
    )


def step(context: ExecutionContext, count: int) -> Effect:
    """Execute instruction s or ROT."""
    if not may_step(context, count):
        return Effect(0)
    return Effect(count if context.echo else 3, action=lambda context, t: context.start(t, count))


def speed_mode(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction N (P006-STA-16, P006-MOT-40..42). The answer is SPEED_MODE."""
    answer = Effect(lambda context: int(context.speed_on))
    if data == 0:
        return answer._replace(action=lambda context, t: context.speed(t, False))
    if data != 1 or context.speed_on:
        return answer
    if context.motion.busy:
        # Instruction N with data 1 is rejected during a move. During a free run that decelerates after N
        # with data 0, it resumes the run.
        return (
            answer._replace(early_action=lambda context, t: context.speed(t, True))
            if context.running
            else answer
        )
    if context.locked or context.settings.vmax < 1:
        return answer
    return answer._replace(action=lambda context, t: context.run(t))


def freerun(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction g."""
    if data not in LEGAL["free"]:
        return Effect(context.settings.free)
    return Effect(data, {"free": data}, halt=data == 1)


def offline(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction F. With data 0, it also ends a program and the key functions."""
    if data not in LEGAL["offline"]:
        return Effect(context.settings.offline)
    return Effect(
        data, {"offline": data}, action=None if data else lambda context, t: context.program.quit(t)
    )


def clear(latch: str) -> ActionInstruction:
    """Return the instruction b, l or p, which clears one latch of the stop monitor."""
    return ActionInstruction(
        lambda context, data: Effect(0, action=lambda context, t: context.stop_monitor.clear(t, latch))
    )


def write_ports(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction y."""
    gpo = data >> 3 & 0x1F
    return Effect(gpo << 3, {"gpo": gpo})


def read_word(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction G."""
    pp = context.settings.pp
    return Effect(context.program.words[pp], {"pp": pp + 1}) if pp < 200 else Effect(0)


def write_word(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction W."""
    pp = context.settings.pp
    if not context.program.halted or context.eeprom.burning or pp >= 200:
        return Effect(0)
    return Effect(data, {"pp": pp + 1}, action=lambda context, t: context.program.write(pp, data))


def try_program(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction z."""
    pp = context.settings.pp
    if not context.program.halted or pp >= 200:
        return Effect(0)
    return Effect(1, action=lambda context, t: context.program.start(t, pp >> 1))


def single(context: ExecutionContext, data: int) -> Effect:
    """Execute instruction E: one instruction of the program (P006-PRG-20).

    The instruction acts as if the host had sent it.
    """
    pp = context.settings.pp
    if not context.program.halted or pp >= 200:
        return Effect(0)
    return Effect(1, program_index=pp >> 1)


def job(kind: str) -> ActionInstruction:
    """Return the instruction t or B, which starts a job of the EEPROM engine."""

    def start_job(context: ExecutionContext, data: int) -> Effect:
        if context.eeprom.busy:
            return Effect(0)
        return Effect(1, action=lambda context, t: context.eeprom.begin(t + 1, kind))

    return ActionInstruction(start_job)


def status1(context: ExecutionContext) -> int:
    """Return status 1, read with j (docs/pmc006/README.md, 5 Status)."""
    monitor = context.stop_monitor
    bits = (
        context.motion.busy,
        monitor.latched("ext1"),
        monitor.latched("ext2"),
        context.settings.autodec,
        monitor.stall,
    )
    return sum(bool(bit) << place for place, bit in enumerate(bits))


def status2(context: ExecutionContext) -> int:
    """Return status 2, read with O (docs/pmc006/README.md, 5 Status)."""
    regs = context.settings
    bits = (regs.free, regs.exten & 1, regs.exten >> 1, context.speed_on, regs.dir, regs.offline)
    return sum(bool(bit) << place for place, bit in enumerate(bits))


ABORT = ActionInstruction(lambda context, data: Effect(data, halt=True))
POSITION = ActionInstruction(
    lambda context, data: Effect(
        data, action=lambda context, t: context.load_position(data), excludes_step=True
    )
)

LETTERS: dict[str, Instruction] = {
    "A": Setting("pp"),
    "B": job("burn"),
    "E": ActionInstruction(single),
    "F": ActionInstruction(offline),
    "G": ActionInstruction(read_word),
    "I": ABORT,
    "J": Setting("trigm"),
    "K": value("trigm"),
    "L": Setting("vstart"),
    "M": Setting("ccomp"),
    "N": ActionInstruction(speed_mode),
    "O": Read(status2),
    "P": Setting("scomp"),
    "Q": Setting("att"),
    "R": Read(lambda context: context.version),
    "S": Setting("vstop"),
    "T": Setting("stlen"),
    "U": value("att"),
    "V": Read(lambda context: context.eeprom.state),
    "W": ActionInstruction(write_word),
    "X": Read(lambda context: context.stop_monitor.stpos),
    "Y": Setting("stcfg"),
    "Z": Setting("stlvl"),
    "a": Setting("autodec"),
    "b": clear("ext1"),
    "c": Read(lambda context: context.position),
    "d": Setting("dir"),
    "e": Setting("cur"),
    "f": Setting("exten"),
    "g": ActionInstruction(freerun),
    "h": value("dec"),
    "i": POSITION,
    "j": Read(status1),
    "k": value("mstep"),
    "l": clear("ext2"),
    "m": Setting("mstep"),
    "n": value("cur"),
    "o": Setting("dec"),
    "p": clear("stall"),
    "q": value("vmax"),
    "r": value("acc"),
    "s": ActionInstruction(step),
    "t": job("save"),
    "u": Setting("acc"),
    "v": Setting("vmax", also={"analog": 0}),
    "w": Setting("addr", range(1, 121)),
    "x": Read(lambda context: context.port_word),
    "y": ActionInstruction(write_ports),
    "z": ActionInstruction(try_program),
}
UNKNOWN = Instruction()
TABLE: tuple[Instruction, ...] = tuple(LETTERS.get(chr(code), UNKNOWN) for code in range(256))
"""Instruction of each code."""
