"""`make soak SEED= COUNT=`: random hosts without end, each against the golden model, edge by edge.

What a seed is, each part says in its column `soak` of the table of parts.
Seeds S, S+1, … S+N-1 run on J worker processes. A failure does not stop the rest; at the end the failing
seeds are listed with the line that repeats each. Exit code 1 if any failed.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from functools import partial
from typing import Protocol

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from cocotb_tests.harness.project import ProjectError, console
from openppmc import parts
from scripts.pool import as_done


class Campaign(Protocol):
    """What a part has in its column `soak`: `RandomItems`, or what does more with a seed."""

    def one(self, seed: int) -> tuple[int, str, str]:
        """Run one seed in this process; returns (seed, test id, message or "")."""
        ...

    def summary(self, first: int, count: int) -> str:
        """What has been done when all seeds have passed."""
        ...


def campaign(part_name: str) -> Campaign:
    """That of a part; ProjectError if it has none."""
    known = [row.name for row in parts.having("soak")]
    if part_name not in known:
        raise ProjectError(f"PART={part_name}: no random hosts of it (there are of {', '.join(known)})")
    found: Campaign = parts.part(part_name).load("soak")
    return found


def one(part_name: str, seed: int) -> tuple[int, str, str]:
    """Run one seed in this process, which may be a new one; returns (seed, test id, message or "")."""
    return campaign(part_name).one(seed)


def soak(part_name: str, first: int, count: int, jobs: int) -> int:
    """Run the seeds with a progress bar; returns the exit code."""
    failures: list[tuple[int, str]] = []
    done = 0
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("[red]{task.fields[bad]}"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console) as progress:
        task = progress.add_task(f"{part_name} seeds {first}…{first + count - 1}", total=count, bad="")
        try:
            seeds = range(first, first + count)
            for seed, name, message in as_done(partial(one, part_name), seeds, jobs):
                done += 1
                if message:
                    failures.append((seed, name))
                    console.print(f"[red]seed {seed} failed[/red]")
                    console.print(message, markup=False)
                bad = f"{len(failures)} failed" if failures else ""
                progress.update(task, advance=1, bad=bad)
        except KeyboardInterrupt:
            console.print("stopped by the keyboard")
    if failures:
        console.print(f"[red]{len(failures)} of {done} seeds failed[/red]; to repeat one:")
        for seed, name in sorted(failures):
            console.print(f"  make test T={name} SEED={seed}", markup=False)
        return 1
    console.print(f"{done} seeds passed: {campaign(part_name).summary(first, done)}")
    return 0 if done == count else 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.soak", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("part", nargs="?", default="ppmc104")
    parser.add_argument("--seed", type=int, default=1, help="first seed (default 1)")
    parser.add_argument("--count", type=int, default=1000, help="number of seeds (default 1000)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 2, help="worker processes")
    given = parser.parse_args(arguments)
    try:
        campaign(given.part)
        if given.count < 1 or given.jobs < 1:
            raise ProjectError("--count and --jobs must be 1 or more")
    except ProjectError as error:
        console.print(f"error: {error}", markup=False)
        return 2
    return soak(given.part, given.seed, given.count, given.jobs)


if __name__ == "__main__":
    sys.exit(main())
