"""Generated content of the pages of a part, defined in its manual.py, which the table of parts names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Manual:
    """tables: marker in the part's README.md -> Markdown. plots: name -> SVG. diagrams: name -> WaveDrom."""

    tables: Mapping[str, Callable[[], str]] = field(default_factory=dict)
    plots: Mapping[str, Callable[[], bytes]] = field(default_factory=dict)
    diagrams: Mapping[str, Callable[[], dict[str, Any]]] = field(default_factory=dict)
