"""`make scheduler` and `make worker SCHEDULER=tcp://host:port`: workers of a campaign on many machines.

`make worker` makes an environment in a checkout (or a shared folder) of the same commit and starts a worker
in it. A campaign that is started with the same SCHEDULER=… uses all these workers. If a worker has other
sources, an error is raised.
"""

from __future__ import annotations

import argparse
import os
import sys

from cocotb_tests.harness import project
from scripts.measure.campaign.cluster import Workers

PORT = 8786


def command(what: str, scheduler: str, count: int) -> list[str]:
    """Return the command of Dask with which this process is replaced."""
    if what == "scheduler":
        return ["dask_scheduler", "--port", str(PORT), "--no-dashboard"]
    words = ["dask_worker", scheduler, "--nworkers", str(count), "--nthreads", "1", "--memory-limit", "0"]
    return [*words, "--no-dashboard", "--local-directory", str(project.BUILD / "campaign")]


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m scripts.measure.campaign", description=__doc__)
    parser.add_argument("what", choices=("scheduler", "worker"))
    parser.add_argument("--scheduler", default="", help="tcp://host:port of the scheduler, for a worker")
    parser.add_argument(
        "-n", type=int, default=os.cpu_count() or 2, metavar="WORKERS", help="worker processes"
    )
    args = parser.parse_args()
    if args.what == "worker" and not args.scheduler:
        raise project.ProjectError("SCHEDULER is missing; add SCHEDULER=tcp://host:port")
    Workers(args.n, args.scheduler)
    program, *words = command(args.what, args.scheduler, args.n)
    environment = {**os.environ, "PYTHONPATH": str(project.ROOT), "DASK_DISTRIBUTED__WORKER__DAEMON": "False"}
    os.execve(sys.executable, [sys.executable, "-m", f"distributed.cli.{program}", *words], environment)


if __name__ == "__main__":
    raise SystemExit(project.run(main))
