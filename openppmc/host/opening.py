"""Opens a board with whatever part it carries."""

from __future__ import annotations

from typing import TypeAlias

from .basis.kind import KINDS, kind_of
from .bridge.link import DEFAULT_BAUD, Link
from .ports.transport import Port
from .ppmc104.driver import Ppmc104
from .ppmc312.driver import Ppmc312
from .ppmc2104.driver import Ppmc2104
from .stmc.driver import Stmc

AnyPart: TypeAlias = Ppmc104 | Ppmc2104 | Stmc | Ppmc312
DRIVERS: dict[int, type[AnyPart]] = {kind.kind.number: kind for kind in (Ppmc104, Ppmc2104, Stmc, Ppmc312)}
assert set(DRIVERS) == set(KINDS)


def open_part(spec: str | Port, baud: int = DEFAULT_BAUD, number: int | None = None) -> AnyPart:
    """Open a port and take the driver of the part that is there (IDENT). number: the part that it must be.

    Raises WrongDevice for another part, or one without a driver.
    """
    link = Link(spec, baud, number)
    try:
        kind_of(link.identity.part, link.name)
    except BaseException:
        link.close()
        raise
    return DRIVERS[link.identity.part].on(link)
