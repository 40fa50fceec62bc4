"""Data types that describe a campaign."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Job:
    """One piece of work; its `key` is unique in a campaign, and its `what` is sent to the worker by pickle.

    Attributes:
        stamp: digest of all that the result depends on, except the key; "" = digest of the tree.
    """

    key: str
    what: Any
    stamp: str = ""


@dataclass(frozen=True)
class Result:
    """Result of a job. A later run reuses the result only if it is `good`. `data` can be written as JSON."""

    good: bool
    data: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Done:
    """A completed job. It ran on a worker in `seconds`, or, if `old` is set, in an earlier run."""

    key: str
    good: bool
    data: Mapping[str, Any]
    seconds: float
    old: bool = False


@dataclass(frozen=True)
class Campaign:
    """A campaign calls `work(job.what)` for `count` jobs. Its name and the key of a job identify a result."""

    name: str
    work: Callable[[Any], Result]
    jobs: Iterable[Job]
    count: int
    title: str = ""
