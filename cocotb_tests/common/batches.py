"""Several seeds in one simulation: random tests of scripts, whose tapes each begin with a reset."""

from __future__ import annotations

from collections.abc import Sequence

from .collect import Item


def batches(items: Sequence[Item], size: int) -> list[tuple[Item, str]]:
    """(first item, all seeds) of each simulation: at most `size` items of one build each."""
    builds: dict[str, list[Item]] = {}
    for item in items:
        builds.setdefault(item.config.name, []).append(item)
    return [
        (group[k], " ".join(str(item.seed) for item in group[k : k + size]))
        for group in builds.values()
        for k in range(0, len(group), size)
    ]
