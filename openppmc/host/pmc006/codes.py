"""Instructions and status bits of the PMC006B4, as a host sends and reads them. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Code(IntEnum):
    """Instruction codes; the letter is what manuals call them."""

    POINTER = ord("A")
    BURN = ord("B")
    TRY = ord("E")
    OFFLINE = ord("F")
    READ_WORD = ord("G")
    ABORT = ord("I")
    TRIGGER = ord("J")
    READ_TRIGGER = ord("K")
    START_SPEED = ord("L")
    CURRENT_COMPENSATION = ord("M")
    RUN = ord("N")
    STATUS_2 = ord("O")
    SPEED_COMPENSATION = ord("P")
    ATTENUATION = ord("Q")
    VERSION = ord("R")
    STOP_SPEED = ord("S")
    STALL_LENGTH = ord("T")
    READ_ATTENUATION = ord("U")
    STORED = ord("V")
    WRITE_WORD = ord("W")
    STALL_POSITION = ord("X")
    STALL_CONFIG = ord("Y")
    STALL_LEVEL = ord("Z")
    AUTO_DECAY = ord("a")
    CLEAR_EXT1 = ord("b")
    POSITION = ord("c")
    DIRECTION = ord("d")
    CURRENT = ord("e")
    EXT_ENABLE = ord("f")
    FREE = ord("g")
    READ_DECELERATION = ord("h")
    SET_POSITION = ord("i")
    STATUS_1 = ord("j")
    READ_MICROSTEPS = ord("k")
    CLEAR_EXT2 = ord("l")
    MICROSTEPS = ord("m")
    READ_CURRENT = ord("n")
    DECELERATION = ord("o")
    CLEAR_STALL = ord("p")
    READ_MAX_SPEED = ord("q")
    READ_ACCELERATION = ord("r")
    STEP = ord("s")
    SAVE = ord("t")
    ACCELERATION = ord("u")
    MAX_SPEED = ord("v")
    ADDRESS = ord("w")
    READ_IO = ord("x")
    WRITE_IO = ord("y")
    RUN_PROGRAM = ord("z")


@dataclass(frozen=True)
class Flags:
    """Status 1. busy: a motion is planned or runs. ext1, ext2: that stop has come and blocks starts."""

    busy: bool
    ext1: bool
    ext2: bool
    auto_decay: bool
    stall: bool

    @classmethod
    def parse(cls, value: int) -> Flags:
        """From the reply to `j`.

        >>> Flags.parse(0x0A).ext1, Flags.parse(8).busy
        (True, False)
        """
        return cls(*(bool(value >> bit & 1) for bit in range(5)))

    @property
    def stops(self) -> tuple[int, ...]:
        """Numbers of the EXT inputs whose stop has come."""
        return tuple(number for number, on in ((1, self.ext1), (2, self.ext2)) if on)


@dataclass(frozen=True)
class Modes:
    """Status 2. running: speed mode. forward: direction of the next motion. offline: the program starts by
    itself after power-up."""

    free: bool
    ext1_enabled: bool
    ext2_enabled: bool
    running: bool
    forward: bool
    offline: bool

    @classmethod
    def parse(cls, value: int) -> Modes:
        """From the reply to `O`."""
        return cls(*(bool(value >> bit & 1) for bit in range(6)))


@dataclass(frozen=True)
class Ports:
    """The port word. inputs, outputs: GPI1 and GPO1 in bit 0. ext1, ext2: levels of these pins."""

    inputs: int
    outputs: int
    ext1: bool
    ext2: bool

    @classmethod
    def parse(cls, word: int) -> Ports:
        """From the reply to `x`.

        >>> Ports.parse(0xE09)
        Ports(inputs=17, outputs=1, ext1=True, ext2=True)
        """
        inputs = word & 7 | (word >> 8 & 3) << 3
        return cls(inputs, word >> 3 & 31, bool(word >> 10 & 1), bool(word >> 11 & 1))

    def level(self, ext: int) -> bool:
        """Level of EXT1 or EXT2."""
        return self.ext2 if ext == 2 else self.ext1


class Storage(IntEnum):
    """What `V` replies about the EEPROM: the last save, burn or restore. Of this part only: the original
    does not know V."""

    KEPT = 0
    WORKING = 1
    FAILED = 2


STATUS_1_BITS, STATUS_2_BITS, PORT_BITS = 5, 6, 12
"""How many bits these read-outs have: a reply with others is none."""
