"""The 256 instruction codes of the PMC006B4 as a table of objects.

Rules: P006 chapters 3.1, 3.2, 3.3, 4.2.
"""

from __future__ import annotations

from .execution_context import Deed, Desk, Effect, Instruction, Read, Setting, value
from .settings import LEGAL

STEPS = range(1, 0x8000_0000)


def may_step(desk: Desk, count: int) -> bool:
    """Return True if condition C holds (P006-STA-01)."""
    return (
        count in STEPS
        and max(desk.settings.vstart, desk.settings.vstop) <= desk.settings.vmax
        and not desk.motion.busy
        and not desk.locked
    )


def step(desk: Desk, count: int) -> Effect:
    """Execute instruction s or ROT."""
    if not may_step(desk, count):
        return Effect(0)
    return Effect(count if desk.echo else 3, do=lambda desk, t: desk.start(t, count))


def speed_mode(desk: Desk, data: int) -> Effect:
    """Execute instruction N (P006-STA-16, P006-MOT-40..42); the answer is SPEED_MODE."""
    answer = Effect(lambda desk: int(desk.speed_on))
    if data == 0:
        return answer._replace(do=lambda desk, t: desk.speed(t, False))
    if data != 1 or desk.speed_on:
        return answer
    if desk.motion.busy:
        # A move rejects N. A motion that is decelerating after N=0 continues.
        return answer._replace(early=lambda desk, t: desk.speed(t, True)) if desk.running else answer
    if desk.locked or desk.settings.vmax < 1:
        return answer
    return answer._replace(do=lambda desk, t: desk.run(t))


def freerun(desk: Desk, data: int) -> Effect:
    """Execute instruction g."""
    if data not in LEGAL["free"]:
        return Effect(desk.settings.free)
    return Effect(data, {"free": data}, halt=data == 1)


def offline(desk: Desk, data: int) -> Effect:
    """Execute instruction F; 0 also ends a program and the key functions."""
    if data not in LEGAL["offline"]:
        return Effect(desk.settings.offline)
    return Effect(data, {"offline": data}, do=None if data else lambda desk, t: desk.program.quit(t))


def clear(latch: str) -> Deed:
    """Return the instruction b, l or p, which clears one latch of the guard."""
    return Deed(lambda desk, data: Effect(0, do=lambda desk, t: desk.guard.clear(t, latch)))


def write_ports(desk: Desk, data: int) -> Effect:
    """Execute instruction y."""
    gpo = data >> 3 & 0x1F
    return Effect(gpo << 3, {"gpo": gpo})


def read_word(desk: Desk, data: int) -> Effect:
    """Execute instruction G."""
    pp = desk.settings.pp
    return Effect(desk.program.words[pp], {"pp": pp + 1}) if pp < 200 else Effect(0)


def write_word(desk: Desk, data: int) -> Effect:
    """Execute instruction W."""
    pp = desk.settings.pp
    if not desk.program.halted or desk.eeprom.burning or pp >= 200:
        return Effect(0)
    return Effect(data, {"pp": pp + 1}, do=lambda desk, t: desk.program.write(pp, data))


def try_program(desk: Desk, data: int) -> Effect:
    """Execute instruction z."""
    pp = desk.settings.pp
    if not desk.program.halted or pp >= 200:
        return Effect(0)
    return Effect(1, do=lambda desk, t: desk.program.start(t, pp >> 1))


def single(desk: Desk, data: int) -> Effect:
    """Execute instruction E: one instruction of the program (P006-PRG-20).

    The instruction acts as if the host had sent it.
    """
    pp = desk.settings.pp
    if not desk.program.halted or pp >= 200:
        return Effect(0)
    return Effect(1, once=pp >> 1)


def job(kind: str) -> Deed:
    """Return the instruction t or B, a job for the EEPROM engine."""

    def ask(desk: Desk, data: int) -> Effect:
        if desk.eeprom.busy:
            return Effect(0)
        return Effect(1, do=lambda desk, t: desk.eeprom.begin(t + 1, kind))

    return Deed(ask)


def status1(desk: Desk) -> int:
    """Return status 1, read with j (P006 chapter 3.2)."""
    guard = desk.guard
    bits = (
        desk.motion.busy,
        guard.latched("ext1"),
        guard.latched("ext2"),
        desk.settings.autodec,
        guard.stall,
    )
    return sum(bool(bit) << place for place, bit in enumerate(bits))


def status2(desk: Desk) -> int:
    """Return status 2, read with O (P006 chapter 3.3)."""
    regs = desk.settings
    bits = (regs.free, regs.exten & 1, regs.exten >> 1, desk.speed_on, regs.dir, regs.offline)
    return sum(bool(bit) << place for place, bit in enumerate(bits))


ABORT = Deed(lambda desk, data: Effect(data, halt=True))
POSITION = Deed(lambda desk, data: Effect(data, do=lambda desk, t: desk.load_position(data), still=True))

LETTERS: dict[str, Instruction] = {
    "A": Setting("pp"),
    "B": job("burn"),
    "E": Deed(single),
    "F": Deed(offline),
    "G": Deed(read_word),
    "I": ABORT,
    "J": Setting("trigm"),
    "K": value("trigm"),
    "L": Setting("vstart"),
    "M": Setting("ccomp"),
    "N": Deed(speed_mode),
    "O": Read(status2),
    "P": Setting("scomp"),
    "Q": Setting("att"),
    "R": Read(lambda desk: desk.version),
    "S": Setting("vstop"),
    "T": Setting("stlen"),
    "U": value("att"),
    "V": Read(lambda desk: desk.eeprom.state),
    "W": Deed(write_word),
    "X": Read(lambda desk: desk.guard.stpos),
    "Y": Setting("stcfg"),
    "Z": Setting("stlvl"),
    "a": Setting("autodec"),
    "b": clear("ext1"),
    "c": Read(lambda desk: desk.position),
    "d": Setting("dir"),
    "e": Setting("cur"),
    "f": Setting("exten"),
    "g": Deed(freerun),
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
    "s": Deed(step),
    "t": job("save"),
    "u": Setting("acc"),
    "v": Setting("vmax", also={"analog": 0}),
    "w": Setting("addr", range(1, 121)),
    "x": Read(lambda desk: desk.port_word),
    "y": Deed(write_ports),
    "z": Deed(try_program),
}
UNKNOWN = Instruction()
TABLE: tuple[Instruction, ...] = tuple(LETTERS.get(chr(code), UNKNOWN) for code in range(256))
"""Instruction of each code."""
