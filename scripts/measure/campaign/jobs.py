"""What a campaign is made of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Job:
    """One piece of work. `key` is unique in its campaign; `what` (it can be pickled) goes to the worker.

    stamp: what the result depends on besides the key, as a digest; "" stands for the tree.
    """

    key: str
    what: Any
    stamp: str = ""


@dataclass(frozen=True)
class Result:
    """What came of a job. Only a good one is taken over by a later run; `data` can be written as JSON."""

    good: bool
    data: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Done:
    """A job that has ended: on a worker, in so many s, or long ago (`old`)."""

    key: str
    good: bool
    data: Mapping[str, Any]
    seconds: float
    old: bool = False


@dataclass(frozen=True)
class Campaign:
    """`work(job.what)` for each of `count` jobs; name and key say which results on file are of the same."""

    name: str
    work: Callable[[Any], Result]
    jobs: Iterable[Job]
    count: int
    title: str = ""
