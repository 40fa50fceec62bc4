"""Import of names at their first use (PEP 562), and old names with a warning.

A package whose names are imported at their first use lists its imports twice: under `TYPE_CHECKING` for type
checkers and editors, and as rows for this module. `tests/common/test_lazy.py` compares both lists with
`__all__`. The modules of the package import each other, but not the package. Therefore, the use of a name
imports only the modules that it needs.

After a public name is changed, the old name remains available for one minor version. For names in modules,
`renamed` or the argument `old` of `lazy` provides the old name; for attributes, `Renamed` provides it. Type
checkers do not know the old names.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def _warn(old: str, new: str) -> None:
    """Emit a DeprecationWarning at the line that uses the old name."""
    message = f"{old} is now {new}; the old name will be removed in the next minor version"
    warnings.warn(message, DeprecationWarning, stacklevel=3)


class Renamed:
    """Old name of an attribute or method.

    Its use emits a warning and returns the attribute with the new name.

    Attributes:
        name: new name.
    """

    def __init__(self, name: str) -> None:
        self.name = name

    def __set_name__(self, owner: type, name: str) -> None:
        self._old = name

    def __get__(self, instance: object, owner: type) -> Any:
        if instance is None:
            return self
        _warn(f"{owner.__name__}.{self._old}", self.name)
        return getattr(instance, self.name)


def renamed(module: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """Return the function `__getattr__` for a module with old names.

    Args:
        names: new name of each old name.
    """

    def load(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        _warn(f"{module}.{name}", names[name])
        return getattr(sys.modules[module], names[name])

    return load


def lazy(
    package: str, rows: str, old: Mapping[str, str] | None = None
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Return the functions `__getattr__` and `__dir__` for a package.

    Args:
        rows: lines that consist of the name of a module, relative to the package, and the names that it
            defines. `PUBLIC=NAME` makes its name NAME available as PUBLIC. In the row of ".", the names are
            modules of the package.
        old: new name of each old name.
    """
    places, old = {}, old or {}
    for module, *names in map(str.split, rows.strip().splitlines()):
        for name in names:
            public, _, own = name.partition("=")
            places[public] = module, own or public

    def load(name: str) -> Any:
        if name in old:
            _warn(f"{package}.{name}", old[name])
            name = old[name]
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, own = places[name]
        if module == ".":
            return import_module(f".{own}", package)
        value = getattr(import_module(module, package), own)
        setattr(sys.modules[package], name, value)
        return value

    return load, lambda: sorted({*vars(sys.modules[package]), *places})
