"""Data types of a campaign."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Job:
    """One piece of work. `key` is unique in its campaign; `what` is sent to the worker and can be pickled.

    Attributes:
        stamp: digest of all that the result depends on, except the key; "" means the digest of the tree.
    """

    key: str
    what: Any
    stamp: str = ""


@dataclass(frozen=True)
class Result:
    """Result of a job. A later run reuses only good results; `data` can be written as JSON."""

    good: bool
    data: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Done:
    """A completed job: on a worker in `seconds`, or in an earlier run (`old`)."""

    key: str
    good: bool
    data: Mapping[str, Any]
    seconds: float
    old: bool = False


@dataclass(frozen=True)
class Campaign:
    """`work(job.what)` for each of `count` jobs; name and key identify a stored result."""

    name: str
    work: Callable[[Any], Result]
    jobs: Iterable[Job]
    count: int
    title: str = ""
