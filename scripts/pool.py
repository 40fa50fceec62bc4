"""Jobs on worker processes, results as they come."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from itertools import islice
from typing import TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")


def as_done(work: Callable[[Job], Result], todo: Iterable[Job], workers: int) -> Iterator[Result]:
    """`work(job)` for each job on this many processes, in the order in which they end.

    At most 2 * workers are under way, so Ctrl-C ends soon. Raises what a job raises; the jobs not yet begun
    are dropped then.
    """
    left = iter(todo)
    with ProcessPoolExecutor(workers) as pool:
        running = {pool.submit(work, job) for job in islice(left, 2 * workers)}
        try:
            while running:
                done, running = wait(running, return_when=FIRST_COMPLETED)
                running |= {pool.submit(work, job) for job in islice(left, len(done))}
                for future in done:
                    yield future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
