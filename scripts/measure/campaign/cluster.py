"""The workers of a campaign: processes of this machine, or those that a scheduler on the network has.

Dask is imported when a cluster is opened, so that `make test` needs none of it.
"""

from __future__ import annotations

import argparse
import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from cocotb_tests.harness.project import ProjectError

SETTINGS = {
    # A worker that has become too slow to answer is not lost: simulators take all processors.
    "distributed.scheduler.worker-ttl": "15 minutes",
    "distributed.comm.timeouts.connect": "60s",
    # How often a job may lose its worker before it counts as failed. All jobs at a lost worker are blamed, so
    # that none waits there.
    "distributed.scheduler.allowed-failures": 3,
    "distributed.scheduler.worker-saturation": 1.0,
    "distributed.admin.system-monitor.gil.enabled": False,
}


@dataclass(frozen=True)
class Workers:
    """`count` processes of this machine, or all that `scheduler` (tcp://host:port) knows."""

    count: int = 2
    scheduler: str = ""

    def __post_init__(self) -> None:
        if self.count < 1:
            raise ProjectError("-n must be 1 or more")
        if self.scheduler and not re.fullmatch(r"(tcp|tls)://[^\s/]+:\d+", self.scheduler):
            raise ProjectError(f"SCHEDULER={self.scheduler}: expected tcp://host:port")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What each campaign takes on its command line."""
    parser.add_argument("-n", type=int, default=2, metavar="WORKERS", help="worker processes (2)")
    parser.add_argument("--scheduler", default="", metavar="TCP", help="use the workers of tcp://host:port")
    parser.add_argument("--fresh", action="store_true", help="take over no results of earlier runs")


def workers_of(arguments: argparse.Namespace) -> Workers:
    """Which workers the command line asks for."""
    return Workers(arguments.n, arguments.scheduler)


@contextmanager
def client(workers: Workers) -> Iterator[Any]:
    """A Dask client; workers of this machine end with it. ProjectError if nobody answers."""
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError:
        raise ProjectError("Dask is not in this environment: `make soak` and the like install it") from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with dask.config.set(SETTINGS):
        if workers.scheduler:
            try:
                found = Client(workers.scheduler, timeout=20)
            except (OSError, TimeoutError, ValueError) as error:
                line = (str(error).splitlines() or [type(error).__name__])[0]
                raise ProjectError(f"SCHEDULER={workers.scheduler}: no answer ({line})") from None
            with found:
                yield found
            return
        with (
            LocalCluster(
                n_workers=workers.count,
                threads_per_worker=1,
                processes=True,
                memory_limit=None,
                # A free port of this machine: without a word the usual one is taken, or complained about.
                dashboard_address="127.0.0.1:0",
                host="127.0.0.1",
                silence_logs=logging.CRITICAL,
            ) as cluster,
            Client(cluster) as local,
        ):
            yield local
