"""Code that runs in a worker process in addition to the job."""

from __future__ import annotations

import os
import time
from functools import cache
from typing import Any

import psutil
from distributed import WorkerPlugin

from cocotb_tests.harness.project import ProjectError
from scripts.measure.campaign.jobs import Campaign, Result
from scripts.measure.campaign.tree import tree


@cache
def _own_tree() -> str:
    """Return the digest of the sources at the start of this process, which ignores later changes."""
    return tree()


class OwnSession(WorkerPlugin):  # type: ignore[misc]
    """Processes in a separate session, so that Ctrl-C does not reach the workers and their simulators."""

    name = "openppmc-own-session"

    def setup(self, worker: Any) -> None:
        """Set up a worker process, including a process that replaces a lost worker."""
        _own_tree()
        if os.getsid(0) != os.getpid() and os.getpgid(0) != os.getpid():
            os.setsid()


def stop_children() -> int:
    """Kill all processes that this worker has started, most of which are simulators; return their number."""
    children = psutil.Process().children(recursive=True)
    for child in children:
        try:
            child.kill()
        except psutil.NoSuchProcess:
            pass
    return len(children)


def carry_out(work: Any, what: Any, expected: str) -> tuple[Result, float]:
    """Run a job; return its result and its seconds. Raise ProjectError if this worker has other sources."""
    if expected != _own_tree():
        raise ProjectError(
            f"a worker has other sources than the campaign ({_own_tree()}, not {expected}); "
            "repeat without changing files"
        )
    begin = time.monotonic()
    result = work(what)
    if not isinstance(result, Result):
        raise TypeError(f"{Campaign.__name__}: the work of a job must return a {Result.__name__}")
    return result, time.monotonic() - begin
