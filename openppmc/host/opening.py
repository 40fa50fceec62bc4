"""Opens a board with whatever part it carries."""

from __future__ import annotations

from typing import cast

from ..parts import by_number, having
from .axis.part import Part
from .basis.errors import WrongDevice
from .basis.kind import name_of
from .bridge.link import DEFAULT_BAUD, Link
from .ports.transport import Port


def driver_of(number: int, where: str = "") -> type[Part]:
    """The driver of the part with this number; WrongDevice if there is none."""
    row = by_number(number)
    if row is None or not row.driver:
        *most, last = (one.title for one in having("number", "driver"))
        raise WrongDevice(
            f"{where}: the part is a {name_of(number)}; there are drivers for {', '.join(most)} and {last}: "
            "renew the package"
        )
    return cast("type[Part]", row.load("driver"))


def open_part(spec: str | Port, baud: int = DEFAULT_BAUD, number: int | None = None) -> Part:
    """Open a port and take the driver of the part that is there (IDENT). number: the part that it must be.

    Raises WrongDevice for another part, or one without a driver.
    """
    link = Link(spec, baud, number)
    try:
        driver = driver_of(link.identity.part, link.name)
    except BaseException:
        link.close()
        raise
    return driver.on(link)
