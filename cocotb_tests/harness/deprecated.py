"""Old names that emit a DeprecationWarning; they are removed after the next release."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

Load = Callable[[str], Any]


def with_old_names(module: str, names: Mapping[str, str], load: Load | None = None) -> Load:
    """Return a `__getattr__` of `module` that also finds old names.

    Args:
        names: old name -> "new_name", or "module:new_name" in another module.
        load: `__getattr__` of all other names.
    """

    def get(name: str) -> Any:
        if name not in names:
            if load is None:
                raise AttributeError(f"module {module!r} has no attribute {name!r}")
            return load(name)
        place, _, new = names[name].rpartition(":")
        text = (
            f"{module}.{name} is now {place or module}.{new}; the old name is removed after the next release"
        )
        warnings.warn(text, DeprecationWarning, stacklevel=2)
        return getattr(import_module(place or module), new)

    return get
