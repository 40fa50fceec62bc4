"""Directed tests of one build in few simulator processes, each with an outcome of its own."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

from . import mutant
from .collect import Item
from .outcome import MISSING, Outcome
from .simulate import Job, tried

MOST = 40
"""Tests in one process: two workers stay busy, and importing cocotb and pytest no longer counts."""

T = TypeVar("T")


def groups_of(things: Iterable[T], key: Callable[[T], Hashable]) -> list[tuple[T, ...]]:
    """Those with the same key, at most MOST together, in their order; who has the key None is alone."""
    found: dict[Hashable, list[T]] = {}
    for number, thing in enumerate(things):
        found.setdefault((number,) if (name := key(thing)) is None else (None, name), []).append(thing)
    return [
        tuple(members[k : k + size])
        for members in found.values()
        for size in [-(-len(members) // -(-len(members) // MOST))]
        for k in range(0, len(members), size)
    ]


def run_group(job: Job) -> dict[Item, tuple[Outcome, Job]]:
    """Outcome of each item of a job, and the process that it comes from.

    What a crash keeps from running has a new process, without the test that crashed; but one failure says all
    of a mutant.
    """
    found: dict[Item, tuple[Outcome, Job]] = {}
    left: Sequence[Item] = job.items
    while left:
        now = replace(job, items=tuple(left))
        outcomes = tried(now)
        left = [item for item, outcome in outcomes.items() if outcome.kind == MISSING]
        nothing_ran = len(left) == len(outcomes)
        if nothing_ran or mutant.present():
            left = []
        found |= {item: (outcome, now) for item, outcome in outcomes.items() if item not in left}
    return found


def fails(job: Job, items: Sequence[Item]) -> bool:
    """Whether the last of these items fails in a process of them."""
    outcome = tried(replace(job, items=tuple(items)))[items[-1]]
    return not outcome.good


def narrowed(job: Job, before: Sequence[Item], item: Item) -> list[Item]:
    """The fewest of the tests `before` that `item` fails behind, halving them while one half will do."""
    culprits = list(before)
    while len(culprits) > 1:
        middle = len(culprits) // 2
        for half in (culprits[middle:], culprits[:middle]):
            if fails(job, [*half, item]):
                culprits = half
                break
        else:
            break
    return culprits
