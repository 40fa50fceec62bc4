"""Run a campaign on Dask: reuse stored results, run the other jobs on workers, store each result.

If a worker is lost, another one repeats its job. Ctrl-C ends the workers and their child processes; the next
run of the same campaign continues after the stored results.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import chain, islice
from typing import Any

from cocotb_tests.harness.project import ProjectError
from scripts.measure.campaign.cluster import Workers, client
from scripts.measure.campaign.jobs import Campaign, Done, Job
from scripts.measure.campaign.show import Show
from scripts.measure.campaign.store import RESULTS, Store
from scripts.measure.campaign.tree import tree

AHEAD = 3
"""Number of submitted jobs per worker: enough to keep it busy; few, because Ctrl-C discards them."""
LOST = "its workers were lost"


def run(
    campaign: Campaign, workers: Workers, fresh: bool = False, store: Store | None = None
) -> Iterator[Done]:
    """Yield the result of each job in order of completion, stored results first.

    An exception of a job is raised.

    Args:
        fresh: True to ignore stored results.
        store: file of results; default: the file of the project.
    """
    with store or Store(RESULTS) as file, Show(campaign.title or campaign.name, campaign.count) as show:
        now = tree()
        if fresh:
            file.forget(campaign.name)
        stamps: dict[str, str] = {}
        left: list[Job] = []

        def todo() -> Iterator[Job]:
            """Yield the jobs that have no stored result; append the stored results to `olds`."""
            for job in campaign.jobs:
                stamps[job.key] = job.stamp or now
                if (old := file.good(campaign.name, job.key, stamps[job.key])) is None:
                    yield job
                else:
                    olds.append(old)

        olds: list[Done] = []
        jobs = todo()
        # If all results are stored, the campaign needs no workers.
        left += islice(jobs, 1)
        fresh_ones = _on_workers(campaign, left, jobs, workers, now) if left else iter(())
        for done in _mixed(fresh_ones, olds):
            if not done.old:
                file.note(campaign.name, stamps.pop(done.key), done)
            show.step(done.good, done.old)
            yield done


def _mixed(fresh: Iterator[Done], olds: list[Done]) -> Iterator[Done]:
    """Yield the completed jobs, and after each of them the stored results that were found before it."""
    for done in chain([None], fresh):
        if done is not None:
            yield done
        while olds:
            yield olds.pop(0)


def _on_workers(
    campaign: Campaign, first: list[Job], jobs: Iterator[Job], workers: Workers, now: str
) -> Iterator[Done]:
    with client(workers) as dask:
        from distributed import as_completed

        from scripts.measure.campaign.on_worker import OwnSession, carry_out, stop_children

        dask.register_plugin(OwnSession())

        def submit(job: Job) -> Any:
            with _ctrl_c_waits():
                future = dask.submit(carry_out, campaign.work, job.what, now, pure=False)
            keys[future.key] = job.key
            return future

        keys: dict[str, str] = {}
        window = AHEAD * max(workers.count, len(dask.scheduler_info()["workers"]))
        running = as_completed([submit(job) for job in [*first, *islice(jobs, window - 1)]])
        try:
            for future in running:
                for job in islice(jobs, 1):
                    running.add(submit(job))
                yield _ended(future, keys.pop(future.key))
        finally:
            if keys:
                dask.cancel([future for future in running.futures], force=True)
                if not workers.scheduler:
                    with suppress(Exception):  # the campaign is ending
                        dask.run(stop_children)


@contextmanager
def _ctrl_c_waits() -> Iterator[None]:
    """Delay Ctrl-C to the end of this context, because half a Future of Dask prints a traceback."""
    pressed: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        for number in pressed[:1]:
            signal.raise_signal(number)


def _ended(future: Any, key: str) -> Done:
    from distributed import KilledWorker

    try:
        result, seconds = future.result()
    except KilledWorker:
        return Done(key, False, {"message": LOST}, 0.0)
    except ProjectError:
        raise
    return Done(key, result.good, dict(result.data), seconds)
