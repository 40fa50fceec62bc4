"""Registers of the PMC006B4 with legal values and factory values.

A page of the EEPROM holds the saved values of some registers.

Rules: P006-CMD (legal values), P006-EEP-10, -20.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass

MICROSTEPS = (0, 2, 4, 8, 16, 32, 64, 128)
SPEEDS = range(65, 3001)
BOTH = range(2)

LEGAL: dict[str, Container[int]] = {
    "addr": (*range(1, 121), 255),
    "mstep": MICROSTEPS,
    "cur": range(400, 4001),
    "acc": range(6),
    "dec": range(6),
    "autodec": BOTH,
    "att": range(1, 5),
    "trigm": range(4),
    "offline": BOTH,
    "vstart": SPEEDS,
    "vstop": SPEEDS,
    "ccomp": range(100, 1201),
    "scomp": range(300, 2001),
    "vmax": range(1, 16001),
    "dir": BOTH,
    "exten": range(4),
    "free": BOTH,
    "stlen": range(64),
    "stcfg": range(8),
    "stlvl": range(512),
    "pp": range(200),
}
"""Values that a host instruction or the EEPROM may write to each register.

Other parts of the controller also write 0 to `vmax` and 200 to `pp`.
"""


@dataclass
class Settings:
    """All registers except positions and flags. The defaults are the factory values."""

    addr: int = 255
    mstep: int = 16
    cur: int = 800
    acc: int = 0
    dec: int = 0
    autodec: int = 1
    att: int = 1
    trigm: int = 0
    offline: int = 0
    vstart: int = 600
    vstop: int = 600
    ccomp: int = 300
    scomp: int = 1250
    vmax: int = 1000
    dir: int = 1
    exten: int = 0
    free: int = 0
    gpo: int = 0
    stlen: int = 64
    stcfg: int = 0
    stlvl: int = 0
    pp: int = 0
    analog: int = 0

    def load(self, values: dict[str, int]) -> None:
        """Load values, for example from the EEPROM."""
        for name, value in values.items():
            setattr(self, name, value)


PAGE, MAGIC = 32, bytes((0x50, 0x36, 0x01))
PLACES: dict[str, tuple[int, int]] = {
    "addr": (3, 1),
    "mstep": (4, 1),
    "acc": (6, 1),
    "dec": (7, 1),
    "autodec": (8, 1),
    "att": (9, 1),
    "trigm": (10, 1),
    "offline": (11, 1),
    "vstart": (12, 2),
    "vstop": (14, 2),
    "ccomp": (16, 2),
    "scomp": (18, 2),
    "cur": (20, 2),
}
"""For each saved register, its position in the page and its number of bytes."""


def page_of(settings: Settings) -> bytes:
    """Return the parameter block that instruction t writes to the EEPROM."""
    page = bytearray(MAGIC + bytes(PAGE - 1 - len(MAGIC)))
    for name, (place, size) in PLACES.items():
        page[place : place + size] = int(getattr(settings, name)).to_bytes(size, "little")
    return bytes(page) + bytes([sum(page) % 256])


FACTORY_PAGE = page_of(Settings())


def framed(page: bytes) -> bool:
    """Return True if the header and the checksum of a block are valid."""
    return page[: len(MAGIC)] == MAGIC and sum(page[:-1]) % 256 == page[-1]


def values_of(page: bytes) -> dict[str, int] | None:
    """Return the registers of a block read from the EEPROM.

    The result is `None` if any register value is invalid (docs/pmc006/README.md, 14 EEPROM).
    """
    if not framed(page):
        return None
    values = {name: int.from_bytes(page[at : at + size], "little") for name, (at, size) in PLACES.items()}
    return values if all(value in LEGAL[name] for name, value in values.items()) else None
