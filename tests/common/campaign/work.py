"""Jobs for the campaigns of the tests. Each job that starts creates a file. Workers import this module."""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

from cocotb_tests.harness.project import ProjectError
from scripts.measure.campaign.cluster import Workers
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.campaign.store import Store


def note(folder: Path, number: int) -> None:
    """Create a file that records a start of a job."""
    (folder / f"{number}-{os.getpid()}-{time.monotonic_ns()}").touch()


def begun(folder: Path, number: int) -> int:
    """Return how often a job has started."""
    return len(list(folder.glob(f"{number}-*")))


def square(what: tuple[Path, int]) -> Result:
    """Return the square of the number; raise an error for 13."""
    folder, number = what
    note(folder, number)
    time.sleep(0.05)
    return Result(number != 13, {"square": number * number, "worker": os.getpid()})


def dies(what: tuple[Path, int]) -> Result:
    """Do the same as `square`, but 5 kills its worker the first time, as a power failure would."""
    folder, number = what
    if number == 5 and not begun(folder, 5):
        note(folder, number)
        os.kill(os.getpid(), signal.SIGKILL)
    return square(what)


def dies_always(what: tuple[Path, int]) -> Result:
    """Do the same as `square`, but 5 kills each worker."""
    if what[1] == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    return square(what)


def refuses(what: tuple[Path, int]) -> Result:
    """Raise an error for a mistake of the user that only the worker can detect."""
    raise ProjectError("no such thing")


def slow(what: tuple[Path, int]) -> Result:
    """Do the same as `square`, after a delay of 0.3 s."""
    time.sleep(0.3)
    return square(what)


def campaign(work: object, folder: Path, count: int, stamp: str = "") -> Campaign:
    """Return the campaign of jobs 0 … count - 1."""
    jobs = (Job(str(number), (folder, number), stamp) for number in range(count))
    return Campaign("test", work, jobs, count)  # type: ignore[arg-type]


def main() -> int:
    """Run twenty slow jobs, for the test of Ctrl-C: `python -m tests.common.campaign.work FOLDER`."""
    folder = Path(sys.argv[1])
    with Store(folder / "results.sqlite") as store:
        for done in run(campaign(slow, folder, 20), Workers(2), store=store):
            print(done.key, flush=True)
    return 0


if __name__ == "__main__":
    from cocotb_tests.harness.project import run as guarded

    raise SystemExit(guarded(main))
