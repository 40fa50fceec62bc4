"""Data types of a campaign."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Job:
    """One piece of work; its `key` is unique in a campaign, and its `what` is sent to the worker by pickle.

    Attributes:
        stamp: digest of all that the result depends on, except the key; "" means the digest of the tree.
    """

    key: str
    what: Any
    stamp: str = ""


@dataclass(frozen=True)
class Result:
    """Result of a job; a later run reuses it only if it is `good`. `data` can be written as JSON."""

    good: bool
    data: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Done:
    """A completed job: it ran on a worker in `seconds`, or in an earlier run (`old`)."""

    key: str
    good: bool
    data: Mapping[str, Any]
    seconds: float
    old: bool = False


@dataclass(frozen=True)
class Campaign:
    """A campaign calls `work(job.what)` for each of `count` jobs; name and key identify a stored result."""

    name: str
    work: Callable[[Any], Result]
    jobs: Iterable[Job]
    count: int
    title: str = ""
