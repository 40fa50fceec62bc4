"""The workers of a campaign: processes of this machine, or the workers of a scheduler on the network.

Dask is imported only when a cluster is opened, so that `make test` does not need it.
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
    # A slow worker must not be treated as lost: it may have to wait, because simulators use all processors.
    "distributed.scheduler.worker-ttl": "15 minutes",
    "distributed.comm.timeouts.connect": "60s",
    # A job has failed when it has lost its worker more often than this number. Dask counts a loss for all
    # jobs that are assigned to the worker. Therefore, no job may wait at a worker.
    "distributed.scheduler.allowed-failures": 3,
    "distributed.scheduler.worker-saturation": 1.0,
    "distributed.admin.system-monitor.gil.enabled": False,
}


@dataclass(frozen=True)
class Workers:
    """Workers: `count` processes of this machine, or all workers of `scheduler` (tcp://host:port)."""

    count: int = 2
    scheduler: str = ""

    def __post_init__(self) -> None:
        if self.count < 1:
            raise ProjectError("-n must be 1 or more")
        if self.scheduler and not re.fullmatch(r"(tcp|tls)://[^\s/]+:\d+", self.scheduler):
            raise ProjectError(f"SCHEDULER={self.scheduler}: expected tcp://host:port")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command-line arguments that all campaigns share."""
    parser.add_argument("-n", type=int, default=2, metavar="WORKERS", help="worker processes (2)")
    parser.add_argument("--scheduler", default="", metavar="TCP", help="use the workers of tcp://host:port")
    parser.add_argument("--fresh", action="store_true", help="ignore the results of earlier runs")


def workers_of(arguments: argparse.Namespace) -> Workers:
    """Return the workers that the command line selects."""
    return Workers(arguments.n, arguments.scheduler)


@contextmanager
def client(workers: Workers) -> Iterator[Any]:
    """Provide a Dask client. Workers on this machine end together with the client.

    The call raises ProjectError if there is no scheduler.
    """
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError:
        raise ProjectError("Dask is not in this environment; `make soak` installs it") from None
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
                # Use any free port of this machine, because Dask warns if the default port is in use.
                dashboard_address="127.0.0.1:0",
                host="127.0.0.1",
                silence_logs=logging.CRITICAL,
            ) as cluster,
            Client(cluster) as local,
        ):
            yield local
