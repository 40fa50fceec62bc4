"""What runs in a worker process beside the job."""

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
    """Of this process, when it began: what it has imported does not follow later changes."""
    return tree()


class OwnSession(WorkerPlugin):  # type: ignore[misc]
    """Ctrl-C on the terminal is for the campaign, not for its workers and their simulators."""

    name = "openppmc-own-session"

    def setup(self, worker: Any) -> None:
        """When a worker begins; also in one that replaces a lost one."""
        _own_tree()
        if os.getsid(0) != os.getpid() and os.getpgid(0) != os.getpid():
            os.setsid()


def stop_children() -> int:
    """End what this worker has started, simulators for the most part; how many processes."""
    children = psutil.Process().children(recursive=True)
    for child in children:
        try:
            child.kill()
        except psutil.NoSuchProcess:
            pass
    return len(children)


def carry_out(work: Any, what: Any, wanted: str) -> tuple[Result, float]:
    """One job, and the s that it took; ProjectError if this worker sees other sources than the campaign."""
    if wanted != _own_tree():
        raise ProjectError(
            f"a worker has other sources than the campaign ({_own_tree()}, wanted {wanted}): "
            "was a file changed meanwhile?"
        )
    begin = time.monotonic()
    result = work(what)
    if not isinstance(result, Result):
        raise TypeError(f"{Campaign.__name__}: the work of a job must return a {Result.__name__}")
    return result, time.monotonic() - begin
