"""Parameters of tests, some of which are marked `slow`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import pytest


def slow_if(slow: Callable[[str], bool], names: Iterable[str]) -> list[Any]:
    """Return the names as parameters of a test; those for which `slow` returns True are marked."""
    return [pytest.param(name, marks=pytest.mark.slow if slow(name) else []) for name in names]
