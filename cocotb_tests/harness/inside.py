"""`@inside("u_single.u_axis.rate", ...)`: inner signals that a cocotb test reads.

A build shows the ports of its top and hides everything else, which doubles the speed. What a test names here
is visible in a build of its own; with `INSIDE=1` (pytest --inside) everything is, in each build.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

from .build import Design

F = TypeVar("F")

_UNKNOWN = re.compile(r"AttributeError: .*contains no (child )?object")
HINT = "hidden in this build: @inside(…) or INSIDE=1"


def inside(*paths: str) -> Callable[[F], F]:
    """Decorator of a cocotb test, above or below the others: these signals, as paths below `dut`.

    Raises ValueError if there is none, or one that is no path.
    """
    if not paths or not all(re.fullmatch(r"\w+(\[\d+\])?(\.\w+(\[\d+\])?)*", path) for path in paths):
        raise ValueError(f"inside(): expected paths such as 'u_axis.rate', got {paths}")

    def mark(test: F) -> F:
        target: Any = getattr(test, "func", test)
        target._openppmc_inside = (*paths, *getattr(target, "_openppmc_inside", ()))
        return test

    return mark


def inside_of(test: Any) -> tuple[str, ...]:
    """What a test function (or cocotb test object) names."""
    return tuple(getattr(getattr(test, "func", test), "_openppmc_inside", ()))


def seen(design: Design, paths: tuple[str, ...], everything: bool = False) -> Design:
    """The design with these inner signals visible, or with everything."""
    if everything:
        return replace(design, ports=())
    return replace(design, inside=paths) if paths and design.ports else design


def hint(text: str, design: Design) -> str:
    """What to do if a failure says that a name is unknown, and the design has hidden ones; else nothing."""
    return HINT if design.ports and _UNKNOWN.search(text) else ""
