"""Kinds of tables and pictures: functions below scripts.pages, which docs/<folder>/figures.yml names."""

from __future__ import annotations

import pkgutil
from typing import Any


def made(entry: dict[str, Any]) -> Any:
    """Call the function that `kind` of an entry names, with the entry's other values; return its result."""
    arguments = {name: value for name, value in entry.items() if name != "kind"}
    return pkgutil.resolve_name(f"scripts.pages.{entry['kind']}")(**arguments)
