"""Functional coverage: what golden models go through while tests are compared, counted in crosses.

A part's `crosses` (its column in the table of parts) hooks into its golden model when coverage is wanted
(`coverage.COVERAGE`): the golden model sees what the RTL does, so neither side is changed for it. Counts go
to a file, a JSON list a comparison; `scripts.coverage` adds them up and makes a table of each cross.
"""

from __future__ import annotations

import functools
import json
import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from openppmc import parts

from .coverage import COVERAGE

SUFFIX = ".crosses"
_counts: Counter[tuple[str, ...]] = Counter()
_hooked: set[str] = set()


@dataclass(frozen=True)
class Cross:
    """A table with two axes. `rows` and `columns`: values as they are counted, all that the sheet knows.

    never: (row, column) -> why it cannot happen; "*" stands for each row or each column.
    """

    name: str
    rows: Sequence[str]
    columns: Sequence[str]
    never: Mapping[tuple[str, str], str] = field(default_factory=dict)

    def why_never(self, row: str, column: str) -> str:
        """Why this cannot happen; "" if it can."""
        places = ((row, column), (row, "*"), ("*", column))
        return next((self.never[place] for place in places if place in self.never), "")


@dataclass(frozen=True)
class Crosses:
    """Those of a part: `hook(count)` lets its golden model call count(cross, row, column)."""

    tables: Sequence[Cross]
    hook: Callable[[Callable[[str, str, str], None]], None]


def watch(part: str) -> None:
    """Count from now on in each golden model of a part, if coverage is wanted and the part has crosses."""
    if os.environ.get(COVERAGE) and part not in _hooked and parts.part(part).crosses:
        _hooked.add(part)
        found: Crosses = parts.part(part).load("crosses")
        found.hook(lambda cross, row, column: _counts.update([(part, cross, row, column)]))


def before(owner: type, method: str, look: Callable[..., None]) -> None:
    """Let `look(model, *arguments)` see each call of a golden model's method before it is carried out."""
    original: Any = getattr(owner, method)

    @functools.wraps(original)
    def seen(self: Any, *arguments: Any) -> Any:
        look(self, *arguments)
        return original(self, *arguments)

    setattr(owner, method, seen)


def after(owner: type, method: str, look: Callable[..., None]) -> None:
    """As `before`, with `look(model, result, *arguments)` behind the call."""
    original: Any = getattr(owner, method)

    @functools.wraps(original)
    def seen(self: Any, *arguments: Any) -> Any:
        result = original(self, *arguments)
        look(self, result, *arguments)
        return result

    setattr(owner, method, seen)


def leave() -> None:
    """Write down what was counted since the last call."""
    where = os.environ.get(COVERAGE)
    if where and _counts:
        Path(where).mkdir(parents=True, exist_ok=True)
        rows = [[*key, number] for key, number in _counts.items()]
        with open(Path(where) / f"{os.getpid()}{SUFFIX}", "a", encoding="utf-8") as file:
            file.write(json.dumps(rows) + "\n")
        _counts.clear()
