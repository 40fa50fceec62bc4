"""Kinds of tables and pictures: functions below scripts.pages, which docs/<folder>/figures.yml names."""

from __future__ import annotations

import pkgutil
from typing import Any


def made(entry: dict[str, Any]) -> Any:
    """Return the result of the function that an entry names as its `kind`, called with the other values."""
    arguments = {name: value for name, value in entry.items() if name != "kind"}
    return pkgutil.resolve_name(f"scripts.pages.{entry['kind']}")(**arguments)
