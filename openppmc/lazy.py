"""Packages that import a name at its first use (PEP 562).

Such a package has its imports twice: under `TYPE_CHECKING` for type checkers and editors, and as rows for
this module. `tests/common/test_lazy.py` compares both with `__all__`. The modules of the package import each
other and never the package, so a name loads only the modules that it needs.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any


def lazy(package: str, rows: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Return `__getattr__` and `__dir__` of a package.

    Args:
        rows: lines of a module, relative to the package, and names in it; `PUBLIC=NAME` renames one. Names of
            the module "." are modules themselves.
    """
    places = {}
    for module, *names in map(str.split, rows.strip().splitlines()):
        for name in names:
            public, _, own = name.partition("=")
            places[public] = module, own or public

    def load(name: str) -> Any:
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, own = places[name]
        if module == ".":
            return import_module(f".{own}", package)
        value = getattr(import_module(module, package), own)
        setattr(sys.modules[package], name, value)
        return value

    return load, lambda: sorted({*vars(sys.modules[package]), *places})
